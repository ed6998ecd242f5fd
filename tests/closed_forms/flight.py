# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Free bodies: falls, throws, damping, forces, locked axes; and bodies that turn freely."""

import math

from form import G, WEIGHTLESS, Form, See, facing, moved, rotate, speed, turned, turning
from ode import tumble

from author import body, prim, scene

ROUND = {"mass": 1.0, "inertia": (0.02, 0.02, 0.02)}


def falls():
    for seconds in (0.5, 1.0, 2.0):
        yield Form(
            f"fall_{seconds:g}",
            f"a box falls for {seconds:g} s",
            scene(body("A", (0, 0, 30))),
            seconds,
            (moved(seconds, "z", -G / 2 * seconds**2), speed(seconds, "z", -G * seconds)),
        )
    for mass in (0.001, 1e5):
        yield Form(
            f"fall_{mass:g}_kg",
            f"{mass:g} kg fall",
            scene(body("A", (0, 0, 30), mass=mass, inertia=(mass,) * 3)),
            1.0,
            (moved(1.0, "z", -G / 2),),
        )
    yield Form(
        "throw",
        "a throw",
        scene(body("A", (0, 0, 5), velocity=(2, 1, 3))),
        1.0,
        (moved(1.0, "x", 2), moved(1.0, "y", 1), moved(1.0, "z", 3 - G / 2)),
    )
    yield Form(
        "straight",
        "100 m/s without weight",
        scene(body("A", velocity=(100, 0, 0)), gravity=WEIGHTLESS),
        1.0,
        (moved(1.0, "x", 100, 1e-4),),
    )
    yield Form(
        "moon",
        "gravity of 1.62",
        scene(body("A"), gravity=["float physics:gravityMagnitude = 1.62"]),
        2.0,
        (moved(2.0, "z", -1.62 * 2),),
    )


def falls_elsewhere():
    skew = [
        "vector3f physics:gravityDirection = (0, 0.6, 0.8)",
        "float physics:gravityMagnitude = 5",
    ]
    yield Form(
        "gravity_skew",
        "gravity along (0, 0.6, 0.8)",
        scene(body("A"), gravity=skew),
        1.0,
        (moved(1.0, "y", 1.5), moved(1.0, "z", 2.0), moved(1.0, "x", 0)),
    )
    for up in "YX":
        start = (30, 0, 0) if up == "X" else (0, 30, 0)
        yield Form(
            f"up_{up.lower()}",
            f"down is -{up}",
            scene(body("A", start), up=up),
            1.0,
            (moved(1.0, up.lower(), -G / 2), moved(1.0, "z", 0)),
        )
    yield Form(
        "two_gravities",
        "two scenes of different gravity",
        scene(
            prim("PhysicsScene", "S2", (), ["float physics:gravityMagnitude = 1"]),
            body("A", (0, 0, 30)),
            body("B", (2, 0, 30), lines=["rel physics:simulationOwner = </World/S2>"]),
        ),
        1.0,
        (moved(1.0, "z", -G / 2), moved(1.0, "z", -0.5, name="B")),
    )
    yield Form(
        "weight_off",
        "physxRigidBody:disableGravity",
        scene(body("A", velocity=(1, 0, 0), lines=["bool physxRigidBody:disableGravity = true"])),
        1.0,
        (moved(1.0, "x", 1), moved(1.0, "z", 0)),
    )
    arm = (0.3, 0, 0)
    turn = (math.cos(math.pi / 3), 0, 0, math.sin(math.pi / 3))
    end = rotate(turn, arm)
    yield Form(
        "spun_throw",
        "a thrown body turns about its centre of mass",
        scene(body("A", (0, 0, 9), velocity=(1, 2, 3), spin=(0, 0, 120), com=arm, **ROUND)),
        1.0,
        (
            moved(1.0, "x", 1 + arm[0] - end[0]),
            moved(1.0, "y", 2 - end[1]),
            moved(1.0, "z", 3 - G / 2),
            turned(1.0, "z", 120),
        ),
    )


def damped():
    for rate in (0.5, 2.0, 5.0):
        yield Form(
            f"drag_{rate:g}",
            f"linearDamping {rate:g}",
            scene(
                body(
                    "A", velocity=(2, 0, 0), lines=[f"float physxRigidBody:linearDamping = {rate}"]
                ),
                gravity=WEIGHTLESS,
            ),
            1.0,
            (moved(1.0, "x", 2 / rate * (1 - math.exp(-rate)), 0.015),),
        )
        yield Form(
            f"turn_drag_{rate:g}",
            f"angularDamping {rate:g}",
            scene(body("A", spin=(0, 0, 180), damping=rate), gravity=WEIGHTLESS),
            1.0,
            (turned(1.0, "z", 180 / rate * (1 - math.exp(-rate)), 2.0),),
        )
    yield Form(
        "drag_fall",
        "a fall with linearDamping 2",
        scene(body("A", (0, 0, 30), lines=["float physxRigidBody:linearDamping = 2"])),
        2.0,
        (speed(2.0, "z", -G / 2 * (1 - math.exp(-4)), 0.015),),
    )
    fall = 3 / G
    yield Form(
        "speed_cap",
        "maxLinearVelocity 3",
        scene(body("A", (0, 0, 30), lines=["float physxRigidBody:maxLinearVelocity = 3"])),
        1.0,
        (moved(1.0, "z", -(1.5 * fall + 3 * (1 - fall))),),
    )
    lock = "int physxRigidBody:lockedPosAxis = "
    for number, axis in ((1, "x"), (2, "y"), (4, "z")):
        free = {"x": 1.0, "y": 2.0, "z": -G / 2, axis: 0.0}
        yield Form(
            f"locked_{axis}",
            f"lockedPosAxis {number}",
            scene(body("A", (0, 0, 9), velocity=(1, 2, 0), lines=[lock + str(number)])),
            1.0,
            tuple(moved(1.0, one, way) for one, way in free.items()),
        )
    yield Form(
        "locked_turn",
        "lockedRotAxis 4",
        scene(
            body("A", spin=(0, 0, 90), lines=["int physxRigidBody:lockedRotAxis = 4"]),
            gravity=WEIGHTLESS,
        ),
        1.0,
        (turned(1.0, "z", 0),),
    )


def pushed(name, shows, lines, sees, **more):
    return Form(
        name,
        shows,
        scene(
            body(
                "A",
                apis=["PhysxForceAPI"],
                lines=lines,
                mass=2.0,
                inertia=(0.05, 0.05, 0.05),
                **more,
            ),
            gravity=WEIGHTLESS,
        ),
        1.0,
        sees,
    )


def forces():
    force = "vector3f physxForce:force = "
    mode = "uniform token physxForce:mode = "
    yield pushed(
        "force",
        "a force of 4 N on 2 kg",
        [force + "(4, 0, 0)", mode + '"force"'],
        (moved(1.0, "x", 1.0),),
    )
    yield pushed(
        "force_acceleration",
        "an acceleration of 3 m/s2",
        [force + "(0, 3, 0)", mode + '"acceleration"'],
        (moved(1.0, "y", 1.5),),
    )
    yield pushed(
        "force_local",
        "a force along the axes of a body that lies on its side",
        [force + "(4, 0, 0)", mode + '"force"', "bool physxForce:worldFrameEnabled = false"],
        (moved(1.0, "y", 1.0), moved(1.0, "x", 0)),
        turn=(math.sqrt(0.5), 0, 0, math.sqrt(0.5)),
    )
    yield pushed(
        "torque",
        "a torque of 0.1 N m on 0.05 kg m2",
        ["vector3f physxForce:torque = (0, 0, 0.1)", mode + '"force"'],
        (turned(1.0, "z", math.degrees(1.0)),),
    )


def energy_change(moments, spin, seconds):
    """[%], of the energy of turning."""
    start = sum(i * w * w for i, w in zip(moments, spin))

    def measured(run):
        w, x, y, z = run.turn("A", seconds)
        rates = rotate((w, -x, -y, -z), [math.radians(v) for v in run.spin("A", seconds)])
        return 100 * (sum(i * v * v for i, v in zip(moments, rates)) / start - 1)

    return See("change of energy, %", measured, 0.0, 2.0)


def free_turn(name, shows, moments, spin, seconds):
    """`spin` in rad/s. 2 % of the angle through which the body turns, at most 10 degrees."""
    turn, _ = tumble(seconds, moments, spin)
    way = math.degrees(math.hypot(*spin)) * seconds
    layer = scene(
        body(
            "A",
            mass=1.0,
            inertia=moments,
            spin=tuple(map(math.degrees, spin)),
            lines=["float physxRigidBody:maxAngularVelocity = 100000"],
        ),
        gravity=WEIGHTLESS,
    )
    return Form(
        name,
        shows,
        layer,
        seconds,
        (facing(seconds, turn, min(10, max(1, 0.02 * way))), energy_change(moments, spin, seconds)),
    )


def gyroscopes():
    three, top, disc = (0.01, 0.02, 0.03), (0.02, 0.02, 0.01), (0.01, 0.01, 0.018)
    for axis in range(3):
        spin = tuple(3.0 if i == axis else 0.0 for i in range(3))
        yield free_turn(
            f"principal_{'xyz'[axis]}", "a turn about a principal axis", three, spin, 1.0
        )
    for size in (1.0, 3.0, 10.5, 30.0, 60.0):
        spin = tuple(size * part for part in (0.2, 0.95, 0.24))
        yield free_turn(
            f"tumble_{size:g}", f"three moments, {size:g} rad/s", three, spin, min(1.0, 12 / size)
        )
    for name, moments in (("top", top), ("disc", disc)):
        for size in (3.0, 10.0, 30.0):
            spin = (size * math.sin(0.4), 0.0, size * math.cos(0.4))
            yield free_turn(
                f"{name}_{size:g}",
                f"a symmetric {name} precesses, {size:g} rad/s",
                moments,
                spin,
                min(1.0, 12 / size),
            )
    spin = (2.0, 3.0, 1.0)
    half = math.hypot(*spin) * 0.5 / 2
    unit = [part / math.hypot(*spin) * math.sin(half) for part in spin]
    yield Form(
        "gyroscopic_off",
        "enableGyroscopicForces switched off",
        scene(
            body(
                "A",
                mass=1.0,
                inertia=three,
                spin=tuple(map(math.degrees, spin)),
                lines=["bool physxRigidBody:enableGyroscopicForces = false"],
            ),
            gravity=WEIGHTLESS,
        ),
        0.5,
        (facing(0.5, (math.cos(half), *unit), 2.0), turning(0.5, "y", math.degrees(3.0), 0.02)),
    )


KINDS = {
    "flight": (falls, falls_elsewhere),
    "damping, caps and locks": (damped,),
    "forces": (forces,),
    "free gyroscopes": (gyroscopes,),
}
