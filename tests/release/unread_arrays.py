#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon info` of a binary layer does not read the arrays of a mesh that collides and stands still.

    unread_arrays.py PROGRAM

PROGRAM is built with the preset `release`. What it keeps in memory at most, with a mesh of 250,000
points that collides and with the same mesh as a picture alone, may differ by 4 MB; its arrays take
25. Where the arrays are missing, info says so all the same.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

SIDE = 500
HEAD = '#usda 1.0\n(\n    defaultPrim = "W"\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n'
COLLIDES = ' (prepend apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"])'


def scene(applied, arrays):
    return (HEAD + f'def Xform "W"\n{{\n    def Mesh "m"{applied}\n    {{\n'
            f'        uniform token subdivisionScheme = "none"\n{arrays}    }}\n}}\n')


def arrays_of_a_grid():
    points = ", ".join(f"({i / 7:.3f}, {j / 9:.3f}, {(i * j) % 97 / 50})"
                       for i in range(SIDE) for j in range(SIDE))
    corners = ", ".join(f"{at}, {at + 1}, {at + SIDE + 1}, {at + SIDE}"
                        for i in range(SIDE - 1) for at in range(i * SIDE, i * SIDE + SIDE - 1))
    counts = ", ".join(["4"] * (SIDE - 1) ** 2)
    return (f"        int[] faceVertexCounts = [{counts}]\n"
            f"        int[] faceVertexIndices = [{corners}]\n"
            f"        point3f[] points = [{points}]\n")


# The memory of a process begins with that of the one that starts it: a small one.
MEASURE = ("import resource, subprocess, sys\n"
           "subprocess.run(sys.argv[1:], check=False)\n"
           "sys.stderr.write(str(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss))")


def told(program, *words):
    """-> its answer, and the most memory that it had [MB]."""
    done = subprocess.run([sys.executable, "-S", "-c", MEASURE, program, *words, "--json"],
                          capture_output=True, text=True, check=True)
    return json.loads(done.stdout), int(done.stderr) / 1024


def main():
    program = os.path.abspath(sys.argv[1])
    if not os.path.exists(program):
        print("skipped: no " + program)
        return 77
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        grid, memory = arrays_of_a_grid(), {}
        for name, applied in (("collides", COLLIDES), ("drawn", "")):
            text, crate = (str(pathlib.Path(folder, name + end)) for end in (".usda", ".usdc"))
            pathlib.Path(text).write_text(scene(applied, grid), encoding="utf-8")
            subprocess.run([program, "cat", text, "-o", crate], check=True)
            answer, memory[name] = told(program, "info", crate)
            found = answer["physics"]["colliders"], answer["physics"]["staticColliders"]
            if found != ((1, 1) if applied else (0, 0)) or answer["diagnostics"]:
                faults.append(f"{name}: {found}, {answer['diagnostics']}")
        print(f"info: {memory['collides']:.1f} MB, without the collider {memory['drawn']:.1f} MB")
        if memory["collides"] > memory["drawn"] + 4:
            faults.append("the arrays of the collider were read")
        empty = pathlib.Path(folder, "empty.usda")
        empty.write_text(scene(COLLIDES, ""), encoding="utf-8")
        rules = [finding["rule"] for finding in told(program, "info", str(empty))[0]["diagnostics"]]
        if rules != ["collider.mesh-invalid"]:
            faults.append(f"a mesh without arrays: {rules}")
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
