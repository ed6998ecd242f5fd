#!/bin/sh
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# run_mutants.sh DRIVER PROGRAM OPTIONS...: skips (77) where the program is not built.
driver=$1
program=$2
shift 2
if [ ! -x "$program" ]; then
  echo "skipped: no $program; make test builds it"
  exit 77
fi
exec "$driver" --program "$program" "$@"
