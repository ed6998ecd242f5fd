#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# For the judge: the tests of the Python package with library and extension under address and
# undefined-behaviour sanitizers. Needs the archives of build/dev (targets tenon_asset and
# tenon_worker) and what python/tests/install.sh makes.
set -euo pipefail
cd "$(dirname "$0")/../.."
clean=$PWD/build/wheel/clean
tools=$(cat build/wheel/tools)
folder=$PWD/build/python_sanitized
PATH="$tools:$PATH" cmake -S python -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
  -DTENON_SANITIZED="$PWD/build/dev" -Dnanobind_DIR="$("$tools/python" -m nanobind --cmake_dir)" \
  -DPython_EXECUTABLE="$tools/python" >"$folder.log" ||
  { tail "$folder.log"; exit 1; }
PATH="$tools:$PATH" cmake --build "$folder/build" --target _tenon >>"$folder.log" ||
  { tail -n 30 "$folder.log"; exit 1; }
rm -rf "$folder/tenon_usd"
mkdir -p "$folder/tenon_usd"
cp python/tenon_usd/*.py "$folder/tenon_usd/"
ln -sf "$folder"/build/_tenon*.so "$folder/tenon_usd/"
ln -s "$PWD/build/dev/libexec" "$folder/tenon_usd/libexec"
export PYTHONPATH=$folder ASAN_OPTIONS=detect_leaks=0:detect_odr_violation=0
# Python's own allocator would hide what is freed too early.
export PYTHONMALLOC=malloc
preload="$(c++ -print-file-name=libasan.so) $(c++ -print-file-name=libubsan.so)"
run() { LD_PRELOAD="$preload" "$clean/bin/python" -B "$@"; }
for test in arrays dynamics edits functions physics stage world; do
  run "python/tests/test_$test.py"
done
run python/tests/many_opens.py 50 4 --sanitized
echo "stages, physics, dynamics, worlds, functions and threads without a fault"
