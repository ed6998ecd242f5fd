# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The vendor's hand, whose drives have no gains, holds a can after two commands: `tenon pairs
--filter` and `tenon tune --frequency 10 --damping-ratio 1 --save`. The thumb turns, the fingers
close, the table below the can sinks at 6 s; until 8 s the can has to stay where it was. Untuned,
the hand lets it fall.
"""

import json
import math
import pathlib
import shutil

CAN_AT_START = (0.05, -0.005, 0.235)
# Time codes, 60 a second, and targets [deg] of each drive.
TARGETS = {
    "thumb_proximal_yaw": ((0, 0), (140, 74)),
    "thumb_proximal_pitch": ((0, -5), (280, -5), (340, 33)),
    **{f"{finger}_proximal": ((0, 0), (140, 0), (290, 90))
       for finger in ("index", "middle", "ring", "pinky")},
}
TABLE = ((0, 0.175), (360, 0.175), (396, 0.035))
SCENE = """#usda 1.0
(
    defaultPrim = "World"
    endTimeCode = 480
    kilogramsPerUnit = 1
    metersPerUnit = 1
    timeCodesPerSecond = 60
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "PhysicsScene"
    {
        vector3f physics:gravityDirection = (0, 0, -1)
        float physics:gravityMagnitude = 9.81
    }
    def Xform "hand" (
        prepend references = @./hand/inspire_hand.usda@
    )
    {
        quatf xformOp:orient = (0.7071068, 0, 0, -0.7071068)
        double3 xformOp:translate = (0, 0.1615, 0.244)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]
        over "Physics"
        {
%(drives)s
        }
    }
    def Cylinder "can" (
        prepend apiSchemas = [
            "PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysicsCollisionAPI", "MaterialBindingAPI"
        ]
    )
    {
        uniform token axis = "Z"
        double height = 0.1
        rel material:binding:physics = </World/Tin>
        float physics:mass = 0.1
        double radius = 0.0275
        double3 xformOp:translate = %(can)s
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Cube "table" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    )
    {
        bool physics:kinematicEnabled = true
        double size = 1
        float3 xformOp:scale = (0.16, 0.12, 0.02)
        double3 xformOp:translate.timeSamples = {
%(table)s
        }
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }
    def Material "Tin" (
        prepend apiSchemas = ["PhysicsMaterialAPI"]
    )
    {
        float physics:dynamicFriction = 0.7
        float physics:staticFriction = 0.7
    }
}
"""


def samples(rows):
    return "".join(f"{time}: {value},\n" for time, value in rows)


def scene():
    drives = "".join(
        f'over "R_{name}_joint"\n{{\nfloat drive:angular:physics:targetPosition.timeSamples = '
        f"{{\n{samples(rows)}}}\n}}\n" for name, rows in TARGETS.items())
    table = samples((time, f"(0.0425, 0.0045, {height})") for time, height in TABLE)
    return SCENE % {"drives": drives, "table": table, "can": CAN_AT_START}


def moved(tenon, file, engine):
    """How far the can is from where it stood, after 8 s [m]."""
    state = json.loads(tenon("sim", file, "--engine", engine, "--physics", "physics", "--json"))
    return math.dist(state["bodies"]["/World/can"]["position"], CAN_AT_START)


def faults_of(tenon, asset, engines, folder):
    """`tenon` runs the command; `asset` is the vendor's; the scene is made in `folder`."""
    hand = pathlib.Path(folder) / "hand"
    shutil.copytree(asset.parent, hand, copy_function=shutil.copyfile)
    for place in (hand, *hand.rglob("*")):
        place.chmod(0o755 if place.is_dir() else 0o644)
    file = pathlib.Path(folder) / "grasp.usda"
    file.write_text(scene(), encoding="utf-8")
    if engines and moved(tenon, file, engines[0]) < 0.05:
        yield "without gains the hand holds the can as well: the scene proves nothing"
    own = hand / asset.name
    tenon("pairs", own, "--filter", "always,adjacent,default", "-q")
    tenon("tune", own, "--frequency", 10, "--damping-ratio", 1, "--save", "-q")
    for engine in engines:
        way = moved(tenon, file, engine)
        print(f"{engine}: the can moved {way * 1000:.1f} mm")
        if way > 0.02:
            yield f"{engine}: the can moved {way * 1000:.0f} mm: it is not held"
