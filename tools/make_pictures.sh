#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Makes all pictures of docs/images anew, with `tenon record` of build/release and a Chromium.
#   tools/make_pictures.sh [FOLDER]     elsewhere, to compare
# Exit 0: all made; a file of docs/images that has no line here is an error.
set -euo pipefail
cd "$(dirname "$0")/.."
tenon=build/release/bin/tenon
hand=examples/inspire_hand/inspire_hand.usda
grasp=examples/inspire_hand/grasp.usda
folder=${1:-docs/images}
made=()

picture() { # picture NAME ASSET [OPTION...]
  local name=$1 asset=$2
  shift 2
  "$tenon" record "$asset" -o "$folder/$name" --quiet "$@"
  made+=("$name")
}

mkdir -p "$folder"
picture report.png "$grasp" --physics mujoco --panels --time 2 --size 1100x620
picture joints.png "$hand" --physics physics --show joints,limits --hide grid --size 800x450

made+=(film.webp) # by tools/make_film.sh
for file in docs/images/*; do
  [[ $file == */walk-* ]] && continue # made by tests/browser/tests/walk.mjs --write
  [[ " ${made[*]} " == *" ${file##*/} "* ]] || {
    echo "make_pictures: ${file##*/} has no line in tools/make_pictures.sh" >&2
    exit 1
  }
done
echo "${#made[@]} pictures in $folder"
