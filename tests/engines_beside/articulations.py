# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes of articulations: bases, chains, drives, mimics, tendons."""

from author import body, drive, joint, limit, scene
from row import OVPHYSX, Row

WEIGHTLESS = ["float physics:gravityMagnitude = 0"]
BASE, A, B = "/World/Base", "/World/A", "/World/B"
LINK = {"mass": 1.0, "inertia": (0.02, 0.02, 0.02)}


def link(name, at, **more):
    return body(name, at, **{"collides": False, **LINK, **more})


def weld(name="Weld", **more):
    return joint("fixed", name, None, BASE, (0, 0, 3), **more)


def hinge(name, parent, child, pos0, pos1=(-0.5, 0, 0), axis="Y", **more):
    return joint("revolute", name, parent, child, pos0, pos1, axis=axis, **more)


def chain(*parts, first=None, second=None, gravity=(), more=(), second_body=None):
    """A welded base and two links of 1 m that start level."""
    return scene(
        link("Base", (0, 0, 3)),
        link("A", (0.5, 0, 3)),
        second_body or link("B", (1.5, 0, 3)),
        weld(),
        hinge("J", BASE, A, (0, 0, 0), **(first or {})),
        hinge("K", A, B, (0.5, 0, 0), **(second or {})),
        *more,
        articulated=True,
        gravity=gravity,
    )


def chains():
    yield Row("chain", "two links fall from level", chain(), (0.2, 0.4), 0.006, 0.6)
    yield Row(
        "chain_limits",
        "two links that limits stop",
        chain(first={"limits": (-90, 0)}, second={"limits": (-20, 0)}),
        (0.5, 1.0),
        0.004,
        engines=(OVPHYSX,),
    )
    yield Row(
        "chain_skew",
        "the second hinge about Z",
        scene(
            link("Base", (0, 0, 3)),
            link("A", (0.5, 0, 3)),
            link("B", (0.5, 0.5, 3)),
            weld(),
            hinge("J", BASE, A, (0, 0, 0)),
            hinge("K", A, B, (0, 0, 0), (0, -0.5, 0), axis="Z"),
            articulated=True,
        ),
        (0.2, 0.4),
        0.006,
        0.6,
    )
    yield Row(
        "slider_chain",
        "a carriage with a pendulum",
        scene(
            link("Base", (0, 0, 3)),
            link("A", (0, 0, 3), shape=("Cube", 0.3)),
            link("B", (0.5, 0, 3)),
            weld(),
            joint("prismatic", "J", BASE, A, axis="X"),
            hinge("K", A, B, (0, 0, 0)),
            articulated=True,
        ),
        (0.2, 0.4),
        0.006,
        0.6,
    )
    yield Row(
        "ball_chain",
        "a spherical joint in an articulation",
        scene(
            link("Base", (0, 0, 3)),
            link("A", (0.5, 0, 3)),
            weld(),
            joint("spherical", "J", BASE, A, (0, 0, 0), (-0.5, 0, 0), axis="X"),
            articulated=True,
        ),
        (0.2, 0.4),
        0.004,
        0.6,
    )


def bases():
    yield Row(
        "fixed_links",
        "two links welded to one another",
        scene(
            link("Base", (0, 0, 3)),
            link("A", (0.5, 0, 3)),
            link("B", (1.5, 0, 3)),
            weld(),
            hinge("J", BASE, A, (0, 0, 0)),
            joint("fixed", "K", A, B, (0.5, 0, 0), (-0.5, 0, 0)),
            articulated=True,
        ),
        (0.2, 0.4),
        0.005,
        0.6,
    )


def floating():
    yield Row(
        "floating",
        "a floating base with a motor",
        scene(
            link("Base", (0, 0, 3)),
            link("A", (1, 0, 3)),
            hinge(
                "J",
                BASE,
                A,
                (0.5, 0, 0),
                parts=[drive("angular", damping=0.2, target_velocity=60.0)],
            ),
            articulated=True,
        ),
        (0.25, 0.5),
        0.005,
        0.6,
    )
    yield Row(
        "tree",
        "two branches on a floating base",
        scene(
            link("Base", (0, 0, 3), mass=3.0),
            link("A", (1, 0, 3)),
            link("B", (-1, 0, 3)),
            hinge(
                "J",
                BASE,
                A,
                (0.5, 0, 0),
                parts=[drive("angular", stiffness=1.0, damping=0.2, target_position=40.0)],
            ),
            hinge(
                "K",
                BASE,
                B,
                (-0.5, 0, 0),
                (0.5, 0, 0),
                parts=[drive("angular", stiffness=1.0, damping=0.2, target_position=20.0)],
            ),
            articulated=True,
        ),
        (0.25, 0.5),
        0.006,
        0.8,
    )


def targets():
    yield Row(
        "arm_position",
        "springs to 30 and -45 degrees",
        chain(
            first={"parts": [drive("angular", stiffness=5.0, damping=1.0, target_position=30.0)]},
            second={"parts": [drive("angular", stiffness=5.0, damping=1.0, target_position=-45.0)]},
            gravity=WEIGHTLESS,
        ),
        (0.5, 1.0),
        0.008,
        0.8,
    )
    yield Row(
        "arm_rest",
        "where springs carry two links",
        chain(
            first={"parts": [drive("angular", stiffness=50.0, damping=10.0)]},
            second={"parts": [drive("angular", stiffness=20.0, damping=4.0)]},
        ),
        (1.5, 2.0),
        0.004,
    )
    yield Row(
        "arm_velocity",
        "a joint at 60 degrees per second",
        chain(
            first={"parts": [drive("angular", damping=5.0, target_velocity=60.0)]},
            gravity=WEIGHTLESS,
        ),
        (0.25, 0.5),
        0.006,
        0.8,
    )


def settings():
    yield Row(
        "arm_acceleration",
        "an acceleration drive",
        chain(
            first={
                "parts": [
                    drive(
                        "angular", "acceleration", stiffness=1.0, damping=0.1, target_position=30.0
                    )
                ]
            },
            gravity=WEIGHTLESS,
        ),
        (0.25, 0.5),
        0.006,
        0.8,
        engines=(OVPHYSX,),
    )
    yield Row(
        "arm_max_force",
        "a maximal force of 4 N m",
        chain(
            first={
                "parts": [
                    drive(
                        "angular", stiffness=100.0, damping=1.0, target_position=60.0, max_force=4.0
                    )
                ]
            },
            gravity=WEIGHTLESS,
        ),
        (0.2, 0.4),
        0.005,
        0.6,
        engines=(OVPHYSX,),
    )


def inertias():
    strong = {"parts": [drive("angular", stiffness=50.0, damping=1.0, target_position=100.0)]}
    yield Row(
        "joint_speed",
        "physxJointAxis maxJointVelocity of 60 degrees per second",
        scene(
            link("Base", (0, 0, 3)),
            link("A", (0.5, 0, 3)),
            weld(),
            hinge(
                "J",
                BASE,
                A,
                (0, 0, 0),
                apis=["PhysxJointAxisAPI:angular"],
                lines=["float physxJointAxis:angular:maxJointVelocity = 60"],
                **strong,
            ),
            articulated=True,
            gravity=WEIGHTLESS,
        ),
        (0.5, 1.0),
        engines=(OVPHYSX,),
    )
    yield Row(
        "armature",
        "physxJointAxis armature",
        chain(
            first={
                "apis": ["PhysxJointAxisAPI:angular"],
                "lines": ["float physxJointAxis:angular:armature = 2"],
            }
        ),
        (0.25, 0.5),
        0.006,
        0.6,
        engines=(OVPHYSX,),
    )
    yield Row(
        "joint_state",
        "velocities of joints at the start",
        chain(
            first={
                "apis": ["PhysicsJointStateAPI:angular"],
                "lines": ["float state:angular:physics:velocity = 60"],
            },
            gravity=WEIGHTLESS,
        ),
        (0.25, 0.5),
        0.006,
        0.8,
        engines=(OVPHYSX,),
    )


MIMIC = {
    "apis": ["PhysxMimicJointAPI:rotY"],
    "limits": (-90, 90),
    "lines": [
        "float physxMimicJoint:rotY:gearing = -0.5",
        "rel physxMimicJoint:rotY:referenceJoint = </World/J>",
        'uniform token physxMimicJoint:rotY:referenceJointAxis = "rotY"',
    ],
}


def fork(second, **more):
    return scene(
        link("Base", (0, 0, 3)),
        link("A", (0.5, 0.3, 3)),
        link("B", (0.5, -0.3, 3)),
        weld(),
        hinge(
            "J",
            BASE,
            A,
            (0, 0.3, 0),
            limits=(-90, 90),
            parts=[drive("angular", stiffness=5.0, damping=0.5, target_position=30.0)],
        ),
        hinge("K", BASE, B, (0, -0.3, 0), **second),
        articulated=True,
        **more,
    )


def mimics():
    yield Row(
        "mimic",
        "a rigid mimic of gearing -0.5",
        fork(MIMIC, gravity=WEIGHTLESS),
        (0.5, 1.0),
        0.006,
        0.8,
        engines=(OVPHYSX,),
    )
    yield Row(
        "mimic_rest",
        "a mimic under weight",
        fork(MIMIC),
        (2.5, 3.0),
        0.006,
        0.8,
        engines=(OVPHYSX,),
    )


def loops():
    yield Row(
        "self_filter",
        "self collisions switched off",
        scene(
            link("Base", (0, 0, 3)),
            link("A", (0.5, 0, 3), collides=True),
            link("B", (0.55, 0, 3), collides=True),
            weld(),
            hinge("J", BASE, A, (0, 0, 0), limits=(-5, 5)),
            hinge("K", BASE, B, (0, 0, 0), (-0.55, 0, 0), limits=(-5, 60)),
            articulated=True,
            apis=["PhysxArticulationAPI"],
        ).replace(
            "def PhysicsScene",
            "bool physxArticulation:enabledSelfCollisions = false\n    def PhysicsScene",
        ),
        (0.2, 1.0),
        0.006,
        0.8,
        engines=(OVPHYSX,),
    )
    yield Row(
        "four_bar",
        "a loop closed by an excluded joint",
        scene(
            link("Base", (0, 0, 3)),
            link("A", (0, 0, 2.5)),
            link("B", (1, 0, 2.5)),
            link("C", (0.5, 0, 2)),
            weld(),
            hinge("J", BASE, A, (0, 0, 0), (0, 0, 0.5)),
            hinge("K", BASE, B, (1, 0, 0), (0, 0, 0.5)),
            hinge(
                "L",
                A,
                "/World/C",
                (0, 0, -0.5),
                (-0.5, 0, 0),
                parts=[drive("angular", damping=0.01)],
            ),
            hinge(
                "M",
                B,
                "/World/C",
                (0, 0, -0.5),
                (0.5, 0, 0),
                lines=["bool physics:excludeFromArticulation = true"],
            ),
            articulated=True,
            gravity=["vector3f physics:gravityDirection = (0.7071068, 0, -0.7071068)"],
        ),
        (0.2, 0.4),
        0.006,
        0.8,
    )


LINKS = [link("Base", (0, 0, 3)), link("A", (0.5, 0, 3))]
TURNS = [limit(axis, 1, -1) for axis in ("transX", "transY", "transZ", "rotX")]
BOTH = [drive("angular", stiffness=2.0, damping=2.0, target_position=20.0, target_velocity=30.0)]


def misfits():
    yield Row(
        "links_apart",
        "links whose fixed frames are 0.2 m apart: the child is moved",
        scene(
            *LINKS,
            link("B", (1.5, 0, 3)),
            weld(),
            hinge("J", BASE, A, (0, 0, 0)),
            joint("fixed", "K", A, B, (0.5, 0, 0), (-0.7, 0, 0.1)),
            articulated=True,
        ),
        (0.2, 0.4),
        0.006,
        0.6,
        engines=(OVPHYSX,),
    )
    yield Row(
        "weld_apart",
        "a weld to the world whose frames are 1 m apart: the robot stays",
        scene(
            *LINKS,
            joint("fixed", "Weld", None, BASE, (0, 0, 2)),
            hinge("J", BASE, A, (0, 0, 0)),
            articulated=True,
        ),
        (0.2, 0.4),
        0.006,
        0.6,
        engines=(OVPHYSX,),
    )
    yield Row(
        "hinge_apart",
        "a hinge whose frames are 0.1 m apart: the child is moved",
        scene(
            link("Base", (0, 0, 3)),
            link("A", (0.6, 0, 3)),
            weld(),
            hinge("J", BASE, A, (0, 0, 0)),
            articulated=True,
        ),
        (0.2, 0.4),
        0.006,
        0.6,
        engines=(OVPHYSX,),
    )


def turning():
    yield Row(
        "d6_of_two",
        "a D6 that turns about Y and Z",
        scene(
            *LINKS,
            weld(),
            joint("d6", "J", BASE, A, (0, 0, 0), (-0.5, 0, 0), parts=TURNS),
            articulated=True,
        ),
        (0.2, 0.4),
        0.006,
        0.6,
        engines=(OVPHYSX,),
    )
    yield Row(
        "arm_both_targets",
        "a target of position and one of velocity",
        chain(first={"parts": BOTH}, gravity=WEIGHTLESS),
        (0.5, 1.0),
        0.006,
        0.6,
        engines=(OVPHYSX,),
    )
    for name, what in (
        ("dry", ("staticFrictionEffort = 3", "dynamicFrictionEffort = 3")),
        ("viscous", ("viscousFrictionCoefficient = 0.1",)),
    ):
        yield Row(
            f"joint_friction_{name}",
            f"{name} friction of a joint",
            chain(
                first={
                    "apis": ["PhysxJointAxisAPI:angular"],
                    "lines": [f"float physxJointAxis:angular:{one}" for one in what],
                }
            ),
            (0.2, 0.4),
            0.006,
            0.6,
            engines=(OVPHYSX,),
        )


def scenes():
    for part in (
        chains,
        bases,
        floating,
        targets,
        settings,
        inertias,
        mimics,
        loops,
        misfits,
        turning,
    ):
        yield from part()
