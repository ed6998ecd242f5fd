# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Friction: sliding, stopping, slopes, thresholds of force, modes; and what rolls.

What slides is a flat slab that lies on its floor from the start, so that it does not tip.
"""

import math

from form import G, Form, moved, speed, turning

from author import body, floor, material, plane, scene, static

SLAB = {"shape": ("Cube", 1), "scale": (0.4, 0.4, 0.1)}
ROUGH, SMOOTH = "/World/Rough", "/World/Smooth"


def rough(friction, name="Rough", **more):
    return material(name, friction, **more)


def slide(name, shows, materials, seconds, sees, of_slab=ROUGH, of_floor=ROUGH, **slab):
    words = {**SLAB, **slab}
    return Form(
        name,
        shows,
        scene(*materials, floor(of_floor), body("A", (0, 0, 0.05), material=of_slab, **words)),
        seconds,
        sees,
    )


def stops():
    for friction, start in ((0.1, 1.0), (0.3, 1.0), (0.5, 2.0), (0.8, 3.0), (1.0, 1.0)):
        way = start * start / (2 * friction * G)
        end = round(start / (friction * G) + 0.3, 1)
        yield slide(
            f"stop_{friction:g}_{start:g}",
            f"{start:g} m/s, friction {friction:g}",
            [rough(friction)],
            end,
            (moved(end, "x", way, 0.02, 0.002),),
            velocity=(start, 0, 0),
        )
    for degrees in (30, 45, 70):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        way = 1 / (2 * 0.4 * G)
        yield slide(
            f"stop_along_{degrees}",
            f"1 m/s at {degrees} degrees to the floor's axes",
            [rough(0.4)],
            0.5,
            (moved(0.5, "x", way * c, 0, 0.02 * way), moved(0.5, "y", way * s, 0, 0.02 * way)),
            velocity=(c, s, 0),
        )
    yield slide(
        "no_friction", "no friction", [rough(0.0)], 1.0, (moved(1.0, "x", 1),), velocity=(1, 0, 0)
    )
    yield slide(
        "sliding_speed",
        "friction 0.2 brakes",
        [rough(0.2)],
        0.5,
        (speed(0.5, "x", 2 - 0.2 * G * 0.5, 0.02), moved(0.5, "x", 1 - 0.1 * G * 0.25, 0.02)),
        velocity=(2, 0, 0),
    )
    for mass in (0.01, 1000.0):
        yield slide(
            f"stop_{mass:g}_kg",
            f"{mass:g} kg, 1 m/s, friction 0.3",
            [rough(0.3)],
            0.6,
            (moved(0.6, "x", 1 / (0.6 * G), 0.02),),
            velocity=(1, 0, 0),
            mass=mass,
        )
    yield Form(
        "stop_on_plane",
        "1 m/s on a plane, friction 0.3",
        scene(
            rough(0.3),
            plane(material=ROUGH),
            body("A", (0, 0, 0.05), velocity=(1, 0, 0), material=ROUGH, **SLAB),
        ),
        0.6,
        (moved(0.6, "x", 1 / (0.6 * G), 0.02),),
    )


def modes():
    way = {"average": 0.5, "min": 0.2, "max": 0.8, "multiply": 0.16}
    for mode, friction in way.items():
        lines = [f'uniform token physxMaterial:frictionCombineMode = "{mode}"']
        upper = rough(0.8, apis=["PhysxMaterialAPI"], lines=lines)
        end = round(1 / (friction * G) + 0.2, 1)
        yield slide(
            f"mode_{mode}",
            f"0.8 and 0.2 by the mode {mode}",
            [upper, rough(0.2, "Smooth")],
            end,
            (moved(end, "x", 1 / (2 * friction * G), 0.02, 0.002),),
            ROUGH,
            SMOOTH,
            velocity=(1, 0, 0),
        )
    yield slide(
        "unbound",
        "no material: 0.5",
        [],
        0.4,
        (moved(0.4, "x", 1 / G, 0.02),),
        None,
        None,
        velocity=(1, 0, 0),
    )
    yield slide(
        "static_above_dynamic",
        "static 0.8, dynamic 0.4: what slides",
        [rough(0.4, static_friction=0.8)],
        0.5,
        (moved(0.5, "x", 1 / (0.8 * G), 0.02),),
        velocity=(1, 0, 0),
    )


def thresholds():
    """A horizontal force on 2 kg."""

    def push(name, shows, friction, force, way, share=0.02, **more):
        return slide(
            name,
            shows,
            [rough(friction, **more)],
            0.5,
            (moved(0.5, "x", way, share, 0.002),),
            mass=2.0,
            apis=["PhysxForceAPI"],
            lines=[
                f"vector3f physxForce:force = ({force}, 0, 0)",
                'uniform token physxForce:mode = "force"',
            ],
        )

    for friction in (0.2, 0.5, 1.0):
        hold = friction * 2 * G
        for part in (0.9, 0.97):
            yield push(
                f"holds_{friction:g}_{part:g}",
                f"{part:g} of what friction {friction:g} holds",
                friction,
                hold * part,
                0,
            )
        for part in (1.1, 1.5):
            way = hold * (part - 1) / 2 * 0.5**2 / 2
            yield push(
                f"gives_{friction:g}_{part:g}",
                f"{part:g} of what friction {friction:g} holds",
                friction,
                hold * part,
                way,
            )
    yield push(
        "holds_static",
        "static 0.8, dynamic 0.4, a force of 0.6 m g",
        0.4,
        0.6 * 2 * G,
        0,
        static_friction=0.8,
    )


def slope(name, shows, degrees, friction, seconds, sees_of, shape, height, **more):
    """A body on a slope that goes down along x; `sees_of` takes the directions of the slope."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    half = math.radians(degrees) / 2
    turn = (math.cos(half), 0, math.sin(half), 0)
    at = ((0.5 + height) * s, 0, (0.5 + height) * c)
    layer = scene(
        rough(friction),
        static("Ramp", (0, 0, 0), ("Cube", 1), turn, (20, 8, 1), material=ROUGH),
        body("A", at, shape, turn, material=ROUGH, **more),
    )
    return Form(name, shows, layer, seconds, sees_of(c, s))


def slopes():
    for degrees, friction in ((10, 0.5), (20, 0.4), (30, 0.6), (30, 0.9), (40, 1.0)):
        yield slope(
            f"slope_holds_{degrees}_{friction:g}",
            f"{degrees} degrees, friction {friction:g}",
            degrees,
            friction,
            1.0,
            lambda c, s: (moved(1.0, "x", 0, least=0.002), moved(1.0, "z", 0, least=0.002)),
            ("Cube", 1),
            0.05,
            scale=SLAB["scale"],
        )
    for degrees, friction in ((10, 0.0), (20, 0.2), (30, 0.3), (30, 0.5), (45, 0.5)):
        angle = math.radians(degrees)
        way = G * (math.sin(angle) - friction * math.cos(angle)) / 2 * 0.8**2
        yield slope(
            f"slope_slides_{degrees}_{friction:g}",
            f"{degrees} degrees, friction {friction:g}",
            degrees,
            friction,
            0.8,
            lambda c, s, way=way: (
                moved(0.8, "x", way * c, 0.02, 0.002),
                moved(0.8, "z", -way * s, 0.02, 0.002),
            ),
            ("Cube", 1),
            0.05,
            scale=SLAB["scale"],
        )
    for height, topples in ((0.4, False), (0.8, True)):

        def sees(c, s, topples=topples, height=height):
            if topples:  # about its lower edge, onto its side
                way = (height + 0.2) / 2 * s + (height - 0.2) / 2 * c
                return (moved(1.5, "z", -way, 0.1),)
            return (moved(1.0, "x", 0, least=0.002), moved(1.0, "z", 0, least=0.002))

        yield slope(
            f"tower_{height:g}",
            f"a tower of 0.2 x {height:g} m on 20 degrees " + ("topples" if topples else "stands"),
            20,
            1.0,
            1.5 if topples else 1.0,
            sees,
            ("Cube", 1),
            height / 2,
            scale=(0.2, 0.2, height),
        )


ROLLERS = {  # moment over m r^2
    "ball": (("Sphere", 0.2), 0.4),
    "cylinder": (("Cylinder", 0.2, 0.4, "Y"), 0.5),
    "hoop": (("Cylinder", 0.2, 0.4, "Y"), 0.95),
    "hollow_ball": (("Sphere", 0.2), 2 / 3),
}


def roller(name, **more):
    shape, part = ROLLERS[name]
    moment = part * 2.0 * 0.2**2
    return part, {"shape": shape, "mass": 2.0, "inertia": (moment,) * 3, **more}


def rolls_down():
    for name in ROLLERS:
        for degrees in (5, 20):
            part, words = roller(name)
            shape = words.pop("shape")
            way = G * math.sin(math.radians(degrees)) / (1 + part) / 2
            yield slope(
                f"rolls_{name}_{degrees}",
                f"a {name} rolls down {degrees} degrees",
                degrees,
                0.8,
                1.0,
                lambda c, s, way=way: (
                    moved(1.0, "x", way * c, 0.02),
                    moved(1.0, "z", -way * s, 0.02),
                ),
                shape,
                0.2,
                **words,
            )
    part, words = roller("ball")
    shape = words.pop("shape")
    way = G * (math.sin(math.radians(30)) - 0.1 * math.cos(math.radians(30))) / 2 * 0.64
    spin = math.degrees(0.1 * G * math.cos(math.radians(30)) / (part * 0.2) * 0.8)
    yield slope(
        "slips_30",
        "a ball slips down 30 degrees, friction 0.1",
        30,
        0.1,
        0.8,
        lambda c, s: (moved(0.8, "x", way * c, 0.02), turning(0.8, "y", spin, 0.02)),
        shape,
        0.2,
        **words,
    )


def rolls_level():
    for name in ROLLERS:
        part, words = roller(name)
        yield Form(
            f"catches_{name}",
            f"a {name} slides at 2 m/s until it rolls",
            scene(
                rough(0.5),
                floor(ROUGH),
                body("A", (0, 0, 0.2), velocity=(2, 0, 0), material=ROUGH, **words),
            ),
            0.8,
            (
                speed(0.8, "x", 2 / (1 + part), 0.02),
                turning(0.8, "y", math.degrees(10 / (1 + part)), 0.02),
            ),
        )
        yield Form(
            f"spun_{name}",
            f"a {name} spun at 20 rad/s moves off",
            scene(
                rough(0.5),
                floor(ROUGH),
                body("A", (0, 0, 0.2), spin=(0, math.degrees(20), 0), material=ROUGH, **words),
            ),
            0.8,
            (speed(0.8, "x", 4 * part / (1 + part), 0.02),),
        )
        yield Form(
            f"coasts_{name}",
            f"a {name} that rolls keeps its speed",
            scene(
                rough(0.5),
                floor(ROUGH),
                body(
                    "A",
                    (0, 0, 0.2),
                    velocity=(1, 0, 0),
                    spin=(0, math.degrees(5), 0),
                    material=ROUGH,
                    **words,
                ),
            ),
            1.5,
            (moved(1.5, "x", 1.5, 0.01), moved(1.5, "y", 0, least=0.005)),
        )
    part, words = roller("ball")
    time = 2 / (0.5 * G) * part / (1 + part)
    way = 2 * time - 0.25 * G * time**2 + (0.8 - time) * 2 / (1 + part)
    yield Form(
        "catches_way",
        "how far the sliding ball has come",
        scene(
            rough(0.5),
            floor(ROUGH),
            body("A", (0, 0, 0.2), velocity=(2, 0, 0), material=ROUGH, **words),
        ),
        0.8,
        (moved(0.8, "x", way, 0.02), moved(0.8, "y", 0, least=0.003)),
    )


KINDS = {
    "sliding and stopping": (stops,),
    "combine modes": (modes,),
    "force against friction": (thresholds,),
    "slopes": (slopes,),
    "rolling down": (rolls_down,),
    "rolling on the level": (rolls_level,),
}
