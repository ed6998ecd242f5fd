# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The scene grasp.usda: the hand closes on a can, the table under the can goes away, the can
stays.

The hand lies on its side, little finger down: base frame +Z (fingers) along world -Y, +Y (thumb's
side) up, +X out of the palm along world X. Places below are in the hand's base frame unless they
say world."""

import math

from . import hand
from . import layers
from . import usda

FRAMES_PER_SECOND = 60
END_SECONDS = 4.0
MOUNT = (0.0, 0.12, 0.25)

CAN_RADIUS, CAN_HEIGHT, CAN_MASS = 0.0275, 0.1, 0.1
# The thumb must swing past its top. Place and targets are chosen so that the can is held as well when
# it stands 8 mm nearer to the wrist or to the fingertips.
CAN_PLACE = (0.0425, -0.015, 0.1155)

# (seconds, degrees) of the six drive targets; targets run straight between them. The targets lie
# inside the can: what is missing to them, times the stiffness, is the grip.
SWING = ((0.0, 0.0), (0.8, 65.0))
THUMB = ((0.0, 0.0), (1.25, 0.0), (1.95, 22.0))
FINGER = ((0.0, 0.0), (0.5, 0.0), (1.3, 59.5))
TARGETS = (("right_thumb_1", SWING), ("right_thumb_2", THUMB)) + tuple(
    (f"right_{finger}_1", FINGER) for finger in hand.FINGERS
)

TABLE_SIZE = (0.16, 0.12, 0.02)
TABLE_DROP = ((0.0, 0.0), (2.0, 0.0), (2.6, 0.14))


def in_world(place):
    """A place in the hand's base frame, in the world."""
    return (MOUNT[0] + place[0], MOUNT[1] - place[2], MOUNT[2] + place[1])


def _samples(layer, declaration, keys, text):
    """Writes (seconds, value) keys as time samples."""
    with layer.block(f"{declaration}.timeSamples ="):
        for seconds, value in keys:
            layer.line(f"{round(seconds * FRAMES_PER_SECOND)}: {text(value)},")


def _hand(layer):
    root = math.sqrt(0.5)
    with layer.prim('def Xform "inspire_hand"', "prepend references = @./inspire_hand.usda@"):
        layer.attribute("quatf xformOp:orient", usda.group((root, root, 0, 0)))
        layer.attribute("double3 xformOp:translate", usda.group(MOUNT))
        layer.attribute(
            "uniform token[] xformOpOrder", usda.tokens(("xformOp:translate", "xformOp:orient"))
        )
        with layer.prim('over "Physics"'):
            for link, keys in TARGETS:
                with layer.prim(f'over "{link}_joint"'):
                    _samples(layer, "float drive:angular:physics:targetPosition", keys, usda.number)


def _physics_of_the_scene(layer):
    layer.line()
    layer.comment("The scene's choice of physics is the hand's.")
    with layer.block('variantSet "Physics" ='):
        for variant in layers.VARIANTS:
            with layer.block(f'"{variant}"'):
                with layer.prim('over "inspire_hand"', layers.selection(variant)):
                    pass


def _can(layer):
    with layer.prim(
        'def Cylinder "can"',
        apis=("PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysicsCollisionAPI", "MaterialBindingAPI"),
    ):
        half = CAN_HEIGHT / 2
        layer.attribute("uniform token axis", '"Z"')
        layer.attribute(
            "float3[] extent",
            usda.array(
                ((-CAN_RADIUS, -CAN_RADIUS, -half), (CAN_RADIUS, CAN_RADIUS, half)), usda.group
            ),
        )
        layer.attribute("double height", usda.number(CAN_HEIGHT))
        layer.attribute("rel material:binding:physics", usda.path("/World/Tin"))
        layer.attribute("float physics:mass", usda.number(CAN_MASS))
        layer.attribute("color3f[] primvars:displayColor", "[(0.75, 0.2, 0.15)]")
        layer.attribute("double radius", usda.number(CAN_RADIUS))
        layer.attribute("double3 xformOp:translate", usda.group(in_world(CAN_PLACE)))
        layer.attribute("uniform token[] xformOpOrder", '["xformOp:translate"]')


def _table(layer):
    x, y, z = in_world(CAN_PLACE)
    top = z - CAN_HEIGHT / 2
    with layer.prim('def Cube "table"', apis=("PhysicsRigidBodyAPI", "PhysicsCollisionAPI")):
        layer.attribute("float3[] extent", "[(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)]")
        layer.attribute("bool physics:kinematicEnabled", "true")
        layer.attribute("color3f[] primvars:displayColor", "[(0.55, 0.45, 0.35)]")
        layer.attribute("double size", "1")
        layer.attribute("float3 xformOp:scale", usda.group(TABLE_SIZE))
        _samples(
            layer,
            "double3 xformOp:translate",
            TABLE_DROP,
            lambda drop: usda.group((x, y, top - TABLE_SIZE[2] / 2 - drop)),
        )
        layer.attribute("uniform token[] xformOpOrder", '["xformOp:translate", "xformOp:scale"]')


def grasp():
    """grasp.usda."""
    layer = usda.Layer(
        "The hand closes on a can (until 1.95 s), the table under the can sinks (2.0 to 2.6 s), the "
        "can stays in the hand.",
        "World",
        [
            "startTimeCode = 0",
            f"endTimeCode = {round(END_SECONDS * FRAMES_PER_SECOND)}",
            f"timeCodesPerSecond = {FRAMES_PER_SECOND}",
            f"framesPerSecond = {FRAMES_PER_SECOND}",
        ],
    )
    with layer.prim(
        'def Xform "World"',
        'kind = "assembly"',
        layers.selection("physics"),
        'append variantSets = "Physics"',
    ):
        with layer.prim('def PhysicsScene "PhysicsScene"', apis=("NewtonSceneAPI",)):
            layer.attribute("uniform int newton:timeStepsPerSecond", "500")
            layer.attribute("vector3f physics:gravityDirection", "(0, 0, -1)")
            layer.attribute("float physics:gravityMagnitude", "9.81")
        _hand(layer)
        _can(layer)
        _table(layer)
        with layer.prim('def Plane "ground"', apis=("PhysicsCollisionAPI",)):
            layer.attribute("uniform token axis", '"Z"')
            layer.attribute("float3[] extent", "[(-0.5, -0.5, 0), (0.5, 0.5, 0)]")
            layer.attribute("double length", "1")
            layer.attribute("color3f[] primvars:displayColor", "[(0.5, 0.5, 0.5)]")
            layer.attribute("double width", "1")
        with layer.prim('def Material "Tin"', apis=("PhysicsMaterialAPI",)):
            layer.attribute("float physics:dynamicFriction", "0.7")
            layer.attribute("float physics:restitution", "0")
            layer.attribute("float physics:staticFriction", "0.7")
        with layer.prim('def DistantLight "sun"'):
            layer.attribute("float inputs:intensity", "3000")
            layer.attribute("quatf xformOp:orient", "(0.9238795, 0.3826834, 0, 0)")
            layer.attribute("uniform token[] xformOpOrder", '["xformOp:orient"]')
        _physics_of_the_scene(layer)
    return layer.text()
