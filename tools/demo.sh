#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# The demonstration behind `make demo`: the example hand closes on an object and holds it.
#   tools/demo.sh BUILD
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
tenon=$build/bin/tenon
hand=examples/inspire_hand/inspire_hand.usda
grasp=examples/inspire_hand/grasp.usda
motion=build/demo/grasp_motion.usda
log=build/demo/grasp.csv
page=build/demo/grasp.html
picture=build/demo/grasp.png

step() { # step WORDS -- COMMAND: say it, show the command, run it
  local words=$1
  shift 2
  printf '\n== %s\n   $ %s\n\n' "$words" "$*"
  "$@"
}

mkdir -p build/demo
step "What the asset is, with its neutral physics switched on" -- \
  "$tenon" info "$hand" --physics physics
step "Simulate the grasp on MuJoCo, follow the drive targets of grasp.usda, log it and bake it" -- \
  "$tenon" sim "$grasp" --physics mujoco --duration 4 -o "$log" --bake "$motion"

# Rows of the log at a few times: the table leaves, the can stays.
printf '\n== The hand holds the can while the table sinks (heights in metres)\n\n'
awk -F, '
  NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i
            printf "%8s %12s %12s\n", "time [s]", "can", "table"; next }
  (NR - 2) % 60 == 0 { printf "%8.2f %12.4f %12.4f\n", $1, $column["/World/can.position.z"],
                       $column["/World/table.position.z"] }' "$log"

# The page is built where node 18 and npm are, and a Chromium draws it. Neither has to be here.
looked_at=
if [ -e "$build/share/tenon/page/report.html" ]; then
  step "One page with all of it" -- \
    "$tenon" report "$grasp" --physics mujoco --duration 4 -o "$page"
  looked_at="   $page             the same in one page: open it in a browser and press play
"
  said=build/demo/record.txt
  if step "A picture of its end: the hand holds the can above the table" -- \
    "$tenon" record "$grasp" --physics mujoco --time 4 -o "$picture" --size 960x540 2>"$said"; then
    looked_at+="   $picture              the hand that holds the can
"
  elif [ $? -eq 4 ]; then # exit code 4: missing
    printf '\n== No picture without a Chromium: apt-get install chromium, then make demo again\n'
  else
    cat "$said" >&2
    printf '\n== No picture: Chromium failed as told above; make demo tries again\n'
  fi
else
  printf '\n== No picture without node 18, npm and a Chromium: %s\n' \
    "apt-get install nodejs npm chromium, then make demo again"
fi

cat <<END

== What to look at
$looked_at   $motion   open it in any USD viewer and press play
   $log                every joint and body over time, for a spreadsheet
   $hand   the asset: start reading here

== Try a file of your own
   $tenon info FILE.usda                     what it is, what is missing
   $tenon physics FILE.usda --json           what an engine would receive, in SI units
   $tenon sim FILE.usda --duration 5         simulate it
   $tenon bake FILE.usda -o motion.usda      and look at the motion
   $tenon view FILE.usda                     or in the browser, live
   $tenon record FILE.usda -o motion.webm    or as a film, or a picture (.png)
   $tenon --help                             everything else

$tenon is compiled without optimisation and hardening; make build makes the one to keep.
END
