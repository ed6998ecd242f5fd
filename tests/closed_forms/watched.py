# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Motions that look like the faults which a run warns of, and are right: nothing is to speak."""

import dataclasses
import math

import ode
from form import G, WEIGHTLESS, Form, coordinate, moved, rate, samples, speed, stands, timed

from author import body, drive, floor, joint, material, scene, static

A, ROUGH = "/World/A", "/World/Rough"
BALL = ("Sphere", 0.05)


def passes(name, shows, *prims, metres=50.0, lines=(), apis=()):
    """A ball flies on as if nothing were there."""
    return Form(
        name,
        shows,
        scene(
            material("Rough", 0.0),
            *prims,
            body(
                "A",
                (0, 0, 0),
                BALL,
                velocity=(metres, 0, 0),
                material=ROUGH,
                lines=lines,
                apis=apis,
            ),
            gravity=WEIGHTLESS,
        ),
        0.2,
        (moved(0.2, "x", metres * 0.2), moved(0.2, "y", 0)),
    )


def wall(name="Wall", at=(1, 0, 0), scale=(0.02, 2, 2), **more):
    return static(name, at, ("Cube", 1), scale=scale, material=ROUGH, **more)


def passing():
    yield passes(
        "passes_filtered",
        "a filtered pair at 50 m/s",
        wall(),
        lines=["rel physics:filteredPairs = </World/Wall>"],
        apis=["PhysicsFilteredPairsAPI"],
    )
    yield passes("passes_trigger", "a trigger at 50 m/s", wall(apis=["PhysxTriggerAPI"]))
    yield passes(
        "passes_disabled",
        "a collider that is switched off at 50 m/s",
        wall(lines=["bool physics:collisionEnabled = false"]),
    )
    yield passes("passes_beside", "past the edge of a wall, 5 mm away", wall(at=(1, 1.055, 0)))
    yield passes(
        "passes_between",
        "between two posts, 10 mm from each",
        wall("L", (1, 0.11, 0), (0.02, 0.1, 2)),
        wall("R", (1, -0.11, 0), (0.02, 0.1, 2)),
    )
    yield passes(
        "passes_over",
        "over a floor, 5 mm above it, at 200 m/s",
        wall(at=(20, 0, -0.105), scale=(100, 4, 0.1)),
        metres=200.0,
    )


def sprung():
    mass = 2.0
    for paces, name in ((60.0, "60"), (150.0, "150")):
        stiffness = mass * paces**2
        times = round(3.3 / paces * 500) / 500
        place = ode.oscillator(times, mass, 0.0, stiffness, start=0.3)[0]
        yield Form(
            f"spring_{name}",
            f"a spring swings at {name} rad/s",
            scene(
                body("A", (0.3, 0, 0), collides=False, mass=mass, inertia=(0.1,) * 3),
                joint(
                    "prismatic",
                    "J",
                    None,
                    A,
                    axis="X",
                    parts=[drive("linear", stiffness=stiffness)],
                ),
                gravity=WEIGHTLESS,
            ),
            max(times, 0.1),
            (coordinate(times, place, 0.3 * (0.02 + paces * 0.001)),),
        )


def powered():
    mass = 2.0
    end, fast = ode.oscillator(0.1, mass, 2 * 0.05 * mass * 15, mass * 225, start=-1.0)
    yield Form(
        "spring_release",
        "a pressed spring of 225 J lets go",
        scene(
            body("A", (-1, 0, 0), collides=False, mass=mass, inertia=(0.1,) * 3),
            joint(
                "prismatic",
                "J",
                None,
                A,
                axis="X",
                parts=[drive("linear", "force", mass * 225, 2 * 0.05 * mass * 15)],
            ),
            gravity=WEIGHTLESS,
        ),
        0.1,
        (coordinate(0.1, end, 0.02), rate(0.1, fast, 0.3)),
    )


def pushed():
    for force in (20, 1000):
        push = [
            f"vector3f physxForce:force = ({force}, 0, 0)",
            'uniform token physxForce:mode = "force"',
        ]
        yield Form(
            f"thrust_{force}",
            f"a force of {force} N on 1 kg for 1 s",
            scene(
                body("A", mass=1.0, inertia=(0.01,) * 3, apis=["PhysxForceAPI"], lines=push),
                gravity=WEIGHTLESS,
            ),
            1.0,
            (speed(1.0, "x", force), moved(1.0, "x", force / 2)),
        )
    yield Form(
        "motor",
        "a motor of 50 N m brings 0.1 kg m2 to 3000 degrees/s",
        scene(
            body("A", (0, 0, 3), collides=False, mass=2.0, inertia=(0.1,) * 3),
            joint(
                "revolute",
                "J",
                None,
                A,
                (0, 0, 3),
                axis="Y",
                parts=[drive("angular", damping=10.0, target_velocity=3000.0, max_force=50.0)],
            ),
            gravity=WEIGHTLESS,
        ),
        0.5,
        (rate(0.5, 3000, 30),),
    )
    codes = {c: (-1 + 4 * c / 100, 0.0, 0.0) for c in range(0, 61, 2)}
    yield Form(
        "bat",
        "a kinematic ball of 4 m/s hits one at rest, restitution 1: 8 m/s",
        timed(
            scene(
                material("Rough", 0.0, 1.0),
                body(
                    "K",
                    (-1, 0, 0),
                    ("Sphere", 0.1),
                    material=ROUGH,
                    lines=[
                        "bool physics:kinematicEnabled = true",
                        samples("double3 xformOp:translate", codes),
                    ],
                ),
                body("A", (0, 0, 0), ("Sphere", 0.1), material=ROUGH),
                gravity=WEIGHTLESS,
            )
        ),
        0.5,
        (speed(0.5, "x", 8, 0.03),),
    )


def held():
    yield Form(
        "deep_fall",
        "a fall of 2 s onto a floor",
        scene(
            material("Rough", 0.6),
            floor(ROUGH),
            body("A", (0, 0, 0.1 + G / 2 * 1.6**2), ("Sphere", 0.1), material=ROUGH),
        ),
        2.0,
        (stands(2.0, "z", 0.1, 0.002),),
    )
    for stiffness, name in ((1e4, "stiff"), (1e6, "very_stiff")):
        yield Form(
            f"holds_{name}",
            f"a drive of {stiffness:g} N m/rad holds a lever of 2 kg",
            scene(
                body("A", (1, 0, 3), collides=False, mass=2.0, inertia=(0.02,) * 3),
                joint(
                    "revolute",
                    "J",
                    None,
                    A,
                    (0, 0, 3),
                    (-1, 0, 0),
                    axis="Y",
                    parts=[
                        drive(
                            "angular",
                            "force",
                            stiffness * math.pi / 180,
                            2 * math.sqrt(2 * stiffness) * math.pi / 180,
                        )
                    ],
                ),
                articulated=True,
            ),
            1.0,
            (coordinate(1.0, math.degrees(2 * G / stiffness), 0.02),),
        )


def quiet(*scenes):
    return [
        lambda each=each: (dataclasses.replace(form, quiet=True) for form in each())
        for each in scenes
    ]


KINDS = {
    "springs without damping": [sprung],
    "passing where nothing is to touch": quiet(passing),
    "energy from where it may come": quiet(powered, pushed, held),
}
