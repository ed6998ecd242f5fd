#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Simulates examples/inspire_hand/grasp.usda on every engine of this build and judges whether the
hand holds the can.

    test_grasp.py ROOT TENON

Exit 0: held; 1: each fault on a line; 77: no engine. After four seconds, 1.4 s after the table
has gone, the can must be within 2 cm of where it stood and not on the ground; the mimic
chains must keep their laws within half a degree.
"""

import json
import math
import pathlib
import subprocess
import sys

SKIPPED = 77
HAND = "/World/inspire_hand/Physics"
LAWS = [("right_thumb_3", "right_thumb_2", 1.6, 0.0),
        ("right_thumb_4", "right_thumb_3", 0.7508, -0.1)]
LAWS += [(f"right_{name}_2", f"right_{name}_1", 1.0, 0.0)
         for name in ("index", "middle", "ring", "little")]
CAN_AT_START = (0.0425, 0.0045, 0.235)
TABLE_DROP = 0.14


def run(tenon, *arguments):
    command = [tenon, *map(str, arguments), "--json"]
    process = subprocess.run(command, capture_output=True, text=True, check=False)
    if process.returncode != 0:
        sys.exit(f"{' '.join(command)}: exit {process.returncode}: {process.stderr.strip()}")
    return json.loads(process.stdout)


def engines_of(tenon):
    return [engine["name"] for engine in run(tenon, "doctor")["engines"] if engine["available"]]


def angle(state, link):
    return state["joints"][f"{HAND}/{link}_joint"]["position"][0]


def find_faults(state):
    if state["unstable"]:
        yield "the simulation became unstable"
    moved = math.dist(state["bodies"]["/World/can"]["position"], CAN_AT_START)
    print(f"the can moved {moved * 1000:.1f} mm")
    if moved > 0.02:
        yield f"the can moved {moved * 1000:.0f} mm: it is not held"
    for follower, leader, factor, offset in LAWS:
        error = angle(state, follower) - (offset + factor * angle(state, leader))
        print(f"{follower} is {error:+.3f} degrees off its law")
        if abs(error) > 0.5:
            yield f"{follower} is {error:.2f} degrees off its law"


def faults_on(engine, root, tenon):
    scene = ("sim", root / "examples/inspire_hand/grasp.usda", "--duration", 4, "--engine", engine)
    print(f"on {engine}:")
    yield from find_faults(run(tenon, *scene))
    # The same with a hand too weak to hold: proof that the measure can tell the two apart.
    weak = [f"{HAND}/right_{link}_joint.drive:angular:physics:maxForce=0.001"
            for link in ("thumb_2", "index_1", "middle_1", "ring_1", "little_1")]
    overrides = [word for text in weak for word in ("--set", text)]
    dropped = run(tenon, *scene, *overrides)
    if math.dist(dropped["bodies"]["/World/can"]["position"], CAN_AT_START) < TABLE_DROP / 2:
        yield "a hand without force holds the can as well: the scene proves nothing"


def main():
    root, tenon = pathlib.Path(sys.argv[1]), sys.argv[2]
    engines = engines_of(tenon)
    if not engines:
        print("skipped: this build has no engine")
        return SKIPPED
    faults = [f"{engine}: {fault}" for engine in engines
              for fault in faults_on(engine, root, tenon)]
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
