# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes of joints outside of articulations: kinds, limits, drives, switches.

Most hang a body from the world. Its moments are authored, so that no engine has to weigh it.
"""

import dataclasses

from author import body, drive, indent, joint, limit, prim, scene
from row import NEWTON, OVPHYSX, Row

WEIGHTLESS = ["float physics:gravityMagnitude = 0"]
A, B = "/World/A", "/World/B"
BOB = {"mass": 2.0, "inertia": (0.02, 0.02, 0.02)}
WIDE = (2.0, 2.0, 2.0)  # moments that are half of those about a joint 1 m away
HINGE = (0, 0, 3)
TILT = (0.9659258, 0, 0.2588190, 0)  # 30 degrees about Y


def bob(name="A", at=(1, 0, 3), **more):
    return body(name, at, **{"collides": False, **BOB, **more})


def hung(kind, *more, to=(-1, 0, 0), inertia=BOB["inertia"], **joint_words):
    """A bob 1 m beside its joint to the world."""
    return scene(bob(inertia=inertia), joint(kind, "J", None, A, HINGE, to, **joint_words), *more)


def hinges():
    yield Row("fixed_world", "a fixed joint to the world", hung("fixed"))
    yield Row(
        "fixed_pair",
        "two bodies fixed to one another fall and turn",
        scene(
            bob(spin=(0, 90, 0), velocity=(0, 0, 1)),
            bob("B", (2, 0, 3), spin=(0, 90, 0), velocity=(0, 0, -0.5707963)),
            joint("fixed", "J", A, B, (0.5, 0, 0), (-0.5, 0, 0)),
        ),
        metres=0.004,
        degrees=0.5,
    )
    yield Row("revolute", "a pendulum about Y", hung("revolute", axis="Y"), metres=0.004)
    yield Row(
        "revolute_turned",
        "the same with turned frames about X",
        hung(
            "revolute",
            axis="X",
            rot0=(0.7071068, 0, 0, 0.7071068),
            rot1=(0.7071068, 0, 0, 0.7071068),
        ),
        metres=0.004,
    )
    yield Row(
        "revolute_pair",
        "a hinge between two bodies that turn",
        scene(
            bob(spin=(0, 60, 0)),
            bob("B", (2, 0, 3)),
            joint("revolute", "J", A, B, (0.5, 0, 0), (-0.5, 0, 0), axis="Y"),
            gravity=WEIGHTLESS,
        ),
        metres=0.004,
        degrees=0.5,
    )


def others():
    yield Row(
        "prismatic",
        "a slide down 30 degrees",
        scene(bob(turn=TILT), joint("prismatic", "J", None, A, (1, 0, 3), rot0=TILT, axis="X")),
    )
    yield Row(
        "spherical",
        "a conical swing",
        scene(
            bob(velocity=(0, 1, 0), spin=(0, 0, 57.29578)),
            joint("spherical", "J", None, A, HINGE, (-1, 0, 0), axis="Z"),
        ),
        metres=0.004,
        degrees=0.5,
    )
    yield Row(
        "distance_slack",
        "a rope that a slow drift does not tighten",
        scene(
            bob(at=(0, 0, 3), velocity=(0, 0.1, 0)),
            joint(
                "distance",
                "J",
                None,
                A,
                HINGE,
                lines=["float physics:maxDistance = 3", "float physics:minDistance = -1"],
            ),
            gravity=WEIGHTLESS,
        ),
    )


def d6_turning():
    yield Row("d6_free", "a joint without limits holds nothing", hung("d6"))
    yield Row(
        "d6_hinge",
        "a D6 that is a hinge",
        hung(
            "d6",
            parts=[limit(axis, 1, -1) for axis in ("transX", "transY", "transZ", "rotX", "rotZ")],
        ),
        metres=0.004,
    )
    yield Row(
        "d6_slider",
        "a D6 that is a slider along Z",
        scene(
            bob(),
            joint(
                "d6",
                "J",
                None,
                A,
                (1, 0, 3),
                parts=[limit(axis, 1, -1) for axis in ("transX", "transY", "rotX", "rotY", "rotZ")],
            ),
        ),
    )
    yield Row(
        "d6_ball",
        "a D6 that is a ball",
        hung("d6", parts=[limit(axis, 1, -1) for axis in ("transX", "transY", "transZ")]),
        metres=0.004,
    )


def anchors():
    yield Row(
        "joint_to_child",
        "a joint that names a prim below the body",
        scene(
            bob(
                children=[
                    prim(
                        "Xform",
                        "Hook",
                        (),
                        [
                            "double3 xformOp:translate = (-1, 0, 0)",
                            'uniform token[] xformOpOrder = ["xformOp:translate"]',
                        ],
                    )
                ]
            ),
            joint("revolute", "J", None, A + "/Hook", HINGE, axis="Y"),
        ),
        metres=0.004,
    )
    yield Row(
        "joint_scaled",
        "an anchor on a scaled body",
        scene(
            bob(shape=("Cube", 1), scale=(0.5, 0.2, 0.2)),
            joint("revolute", "J", None, A, HINGE, (-2, 0, 0), axis="Y"),
        ),
        metres=0.004,
    )


def limits():
    yield Row(
        "revolute_limit",
        "a hinge that a limit holds level",
        hung("revolute", inertia=WIDE, axis="Y", limits=(-30, 0)),
    )
    yield Row(
        "revolute_free_range",
        "a hinge within its limits",
        hung("revolute", inertia=WIDE, axis="Y", limits=(-90, 90)),
        (0.2, 0.4),
        0.004,
    )
    yield Row(
        "prismatic_limit",
        "a slide that rests on its limit",
        scene(bob(), joint("prismatic", "J", None, A, (1, 0, 3), axis="Z", limits=(-0.2, 0.5))),
        (0.8, 1.2),
        0.004,
    )
    yield Row(
        "d6_limit",
        "a D6 that rests on a limit of transZ",
        scene(
            bob(),
            joint(
                "d6",
                "J",
                None,
                A,
                (1, 0, 3),
                parts=[
                    *(limit(axis, 1, -1) for axis in ("transX", "transY", "rotX", "rotY", "rotZ")),
                    limit("transZ", -0.2, 0.2),
                ],
            ),
        ),
        (0.8, 1.2),
        0.004,
    )
    yield Row(
        "cone",
        "a ball rests on its cone",
        scene(
            bob(damping=4.0),
            joint(
                "spherical",
                "J",
                None,
                A,
                HINGE,
                (-1, 0, 0),
                axis="X",
                lines=["float physics:coneAngle0Limit = 30", "float physics:coneAngle1Limit = 30"],
            ),
        ),
        (2.0, 2.5),
        0.01,
        180.0,
    )


def hinge(gravity=(), **words):
    return scene(
        bob(inertia=WIDE),
        joint(
            "revolute",
            "J",
            None,
            A,
            HINGE,
            (-1, 0, 0),
            axis="Y",
            parts=[drive("angular", **words)],
        ),
        gravity=gravity,
    )


def slider(**words):
    return scene(
        bob(),
        joint("prismatic", "J", None, A, (1, 0, 3), axis="X", parts=[drive("linear", **words)]),
    )


def angular_drives():
    yield Row(
        "drive_position",
        "an angular spring to 30 degrees",
        hinge(WEIGHTLESS, stiffness=2.0, damping=0.3, target_position=30.0),
        degrees=0.5,
        metres=0.005,
    )
    yield Row(
        "drive_velocity",
        "an angular velocity of 45 degrees per second",
        hinge(WEIGHTLESS, damping=2.0, target_velocity=45.0),
        metres=0.004,
    )
    yield Row(
        "drive_against_weight",
        "where an angular spring carries the weight",
        hinge(stiffness=20.0, damping=5.0),
        (1.0, 1.5),
    )
    yield Row(
        "drive_max_force",
        "a maximal force of 5 N m",
        hinge(WEIGHTLESS, stiffness=500.0, damping=1.0, target_position=45.0, max_force=5.0),
        (0.2, 0.4),
        0.004,
    )


def linear_drives():
    yield Row(
        "drive_linear",
        "a linear spring and damper",
        slider(stiffness=50.0, damping=4.0, target_position=0.5),
        metres=0.004,
    )
    yield Row(
        "drive_linear_velocity",
        "a linear velocity of 0.5 m/s",
        slider(damping=20.0, target_velocity=0.5),
    )
    yield Row(
        "drive_linear_max",
        "a maximal force of 3 N",
        slider(stiffness=1000.0, target_position=2.0, max_force=3.0),
        metres=0.003,
    )


def other_drives():
    yield Row(
        "drive_acceleration",
        "a linear drive of the type acceleration",
        slider(kind="acceleration", stiffness=30.0, damping=5.0, target_position=0.4),
        engines=(OVPHYSX,),
    )
    yield Row(
        "drive_d6",
        "a D6 driven along X",
        scene(
            bob(),
            joint(
                "d6",
                "J",
                None,
                A,
                (1, 0, 3),
                parts=[
                    *(limit(axis, 1, -1) for axis in ("transY", "transZ", "rotX", "rotY", "rotZ")),
                    drive("transX", stiffness=50.0, damping=4.0, target_position=0.5),
                ],
            ),
        ),
        metres=0.004,
    )
    yield Row(
        "drive_d6_turn",
        "a D6 driven about Z",
        scene(
            bob(),
            joint(
                "d6",
                "J",
                None,
                A,
                (1, 0, 3),
                parts=[
                    *(
                        limit(axis, 1, -1)
                        for axis in ("transX", "transY", "transZ", "rotX", "rotY")
                    ),
                    drive("rotZ", stiffness=0.05, damping=0.005, target_position=15.0),
                ],
            ),
        ),
        degrees=0.5,
    )


def carried():
    kinematic = ["bool physics:kinematicEnabled = true"]
    moves = kinematic + [
        "double3 xformOp:translate.timeSamples = { 0: (0, 0, 3), 24: (0.5, 0, 3) }"
    ]
    yield Row(
        "from_kinematic",
        "a pendulum on a kinematic body",
        scene(
            body("K", HINGE, collides=False, mass=1.0, lines=kinematic),
            bob(),
            joint("revolute", "J", "/World/K", A, (0, 0, 0), (-1, 0, 0), axis="Y"),
        ),
        metres=0.004,
    )
    yield Row(
        "from_moving",
        "a pendulum below a kinematic body that moves",
        scene(
            body("K", HINGE, collides=False, mass=1.0, lines=moves),
            bob(at=(0, 0, 2)),
            joint("revolute", "J", "/World/K", A, (0, 0, 0), (0, 0, 1), axis="Y"),
        ).replace("metersPerUnit", "timeCodesPerSecond = 24\n    metersPerUnit"),
        metres=0.004,
        moves={"/World/K": (0.5, 0, 0)},
    )
    soft = ["float physxLimit:angular:stiffness = 2", "float physxLimit:angular:damping = 1"]
    yield Row(
        "soft_limit",
        "where a soft limit carries the weight",
        hung(
            "revolute",
            inertia=WIDE,
            axis="Y",
            limits=(-90, 10),
            apis=["PhysxLimitAPI:angular"],
            lines=soft,
        ),
        (1.5, 2.0),
    )


def switches():
    yield Row(
        "joint_disabled",
        "a joint that is switched off",
        hung("revolute", axis="Y", lines=["bool physics:jointEnabled = false"]),
    )
    yield Row(
        "breaks",
        "a joint that breaks at 10 N under 19.6 N",
        hung("fixed", lines=["float physics:breakForce = 10"]),
        metres=0.006,
        engines=(OVPHYSX,),
    )
    yield Row(
        "holds",
        "a joint that holds 30 N",
        hung("fixed", lines=["float physics:breakForce = 30"]),
        engines=(OVPHYSX,),
    )
    yield Row(
        "jointed_pair_apart",
        "bodies of a joint that overlap do not touch",
        scene(
            bob(at=(0, 0, 3), collides=True),
            bob("B", (0.1, 0, 3), collides=True),
            joint("revolute", "J", A, B, (0.05, 0, 0), (-0.05, 0, 0), axis="Y"),
            gravity=WEIGHTLESS,
        ),
    )


NEWTON_TOO = ("fixed_world", "joint_disabled")
ARTICULATED = (
    "revolute",
    "revolute_turned",
    "prismatic",
    "spherical",
    "joint_to_child",
    "joint_scaled",
    "revolute_free_range",
    "drive_position",
    "drive_velocity",
    "drive_against_weight",
    "drive_linear",
    "drive_linear_velocity",
    "drive_linear_max",
)


def on_base(layer):
    """The same with the joint J from a base that is welded to the world, as an articulation."""
    base = bob("Base", (0, 0, 0)) + joint("fixed", "Weld", None, "/World/Base")
    head = 'def Xform "World"\n{\n'
    assert head in layer and "rel physics:body0" not in layer
    return layer.replace(
        head,
        'def Xform "World" (\n    prepend apiSchemas = ["PhysicsArticulationRootAPI"]\n)\n{\n'
        + indent(base),
    ).replace(
        "    rel physics:body1 = </World/A",
        "    rel physics:body0 = </World/Base>\n        rel physics:body1 = </World/A",
    )


def for_newton(row):
    return dataclasses.replace(
        row, name=row.name + "_on_base", layer=on_base(row.layer), engines=(NEWTON,)
    )


def scenes():
    for part in (
        hinges,
        others,
        d6_turning,
        anchors,
        limits,
        angular_drives,
        linear_drives,
        other_drives,
        carried,
        switches,
    ):
        for row in part():
            too = row.name in NEWTON_TOO
            yield dataclasses.replace(row, engines=(OVPHYSX, NEWTON) if too else (OVPHYSX,))
            if row.name in ARTICULATED:
                yield for_newton(row)
