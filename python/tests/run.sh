#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# run.sh ENVIRONMENT SCRIPT...: runs a test in an environment of install.sh, with the wheel of the
# clean one; exit 77 where there is none.
set -eu
environment=$(cd "$1" 2>/dev/null && pwd || true)
shift
[ -x "$environment/bin/python" ] ||
  { echo "skipped: no package (python/tests/install.sh)"; exit 77; }
for packages in "$(dirname "$0")"/../../build/wheel/clean/lib/python*/site-packages; do
  PYTHONPATH=$(cd "$packages" && pwd)
  export PYTHONPATH
done
exec "$environment/bin/python" -B "$@"
