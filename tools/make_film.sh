#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Makes the film of README.md, docs/images/film.webp: the example hand as URDF becomes a checked
# USD, which then grasps a can on MuJoCo, PhysX and Jolt. Every line of text in it is what the
# commands print. Needs build/release with every engine, a Chromium, ffmpeg and a font (DejaVu).
#   tools/make_film.sh [FILE]     elsewhere, to compare
set -euo pipefail
cd "$(dirname "$0")/.."
PATH=$PWD/build/release/bin:$PATH
film=$(realpath -m "${1:-docs/images/film.webp}")
examples=$PWD/examples/inspire_hand
font=$(fc-match -f '%{file}' 'DejaVu Sans Mono')
work=build/film
width=900 height=380 fps=12
rm -rf "$work"
mkdir -p "$work"
cd "$work"

# The robot as others would hand it over.
tenon convert "$examples/inspire_hand.usda" hand.urdf -q

say() { # say COMMAND: runs it; the words of the film are the command and what it prints
  printf '$ %s\n' "$1"
  bash -c "$1" 2>&1 | cut -c 1-90
}

title() { # title NAME SECONDS WORDS...: text on dark ground
  ffmpeg -v error -y -f lavfi -i "color=0x0d1117:size=${width}x$height:rate=$fps:duration=$2" -vf \
    "drawtext=fontfile=$font:textfile=$3:x=30:y=20:fontsize=15:line_spacing=4:fontcolor=0xe6edf3" \
    "$1.mkv"
}

say "grep -m 1 -A 5 'joint name=\"right_index_1' hand.urdf" >first.txt
echo >>first.txt
say 'tenon convert hand.urdf hand/ --gains 2.86,0.086 -q' >>first.txt
say 'ls hand/payloads/Physics' >>first.txt
echo >>first.txt
say 'tenon check hand/inspire_hand.usda' >>first.txt
title first 5 first.txt

# The example's grasp, with the hand that was just converted.
sed -e 's,@./inspire_hand.usda@,@./hand/inspire_hand.usda@,' "$examples/grasp.usda" >grasp.usda
inputs=() labels=""
for engine in mujoco physx jolt; do
  tenon record grasp.usda --engine "$engine" --duration 4 --fps "$fps" \
    --size "$((width / 3))x$height" -o "$engine.mp4" --quiet
  inputs+=(-i "$engine.mp4")
done
number=0
for name in MuJoCo PhysX Jolt; do
  labels+="[$number]drawtext=fontfile=$font:text=$name:x=16:y=16:fontsize=20:fontcolor=black"
  labels+="[$name];"
  number=$((number + 1))
done
ffmpeg -v error -y "${inputs[@]}" -filter_complex "${labels}[MuJoCo][PhysX][Jolt]hstack=3" \
  -r "$fps" second.mkv
ffmpeg -v error -y -i first.mkv -i second.mkv -filter_complex \
  "[0]format=yuv420p[a];[1]format=yuv420p,setsar=1[b];[a][b]concat=n=2" \
  -r "$fps" -c:v libwebp_anim -loop 0 -quality 70 -compression_level 6 "$film"
ls -l "$film"
