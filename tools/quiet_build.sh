#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Configures and builds a preset without its hundreds of lines: one line that counts on a terminal,
# a first and a last one elsewhere. What the tools say goes to build/PRESET/build.log, and is shown
# when something fails.
#   tools/quiet_build.sh PRESET JOBS TARGET...
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1 jobs=$2
shift 2
folder=build/$preset
log=$folder/build.log
mkdir -p "$folder"
: >"$log"

# Its units are large: no more compilers than the memory has room for, 2.2 GB each.
if [ "$preset" = quick ]; then
  room=$(awk '/^MemAvailable:/ { print int($2 / 2200000) }' /proc/meminfo)
  [ "$room" -ge "$jobs" ] || jobs=$((room > 1 ? room : 1))
fi

fail() {
  [ -t 2 ] && printf '\r\033[K' >&2
  cat "$log" >&2
  echo "The build failed; its log is $log" >&2
  exit 1
}

show() { # show WORDS: replaces the line on a terminal
  [ ! -t 2 ] || printf '\r\033[K%s' "$1" >&2
}

show "Configuring $folder ..."
[ -t 2 ] || echo "Building $folder ..." >&2
# Each time: what was missing when it was configured first may be installed by now.
cmake --preset "$preset" >>"$log" 2>&1 || fail

build() { # what ninja says, line by line, and its exit code
  NINJA_STATUS='[%f/%t] ' cmake --build "$folder" -j "$jobs" --target "$@" 2>&1
}
build "$@" | while IFS= read -r line; do
  printf '%s\n' "$line" >>"$log"
  if [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
    show "Building: ${BASH_REMATCH[1]} of ${BASH_REMATCH[2]} steps"
  fi
done || fail
show ""
[ -t 2 ] || echo "Built $folder in $((SECONDS / 60)) min $((SECONDS % 60)) s" >&2
