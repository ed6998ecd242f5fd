# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Sleep, units, mass properties, filters, point instancers."""

import math

import ode
from form import G, WEIGHTLESS, Form, coordinate, moved, speed, stands, turned

from author import body, drive, floor, group, joint, material, prim, scene, static

ROUGH = "/World/Rough"
A = "/World/A"


def rough(friction=0.8, **more):
    return material("Rough", friction, **more)


ASLEEP = "uniform bool physics:startsAsleep = true"


def sleepers():
    yield Form(
        "asleep",
        "a body asleep in the air hangs there",
        scene(body("A", (0, 0, 5), lines=[ASLEEP])),
        1.0,
        (moved(1.0, "z", 0),),
    )
    yield Form(
        "asleep_moving",
        "a velocity of a body that starts asleep does not act",
        scene(body("A", (0, 0, 5), velocity=(1, 0, 0), lines=[ASLEEP])),
        1.0,
        (moved(1.0, "x", 0), moved(1.0, "z", 0)),
    )
    yield Form(
        "asleep_spun",
        "a spin of a body that starts asleep does not act",
        scene(body("A", (0, 0, 5), spin=(0, 0, 90), lines=[ASLEEP])),
        1.0,
        (turned(1.0, "z", 0), moved(1.0, "z", 0)),
    )
    yield Form(
        "awake_beside",
        "a body beside a sleeper falls",
        scene(body("A", (0, 0, 5), lines=[ASLEEP]), body("B", (3, 0, 5))),
        0.5,
        (moved(0.5, "z", 0), moved(0.5, "z", -G / 8, name="B")),
    )


def woken():
    hit = material("Rough", 0.0, 0.0)
    yield Form(
        "asleep_hit",
        "a ball hits a sleeper of its mass, restitution 0: both go on",
        scene(
            hit,
            body(
                "A",
                (0, 0, 0),
                ("Sphere", 0.1),
                material=ROUGH,
                mass=1.0,
                inertia=(0.004,) * 3,
                lines=[ASLEEP],
            ),
            body(
                "B",
                (-0.5, 0, 0),
                ("Sphere", 0.1),
                material=ROUGH,
                mass=1.0,
                inertia=(0.004,) * 3,
                velocity=(2, 0, 0),
            ),
            gravity=WEIGHTLESS,
        ),
        0.6,
        (speed(0.6, "x", 1.0, 0.03), speed(0.6, "x", 1.0, 0.03, name="B")),
    )
    yield Form(
        "asleep_on_floor",
        "a sleeper on the floor stays when a box falls onto it",
        scene(
            rough(),
            floor(ROUGH),
            body("A", (0, 0, 0.1), ("Cube", 0.2), material=ROUGH, lines=[ASLEEP]),
            body("B", (0, 0, 0.4), ("Cube", 0.2), material=ROUGH),
        ),
        1.0,
        (moved(1.0, "z", 0, least=0.002), stands(1.0, "z", 0.3, 0.002, "B")),
    )
    yield Form(
        "asleep_weightless",
        "a sleeper without weight",
        scene(body("A", lines=[ASLEEP]), gravity=WEIGHTLESS),
        1.0,
        (moved(1.0, "x", 0),),
    )


UNITS = {
    "cm": (0.01, 1.0),
    "mm": (0.001, 1.0),
    "g": (1.0, 0.001),
    "cm_g": (0.01, 0.001),
    "km": (1000.0, 1.0),
}


def stages():
    """Of each: its name, words of scene(), units in 1 m and in 1 kg, mass properties of 2 kg."""
    for name, (length, mass) in UNITS.items():
        one, kilo = 1 / length, 1 / mass
        weight = {"mass": 2 * kilo, "inertia": (0.1 * kilo * one * one,) * 3}
        yield name, {"meters": length, "kilograms": mass}, one, kilo, weight


def units():
    """The same motions of 1 m and 2 kg in other units; answers in lengths of the stage."""
    for name, world, one, kilo, weight in stages():
        thing = body("A", (0, 0, 30 * one), ("Cube", 0.2 * one), **weight)
        yield Form(
            f"fall_in_{name}",
            "a fall",
            scene(thing, **world),
            1.0,
            (moved(1.0, "z", -G / 2 * one, 0.01, 0),),
        )
        spring = ode.oscillator(0.6, 2.0, 3.0, 50.0, start=0.5)[0]
        yield Form(
            f"spring_in_{name}",
            "a spring of 50 N/m and a damper of 3 N s/m",
            scene(
                body("A", (0.5 * one, 0, 0), ("Cube", 0.2 * one), **weight),
                joint(
                    "prismatic",
                    "J",
                    None,
                    A,
                    axis="X",
                    parts=[drive("linear", stiffness=50.0 * kilo, damping=3.0 * kilo)],
                ),
                gravity=WEIGHTLESS,
                **world,
            ),
            0.6,
            (stands(0.6, "x", spring * one, 0.01 * one),),
        )


def units_of_joints():
    for name, world, one, kilo, weight in stages():
        lever = kilo * one * one * math.pi / 180
        turn = math.degrees(ode.oscillator(0.5, 0.1, 0.3, 4.0, target=math.radians(40))[0])
        yield Form(
            f"hinge_in_{name}",
            "an angular drive of 4 N m/rad",
            scene(
                body("A", (0, 0, 0), ("Cube", 0.2 * one), **weight),
                joint(
                    "revolute",
                    "J",
                    None,
                    A,
                    axis="Y",
                    parts=[drive("angular", "force", 4.0 * lever, 0.3 * lever, 40.0)],
                ),
                gravity=WEIGHTLESS,
                **world,
            ),
            0.5,
            (coordinate(0.5, turn, 0.8),),
        )
        slab = {"shape": ("Cube", one), "scale": (0.4, 0.4, 0.1)}
        ground = static(
            "Floor", (0, 0, -0.5 * one), ("Cube", one), scale=(40, 40, 1), material=ROUGH
        )
        if name != "km":
            yield Form(
                f"slide_in_{name}",
                "1 m/s, friction 0.3",
                scene(
                    rough(0.3),
                    ground,
                    body("A", (0, 0, 0.05 * one), velocity=(one, 0, 0), material=ROUGH, **slab),
                    **world,
                ),
                0.6,
                (moved(0.6, "x", one / (0.6 * G), 0.02),),
            )


def units_of_breaks():
    bound = 2 * G * 1.06
    yield Form(
        "break_in_cm_g",
        "a joint of 1.06 m g in centimetres and grams holds",
        scene(
            body("A", (0, 0, 200), collides=False, mass=2000.0, inertia=(1e5,) * 3),
            joint(
                "fixed",
                "J",
                None,
                A,
                (0, 0, 300),
                (0, 0, 100),
                lines=[f"float physics:breakForce = {bound * 1e5}"],
            ),
            meters=0.01,
            kilograms=0.001,
        ),
        0.5,
        (moved(0.5, "z", 0, least=0.1),),
    )


def weighed(name, shows, moment, mass, arm, parts, authored=None):
    """A pendulum of a body whose mass properties come from its colliders; it starts level."""
    strength = mass * G * arm / moment
    end = math.degrees(ode.pendulum(0.5, math.radians(90), strength)[0])
    layer = scene(
        body("A", (0, 0, 3), None, collides=False, children=parts, **(authored or {})),
        joint("revolute", "J", None, A, (0, 0, 3), axis="Y"),
    )
    # It starts level, and falls towards +90 degrees.
    return Form(name, shows, layer, 0.5, (coordinate(0.5, 90 - end, 1.0),))


def masses():
    dense = 1000.0
    side = 0.2
    cube = dense * side**3
    yield weighed(
        "weighed_cube",
        "a cube beside its hinge",
        cube * (side**2 / 6 + 0.25),
        cube,
        0.5,
        [static("C", (0.5, 0, 0), ("Cube", side))],
    )
    ball = dense * 4 / 3 * math.pi * 0.1**3
    both, arm = cube + ball, (cube * 0.5 + ball * 0.2) / (cube + ball)
    yield weighed(
        "weighed_compound",
        "a cube and a ball",
        cube * (side**2 / 6 + 0.25) + ball * (0.4 * 0.01 + 0.04),
        both,
        arm,
        [static("C", (0.5, 0, 0), ("Cube", side)), static("D", (0.2, 0, 0), ("Sphere", 0.1))],
    )
    rod = dense * math.pi * 0.05**2 * 0.8
    yield weighed(
        "weighed_cylinder",
        "a cylinder along its arm",
        rod * (0.05**2 / 4 + 0.8**2 / 12 + 0.16),
        rod,
        0.4,
        [static("C", (0.4, 0, 0), ("Cylinder", 0.05, 0.8, "X"))],
    )


def weighed_parts():
    yield weighed(
        "weighed_masses",
        "masses of two colliders",
        3 * (0.04 / 6 + 0.25) + 1 * (0.4 * 0.01 + 0.04),
        4.0,
        (3 * 0.5 + 0.2) / 4,
        [
            static(
                "C",
                (0.5, 0, 0),
                ("Cube", 0.2),
                apis=["PhysicsMassAPI"],
                lines=["float physics:mass = 3"],
            ),
            static(
                "D",
                (0.2, 0, 0),
                ("Sphere", 0.1),
                apis=["PhysicsMassAPI"],
                lines=["float physics:mass = 1"],
            ),
        ],
    )
    yield weighed(
        "weighed_center",
        "a mass of 2 kg whose centre is authored",
        0.3 + 2 * 0.16,
        2.0,
        0.4,
        [],
        {"mass": 2.0, "inertia": (0.1, 0.3, 0.2), "com": (0.4, 0, 0)},
    )


def weighed_by_springs():
    for density in (250.0, 7800.0):
        end = ode.oscillator(0.5, density * 0.008, 0.0, 50.0 * density / 250, start=1.0)[0]
        yield Form(
            f"density_{density:g}",
            f"a density of {density:g} on a spring",
            scene(
                body("A", (1, 0, 0), density=density),
                joint(
                    "prismatic",
                    "J",
                    None,
                    A,
                    axis="X",
                    parts=[drive("linear", stiffness=50.0 * density / 250)],
                ),
                gravity=WEIGHTLESS,
            ),
            0.5,
            (stands(0.5, "x", end, 0.02),),
        )
    for scale in ((2, 1, 1), (1, 1, 3)):
        mass = 0.5
        size = tuple(0.2 * part for part in scale)
        moment = mass * (size[0] ** 2 + size[2] ** 2) / 12
        end = math.degrees(ode.oscillator(0.4, moment, 0.0, 0.3, target=math.radians(40))[0])
        yield Form(
            f"scaled_moment_{scale[0]}{scale[1]}{scale[2]}",
            f"the moment of a cube scaled {scale}",
            scene(
                body("A", (0, 0, 0), ("Cube", 0.2), scale=scale, mass=mass),
                joint(
                    "revolute",
                    "J",
                    None,
                    A,
                    axis="Y",
                    parts=[drive("angular", "force", 0.3 * math.pi / 180, 0.0, 40.0)],
                ),
                gravity=WEIGHTLESS,
            ),
            0.4,
            (coordinate(0.4, end, 1.2),),
        )


def two(*more, **upper):
    """A cube on a cube on the floor."""
    return scene(
        rough(),
        floor(ROUGH),
        body("A", (0, 0, 0.1), ("Cube", 0.2), material=ROUGH),
        body("B", (0, 0, 0.301), ("Cube", 0.2), material=ROUGH, **upper),
        *more,
    )


RESTS = (stands(1.0, "z", 0.3, 0.002, "B"), stands(1.0, "z", 0.1, 0.002))
THROUGH = (stands(1.0, "z", 0.1, 0.002, "B"), stands(1.0, "z", 0.1, 0.002))


GROUP_A, GROUP_B = "/World/GA", "/World/GB"


def filters():
    yield Form("filter_none", "a cube on a cube", two(), 1.0, RESTS)
    yield Form(
        "filter_pair",
        "a filtered pair",
        two(apis=["PhysicsFilteredPairsAPI"], lines=["rel physics:filteredPairs = </World/A>"]),
        1.0,
        THROUGH,
    )
    yield Form(
        "filter_groups",
        "a group filters another",
        two(group("GA", [A]), group("GB", ["/World/B"], [GROUP_A])),
        1.0,
        THROUGH,
    )
    yield Form(
        "filter_groups_apart",
        "two groups without filters",
        two(group("GA", [A]), group("GB", ["/World/B"])),
        1.0,
        RESTS,
    )


def filters_off():
    yield Form(
        "filter_group_itself",
        "a group that filters itself",
        two(group("GA", [A, "/World/B"], [GROUP_A])),
        1.0,
        THROUGH,
    )
    yield Form(
        "filter_inverted",
        "an inverted group touches only what it names: the floor alone",
        two(
            group("GA", ["/World/B"], [GROUP_B], ["bool physics:invertFilteredGroups = true"]),
            group("GB", ["/World/Floor"]),
        ),
        1.0,
        THROUGH,
    )
    yield Form(
        "filter_off",
        "collisionEnabled false",
        two(lines=["bool physics:collisionEnabled = false"], mass=1.0, inertia=(0.01,) * 3),
        1.0,
        (moved(1.0, "z", -G / 2, name="B"), stands(1.0, "z", 0.1, 0.002)),
    )
    yield Form(
        "filter_trigger",
        "a trigger touches nothing",
        scene(
            rough(),
            static("F", (0, 0, 0.5), ("Cube", 1), apis=["PhysxTriggerAPI"]),
            body("A", (0, 0, 2), material=ROUGH),
        ),
        1.0,
        (moved(1.0, "z", -G / 2),),
    )
    yield Form(
        "filter_joint",
        "bodies of a joint do not touch",
        scene(
            body("A", (0, 0, 3), mass=1.0, inertia=(0.01,) * 3),
            body("B", (0.1, 0, 3), mass=1.0, inertia=(0.01,) * 3),
            joint("revolute", "J", A, "/World/B", (0.05, 0, 0), (-0.05, 0, 0), axis="Y"),
            gravity=WEIGHTLESS,
        ),
        1.0,
        (moved(1.0, "x", 0), moved(1.0, "x", 0, name="B")),
    )


def instanced(positions, scales, velocity=None):
    lines = [
        "rel prototypes = </World/PI/P>",
        f"int[] protoIndices = {[0] * len(positions)}",
        f"point3f[] positions = {list(positions)!r}",
        f"float3[] scales = {list(scales)!r}",
    ]
    if velocity:
        lines.append(f"vector3f[] velocities = {[velocity] * len(positions)!r}")
    return prim(
        "PointInstancer", "PI", (), lines, [body("P", (0, 0, 0), ("Cube", 0.2), material=ROUGH)]
    )


def instancers():
    names = [f"/World/PI/instance_{i}/P" for i in range(3)]
    places, ones = [(0, 0, 5), (1, 0, 6), (2, 0, 7)], [(1, 1, 1)] * 3
    says = ("point-instancer.readings",)
    yield Form(
        "instances_fall",
        "three instances fall",
        scene(rough(), instanced(places, ones)),
        0.5,
        tuple(moved(0.5, "z", -G / 8, name=name) for name in names),
        says,
    )
    yield Form(
        "instances_thrown",
        "instances with velocities",
        scene(rough(), instanced(places, ones, (1, 0, 2))),
        0.5,
        tuple(
            moved(0.5, axis, way, 0, 0.01, name)
            for name in names
            for axis, way in (("x", 0.5), ("z", 1 - G / 8))
        ),
        says,
    )
    low = [(0, 0, 0.12), (1, 0, 0.22), (2, 0, 0.32)]
    sizes = [(1, 1, 1), (2, 2, 2), (3, 3, 3)]
    yield Form(
        "instances_rest",
        "scaled instances rest on the floor",
        scene(rough(), floor(ROUGH), instanced(low, sizes)),
        1.0,
        tuple(stands(1.0, "z", 0.1 * (i + 1), 0.002, name) for i, name in enumerate(names)),
        says,
    )
    stacked = [(0, 0, 0.1), (0, 0, 0.3), (0, 0, 0.5)]
    yield Form(
        "instances_stack",
        "instances on one another",
        scene(rough(), floor(ROUGH), instanced(stacked, ones)),
        1.0,
        tuple(stands(1.0, "z", 0.1 + 0.2 * i, 0.002, name) for i, name in enumerate(names)),
        says,
    )


KINDS = {
    "sleep": (sleepers, woken),
    "units": (units, units_of_joints, units_of_breaks),
    "mass properties": (masses, weighed_parts, weighed_by_springs),
    "filters": (filters, filters_off),
    "point instancers": (instancers,),
}
