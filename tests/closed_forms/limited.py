# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Limits of joints, ropes and struts."""

import math

import ode
from driven import A, carriage, lever, slider, wheel
from form import G, WEIGHTLESS, Form, coordinate, farthest, moved, stands, turned

from author import body, drive, joint, limit, scene


def slide_limits():
    for mass in (0.1, 2.0, 500.0):
        yield Form(
            f"slide_rests_{mass:g}_kg",
            f"{mass:g} kg fall 0.1 m onto a limit",
            slider("Z", mass, (), limits=(-0.1, 0.5)),
            1.0,
            (coordinate(1.0, -0.1, 0.001),),
        )
    yield Form(
        "slide_rests_articulated",
        "the same as an articulation",
        slider("Z", 2.0, (), True, limits=(-0.1, 0.5)),
        1.0,
        (coordinate(1.0, -0.1, 0.001),),
    )
    yield Form(
        "slide_on_limit",
        "2 kg start on their limit",
        slider("Z", 2.0, (), limits=(0, 0.5)),
        1.0,
        (coordinate(1.0, 0, 0.001),),
    )
    for speed_of in (0.5, 2.0, 10.0):
        yield Form(
            f"slide_hits_{speed_of:g}",
            f"{speed_of:g} m/s against a limit",
            slider(velocity=(speed_of, 0, 0), limits=(-1, 0.3)),
            1.0,
            (farthest("x", 0.3, max(0.005, 1.5 * speed_of * 0.002)), coordinate(1.0, 0.3, 0.02)),
        )
    yield Form(
        "slide_one_sided",
        "a limit below alone",
        slider("Z", 2.0, (), limits=(-0.2, float("inf"))),
        1.0,
        (coordinate(1.0, -0.2, 0.001),),
    )


def slide_limits_pressed():
    yield Form(
        "slide_pressed",
        "a drive presses 1000 N onto a limit",
        slider(
            limits=(-1, 0.2),
            parts=[
                drive("linear", stiffness=1e5, damping=2e3, target_position=2.0, max_force=1000.0)
            ],
        ),
        1.0,
        (coordinate(1.0, 0.2, 0.002),),
    )
    locked = [limit(axis, 1, -1) for axis in ("transX", "transY", "rotX", "rotY", "rotZ")]
    yield Form(
        "d6_slide_rests",
        "transZ of a D6 joint rests on its limit",
        scene(
            carriage(),
            joint("d6", "J", None, A, (0, 0, 3), parts=[*locked, limit("transZ", -0.15, 0.2)]),
        ),
        1.0,
        (moved(1.0, "z", -0.15), moved(1.0, "x", 0)),
    )


def turn_limits():
    for low in (10, 45, 80):
        yield Form(
            f"hinge_rests_{low}",
            f"a lever falls onto its limit, {low} degrees below level",
            lever(0, moment=2.0, limits=(-90, low)),
            1.5,
            (coordinate(1.5, low, 0.3),),
        )
    yield Form(
        "hinge_rests_articulated",
        "the same as an articulation",
        lever(0, moment=2.0, articulated=True, limits=(-90, 45)),
        1.5,
        (coordinate(1.5, 45, 0.3),),
    )
    yield Form(
        "hinge_on_limit",
        "a lever starts on its limit",
        lever(0, limits=(-30, 0)),
        1.0,
        (coordinate(1.0, 0, 0.1),),
    )
    yield Form(
        "hinge_on_limit_heavy",
        "1000 kg on a limit",
        lever(0, 1000.0, 10.0, limits=(-30, 0)),
        1.0,
        (coordinate(1.0, 0, 0.1),),
    )
    for spin in (60.0, 600.0):
        yield Form(
            f"hinge_hits_{spin:g}",
            f"a wheel of {spin:g} degrees/s hits its limit",
            wheel(spin=(0, spin, 0), limits=(-20, 45)),
            1.0,
            (coordinate(1.0, 45, 1.0),),
        )
    yield Form(
        "hinge_many_turns",
        "a limit beyond two turns",
        wheel(spin=(0, 900, 0), limits=(-20, 800)),
        1.5,
        (coordinate(1.5, 800, 2.0),),
    )


def ropes():
    yield Form(
        "rope",
        "a weight falls into a rope of 0.5 m",
        scene(
            carriage(),
            joint(
                "distance",
                "J",
                None,
                A,
                (0, 0, 3),
                lines=["float physics:maxDistance = 0.5", "float physics:minDistance = -1"],
            ),
        ),
        1.5,
        (stands(1.5, "z", 2.5, 0.005), farthest("z", 2.5, 0.02, least=True)),
    )
    swing = ode.pendulum(0.8, math.radians(60), G)
    yield Form(
        "rope_swings",
        "a weight swings on a taut rope of 1 m",
        scene(
            body(
                "A",
                (math.sin(math.radians(60)), 0, 3 - 0.5),
                collides=False,
                mass=2.0,
                inertia=(0.001,) * 3,
            ),
            joint(
                "distance",
                "J",
                None,
                A,
                (0, 0, 3),
                lines=["float physics:maxDistance = 1", "float physics:minDistance = -1"],
            ),
        ),
        0.8,
        (
            stands(0.8, "x", math.sin(swing[0]), 0.02),
            stands(0.8, "z", 3 - math.cos(swing[0]), 0.02),
        ),
    )


def limits_of_balls():
    cone = ["float physics:coneAngle0Limit = 30", "float physics:coneAngle1Limit = 30"]
    yield Form(
        "cone",
        "a lever on a ball joint rests on its cone of 30 degrees",
        scene(
            body("A", (1, 0, 3), collides=False, mass=2.0, inertia=(0.1,) * 3, damping=4.0),
            joint("spherical", "J", None, A, (0, 0, 3), (-1, 0, 0), axis="X", lines=cone),
        ),
        2.0,
        (stands(2.0, "z", 2.5, 0.01), stands(2.0, "y", 0, 0.01)),
    )
    locked = [limit(axis, 1, -1) for axis in ("transX", "transY", "transZ", "rotX", "rotZ")]
    yield Form(
        "d6_turn_rests",
        "rotY of a D6 joint rests on its limit",
        scene(
            body("A", (1, 0, 3), collides=False, mass=2.0, inertia=(2.0,) * 3, damping=2.0),
            joint(
                "d6", "J", None, A, (0, 0, 3), (-1, 0, 0), parts=[*locked, limit("rotY", -20, 25)]
            ),
        ),
        1.5,
        (turned(1.5, "y", 25, 0.5),),
    )
    yield Form(
        "strut",
        "a weight rests on a distance of at least 0.5 m",
        scene(
            carriage((0, 0, 3.5)),
            joint(
                "distance",
                "J",
                None,
                A,
                (0, 0, 3),
                lines=["float physics:minDistance = 0.5", "float physics:maxDistance = -1"],
            ),
            joint("prismatic", "K", None, A, (0, 0, 3.5), axis="Z"),
        ),
        1.0,
        (moved(1.0, "z", 0, least=0.002),),
    )


def limits_of_one_turn():
    """One turn of a D6 joint has limits, others are free; a torque presses onto the upper one."""
    for axis, low, high in (("rotX", -20, 35), ("rotY", -30, 30), ("rotZ", -20, 35)):
        torque = [0.0, 0.0, 0.0]
        torque["XYZ".index(axis[-1])] = 2.0
        slides = [limit(each, 1, -1) for each in ("transX", "transY", "transZ")]
        yield Form(
            f"d6_only_{axis}",
            f"{axis} of a D6 joint has limits, the other turns are free",
            scene(
                body(
                    "A",
                    (0, 0, 3),
                    collides=False,
                    mass=2.0,
                    inertia=(0.5,) * 3,
                    damping=1.0,
                    apis=["PhysxForceAPI"],
                    lines=[
                        f"vector3f physxForce:torque = {tuple(torque)}",
                        'uniform token physxForce:mode = "force"',
                    ],
                ),
                joint("d6", "J", None, A, (0, 0, 3), parts=[*slides, limit(axis, low, high)]),
                gravity=WEIGHTLESS,
            ),
            2.0,
            (turned(2.0, axis[-1].lower(), high, 0.7),),
        )


KINDS = {
    "limits of slides": (slide_limits, slide_limits_pressed),
    "limits of hinges, ropes": (turn_limits, ropes, limits_of_balls, limits_of_one_turn),
}
