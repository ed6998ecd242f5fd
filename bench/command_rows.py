# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Small rows of work for the program `tenon`, and how its instructions are counted.

A count is the same at every run: one processor, no random addresses, an environment of four
variables, a folder of one name. Files are made here, from nothing that varies.
"""

import os
import re
import shutil
import subprocess

BENCH = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(BENCH)
SHARED = os.environ.get("TENON_SHARED_DIR", os.path.join(os.path.dirname(ROOT), "shared"))
SHARED_HAND = os.path.join(SHARED, "assets/inspire_hand_urdf/inspire_hand.urdf")
COLLECTED = re.compile(r"Collected : (\d+)")

# name -> words of the command line; {work} is the folder of inputs and outputs. Rows that read the
# hand of ../shared exist where it does.
ROWS = {
    "start": "tree {work}/one.usda",
    "text": "cat {work}/prims.usda -o {work}/out.usda",
    "crate_write": "cat {work}/prims.usda -o {work}/out.usdc",
    "crate_read": "cat {work}/prims.usdc -o {work}/out.usda",
    "compose": "info {work}/fleet.usda",
    "flatten": "cat {work}/fleet.usda --flatten -o {work}/flat.usdc",
    "tree": "tree {work}/prims.usdc -a",
    "dump": "dump {work}/fleet.usda -o {work}/out.json",
    "physics": "physics {work}/bodies.usda --json",
    "sim": "sim {work}/bodies.usda --duration 0.02 --dt 0.002 --json",
    "hand_info": "info {work}/hand/inspire_hand.usda",
    "hand_physics": "physics {work}/hand/inspire_hand.usda --json",
    "check": "check {work}/bodies.usda --json",
    "hand_structure": "structure {work}/hand/inspire_hand.usda -o {work}/structured",
    "hand_zip": "zip {work}/hand/inspire_hand.usda -o {work}/out.usdz",
    "convert_shapes": "convert {work}/urdf/shapes.urdf {work}/shapes",
    "convert_hand": "convert {shared_hand} {work}/converted",
}
NOT_EVERYWHERE = {"convert_hand": SHARED_HAND}
# Exit 1 is an answer: findings, files left out.
ANSWERS = (0, 1)


class Failure(Exception):
    pass


def write_prims(path, count):
    with open(path, "w", encoding="utf-8") as file:
        file.write('#usda 1.0\n(\n    defaultPrim = "W"\n)\ndef Xform "W"\n{\n')
        for i in range(count):
            file.write(f'    def Cube "p{i}" (\n        kind = "component"\n    )\n    {{\n'
                       f"        double size = {1 + i % 7}\n"
                       f"        double3 xformOp:translate = ({i}, {i * 0.25}, {-i})\n"
                       f'        uniform token[] xformOpOrder = ["xformOp:translate"]\n'
                       f"        float a.timeSamples = {{ 0: {i}, 1: {i + 0.5}, 5.5: {i / 8} }}\n"
                       f"        int[] b = [{i}, {i + 1}, {i + 2}, {i + 3}]\n"
                       f"        rel r = </W/p{(i * 7) % count}>\n    }}\n")
        file.write("}\n")


def write_fleet(folder, count):
    with open(os.path.join(folder, "cart.usda"), "w", encoding="utf-8") as file:
        file.write("""#usda 1.0
(
    defaultPrim = "Cart"
)
class "_wheel"
{
    double radius = 0.5
}
def Xform "Cart" (
    variants = {
        string load = "full"
    }
    prepend variantSets = "load"
)
{
    def Cylinder "a" (inherits = </_wheel>)
    {
    }
    def Cylinder "b" (inherits = </_wheel>)
    {
    }
    variantSet "load" = {
        "full" {
            def Cube "box" (specializes = </_wheel>)
            {
                double size = 2
            }
        }
        "empty" {
        }
    }
}
""")
    with open(os.path.join(folder, "fleet.usda"), "w", encoding="utf-8") as file:
        file.write('#usda 1.0\n(\n    defaultPrim = "W"\n)\ndef Xform "W"\n{\n')
        for i in range(count):
            choice = "full" if i % 3 else "empty"
            file.write(f'    def "c{i}" (\n        prepend references = @cart.usda@\n'
                       f'        variants = {{ string load = "{choice}" }}\n    )\n    {{\n'
                       f"        double3 xformOp:translate = ({i}, 0, 0)\n"
                       f'        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }}\n')
        file.write("}\n")


def write_bodies(path, count):
    with open(path, "w", encoding="utf-8") as file:
        file.write('#usda 1.0\n(\n    defaultPrim = "W"\n    metersPerUnit = 1\n    upAxis = "Z"\n'
                   ')\ndef Xform "W"\n{\n    def PhysicsScene "scene"\n    {\n    }\n')
        for i in range(count):
            file.write(f'    def Cube "b{i}" (\n'
                       '        apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]\n'
                       "    )\n    {\n        double size = 0.5\n"
                       f"        double3 xformOp:translate = ({i % 10}, {i // 10}, {1 + i % 3})\n"
                       '        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }\n')
            if i % 2:
                file.write(f'    def PhysicsRevoluteJoint "j{i}"\n    {{\n'
                           f"        rel physics:body0 = </W/b{i - 1}>\n"
                           f"        rel physics:body1 = </W/b{i}>\n"
                           "        point3f physics:localPos0 = (0.5, 0, 0)\n"
                           "        point3f physics:localPos1 = (-0.5, 0, 0)\n"
                           "        float physics:lowerLimit = -30\n"
                           "        float physics:upperLimit = 30\n    }\n")
        file.write("}\n")


def make_inputs(work, program, scale=1):
    """All inputs of the rows in the folder `work`, made new; `program` writes the binary layer."""
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    with open(os.path.join(work, "one.usda"), "w", encoding="utf-8") as file:
        file.write('#usda 1.0\ndef Xform "A"\n{\n}\n')
    write_prims(os.path.join(work, "prims.usda"), 800 * scale)
    write_fleet(work, 150 * scale)
    write_bodies(os.path.join(work, "bodies.usda"), 60 * scale)
    shutil.copytree(os.path.join(ROOT, "examples/inspire_hand"), os.path.join(work, "hand"))
    shutil.copytree(os.path.join(ROOT, "tests/convert/urdf"), os.path.join(work, "urdf"))
    subprocess.run([program, "cat", os.path.join(work, "prims.usda"), "-o",
                    os.path.join(work, "prims.usdc")], check=True, env=environment(work))


def rows_here():
    return [name for name in ROWS if os.path.exists(NOT_EVERYWHERE.get(name, ROOT))]


def command(name, program, work):
    words = ROWS[name].format(work=work, shared_hand=SHARED_HAND).split()
    return [program, *words]


def clear_outputs(work):
    for name in ("out.usda", "out.usdc", "out.usdz", "out.json", "flat.usdc"):
        if os.path.exists(os.path.join(work, name)):
            os.remove(os.path.join(work, name))
    for name in ("structured", "shapes", "converted", "cache"):
        shutil.rmtree(os.path.join(work, name), ignore_errors=True)


def environment(work):
    return {"PATH": "/usr/bin:/bin", "LC_ALL": "C", "HOME": work,
            "XDG_CACHE_HOME": os.path.join(work, "cache")}


def on_one_processor():
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


def has_setarch():
    """Containers may forbid to switch random addresses off."""
    done = subprocess.run(["setarch", "-R", "true"], capture_output=True, check=False)
    return done.returncode == 0


def count_instructions(name, program, work, before=()):
    """Instructions of one run of the row, under callgrind."""
    clear_outputs(work)
    tool = [*before, "valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null"]
    done = subprocess.run([*tool, *command(name, program, work)], env=environment(work),
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, cwd=work,
                          preexec_fn=on_one_processor, check=False)
    found = COLLECTED.search(done.stderr)
    if done.returncode not in ANSWERS or not found:
        raise Failure(f"{name}: exit {done.returncode}\n{done.stderr[-2000:]}")
    return int(found.group(1))
