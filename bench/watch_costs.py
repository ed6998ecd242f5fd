#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What the watches of docs/simulation.md cost: instructions of theirs beside those of steps, under
callgrind, on every engine.

usage: watch_costs.py ROOT PROGRAM

Scenes: the example hand, which its drives hold, with a can, and a pile of boxes that fall on a
floor. Outputs are off. Counted are the functions by which steps and runs enter the watches, with
all that these call, and the steps; two runs of different length leave setting up out. Exit 0: no
watches take more than 1 % of a step; 1: some do; 77: no valgrind, or a program without symbols.
"""

import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

MOST = 0.01
DT = 0.002
STEPS = (128, 384)  # multiples of 64, in which all watches look as often
# How steps and runs enter the watches, and the steps themselves.
WATCHES = re.compile(
    r"tenon::(watches::RunWatches::after_step|"
    r"engines::(EnergyBound|PassageWatch)::(note|begin|end)|"
    r"engines::mujoco::EnergyWatch::(restart|begin|end)|"
    r"engines::mujoco::PassageWatch::look)\(")
STEP = re.compile(r"tenon::engines::(?:\w+::)?\w+Simulation::step\(\)")
LINE = re.compile(r"^\s*([\d,]+) \([^)]*\)\s+(.*?)(?: \[[^\]]*\])?$")

BOX = """    def Cube "box%d" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
    )
    {
        double size = 0.2
        float physics:mass = 1
        double3 xformOp:translate = (%g, %g, %g)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
"""


def pile(path):
    boxes = "".join(BOX % (i, 0.25 * (i % 5), 0.25 * (i // 5 % 5), 0.15 + 0.25 * (i // 25))
                    for i in range(50))
    path.write_text('#usda 1.0\n(\n    defaultPrim = "World"\n    metersPerUnit = 1\n'
                    '    upAxis = "Z"\n)\ndef Xform "World"\n{\n    def PhysicsScene "Scene" {\n'
                    '    }\n    def Plane "floor" (prepend apiSchemas = '
                    '["PhysicsCollisionAPI"]) {\n'
                    '        uniform token axis = "Z"\n    }\n' + boxes + "}\n")
    return path


def instructions(program, scene, engine, steps, folder):
    """-> those of the watches and those of the steps, of one run."""
    out = folder / "callgrind.out"
    subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", program, "sim",
                    scene, "--engine", engine, "--dt", str(DT), "--duration", str(DT * steps),
                    "--json"], capture_output=True, check=False)
    told = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", out],
                          capture_output=True, text=True, check=True).stdout
    watches, step = {}, 0
    for line in told.splitlines():
        found = LINE.match(line)
        if found is None:
            continue
        count, name = int(found[1].replace(",", "")), found[2]
        if (watch := WATCHES.search(name)) is not None:
            watches[watch[1]] = max(watches.get(watch[1], 0), count)
        elif STEP.search(name):
            step = max(step, count)
    return watches, step


def measure(program, scene, engine, folder):
    """-> {watch: share of a step}; empty where the program has no symbols."""
    (some, few), (more, many) = (instructions(program, scene, engine, steps, folder)
                                 for steps in STEPS)
    if many <= few:
        return {}
    outside = "watches::RunWatches::after_step"  # all others are a part of the step
    whole = many - few + more.get(outside, 0) - some.get(outside, 0)
    return {name: (count - some.get(name, 0)) / whole for name, count in more.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("program")
    options = parser.parse_args()
    if shutil.which("callgrind_annotate") is None:
        print("skipped: no valgrind")
        return 77
    told = subprocess.run([options.program, "doctor", "--json"], capture_output=True, text=True,
                          check=True)
    engines = [row["name"] for row in json.loads(told.stdout)["engines"] if row["available"]]
    dear, worst, seen = [], 0.0, 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        scenes = {"hand": options.root.resolve() / "examples/inspire_hand/grasp.usda",
                  "pile": pile(folder / "pile.usda")}
        for engine in engines:
            for name, scene in scenes.items():
                shares = measure(options.program, scene, engine, folder)
                seen += bool(shares)
                share = sum(shares.values())
                worst = max(worst, share)
                print(f"{engine:8} {name:6} {100 * share:6.3f} %  " + ", ".join(
                    f"{watch} {100 * part:.3f}" for watch, part in sorted(shares.items())))
                if share > MOST:
                    dear.append(f"{name} on {engine}")
    if seen < len(engines) * len(scenes):
        print("skipped: the program has no symbols")
        return 77
    print(f"watches take {100 * worst:.2f} % of a step at most" +
          (f": above 1 %: {', '.join(dear)}" if dear else ""))
    return 1 if dear else 0


if __name__ == "__main__":
    sys.exit(main())
