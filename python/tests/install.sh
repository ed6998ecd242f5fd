#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Makes the wheel (tools/make_wheel.sh) and installs it where its tests run:
#   build/wheel/clean    a new environment with the wheel and NumPy alone
#   build/wheel/beside   a link to an environment, kept in ~/.cache/tenon, with what the tests take
#                        beside it (requirements.txt); its tests get the wheel by PYTHONPATH
# Exit 77 where there is no wheel, or nothing to install it with; it says why.
set -euo pipefail
cd "$(dirname "$0")/../.."
wheel=build/wheel
rm -rf "$wheel/clean" "$wheel/beside"
tools/make_wheel.sh >/dev/null
[ ! -e build/wheel.missing ] || { cat build/wheel.missing; exit 77; }
python=$(cat "$wheel/python")
made=$(cat "$wheel/made")

key=$({ "$python" -c 'import sys; print(sys.executable, sys.version)'; \
  cat python/tests/requirements.txt; } | sha256sum | cut -c1-12)
kept=${XDG_CACHE_HOME:-$HOME/.cache}/tenon/python-tests-$key
pip() { "$kept/bin/python" -m pip --quiet --disable-pip-version-check --no-input "$@"; }
if [ ! -e "$kept/made" ]; then
  rm -rf "$kept"
  "$python" -m venv "$kept" &&
    pip download --no-deps --only-binary=:all: --require-hashes \
      -r python/tests/requirements.txt --dest "$kept/wheels" &&
    pip install --no-index --no-deps "$kept"/wheels/*.whl &&
    touch "$kept/made" ||
    { echo "skipped: pip could not install python/tests/requirements.txt (no network?)"; exit 77; }
fi
ln -s "$kept" "$wheel/beside"
"$python" -m venv --without-pip "$wheel/clean"
pip --python "$wheel/clean/bin/python" install --no-index --find-links "$kept/wheels" "$made"
