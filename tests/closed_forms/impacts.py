# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Impacts, stacks and mass ratios in contact, and fast bodies before thin walls.

A speed after an impact is known to a step of gravity, 0.02 m/s, and an engine takes the impact
where a step finds it, within v dt: 3 % of the speed.
"""

import math

from form import G, WEIGHTLESS, Form, See, farthest, moved, path_of, speed, stands, turning

from author import body, floor, material, scene, static

ROUGH, SMOOTH = "/World/Rough", "/World/Smooth"
RADIUS = 0.1
# MuJoCo says that rebounds are right to a few per cent; what is farther off is something else.
REBOUND = ("not mapped: physics:restitution",)


def hard(restitution, friction=0.0, name="Rough", **more):
    return material(name, friction, restitution, **more)


def rebound(name, shows, restitution, drop, materials, of_ball=ROUGH, of_floor=ROUGH):
    hit = math.sqrt(2 * G * drop)
    end = round(hit / G + 0.12, 1)
    see = (
        speed(end, "z", 0, least=0.05)
        if restitution == 0
        else farthest("z", restitution * hit, 0.03 * hit + 0.02, what="linearVelocity")
    )
    return Form(
        name,
        shows,
        scene(
            *materials,
            floor(of_floor),
            body("A", (0, 0, RADIUS + drop), ("Sphere", RADIUS), material=of_ball),
        ),
        end,
        (see,),
    )


def bounces():
    for restitution in (0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0):
        yield rebound(
            f"bounce_{restitution:g}",
            f"restitution {restitution:g}",
            restitution,
            0.5,
            [hard(restitution)],
        )
    yield rebound("bounce_high", "restitution 0.7 from 3 m", 0.7, 3.0, [hard(0.7)])
    yield rebound("bounce_low", "restitution 0.7 from 50 mm", 0.7, 0.05, [hard(0.7)])
    ways = {"average": 0.6, "min": 0.4, "max": 0.8, "multiply": 0.32}
    for mode, restitution in ways.items():
        lines = [f'uniform token physxMaterial:restitutionCombineMode = "{mode}"']
        yield rebound(
            f"bounce_mode_{mode}",
            f"0.8 and 0.4 by the mode {mode}",
            restitution,
            0.5,
            [hard(0.8, apis=["PhysxMaterialAPI"], lines=lines), hard(0.4, name="Smooth")],
            ROUGH,
            SMOOTH,
        )


def spun_bounces():
    """A ball of homogeneous mass that hits the floor with a sideways speed or a spin."""
    drop = 0.4
    hit = math.sqrt(2 * G * drop)
    for name, restitution, friction, sideways, spin in (
        ("slips", 0.8, 0.1, 3.0, 0.0),
        ("slips_soft", 0.3, 0.1, 3.0, 0.0),
        ("slips_dead", 0.0, 0.1, 3.0, 0.0),
        ("sticks", 0.8, 0.8, 1.5, 0.0),
        ("sticks_dead", 0.0, 0.8, 1.5, 0.0),
        ("backspin", 0.7, 0.8, 1.0, -30.0),
        ("spun", 0.7, 0.1, 0.0, 60.0),
        ("topspin_rolls", 0.7, 0.5, 2.0, 20.0),
    ):
        slip = sideways - spin * RADIUS
        change = min(friction * (1 + restitution) * hit, 2 / 7 * abs(slip)) * math.copysign(1, slip)
        end = round(hit / G + (0.12 if restitution else 0.04), 2)
        if not restitution:  # it goes on along the floor
            change += min(friction * G * (end - hit / G), 2 / 7 * abs(slip) - abs(change))
        yield Form(
            f"bounce_{name}",
            f"restitution {restitution:g}, friction {friction:g}, {sideways:g} m/s, "
            f"{spin:g} rad/s",
            scene(
                hard(restitution, friction),
                floor(ROUGH),
                body(
                    "A",
                    (-1, 0, RADIUS + drop),
                    ("Sphere", RADIUS),
                    material=ROUGH,
                    velocity=(sideways, 0, 0),
                    spin=(0, math.degrees(spin), 0) if spin else None,
                ),
            ),
            end,
            (
                speed(end, "x", sideways - change, 0.0, 0.05 * max(abs(change), 0.4)),
                turning(
                    end,
                    "y",
                    math.degrees(spin + 2.5 * change / RADIUS),
                    0.0,
                    math.degrees(0.05 * 2.5 * max(abs(change), 0.4) / RADIUS),
                ),
            ),
            beside=REBOUND,
        )


def collision(name, shows, masses, speeds, restitution, shape=("Sphere", 0.1)):
    m, n = masses
    u, v = speeds
    middle = (m * u + n * v) / (m + n)
    ends = (
        middle - restitution * n / (m + n) * (u - v),
        middle + restitution * m / (m + n) * (u - v),
    )
    least = 0.03 * abs(u - v)
    moments = [(0.004 * mass,) * 3 for mass in masses]
    return Form(
        name,
        shows,
        scene(
            hard(restitution),
            body(
                "A",
                (-0.3, 0, 0),
                shape,
                velocity=(u, 0, 0),
                material=ROUGH,
                mass=m,
                inertia=moments[0],
            ),
            body(
                "B",
                (0.3, 0, 0),
                shape,
                velocity=(v, 0, 0),
                material=ROUGH,
                mass=n,
                inertia=moments[1],
            ),
            gravity=WEIGHTLESS,
        ),
        0.8,
        (speed(0.8, "x", ends[0], 0, least), speed(0.8, "x", ends[1], 0, least, "B")),
    )


def collisions():
    yield collision("head_on", "equal balls, restitution 1", (1.0, 1.0), (1.0, -1.0), 1.0)
    yield collision(
        "onto_rest", "a ball hits an equal one, restitution 1", (1.0, 1.0), (2.0, 0.0), 1.0
    )
    yield collision("half", "restitution 0.5", (1.0, 1.0), (2.0, 0.0), 0.5)
    yield collision("dead", "restitution 0", (1.0, 3.0), (2.0, 0.0), 0.0)
    yield collision("one_to_ten", "1 kg onto 10 kg, restitution 0.8", (1.0, 10.0), (2.0, 0.0), 0.8)
    yield collision(
        "hundred_to_one", "100 kg onto 1 kg, restitution 0.8", (100.0, 1.0), (1.0, 0.0), 0.8
    )
    yield collision("boxes", "two boxes, restitution 0", (2.0, 2.0), (2.0, 0.0), 0.0, ("Cube", 0.2))
    for gap, name in ((0.004, "cradle"), (0.0, "cradle_touching")):
        step = 0.2 + gap
        balls = [body(f"B{i}", (i * step, 0, 0), ("Sphere", 0.1), material=ROUGH) for i in range(4)]
        first = body("A", (-0.6, 0, 0), ("Sphere", 0.1), material=ROUGH, velocity=(1, 0, 0))
        yield Form(
            name,
            f"Newton's cradle of 5 balls, {1000 * gap:g} mm apart",
            scene(hard(1.0), first, *balls, gravity=WEIGHTLESS),
            0.8,
            (
                speed(0.8, "x", 1.0, 0.05, 0, "B3"),
                speed(0.8, "x", 0.0, least=0.05, name="B1"),
                speed(0.8, "x", 0.0, least=0.05),
            ),
            beside=REBOUND,
        )


def cube(i, mass=None, size=0.2, **more):
    weighed = {"mass": mass, "inertia": (mass * size * size / 6,) * 3} if mass else {}
    return body(
        f"B{i}", (0, 0, size * (i + 0.5)), ("Cube", size), material=ROUGH, **weighed, **more
    )


def tower(name, shows, masses, seconds=1.0):
    """Cubes of 0.2 m on one another; the highest one stays in its place."""
    top = f"B{len(masses) - 1}"
    within = max(0.002, 0.0005 * len(masses))  # half a millimetre for each contact
    return Form(
        name,
        shows,
        scene(material("Rough", 0.6), floor(ROUGH), *map(cube, range(len(masses)), masses)),
        seconds,
        (
            *(moved(seconds, axis, 0, least=within, name=top) for axis in "xyz"),
            moved(seconds, "z", 0, least=0.002, name="B0"),
        ),
    )


def stacks():
    for count in (1, 2, 3, 5, 10):
        yield tower(f"stack_{count}", f"{count} cubes", [8.0] * count)
    for name, masses in (
        ("10_on_1", (1.0, 10.0)),
        ("100_on_1", (1.0, 100.0)),
        ("1000_on_0.1", (0.1, 1000.0)),
        ("1_on_100", (100.0, 1.0)),
        ("46_on_nine", (*[1.0] * 9, 46.0)),
    ):
        yield tower(
            f"stack_{name}_kg",
            f"masses {', '.join(f'{m:g}' for m in masses)} kg upwards",
            masses,
            2.0,
        )
    for over, name in ((0.45, "held"), (0.55, "falls")):
        brick = body("A", (over * 0.4, 0, 0.25), ("Cube", 1), scale=(0.4, 0.2, 0.1), material=ROUGH)
        base = static("Base", (0, 0, 0.1), ("Cube", 1), scale=(0.4, 0.2, 0.2), material=ROUGH)
        sees = (
            (moved(1.0, "z", 0, least=0.002), moved(1.0, "x", 0, least=0.002))
            if over < 0.5
            else (stands(2.0, "z", 0.1, 0.1),)
        )
        yield Form(
            f"overhang_{name}",
            f"a brick of which {over:g} stands over an edge",
            scene(material("Rough", 0.8), floor(ROUGH), base, brick),
            1.0 if over < 0.5 else 2.0,
            sees,
        )


def weight_on(time, collider, force):
    """Sum of the normal forces on a collider, the other way round too."""

    def measured(run):
        total = 0.0
        for each in run.contacts(time):
            if path_of(collider) in each["colliders"]:
                total += abs(each["normalForce"])
        return total

    return See(f"normal force on {collider} at {time:g} s, N", measured, force, 0.01 * force)


def loads():
    """What the floor carries; the log has contacts."""
    for mass in (0.1, 10.0, 5000.0):
        yield Form(
            f"load_{mass:g}_kg",
            f"the floor carries {mass:g} kg",
            scene(material("Rough", 0.6), floor(ROUGH), cube(0, mass)),
            1.0,
            (weight_on(1.0, "Floor", mass * G), moved(1.0, "z", 0, least=0.001, name="B0")),
            log="contacts",
        )
    yield Form(
        "load_stack",
        "the floor carries three cubes",
        scene(material("Rough", 0.6), floor(ROUGH), *map(cube, range(3), (2.0, 3.0, 4.0))),
        1.0,
        (weight_on(1.0, "Floor", 9 * G), weight_on(1.0, "B2", 4 * G)),
        log="contacts",
    )
    ramp = math.radians(20)
    half = ramp / 2
    yield Form(
        "load_slope",
        "a slope of 20 degrees carries m g cos",
        scene(
            material("Rough", 0.8),
            static(
                "Ramp",
                (0, 0, 0),
                ("Cube", 1),
                (math.cos(half), 0, math.sin(half), 0),
                (20, 8, 1),
                material=ROUGH,
            ),
            body(
                "A",
                (0.55 * math.sin(ramp), 0, 0.55 * math.cos(ramp)),
                ("Cube", 1),
                (math.cos(half), 0, math.sin(half), 0),
                (0.4, 0.4, 0.1),
                mass=5.0,
                material=ROUGH,
            ),
        ),
        1.0,
        (weight_on(1.0, "Ramp", 5 * G * math.cos(ramp)),),
        log="contacts",
    )


def rests():
    """Shapes on the floor, at their heights, from 20 mm above it."""
    shapes = {
        "sphere": (("Sphere", 0.2), None, 0.2),
        "capsule": (("Capsule", 0.1, 0.4, "X"), None, 0.1),
        "cylinder": (("Cylinder", 0.2, 0.3, "Z"), None, 0.15),
        "cone": (("Cone", 0.2, 0.2, "Z"), None, 0.1),
        "slab": (("Cube", 1), (0.6, 0.4, 0.1), 0.05),
        "scaled_sphere": (("Sphere", 0.1), (2, 2, 2), 0.2),
        "scaled_capsule": (("Capsule", 0.05, 0.2, "X"), (2, 2, 2), 0.1),
        "scaled_cylinder": (("Cylinder", 0.2, 0.2, "Z"), (1, 1, 2.5), 0.25),
        "ellipsoid": (("Sphere", 0.1), (3, 3, 1), 0.1),
    }
    for name, (shape, scale, height) in shapes.items():
        yield Form(
            f"rest_{name}",
            f"a {name.replace('_', ' ')} comes to rest",
            scene(
                material("Rough", 0.6),
                floor(ROUGH),
                body("A", (0, 0, height + 0.02), shape, scale=scale, material=ROUGH),
            ),
            1.0,
            (stands(1.0, "z", height, 0.001), speed(1.0, "z", 0, least=0.01)),
            says=("collider.non-uniform-scale",) if name == "ellipsoid" else (),
        )


def walls():
    """A body flies at a wall of 20 mm and stays before it."""
    on = ["bool physxScene:enableCCD = true"]
    for metres in (5, 20, 50, 200):
        for swept in (False, True):
            for name, shape in (("ball", ("Sphere", 0.05)), ("box", ("Cube", 0.1))):
                lines = ["bool physxRigidBody:enableCCD = true"] if swept else []
                end = round(1.0 / metres + 0.2, 1)
                yield Form(
                    f"wall_{name}_{metres}{'_ccd' if swept else ''}",
                    f"a {name} of 0.1 m at {metres} m/s{', CCD' if swept else ''}",
                    scene(
                        hard(0.0),
                        static("Wall", (1, 0, 0), ("Cube", 1), scale=(0.02, 4, 4), material=ROUGH),
                        body(
                            "A",
                            (0, 0, 0),
                            shape,
                            velocity=(metres, 0, 0),
                            material=ROUGH,
                            lines=lines,
                        ),
                        gravity=WEIGHTLESS + (on if swept else []),
                        physics_apis=["PhysxSceneAPI"] if swept else (),
                    ),
                    end,
                    (
                        See(
                            "place before the wall",
                            lambda run, end=end: max(0.94, run.place("A", end)[0]),
                            0.94,
                            0.02,
                        ),
                        speed(end, "x", 0, least=0.05 * metres),
                    ),
                )


KINDS = {
    "bounces": (bounces,),
    "bounces with spin": (spun_bounces,),
    "collisions": (collisions,),
    "stacks and mass ratios": (stacks,),
    "loads of contacts": (loads,),
    "shapes at rest": (rests,),
    "fast bodies and CCD": (walls,),
}
