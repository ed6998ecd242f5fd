# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Inputs of the benchmarks that are no scenes of make_scenes: what ../shared has, put to use."""

import os
import random
import subprocess
import sys

ROBOTS = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)

def Xform "World"
{
"""
ROBOT = """    def Xform "Robot_{number}" (
        instanceable = true
        prepend references = @{asset}@
    )
    {{
        double3 xformOp:translate = ({x}, {y}, 0)
{turn}        uniform token[] xformOpOrder = [{order}]
    }}
"""


def write_robots(path, asset, count, turned=False):
    """`count` instances of the asset's default prim, in rows of 8; `turned`: each otherwise."""
    order = ["xformOp:translate"] + ["xformOp:rotateXYZ"] * turned
    dice = random.Random(3)
    with open(path, "w", encoding="utf-8") as file:
        file.write(ROBOTS)
        for number in range(count):
            degrees = ", ".join(f"{dice.uniform(-180, 180):.3f}" for _ in range(3))
            turn = f"        float3 xformOp:rotateXYZ = ({degrees})\n" if turned else ""
            file.write(ROBOT.format(number=number, asset=asset, x=number % 8, y=number // 8,
                                    turn=turn, order=", ".join(f'"{op}"' for op in order)))
        file.write("}\n")


def write_suite_list(path, conformance, most):
    """Root layers, text and binary, of the cases of the published composition suite that are there;
    -> how many are listed."""
    roots = []
    with open(os.path.join(conformance, "cases.txt"), encoding="utf-8") as cases:
        for line in cases:
            fields = line.rstrip("\n").split("\t")
            if fields[0] == "aousd_composition":
                layer = "session.usd" if fields[1].endswith("_session") else "root.usd"
                folder = os.path.join(conformance, fields[2])
                roots += [os.path.join(folder, layer), os.path.join(folder, "usda", layer)]
    roots = [root for root in roots if os.path.exists(root)][:most]
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(root + "\n" for root in roots)
    return len(roots)


def make_published_scenes(script, folder):
    """Runs ../shared/bench/gen_scenes.py once; -> True when its scenes are there."""
    last = os.path.join(folder, "mesh1m.usda")
    if not os.path.exists(last):
        subprocess.run([sys.executable, "-B", script, folder], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)
    return os.path.exists(last)


def make_many_prims(program, folder, count):
    """Runs bench/complexity once; -> its layer in `folder`, without .usda and .usdc."""
    layer = os.path.join(folder, "prims")
    if not os.path.exists(layer + ".usdc"):
        os.makedirs(folder, exist_ok=True)
        subprocess.run([program, "prims", str(count), folder], stdout=subprocess.DEVNULL,
                       check=True)
    return layer
