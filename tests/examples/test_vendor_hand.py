#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The layer of gains in examples/vendor_hand moves the vendor's hand alike on every engine, and
with gains by `tenon tune` it holds a can on each (vendor_grasp.py).

    test_vendor_hand.py ROOT TENON

Exit 77, with the reason, where ../shared is absent.
"""

import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import vendor_grasp

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT.parent / "shared"))
ASSET = SHARED / "assets/inspire_hand_isaac/inspire_hand.usda"
GAINS = ROOT / "examples/vendor_hand/gains.usda"
# Follower, leader, multiplier.
LAWS = [("R_thumb_intermediate", "R_thumb_proximal_pitch", 1.6),
        ("R_thumb_distal", "R_thumb_proximal_pitch", 2.4),
        *((f"R_{finger}_intermediate", f"R_{finger}_proximal", 1)
          for finger in ("index", "middle", "ring", "pinky"))]
WITHIN = 0.3  # [deg], as the example says


def tenon(*arguments):
    process = subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                             check=False)
    if process.returncode != 0:
        sys.exit(f"{arguments}: exit {process.returncode}\n{process.stderr}")
    return process.stdout


def off_law(rows):
    def angle(row, name):
        return float(row[f"/Lhand/Physics/{name}_joint.position"])

    return max(abs(angle(row, follower) - factor * angle(row, leader))
               for row in rows for follower, leader, factor in LAWS)


def main():
    if not ASSET.exists():
        print(f"skipped: {ASSET} does not exist")
        return 77
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        # The layer that the example's page shows, between assets that lie elsewhere.
        page = (ROOT / "examples/vendor_hand/README.md").read_text()
        text = re.search(r"(    #usda 1\.0\n(?:    .*\n)+)", page).group(1)
        hand = pathlib.Path(folder) / "moving_hand.usda"
        hand.write_text(re.sub(r"^    ", "", text, flags=re.MULTILINE)
                        .replace("@gains.usda@", f"@{GAINS}@")
                        .replace("@inspire_hand.usda@", f"@{ASSET}@"))
        engines = [one["name"] for one in json.loads(tenon("doctor", "--json"))["engines"]
                   if one["available"]]
        if len(engines) > 1:
            told = json.loads(tenon("compare", hand, "--physics", "physx", "--no-reasons",
                                    "--fail-above", f"jointAngle={WITHIN}deg", "--json"))
            if told["duration"] != 5 or len(told["engines"]) != len(engines):
                faults.append(f"compared {told['duration']} s on {len(told['engines'])} engines")
        for engine in engines:
            log = pathlib.Path(folder) / f"{engine}.csv"
            tenon("sim", hand, "--physics", "physx", "--engine", engine, "--fps", 30, "-o", log)
            rows = list(csv.DictReader(log.read_text().splitlines()))
            closed = float(rows[75]["/Lhand/Physics/R_index_proximal_joint.position"])
            if off_law(rows) > WITHIN or abs(closed - 40) > 0.5:
                faults.append(f"{engine}: {off_law(rows)} degrees off the laws, closed to {closed}")
        faults += vendor_grasp.faults_of(tenon, ASSET, engines, folder)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
