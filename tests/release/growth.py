#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Instructions of a command when what a file has many of is doubled: at most 2.4 times as many, or
what a library takes itself.

    growth.py PROGRAM

PROGRAM is built with the preset `release`. Each kind is a file that a size makes, and a command;
the sizes are large enough for what grows with the square to be seen. Exit 77: no valgrind.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HEAD = '#usda 1.0\n(\n    defaultPrim = "W"\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n'
BODY = '"PhysicsRigidBodyAPI", "PhysicsCollisionAPI"'


def missing_targets(count):
    """One relationship whose targets do not exist."""
    targets = ", ".join(f"</W/a{i}>" for i in range(count))
    return HEAD + 'def Xform "W"\n{\n    rel r = [' + targets + "]\n}\n"


def ops_above_bodies(count):
    """As many transform operations on a prim as bodies below it."""
    ops = [f"xformOp:translate:a{i}" for i in range(count)]
    names = ", ".join(f'"{op}"' for op in ops)
    lines = [f"    double3 {op} = (1, 0, 0)" for op in ops]
    lines.append(f"    uniform token[] xformOpOrder = [{names}]")
    for i in range(count):
        lines.append(f'    def Sphere "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n'
                     f"        double3 xformOp:translate = ({3 * i}, 0, 0)\n"
                     '        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }')
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(lines) + "\n}\n"


def bodies_at_one_place(count):
    spheres = [f'    def Sphere "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n    }}'
               for i in range(count)]
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(spheres) + "\n}\n"


def pairs_with_the_root(count):
    """Bodies that each name the prim above all of them."""
    schemas = BODY + ', "PhysicsFilteredPairsAPI"'
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(
        f'    def Sphere "b{i}" (prepend apiSchemas = [{schemas}])\n    {{\n'
        f"        rel physics:filteredPairs = </W>\n"
        f"        double3 xformOp:translate = ({3 * i}, 0, 0)\n"
        '        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }'
        for i in range(count)) + "\n}\n"


def group(index, inside):
    return (f'    def PhysicsCollisionGroup "g{index}"'
            ' (prepend apiSchemas = ["CollectionAPI:colliders"])\n'
            f"    {{\n        {inside}\n    }}")


def merged_groups(count):
    """Groups of seven merge names, each with all bodies."""
    groups = [group(i, "rel collection:colliders:includes = </W/all>\n"
                    f'        string physics:mergeGroup = "m{i % 7}"\n'
                    f"        rel physics:filteredGroups = </W/g{(i + 1) % count}>")
              for i in range(count)]
    return (HEAD + 'def Xform "W"\n{\n    def Xform "all"\n    {\n'
            f'        def Cube "b" (prepend apiSchemas = [{BODY}])\n        {{\n        }}\n'
            "    }\n" + "\n".join(groups) + "\n}\n")


def expressions_of_groups(count):
    """Bodies, and half as many groups with an expression that names one pattern many times."""
    expression = " + ".join(["//*b1"] * 20 + ["//b2*"])
    bodies = [f'    def Cube "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n    }}'
              for i in range(count)]
    groups = [group(i, "pathExpression collection:colliders:membershipExpression = "
                    f'"{expression}"') for i in range(count // 2)]
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(bodies + groups) + "\n}\n"


def mimics_of_mimics(count):
    """Joints on one body, each of which follows the next one."""
    rows = []
    for i in range(count):
        follows = f"        rel newton:mimicJoint = </W/j{i + 1}>\n" if i + 1 < count else ""
        rows.append(f'    def Cube "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n    }}\n'
                    f'    def PhysicsRevoluteJoint "j{i}"'
                    ' (prepend apiSchemas = ["NewtonMimicAPI"])\n'
                    "    {\n        rel physics:body0 = </W/a>\n"
                    f"        rel physics:body1 = </W/b{i}>\n{follows}    }}")
    return (HEAD + f'def Xform "W"\n{{\n    def Cube "a" (prepend apiSchemas = [{BODY}])\n'
            "    {\n    }\n" + "\n".join(rows) + "\n}\n")


# Name, what makes the file, size, words before the file and behind it, the bound. MuJoCo's lists of
# a model take the square of its bodies, a small part of it; contacts of all pairs took 4 times.
KINDS = (
    ("missing targets", missing_targets, 2000, ("check",), (), 2.4),
    ("operations above bodies", ops_above_bodies, 300, ("check",), (), 2.4),
    ("pairs with the root", pairs_with_the_root, 1500, ("physics",), (), 2.4),
    ("pairs with the root, checked", pairs_with_the_root, 1000, ("check",), (), 2.4),
    ("groups that merge", merged_groups, 500, ("physics",), (), 4.2),
    ("expressions of groups", expressions_of_groups, 300, ("info",), (), 4.2),
    ("mimics of mimics, as MJCF", mimics_of_mimics, 200, ("convert",), ("out.xml",), 3.2),
    ("bodies at one place, as MJCF", bodies_at_one_place, 500, ("convert",), ("out.xml",), 3.2),
)
COLLECTED = re.compile(r"Collected : (\d+)")


def instructions(program, folder, words):
    for old in pathlib.Path(folder).glob("out.*"):
        old.unlink()
    tool = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    if shutil.which("setarch"):
        tool = ["setarch", "-R", *tool]
    done = subprocess.run([*tool, program, *words], cwd=folder, capture_output=True, text=True,
                          check=False)
    found = COLLECTED.search(done.stderr)
    if done.returncode not in (0, 1) or not found:
        sys.exit(f"{' '.join(words)}: exit {done.returncode}\n{done.stderr[-1500:]}")
    return int(found[1])


def main():
    program = os.path.abspath(sys.argv[1])
    if not shutil.which("valgrind") or not os.path.exists(program):
        print("skipped: no valgrind, or no " + program)
        return 77
    faults = 0
    for name, make, size, before, behind, most in KINDS:
        with tempfile.TemporaryDirectory() as folder:
            counts = []
            for count in (0, size, 2 * size):
                pathlib.Path(folder, "scene.usda").write_text(make(count))
                counts.append(instructions(program, folder, [*before, "scene.usda", *behind]))
        none, once, twice = counts
        ratio = (twice - none) / (once - none)
        faults += ratio > most
        print(f"{name}: {size:,} {(once - none) / 1e6:.1f} M, twice as many {ratio:.2f} times"
              + ("  TOO MUCH" if ratio > most else ""))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
