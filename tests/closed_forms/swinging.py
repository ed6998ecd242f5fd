# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Pendulums of all kinds, tops on a point, and joints that carry.

Each pendulum is there as a plain joint and, where it says so, as an articulation. Of an angle 1.5 %
of its amplitude, half a step of its largest speed and the damping of methods of first order, and
1 % of the period.
"""

import math

import ode
from form import G, WEIGHTLESS, Form, See, coordinate, facing, moved, rotate, stands, turned

from author import body, drive, joint, scene

A, B = "/World/A", "/World/B"
SWAY = 0.015
PERIOD = 0.01


def around_y(degrees):
    half = math.radians(degrees) / 2
    return (math.cos(half), 0.0, math.sin(half), 0.0)


def bob(degrees, arm, name="A", at=(0, 0, 3), **more):
    """A body whose joint is at `at` and which hangs there, turned from straight down about Y."""
    turn = around_y(degrees)
    way = rotate(turn, (0, 0, -arm))
    words = {"collides": False, "shape": ("Sphere", 0.05), **more}
    return body(
        name, tuple(p + q for p, q in zip(at, way)), turn=turn if degrees else None, **words
    )


def hung(degrees, arm, mass, moment, articulated=False, **more):
    return scene(
        bob(degrees, arm, mass=mass, inertia=(moment,) * 3),
        joint("revolute", "J", None, A, (0, 0, 3), (0, 0, arm), axis="Y", **more),
        articulated=articulated,
    )


def swing(name, shows, degrees, arm, mass, moment, times, articulated=False):
    strength = mass * G * arm / (mass * arm * arm + moment)
    sees = []
    for t in times:
        angle, rate = map(math.degrees, ode.pendulum(t, math.radians(degrees), strength))
        sees.append(coordinate(t, angle, SWAY * degrees + PERIOD * t * abs(rate)))
    return Form(name, shows, hung(degrees, arm, mass, moment, articulated), max(times), tuple(sees))


def simple():
    for degrees in (5, 60, 120, 170):
        yield swing(
            f"pendulum_{degrees}",
            f"a bob of 1 m swings from {degrees} degrees",
            degrees,
            1.0,
            2.0,
            1e-3,
            (0.5, 1.0, 2.0),
        )
    yield swing(
        "pendulum_60_articulated",
        "the same as an articulation",
        60,
        1.0,
        2.0,
        1e-3,
        (0.5, 1.0, 2.0),
        True,
    )
    for arm in (0.2, 5.0):
        yield swing(
            f"pendulum_arm_{arm:g}",
            f"a pendulum of {arm:g} m",
            60,
            arm,
            2.0,
            1e-3 * arm**2,
            (0.5, 1.0) if arm < 1 else (1.0, 2.0),
        )
    for moment in (0.3, 5.0):
        yield swing(
            f"pendulum_physical_{moment:g}",
            f"a moment of {moment:g} kg m2 about the centre",
            60,
            0.5,
            2.0,
            moment,
            (0.5, 1.0, 2.0),
        )


def rods():
    rod = 1 / 12
    yield swing("pendulum_rod", "a rod of 1 m on its end", 90, 0.5, 1.0, rod, (0.5, 1.0))
    yield swing(
        "pendulum_rod_articulated",
        "the same as an articulation",
        90,
        0.5,
        1.0,
        rod,
        (0.5, 1.0),
        True,
    )
    strength = 2 * G / 2.001
    yield Form(
        "pendulum_damped",
        "damping of the joint by a drive without stiffness",
        hung(60, 1.0, 2.0, 1e-3, parts=[drive("angular", damping=2 * math.pi / 180)]),
        1.5,
        tuple(
            coordinate(
                t,
                math.degrees(ode.pendulum(t, math.radians(60), strength, 2 / 2.001)[0]),
                0.02 * 60,
            )
            for t in (0.5, 1.0, 1.5)
        ),
    )


def conical():
    for degrees in (20, 60):
        angle = math.radians(degrees)
        rate = math.sqrt(G / math.cos(angle))  # of an arm of 1 m
        at = (math.sin(angle), 0, 3 - math.cos(angle))
        turns = rate * 1.0
        layer = scene(
            body(
                "A",
                at,
                collides=False,
                mass=2.0,
                inertia=(1e-4,) * 3,
                velocity=(0, rate * math.sin(angle), 0),
                spin=(0, 0, math.degrees(rate)),
            ),
            joint(
                "spherical",
                "J",
                None,
                A,
                (0, 0, 3),
                (-math.sin(angle), 0, math.cos(angle)),
                axis="Z",
            ),
        )
        size = math.sin(angle)
        yield Form(
            f"conical_{degrees}",
            f"a bob circles at {degrees} degrees from straight down",
            layer,
            1.0,
            (
                stands(1.0, "x", size * math.cos(turns), 0.02 * size * turns),
                stands(1.0, "y", size * math.sin(turns), 0.02 * size * turns),
                stands(1.0, "z", at[2], 0.02 * size),
            ),
        )


def with_carriages():
    carriage = body("C", (0, 0, 3), collides=False, mass=3.0, inertia=(0.1,) * 3)
    arm = math.radians(60)
    for articulated in (False, True):
        end = ode.cart(1.0, -arm, 3.0, 1.0, 0.8, 1e-3, G)
        layer = scene(
            carriage,
            bob(60, 0.8, mass=1.0, inertia=(1e-3,) * 3),
            joint("prismatic", "S", None, "/World/C", (0, 0, 3), axis="X"),
            joint("revolute", "J", "/World/C", A, (0, 0, 0), (0, 0, 0.8), axis="Y"),
            articulated=articulated,
        )
        yield Form(
            "cart" + "_articulated" * articulated,
            "a pendulum on a carriage",
            layer,
            1.0,
            (
                moved(1.0, "x", end[0], 0.02, 0.005, "C"),
                coordinate(1.0, -math.degrees(end[1]), SWAY * 60),
            ),
        )
    for stiffness in (1.0, 20.0):
        moment = 0.1
        end = ode.oscillator(0.7, moment, 0.0, stiffness, start=math.radians(40))[0]
        yield Form(
            f"torsion_{stiffness:g}",
            f"a torsion spring of {stiffness:g} N m",
            scene(
                body(
                    "A",
                    (0, 0, 3),
                    turn=around_y(40),
                    collides=False,
                    mass=2.0,
                    inertia=(moment,) * 3,
                ),
                joint(
                    "revolute",
                    "J",
                    None,
                    A,
                    (0, 0, 3),
                    axis="Y",
                    parts=[drive("angular", stiffness=stiffness * math.pi / 180)],
                ),
                gravity=WEIGHTLESS,
            ),
            0.7,
            (coordinate(0.7, math.degrees(end), 0.04 * 40),),
        )


MASSES, LENGTHS = (1.0, 1.0), (1.0, 1.0)
RODS = (1 / 12, 1 / 12)


def doubled(angles, articulated):
    first = bob(angles[0], 0.5, mass=1.0, inertia=(RODS[0],) * 3)
    tip = rotate(around_y(angles[0]), (0, 0, -1.0))
    second = bob(angles[1], 0.5, "B", (tip[0], 0, 3 + tip[2]), mass=1.0, inertia=(RODS[1],) * 3)
    return scene(
        first,
        second,
        joint("revolute", "J", None, A, (0, 0, 3), (0, 0, 0.5), axis="Y"),
        joint("revolute", "K", A, B, (0, 0, -0.5), (0, 0, 0.5), axis="Y"),
        articulated=articulated,
    )


def total_energy(run, time):
    energy = 0.0
    for name in ("A", "B"):
        state = run.body(name, time)
        spin = math.radians(math.hypot(*state["angularVelocity"]))
        energy += (
            sum(v * v for v in state["linearVelocity"]) / 2
            + RODS[0] * spin * spin / 2
            + G * state["position"][2]
        )
    return energy


def doubles():
    """Two rods; where the motion is chaotic only its energy is known."""
    for angles in ((-20, -20), (-60, -60), (-90, -90), (-120, -30)):
        for articulated in (False, True):
            seconds = 0.6
            end = ode.double_pendulum(
                seconds, tuple(map(math.radians, angles)), MASSES, LENGTHS, RODS, G
            )
            # From straight down a turn about Y leads towards -x.
            at = -math.sin(end[0]) - math.sin(end[1]) / 2
            size = 0.02 * math.radians(max(map(abs, angles)))
            yield Form(
                f"double_{-angles[0]}_{-angles[1]}" + "_articulated" * articulated,
                f"two rods from {angles[0]} and {angles[1]} degrees",
                doubled(angles, articulated),
                seconds,
                (
                    stands(seconds, "x", at, size, "B"),
                    stands(seconds, "z", 3 - math.cos(end[0]) - math.cos(end[1]) / 2, size, "B"),
                ),
            )
    for articulated in (False, True):
        yield Form(
            "double_energy" + "_articulated" * articulated,
            "two rods from level: 2 % of the energy that they can exchange in 2 s",
            doubled((-90, -90), articulated),
            2.0,
            (
                See(
                    "change of energy, J",
                    lambda run: total_energy(run, 2.0) - total_energy(run, 0.0),
                    0.0,
                    0.02 * 2 * G,
                ),
            ),
        )


def heavy_top(name, degrees, spin, seconds=1.0, mass=1.0, arm=0.25, across=0.008, along=0.01):
    """Steady precession on a point. Moments about the centre of mass; `spin` along the axis."""
    angle = math.radians(degrees)
    c, s = math.cos(angle), math.sin(angle)
    foot = across + mass * arm * arm
    # (foot cos) rate^2 - along spin rate + m g arm = 0, the slow one
    if abs(c) < 1e-9:
        rate = mass * G * arm / (along * spin)
    else:
        rate = (along * spin - math.sqrt((along * spin) ** 2 - 4 * foot * c * mass * G * arm)) / (
            2 * foot * c
        )
    axis = (s, 0, c)
    own = spin - rate * c  # `spin` is the whole of the angular velocity along the axis
    turn = tuple(math.degrees(rate * z + own * n) for z, n in zip((0, 0, 1), axis))
    velocity = (0, rate * arm * s, 0)
    half = angle / 2
    layer = scene(
        body(
            "A",
            (0, 0, 3),
            collides=False,
            mass=mass,
            inertia=(across, across, along),
            com=(arm * s, 0, arm * c),
            axes=(math.cos(half), 0, math.sin(half), 0),
            velocity=velocity,
            spin=turn,
            lines=["float physxRigidBody:maxAngularVelocity = 100000"],
        ),
        joint("spherical", "J", None, A, (0, 0, 3), axis="Z"),
    )

    def towards(run):
        return rotate(run.turn("A", seconds), axis)

    def precession(run):
        x, y, _ = towards(run)
        way = math.degrees(rate * seconds)
        return way + (math.degrees(math.atan2(y, x)) - way + 180) % 360 - 180

    way = math.degrees(rate * seconds)
    return Form(
        name,
        f"a top of {spin:g} rad/s at {degrees} degrees precesses",
        layer,
        seconds,
        (
            See(f"precession in {seconds:g} s, degrees", precession, way, max(2, 0.03 * way)),
            See(
                f"angle from upright at {seconds:g} s, degrees",
                lambda run: math.degrees(math.acos(max(-1, min(1, towards(run)[2])))),
                degrees,
                3.0,
            ),
        ),
    )


def tops():
    for degrees, spin in (
        (30, 100.0),
        (60, 90.0),
        (60, 120.0),
        (90, 60.0),
        (90, 150.0),
        (120, 60.0),
    ):
        yield heavy_top(f"heavy_top_{degrees}_{spin:g}", degrees, spin)
    yield heavy_top("heavy_top_light", 60, 50.0, mass=0.2)


def carriers():
    """Joints that hold a weight: nothing moves by more than 1 mm."""
    for kind in ("fixed", "revolute", "spherical"):
        for mass in (1.0, 1000.0):
            yield Form(
                f"holds_{kind}_{mass:g}_kg",
                f"a {kind} joint holds {mass:g} kg straight below",
                scene(
                    bob(0, 1.0, mass=mass, inertia=(0.01 * mass,) * 3),
                    joint(
                        kind,
                        "J",
                        None,
                        A,
                        (0, 0, 3),
                        (0, 0, 1.0),
                        axis=None if kind == "fixed" else "Y",
                    ),
                ),
                1.0,
                (moved(1.0, "z", 0), moved(1.0, "x", 0)),
            )
    for ratio in (1, 10, 100, 1000):
        for articulated in (False, True):
            links = [
                bob(0, 0.1, f"L{i}", (0, 0, 3 - 0.2 * i), mass=1.0, inertia=(0.004,) * 3)
                for i in range(4)
            ]
            load = bob(
                0, 0.1, "Load", (0, 0, 3 - 0.8), mass=float(ratio), inertia=(0.004 * ratio,) * 3
            )
            names = [f"/World/L{i}" for i in range(4)] + ["/World/Load"]
            joints = [joint("revolute", "J0", None, names[0], (0, 0, 3), (0, 0, 0.1), axis="Y")]
            joints += [
                joint(
                    "revolute", f"J{i}", names[i - 1], names[i], (0, 0, -0.1), (0, 0, 0.1), axis="Y"
                )
                for i in range(1, 5)
            ]
            yield Form(
                f"chain_{ratio}_to_1" + "_articulated" * articulated,
                f"a chain of 1 kg links carries {ratio} kg",
                scene(*links, load, *joints, articulated=articulated),
                1.0,
                (moved(1.0, "z", 0, least=0.0015, name="Load"), moved(1.0, "x", 0, name="Load")),
            )


def loaded():
    beam = body("A", (1, 0, 3), collides=False, mass=5.0, inertia=(0.1,) * 3)
    yield Form(
        "cantilever",
        "a fixed joint carries 5 kg on an arm of 1 m",
        scene(beam, joint("fixed", "J", None, A, (0, 0, 3), (-1, 0, 0))),
        1.0,
        (moved(1.0, "z", 0), facing(1.0, (1, 0, 0, 0), 0.1)),
    )
    spin = math.degrees(6.0)
    yield Form(
        "whirl",
        "a weight on a hinge circles at 6 rad/s",
        scene(
            body(
                "A",
                (1, 0, 3),
                collides=False,
                mass=2.0,
                inertia=(0.1,) * 3,
                velocity=(0, 6, 0),
                spin=(0, 0, spin),
            ),
            joint("revolute", "J", None, A, (0, 0, 3), (-1, 0, 0), axis="Z"),
        ),
        0.5,
        (turned(0.5, "z", math.degrees(3.0), 1.8), stands(0.5, "z", 3, 0.001)),
    )


KINDS = {
    "simple and physical pendulums": (simple, rods),
    "conical, torsion, on a carriage": (conical, with_carriages),
    "double pendulums": (doubles,),
    "heavy tops": (tops,),
    "joints that carry": (carriers, loaded),
}
