#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# For the judge: the wheel of the stable interface (cp312-abi3) under every Python from 3.12 on that
# is found, as python3.N or with pyenv. The last line names those that were and were not.
set -euo pipefail
cd "$(dirname "$0")/../.."
good="" missing="" wheel=""
for version in 3.12 3.13 3.14; do
  found=""
  for python in "python$version" "$HOME/.pyenv/versions/$version".*/bin/python; do
    "$python" -c 'import ensurepip, venv' 2>/dev/null && found=$python && break
  done
  [ -n "$found" ] || { missing+=" $version"; continue; }
  if [ -z "$wheel" ]; then
    tools/make_wheel.sh "$found" >/dev/null
    wheel=$(cat build/wheel/made)
  fi
  folder=build/wheel/python$version
  rm -rf "$folder"
  "$found" -m venv "$folder"
  "$folder/bin/python" -m pip install --quiet --disable-pip-version-check numpy "$wheel"
  for test in arrays dynamics edits functions package physics processes stage world; do
    "$folder/bin/python" -B "python/tests/test_$test.py"
  done
  good+=" $version"
done
echo "tested:${good:- none}; not found:${missing:- none}"
[ -n "$good" ]
