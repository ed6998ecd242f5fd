#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Runs ctest and shows what did not pass, one line for a hundred tests that did, the end, and which
# tests skipped and why. All that ctest says is in build/PRESET/tests.log. With TENON_STRICT_SKIPS=1
# a test that skips and is not in tools/allowed_skips.txt fails the run.
#   tools/quiet_tests.sh PRESET OPTIONS_OF_CTEST...
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
shift

begun='^ +Start +[0-9]+: '
ended='^ *([0-9]+)/([0-9]+) Test .* Passed '
ctest --preset "$preset" "$@" 2>&1 | tee "build/$preset/tests.log" |
  while IFS= read -r line; do
    if [[ $line =~ $ended ]]; then
      [ $((BASH_REMATCH[1] % 100)) -ne 0 ] ||
        echo "$((SECONDS / 60)) min: ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]} tests"
    elif ! [[ $line =~ $begun ]]; then
      printf '%s\n' "$line"
    fi
  done || failed=$?
python3 tools/skipped_tests.py "build/$preset/tests.log" \
  "build/$preset/Testing/Temporary/LastTest.log" \
  ${TENON_STRICT_SKIPS:+--strict} || failed=${failed:-$?}
exit "${failed:-0}"
