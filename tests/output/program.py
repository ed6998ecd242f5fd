# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs of the program, as it names them itself, and how each is run on small inputs."""

import fcntl
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
EXAMPLE = ROOT / "examples/inspire_hand"
# What draws here needs no Chromium.
os.environ["TENON_CHROMIUM"] = str(ROOT / "tests/view/fake_browser.py")

SHAPES = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
    subLayers = [@./over.usda@, @./base.usda@]
)
"""
BASE = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
# kept
def Xform "World" (
    variants = {
        string Physics = "physics"
    }
    prepend variantSets = "Physics"
)
{
    def PhysicsScene "Scene"
    {
    }
    def Cube "box" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 2
        float physics:density = 5
        double size = 0.5
        double3 xformOp:translate = (0, 0, 3)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    variantSet "Physics" = {
        "none" {
        }
        "physics" {
        }
    }
}
"""
OVER = """#usda 1.0
over "World"
{
    over "box"
    {
        bool physics:rigidBodyEnabled = 1
    }
}
"""
# A body under a body of its own and a quaternion that is not normal: --fix has work in two files.
FIXABLE = """#usda 1.0
(
    subLayers = [@./fixable_base.usda@]
)
over "World"
{
    over "joint"
    {
        quatf physics:localRot0 = (2, 0, 0, 0)
    }
}
"""
FIXABLE_BASE = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def Cube "a" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    )
    {
    }
    def PhysicsFixedJoint "joint"
    {
        rel physics:body1 = </World/a>
        quatf physics:localRot1 = (3, 0, 0, 0)
    }
}
"""
ROBOT = """<robot name="arm">
  <link name="base"><inertial><mass value="1"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="tip"><inertial><mass value="%s"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="tip"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
"""


def make_inputs(folder):
    """Small files of all kinds in `folder`, and a structured hand in `folder`/hand."""
    texts = {"scene.usda": SHAPES, "base.usda": BASE, "over.usda": OVER, "fixable.usda": FIXABLE,
             "fixable_base.usda": FIXABLE_BASE, "arm.urdf": ROBOT % 1, "arm2.urdf": ROBOT % 2}
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    if not (folder / "hand").exists():
        shutil.copytree(EXAMPLE / "payloads", folder / "hand/payloads")
        shutil.copy(EXAMPLE / "inspire_hand.usda", folder / "hand")


def run(*arguments, **options):
    options = {"capture_output": True, "text": True, "check": False, "timeout": 120, **options}
    return subprocess.run([TENON, *map(str, arguments)], **options)


def verbs():
    """-> the verbs that the program has, from its own help."""
    found = [verb["name"] for verb in json.loads(run("help", "--json").stdout)["verbs"]]
    if len(found) < 15:
        raise AssertionError(f"the help of the program names {found}")
    return found


def has_viewer():
    """This program was built with the server and the page of `tenon view`."""
    parts = json.loads(run("doctor", "--json").stdout)["libraries"]
    return any(part["name"] == "view" and part["available"] for part in parts)


# What each verb prints on standard output. None: it is a verb about something else.
PRINTING = {
    "add": ["add", "scene.usda", "/World/ball=sphere", "--dry-run"],
    "bake": ["bake", "scene.usda", "-o", "-", "--duration", "0.1"],
    "cat": ["cat", "scene.usda"],
    "check": ["check", "fixable.usda"],
    "colliders": ["colliders", "scene.usda"],
    "completion": ["completion", "bash"],
    "convert": ["convert", "arm.urdf", "made.usda", "--json"],
    "diff": ["diff", "base.usda", "over.usda"],
    "doctor": ["doctor"],
    "dump": ["dump", "scene.usda"],
    "dump-index": ["dump-index", "scene.usda"],
    "explain": ["explain", "scene.usda", "/World/box"],
    "help": ["help"],
    "drives": ["drives", "scene.usda"],
    "inertia": ["inertia", "scene.usda"],
    "info": ["info", "scene.usda"],
    "manual": ["manual"],
    "new": ["new", "made.usda", "--json"],
    "pairs": ["pairs", "scene.usda"],
    "physics": ["physics", "scene.usda"],
    "pose": ["pose", "scene.usda"],
    "record": ["record", "scene.usda", "-o", "made.png", "--json"],
    "remove": ["remove", "scene.usda", "/World/box", "--dry-run"],
    "rename": ["rename", "scene.usda", "/World/box", "crate", "--dry-run"],
    "report": ["report", "scene.usda", "-o", "made.html", "--duration", "0.1", "--json"],
    "set": ["set", "scene.usda", "/World/box.size=1", "--dry-run"],
    "bench": ["bench", "scene.usda", "--envs", "2", "--duration", "0.1"],
    "benchmark": ["benchmark", "scene.usda", "--tests", "ground_drop"],
    "compare": ["compare", "scene.usda", "--engines", "mujoco,mujoco", "--duration", "0.1"],
    "sim": ["sim", "scene.usda", "--duration", "0.1"],
    "strip": ["strip", "base.usda", "-o", "-"],
    "structure": ["structure", "scene.usda", "--dry-run"],
    "sweep": ["sweep", "--help"],  # the rest is printed by Python
    "excite": ["excite", "--help"],
    "identify": ["identify", "--help"],
    "test-runner": ["test-runner", "layer", "scene.usda"],
    "tree": ["tree", "scene.usda"],
    "tune": ["tune", "scene.usda"],
    "undo": ["undo", "--help"],  # the rest is in test_undo.py
    "variant": ["variant", "scene.usda"],
    "version": ["version"],
    "view": ["view", "scene.usda", "--for", "0"] if has_viewer() else ["view", "--help"],
    "where": ["where", "scene.usda", "/World/box.size"],
    "zip": ["zip", "scene.usda", "-o", "made.usdz", "--json"],
}

# How each verb writes a file or folder, OUT. An empty list: it writes none.
WRITING = {
    "add": [],  # this and the next like it: in place alone
    "bake": [["bake", "scene.usda", "-o", "OUT.usda", "--duration", "0.1"],
             ["bake", "scene.usda", "-o", "OUT.glb", "--duration", "0.1"]],
    "cat": [["cat", "scene.usda", "-o", "OUT.usdc"], ["cat", "scene.usda", "-f", "-o", "OUT.usda"],
            ["cat", "scene.usda", "-o", "OUT.usdz"]],
    "check": [["check", "fixable.usda", "--sarif", "OUT.sarif"],
              ["check", "fixable.usda", "--write-baseline", "OUT.json"]],
    "convert": [["convert", "arm.urdf", "OUT.usda"], ["convert", "arm.urdf", "OUT"],
                ["convert", "arm.urdf", "OUT.usdc"], ["convert", "arm.urdf", "OUT.usdz"],
                ["convert", "base.usda", "OUT.xml"], ["convert", "base.usda", "OUT.urdf"],
                ["convert", "base.usda", "OUT.sdf"], ["convert", "base.usda", "OUT.srdf"],
                ["convert", "base.usda", "OUT.py", "--format", "isaaclab"]],
    "colliders": [],  # in place alone
    "completion": [],
    "diff": [],
    "doctor": [],
    "dump": [["dump", "scene.usda", "-o", "OUT.json"]],
    "dump-index": [],
    "explain": [],
    "help": [],
    "drives": [],  # in place alone
    "inertia": [],
    "info": [],
    "manual": [],
    "new": [["new", "OUT.usda", "--force"], ["new", "OUT.usdc", "--force"]],
    "pairs": [["pairs", "scene.usda", "--srdf", "OUT.srdf"]],
    "physics": [],
    "pose": [["pose", "scene.usda", "--export", "OUT.json"]],
    "remove": [],
    "rename": [],
    "record": [["record", "scene.usda", "-o", "OUT.png"],
               ["record", "scene.usda", "-o", "OUT.webm", "--duration", "0.1"],
               ["record", "scene.usda", "-o", "OUT.mp4", "--duration", "0.1"]],
    "report": [["report", "scene.usda", "--duration", "0.1", "-o", "OUT.html"]],
    "set": [],  # in place alone
    "bench": [],
    "benchmark": [],
    "compare": [["compare", "scene.usda", "--engines", "mujoco,mujoco", "--duration", "0.1", "-o",
                 f"OUT.{ending}"] for ending in ("html", "csv", "json")],
    "sim": [["sim", "scene.usda", "--duration", "0.1", "-o", "OUT.csv"],
            ["sim", "scene.usda", "--duration", "0.1", "-o", "OUT.npz"],
            ["sim", "scene.usda", "--duration", "0.1", "-o", "OUT.csv", "--log", "contacts,energy"],
            ["sim", "scene.usda", "--duration", "0.1", "--state-out", "OUT.state"],
            ["sim", "scene.usda", "--duration", "0.1", "--bake", "OUT.usdc"]],
    "strip": [["strip", "scene.usda", "-o", "OUT.usda"],
              ["strip", "scene.usda", "--mute", "-o", "OUT.usda"]],
    "structure": [["structure", "base.usda", "-o", "OUT"]],
    "sweep": [],  # Python writes: python/tests/test_sweep_logic.py
    "excite": [],  # and here: python/tests/test_excite.py
    "identify": [],  # likewise: python/tests/test_identify.py
    "test-runner": [],
    "tree": [],
    "tune": [["tune", "scene.usda", "-o", f"OUT.{ending}"] for ending in ("html", "csv", "json")],
    "undo": [],  # in place alone
    "variant": [["variant", "base.usda", "Physics=none", "-o", "OUT.usda"]],
    "version": [],
    "view": [["view", "scene.usda", "--screenshot", "OUT.png"]],
    "where": [],
    "zip": [["zip", "scene.usda", "-o", "OUT.usdz"]],
}

# A build without node has no page, no report and no recording.
if "view.no-page" in run("report", ROOT / "examples/scenes/joint.usda", "--duration", "0", "-o",
                         "-").stderr:
    for verb in ("report", "record"):
        PRINTING[verb] = [verb, "--help"]
    WRITING["report"] = WRITING["record"] = WRITING["view"] = []

# Edits of files of an asset: arguments, and arguments of another edit at the same time.
EDITS = {
    "set": [(["set", "base.usda", "/World/box.size=1"],
             ["set", "base.usda", "/World/box.physics:density=7"]),
            (["set", "scene.usda", "/World/box.size=1", "/World/box.physics:rigidBodyEnabled=0"],
             ["set", "base.usda", "/World/box.physics:density=7"])],
    "drives": [(["drives", "hand/inspire_hand.usda", "--mimic", "25,0.1"],
                ["set", "hand/inspire_hand.usda",
                 "/inspire_hand/Physics/right_index_1_joint.physics:upperLimit=70"])],
    "tune": [(["tune", "hand/inspire_hand.usda", "--frequency", "9", "--damping-ratio", "1",
               "--save"],
              ["set", "hand/inspire_hand.usda",
               "/inspire_hand/Physics/right_index_1_joint.physics:upperLimit=70"])],
    "colliders": [(["colliders", "hand/inspire_hand.usda", "--colliders", "r_base_link",
                    "--budget", "64", "--gap", "1", "--save"],
                   ["set", "hand/inspire_hand.usda",
                    "/inspire_hand/Physics/right_index_1_joint.physics:upperLimit=70"])],
    "add": [(["add", "base.usda", "/World/ball=sphere,collider"],
             ["add", "base.usda", "/World/box=filtered-pair", "--with", "/World"])],
    "remove": [(["remove", "scene.usda", "/World/box=mass"],
                ["set", "base.usda", "/World/box.size=2"])],
    "pairs": [(["pairs", "hand/inspire_hand.usda", "--filter", "right_thumb_1,right_index_2"],
               ["pairs", "hand/inspire_hand.usda", "--filter", "right_thumb_1,right_little_2"])],
    "pose": [(["pose", "hand/inspire_hand.usda", "--save", "bent", "--pose",
               "right_index_1_joint=30"],
              ["pose", "hand/inspire_hand.usda", "--save", "open"])],
    "rename": [(["rename", "scene.usda", "/World/box", "crate"],
                ["set", "base.usda", "/World.visibility=invisible"])],
    "strip": [(["strip", "hand/inspire_hand.usda", "--in-place"],) * 2],
    "check": [(["check", "fixable.usda", "--fix"],) * 2],
    "variant": [(["variant", "base.usda", "Physics=none", "--in-place"],) * 2],
    "structure": [(["structure", "hand/inspire_hand.usda", "--in-place", "--names", "tutorial"],)
                  * 2],
    "cat": [(["cat", "scene.usda", "--flatten", "-o", "scene.usda", "--in-place"],) * 2],
}


def snapshot(folder):
    """-> contents of all files by name, but for hidden ones of a run that was killed."""
    return {str(path.relative_to(folder)): path.read_bytes()
            for path in sorted(folder.rglob("*"))
            if path.is_file() and not any(part.startswith(".tenon-") for part in path.parts)}


def settle(folder):
    """Waits until nobody holds the lock of a folder here: a commit that has begun goes on."""
    for path in (folder, *folder.rglob("*")):
        if path.is_dir():
            descriptor = os.open(path, os.O_RDONLY)
            fcntl.flock(descriptor, fcntl.LOCK_EX)
            os.close(descriptor)
