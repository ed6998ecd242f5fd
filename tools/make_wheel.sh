#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Makes the Python wheel tenon-usd out of build/release: dist/tenon_usd-*.whl. The tools that it
# takes (python/requirements.txt) are kept in ~/.cache/tenon, made once for each list of them.
#   tools/make_wheel.sh [PYTHON]    for that interpreter; the first of 3.11 and later otherwise
# What is not made because something is missing here is said in build/wheel.missing, with exit 0.
set -euo pipefail
cd "$(dirname "$0")/.."
jobs=${JOBS:-$(nproc)}

give_up() {
  mkdir -p build
  echo "no wheel: $1" | tee build/wheel.missing >&2
  exit 0
}

is_usable() { # 3.11 or later, with headers
  "$1" -c 'import os, sys, sysconfig
sys.exit(sys.version_info < (3, 11) or
         not os.path.exists(os.path.join(sysconfig.get_paths()["include"], "Python.h")))' \
    2>/dev/null
}

python=${1:-}
if [ -z "$python" ]; then
  for python in python3 python3.11 python3.12 python3.13 python3.14 ""; do
    [ -n "$python" ] && is_usable "$python" && break
  done
fi
[ -n "$python" ] && is_usable "$python" ||
  give_up "no Python 3.11 or later with its headers (apt-get install python3-dev python3-venv)"
rm -f build/wheel.missing

tools_of() { # the environment of the tools, made where it is missing
  local key folder
  key=$({ "$python" -c 'import sys; print(sys.executable, sys.version)'; \
    cat python/requirements.txt; } | sha256sum | cut -c1-12)
  folder=${XDG_CACHE_HOME:-$HOME/.cache}/tenon/wheel-$key
  if [ ! -e "$folder/made" ]; then
    rm -rf "$folder"
    "$python" -m venv "$folder" >&2 &&
      "$folder/bin/python" -m pip install --quiet --disable-pip-version-check --no-input \
        --only-binary=:all: --require-hashes -r python/requirements.txt >&2 &&
      touch "$folder/made" || return 1
  fi
  echo "$folder/bin"
}
bin=$(tools_of) || give_up "pip could not install python/requirements.txt (no network?)"

cmake --build build/release -j "$jobs" --target all tenon_shared_cli tenon_shared_worker \
  >build/wheel.log ||
  { tail -n 40 build/wheel.log >&2; exit 1; }

# What is installed, with the program over the library in the place of the one that stands alone.
prefix=$PWD/build/wheel/prefix
rm -rf "$prefix"
cmake --install build/release --component runtime --prefix "$prefix" --strip >>build/wheel.log
mkdir -p "$prefix/bin"
cp build/release/shared_bin/tenon "$prefix/bin/tenon"
cp build/release/shared_bin/tenon-worker "$prefix/libexec/tenon/tenon-worker"
# A machine with no more than Python has no meshoptimizer, which packs what pages show.
meshoptimizer=$(sed -n 's/^TENON_MESHOPTIMIZER_LIBRARY:[A-Z]*=//p' build/release/CMakeCache.txt)
meshoptimizer=$(readlink -f "$meshoptimizer")
soname=$("$bin/patchelf" --print-soname "$meshoptimizer")
cp "$meshoptimizer" "$prefix/lib/tenon/$soname"
strip "$prefix/lib/tenon/$soname"
# Nor NLopt, which searches gains. Parts of it are under the LGPL, so it stays a library of its own.
nlopt=$(sed -n 's/^TENON_NLOPT_LIBRARY:[A-Z]*=//p' build/release/CMakeCache.txt)
if [ -e "$nlopt" ]; then
  soname=$("$bin/patchelf" --print-soname "$nlopt")
  cp "$(readlink -f "$nlopt")" "$prefix/lib/tenon/$soname"
  mkdir -p "$prefix/share/doc/tenon/nlopt"
  cp /usr/share/common-licenses/LGPL-2.1 "$prefix/share/doc/tenon/nlopt"
fi
# Also what came as it is: names of its own functions, which only a debugger asks for.
strip "$prefix/bin/tenon" "$prefix/libexec/tenon/tenon-worker" "$prefix"/lib/tenon/libmujoco.so.*
for library in "$prefix"/lib/tenon/coacd/lib_coacd.so; do
  [ ! -e "$library" ] || strip "$library"
done
# A name that no other MuJoCo of the process has: the loader tells libraries apart by it.
for library in "$prefix"/lib/tenon/libmujoco.so.*; do
  "$bin/patchelf" --set-soname "libtenon-mujoco.so" "$library"
done
"$bin/patchelf" --set-rpath "\$ORIGIN/../lib" "$prefix/bin/tenon"
"$bin/patchelf" --set-rpath "\$ORIGIN/../../lib" "$prefix/libexec/tenon/tenon-worker"

rm -rf build/wheel/raw
# CMake and ninja are those of the system. Debian 12's pip 23.0 knows no -C.
CMAKE_BUILD_PARALLEL_LEVEL=$jobs PATH="$bin:$PATH" "$bin/python" -m pip wheel ./python --quiet \
  --disable-pip-version-check --no-build-isolation --no-deps --wheel-dir build/wheel/raw \
  --config-settings build-dir="$PWD/build/wheel/{wheel_tag}" \
  --config-settings cmake.define.TENON_PREFIX="$prefix"
rm -rf build/wheel/repaired
PATH="$bin:$PATH" "$bin/auditwheel" repair build/wheel/raw/*.whl --wheel-dir build/wheel/repaired \
  >>build/wheel.log 2>&1 || { tail -n 20 build/wheel.log >&2; exit 1; }
mkdir -p dist
for repaired in build/wheel/repaired/*.whl; do
  # Not two of one package for pip to choose from.
  rm -f dist/"$(basename "$repaired" | cut -d- -f1-3)"-*.whl
  "$bin/python" tools/pack_wheel.py "$repaired" "dist/$(basename "$repaired")"
  # What was made, and for which Python: for the tests.
  echo "$PWD/dist/$(basename "$repaired")" >build/wheel/made
done
command -v "$python" >build/wheel/python
echo "$bin" >build/wheel/tools
ls -l "$(cat build/wheel/made)"
