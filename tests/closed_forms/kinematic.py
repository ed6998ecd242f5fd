# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Kinematic bodies: platforms, turntables, belts, and what hangs on them."""

import math

import ode
from form import G, Form, about, moved, samples, speed, stands, timed, turned

from author import body, floor, joint, material, scene

ROUGH = "/World/Rough"
A = "/World/A"
KINEMATIC = "bool physics:kinematicEnabled = true"
SLAB = {"shape": ("Cube", 1), "scale": (0.2, 0.2, 0.1)}


def rough(friction=0.8, **more):
    return material("Rough", friction, **more)


def mover(
    at, values, shape=("Cube", 1), scale=(6, 6, 0.2), kind="double3 xformOp:translate", name="K"
):
    return body(
        name,
        at,
        shape,
        (1, 0, 0, 0),
        scale,
        material=ROUGH,
        lines=[KINEMATIC, samples(kind, values)],
    )


def line(start, velocity, seconds):
    """Samples of a straight way."""
    end = tuple(p + v * seconds for p, v in zip(start, velocity))
    return {0: start, round(100 * seconds): end}


def carried():
    for metres in (0.5, 2.0):
        yield Form(
            f"platform_{metres:g}",
            f"a slab rides at {metres:g} m/s",
            timed(
                scene(
                    rough(),
                    mover((0, 0, -0.1), line((0, 0, -0.1), (metres, 0, 0), 2.0)),
                    body("A", (0, 0, 0.05), velocity=(metres, 0, 0), material=ROUGH, **SLAB),
                )
            ),
            1.0,
            (moved(1.0, "x", metres, 0.01), moved(1.0, "z", 0)),
        )
    start = 1.0 / (0.4 * G)
    yield Form(
        "platform_catches",
        "a slab at rest on a platform of 1 m/s, friction 0.4",
        timed(
            scene(
                rough(0.4),
                mover((0, 0, -0.1), line((0, 0, -0.1), (1, 0, 0), 2.0)),
                body("A", (0, 0, 0.05), material=ROUGH, **SLAB),
            )
        ),
        1.0,
        (moved(1.0, "x", 1 - start / 2, 0.01, 0.005),),
    )
    yield Form(
        "lift",
        "a platform lifts a slab at 0.5 m/s",
        timed(
            scene(
                rough(),
                mover((0, 0, -0.1), line((0, 0, -0.1), (0, 0, 0.5), 2.0)),
                body("A", (0, 0, 0.05), velocity=(0, 0, 0.5), material=ROUGH, **SLAB),
            )
        ),
        1.0,
        (moved(1.0, "z", 0.5, 0.01, 0.005),),
    )
    yield Form(
        "platform_ball",
        "a ball at rest on a platform of 2 m/s rolls at 2/7 of it",
        timed(
            scene(
                rough(),
                mover((0, 0, -0.1), line((0, 0, -0.1), (2, 0, 0), 2.0)),
                body("A", (0, 0, 0.2), ("Sphere", 0.2), material=ROUGH),
            )
        ),
        1.0,
        (speed(1.0, "x", 4 / 7, 0.03),),
    )


def platforms_that_speed_up():
    for rate, friction, name in ((1.0, 0.4, "rides"), (6.0, 0.4, "slips")):
        codes = {c: (rate / 2 * (c / 100) ** 2, 0.0, -0.1) for c in range(0, 121)}
        way = min(rate, friction * G) / 2 * 0.8**2
        yield Form(
            f"platform_speeds_up_{name}",
            f"a platform of {rate:g} m/s2, friction {friction:g}",
            timed(
                scene(
                    rough(friction),
                    mover((0, 0, -0.1), codes),
                    body("A", (0, 0, 0.05), material=ROUGH, **SLAB),
                )
            ),
            0.8,
            (moved(0.8, "x", way, 0.02, 0.006),),
        )
    codes = {c: (0.0, 0.0, 3.0 + 0.2 * math.sin(4 * c / 100)) for c in range(0, 121)}
    yield Form(
        "kinematic_pose",
        "a kinematic body is where its samples say",
        timed(scene(rough(), mover((0, 0, 3), codes))),
        1.0,
        (stands(1.0, "z", 3 + 0.2 * math.sin(4.0), 0.002, "K"),),
    )
    yield Form(
        "pusher",
        "a kinematic ball pushes a slab at 0.5 m/s",
        timed(
            scene(
                rough(0.5),
                floor(ROUGH),
                mover(
                    (-0.4, 0, 0.1),
                    line((-0.4, 0, 0.1), (0.5, 0, 0), 2.0),
                    ("Sphere", 0.1),
                    (1, 1, 1),
                ),
                body("A", (0, 0, 0.1), ("Cube", 0.2), material=ROUGH),
            )
        ),
        1.0,
        (stands(1.0, "x", -0.4 + 0.5 + 0.2, 0.01),),
    )


def spun(degrees):
    """Samples of a table that turns about z."""
    return {c: about("z", degrees * c / 100) for c in range(0, 161, 2)}


def turntables():
    for degrees, arm in ((20.0, 1.0), (60.0, 1.0), (60.0, 0.0), (120.0, 0.5), (170.0, 0.7)):
        table = mover((0, 0, -0.1), spun(degrees), kind="quatd xformOp:orient")
        slab = body(
            "A",
            (arm, 0, 0.05),
            spin=(0, 0, degrees),
            material=ROUGH,
            velocity=(0, math.radians(degrees) * arm, 0) if arm else None,
            **SLAB,
        )
        turn = math.radians(degrees)
        yield Form(
            f"turntable_{degrees:g}_{arm:g}",
            f"a slab rides at {arm:g} m, {degrees:g} degrees/s",
            timed(scene(rough(), table, slab)),
            1.0,
            (
                stands(1.0, "x", arm * math.cos(turn), max(0.005, 0.01 * arm * turn)),
                stands(1.0, "y", arm * math.sin(turn), max(0.005, 0.01 * arm * turn)),
                turned(1.0, "z", degrees, 3.0),
            ),
        )
    table = mover((0, 0, -0.1), spun(20.0), kind="quatd xformOp:orient")
    turn = math.radians(20)
    yield Form(
        "turntable_at_rest",
        "a slab at rest on a table of 20 degrees/s is taken along",
        timed(scene(rough(), table, body("A", (1, 0, 0.05), material=ROUGH, **SLAB))),
        1.0,
        (stands(1.0, "x", math.cos(turn), 0.01), stands(1.0, "y", math.sin(turn), 0.02)),
    )


def tilted():
    """A slab stays where it lies on a table that tilts about y through the table's middle."""
    for degrees in (5.0, 20.0):
        turns = {c: about("y", degrees * c / 100) for c in range(0, 101, 2)}
        table = mover((0, 0, -0.1), turns, kind="quatd xformOp:orient")
        turn = math.radians(degrees)
        yield Form(
            f"table_tilts_{degrees:g}",
            f"a table tilts by {degrees:g} degrees in 1 s, friction 0.5",
            timed(scene(rough(0.5), table, body("A", (0, 0, 0.05), material=ROUGH, **SLAB))),
            1.0,
            (
                stands(1.0, "x", 0.15 * math.sin(turn), 0.003),
                stands(1.0, "z", -0.1 + 0.15 * math.cos(turn), 0.003),
                turned(1.0, "y", degrees, 0.3),
            ),
        )


def belts():
    for world in (False, True):
        belt = body(
            "K",
            (0, 0, -0.5),
            ("Cube", 1),
            scale=(20, 20, 1),
            material=ROUGH,
            apis=["PhysxSurfaceVelocityAPI"],
            lines=[
                KINEMATIC,
                "vector3f physxSurfaceVelocity:surfaceVelocity = (0.5, 0, 0)",
                "bool physxSurfaceVelocity:surfaceVelocityLocalSpace = "
                + ("false" if world else "true"),
            ],
        )
        caught = 0.5 / (0.8 * G)
        yield Form(
            "belt_" + ("world" if world else "local"),
            "a surface velocity of 0.5 m/s",
            scene(rough(), belt, body("A", (0, 0, 0.05), material=ROUGH, **SLAB)),
            1.0,
            (moved(1.0, "x", 0.5 - caught * 0.25, 0.02, 0.005),),
        )
    codes = {c: (0.5 * c / 100, 0.0, 3.0) for c in range(0, 121, 4)}
    swing = ode.pendulum(0.8, 0.0, G, velocity=-0.5)
    yield Form(
        "hung_on_mover",
        "a pendulum below a body that moves off at 0.5 m/s",
        timed(
            scene(
                rough(),
                mover((0, 0, 3), codes, ("Cube", 0.1), (1, 1, 1)),
                body("A", (0, 0, 2), collides=False, mass=1.0, inertia=(1e-3,) * 3),
                joint("revolute", "J", "/World/K", A, (0, 0, 0), (0, 0, 1), axis="Y"),
            )
        ),
        0.8,
        (moved(0.8, "x", 0.4 + math.sin(swing[0]), 0.02, 0.006),),
    )


KINDS = {
    "kinematic platforms": (carried, platforms_that_speed_up),
    "turntables, belts, movers": (turntables, tilted, belts),
}
