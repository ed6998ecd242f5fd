# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Drives, and settings of joints."""

import math

import ode
from form import G, WEIGHTLESS, Form, coordinate, moved, rate, turned

from author import body, drive, joint, limit, scene

A = "/World/A"
HALF = math.pi / 180


def carriage(at=(0, 0, 3), mass=2.0, **more):
    return body("A", at, collides=False, mass=mass, inertia=(0.1 * mass,) * 3, **more)


def slider(axis="X", mass=2.0, gravity=WEIGHTLESS, articulated=False, velocity=None, **words):
    return scene(
        carriage(mass=mass, velocity=velocity),
        joint("prismatic", "J", None, A, (0, 0, 3), axis=axis, **words),
        gravity=gravity,
        articulated=articulated,
    )


def wheel(moment=0.5, gravity=WEIGHTLESS, articulated=False, spin=None, **words):
    """A hinge about Y through the centre of mass."""
    return scene(
        body("A", (0, 0, 3), collides=False, mass=2.0, inertia=(moment,) * 3, spin=spin),
        joint("revolute", "J", None, A, (0, 0, 3), axis="Y", **words),
        gravity=gravity,
        articulated=articulated,
    )


def lever(degrees, mass=2.0, moment=0.02, articulated=False, **words):
    """A weight 1 m from its hinge, at first `degrees` below level."""
    angle = math.radians(degrees)
    half = angle / 2
    return scene(
        body(
            "A",
            (math.cos(angle), 0, 3 - math.sin(angle)),
            collides=False,
            mass=mass,
            inertia=(moment,) * 3,
            turn=(math.cos(half), 0, math.sin(half), 0),
        ),
        joint("revolute", "J", None, A, (0, 0, 3), (-1, 0, 0), axis="Y", **words),
        articulated=articulated,
    )


def sags():
    for stiffness in (100.0, 1000.0, 1e5):
        for articulated in (False, True):
            sag = 2 * G / stiffness
            yield Form(
                f"sag_{stiffness:g}" + "_articulated" * articulated,
                f"2 kg on a linear drive of {stiffness:g} N/m",
                slider(
                    "Z",
                    2.0,
                    (),
                    articulated,
                    parts=[
                        drive("linear", stiffness=stiffness, damping=2 * math.sqrt(2 * stiffness))
                    ],
                ),
                2.0,
                (coordinate(2.0, -sag, max(0.01 * sag, 1e-4)),),
            )
    for stiffness in (30.0, 100.0, 1000.0):
        angle = 0.0
        for _ in range(200):
            angle = 2 * G * math.cos(angle) / stiffness * 0.5 + angle * 0.5
        yield Form(
            f"lever_sag_{stiffness:g}",
            f"2 kg at 1 m on a drive of {stiffness:g} N m/rad",
            lever(
                0,
                parts=[
                    drive(
                        "angular",
                        stiffness=stiffness * HALF,
                        damping=2 * math.sqrt(2 * stiffness) * HALF,
                    )
                ],
            ),
            2.0,
            (coordinate(2.0, math.degrees(angle), max(0.01 * math.degrees(angle), 0.05)),),
        )
    yield Form(
        "sag_acceleration",
        "2 kg on an acceleration drive of 80 /s2",
        slider("Z", 2.0, (), parts=[drive("linear", "acceleration", 80.0, 15.0)]),
        2.0,
        (coordinate(2.0, -G / 80, 0.01 * G / 80),),
    )


def steps():
    """The step response of a mass on a drive has an exact solution."""
    for name, damping in (("swings", 0.2), ("damped", 0.7), ("critical", 1.0), ("slow", 2.0)):
        for pace in (6.0, 20.0):
            mass = 2.0
            stiffness, loss = mass * pace**2, 2 * damping * mass * pace
            times = (2.0 / pace, 5.0 / pace)
            times = tuple(round(t * 500) / 500 for t in times)
            sees = tuple(
                coordinate(
                    t,
                    ode.oscillator(t, mass, loss, stiffness, target=0.5)[0],
                    0.5 * max(0.015, pace * 0.002),
                )
                for t in times
            )
            yield Form(
                f"step_{name}_{pace:g}",
                f"{pace:g} rad/s, damping ratio {damping:g}",
                slider(parts=[drive("linear", "force", stiffness, loss, 0.5)]),
                times[-1],
                sees,
            )
    for articulated in (False, True):
        end = ode.oscillator(0.4, 0.5, 3.0, 20.0, target=math.radians(60))[0]
        yield Form(
            "step_angular" + "_articulated" * articulated,
            "an angular drive of 20 N m/rad",
            wheel(
                articulated=articulated,
                parts=[drive("angular", "force", 20 * HALF, 3 * HALF, 60.0)],
            ),
            0.4,
            (coordinate(0.4, math.degrees(end), 0.015 * 60),),
        )
    for mass in (0.5, 50.0):
        end = ode.oscillator(0.4, 1.0, 5.0, 40.0, target=0.5)[0]
        yield Form(
            f"step_acceleration_{mass:g}_kg",
            f"an acceleration drive moves {mass:g} kg alike",
            slider(mass=mass, parts=[drive("linear", "acceleration", 40.0, 5.0, 0.5)]),
            0.4,
            (coordinate(0.4, end, 0.0075),),
        )


def steps_of_others():
    end = ode.oscillator(0.4, 1.0, 6.0, 40.0, target=math.radians(60))[0]
    yield Form(
        "step_angular_acceleration",
        "an angular acceleration drive, gains per degree",
        wheel(parts=[drive("angular", "acceleration", 40 * HALF, 6 * HALF, 60.0)]),
        0.4,
        (coordinate(0.4, math.degrees(end), 1.2),),
    )
    locked = [limit(axis, 1, -1) for axis in ("transY", "transZ", "rotX", "rotY", "rotZ")]
    end = ode.oscillator(0.4, 2.0, 8.0, 80.0, target=0.5)[0]
    yield Form(
        "step_d6",
        "a drive along transX of a D6 joint",
        scene(
            carriage(),
            joint(
                "d6",
                "J",
                None,
                A,
                (0, 0, 3),
                parts=[*locked, drive("transX", "force", 80.0, 8.0, 0.5)],
            ),
            gravity=WEIGHTLESS,
        ),
        0.4,
        (moved(0.4, "x", end, 0, 0.0075),),
    )
    for index, axis in enumerate(("rotX", "rotY", "rotZ")):
        others = [
            limit(each, 1, -1)
            for each in ("transX", "transY", "transZ", "rotX", "rotY", "rotZ")
            if each != axis
        ]
        end = math.degrees(ode.oscillator(0.4, 0.2, 1.0, 8.0, target=math.radians(50))[0])
        yield Form(
            f"step_d6_{axis}",
            f"a drive along {axis} of a D6 joint",
            scene(
                carriage(),
                joint(
                    "d6",
                    "J",
                    None,
                    A,
                    (0, 0, 3),
                    parts=[*others, drive(axis, "force", 8 * HALF, HALF, 50.0)],
                ),
                gravity=WEIGHTLESS,
            ),
            0.4,
            (turned(0.4, "xyz"[index], end, 0.8),),
        )


def velocities():
    for damping in (5.0, 100.0):
        end = 0.8 * (1 - math.exp(-damping / 2 * 0.5))
        yield Form(
            f"speed_{damping:g}",
            f"a velocity drive of {damping:g} N s/m to 0.8 m/s",
            slider(parts=[drive("linear", damping=damping, target_velocity=0.8)]),
            0.5,
            (rate(0.5, end, 0.012),),
        )
    lag = 2 * G / 200
    yield Form(
        "speed_lifts",
        "a velocity drive of 200 N s/m lifts 2 kg",
        slider("Z", 2.0, (), parts=[drive("linear", damping=200.0, target_velocity=0.5)]),
        0.5,
        (rate(0.5, 0.5 - lag, 0.006),),
    )
    yield Form(
        "speed_falls",
        "2 kg fall against a damper of 50 N s/m",
        slider("Z", 2.0, (), parts=[drive("linear", damping=50.0)]),
        1.0,
        (rate(1.0, -2 * G / 50, 0.006),),
    )
    for articulated in (False, True):
        end = 90 * (1 - math.exp(-2 / 0.5 * 0.5))
        yield Form(
            "speed_turns" + "_articulated" * articulated,
            "2 N m s/rad to 90 degrees/s",
            wheel(
                articulated=articulated,
                parts=[drive("angular", damping=2 * HALF, target_velocity=90.0)],
            ),
            0.5,
            (rate(0.5, end, 1.5),),
        )
    end = 0.5 + 8.0 * 0.3 / 80.0
    yield Form(
        "both_targets",
        "a target of position and one of velocity",
        slider(parts=[drive("linear", "force", 80.0, 8.0, 0.5, 0.3)]),
        2.5,
        (coordinate(2.5, end, 0.006),),
    )


def saturations():
    for force in (1.0, 10.0):
        way = force / 2 * 0.4**2 / 2
        yield Form(
            f"max_force_{force:g}",
            f"a stiff drive of at most {force:g} N moves 2 kg",
            slider(parts=[drive("linear", "force", 1e4, 0.0, 10.0, max_force=force)]),
            0.4,
            (moved(0.4, "x", way, 0.015),),
        )
    for part in (0.9, 1.1):
        force = part * 2 * G
        way = ode.integrate(  # the drive has to give way first before it pulls
            lambda y, force=force: (
                y[1],
                max(-force, min(force, -1e4 * y[0] - 300 * y[1])) / 2 - G,
            ),
            [0.0, 0.0],
            0.5,
        )[0]
        yield Form(
            f"max_force_lifts_{part:g}",
            f"at most {part:g} m g under 2 kg",
            slider("Z", 2.0, (), parts=[drive("linear", "force", 1e4, 300.0, max_force=force)]),
            0.5,
            (moved(0.5, "z", way, 0.02, 0.003),),
        )
    for articulated in (False, True):
        yield Form(
            "max_torque" + "_articulated" * articulated,
            "at most 2 N m turn 0.5 kg m2",
            wheel(
                articulated=articulated,
                parts=[drive("angular", "force", 1e3, 0.0, 170.0, max_force=2.0)],
            ),
            0.5,
            (coordinate(0.5, math.degrees(0.5), 0.5),),
        )
    yield Form(
        "max_speed_force",
        "a velocity drive of at most 3 N",
        slider(parts=[drive("linear", damping=1e4, target_velocity=5.0, max_force=3.0)]),
        0.5,
        (rate(0.5, 0.75, 0.01), moved(0.5, "x", 0.1875, 0.015)),
    )


def axis_api(kind, **settings):
    return {
        "apis": [f"PhysxJointAxisAPI:{kind}"],
        "lines": [
            f"float physxJointAxis:{kind}:{name} = {number}" for name, number in settings.items()
        ],
    }


def joint_settings():
    """Of an articulation, where PhysX reads them."""
    torque = [drive("angular", "force", 1e3, 0.0, 170.0, max_force=2.0)]
    for armature in (0.5, 5.0):
        angle = math.degrees(2.0 / (0.5 + armature) * 0.5**2 / 2)
        yield Form(
            f"armature_{armature:g}",
            f"an armature of {armature:g} kg m2 beside 0.5",
            wheel(articulated=True, parts=torque, **axis_api("angular", armature=armature)),
            0.5,
            (coordinate(0.5, angle, 0.015 * angle),),
        )
    for friction in (1.0, 4.0):
        dry = axis_api("angular", staticFrictionEffort=friction, dynamicFrictionEffort=friction)
        end = 180**2 * HALF * 0.5 / (2 * friction)
        yield Form(
            f"dry_friction_{friction:g}",
            f"dry friction of {friction:g} N m stops a wheel",
            wheel(articulated=True, spin=(0, 180, 0), **dry),
            1.8,
            (coordinate(1.8, end, 0.02 * end + 0.4),),
        )
    dry = axis_api("angular", staticFrictionEffort=3.0, dynamicFrictionEffort=3.0)
    yield Form(
        "dry_friction_holds",
        "dry friction of 3 N m holds 2 N m",
        wheel(articulated=True, parts=torque, **dry),
        1.0,
        (coordinate(1.0, 0, 0.5),),
    )
    end = 180 * (1 - math.exp(-0.5 / 0.5))
    yield Form(
        "viscous_friction",
        "viscous friction of 0.5 N m s/rad",
        wheel(
            articulated=True,
            spin=(0, 180, 0),
            **axis_api("angular", viscousFrictionCoefficient=0.5 * HALF),
        ),
        1.0,
        (coordinate(1.0, end * 1.0, 0.015 * end),),
    )


def joint_speeds():
    torque = [drive("angular", "force", 1e3, 0.0, 170.0, max_force=2.0)]
    yield Form(
        "joint_speed",
        "maxJointVelocity of 60 degrees/s",
        wheel(articulated=True, parts=torque, **axis_api("angular", maxJointVelocity=60)),
        1.0,
        (rate(1.0, 60, 0.6),),
    )
    state = {
        "apis": ["PhysicsJointStateAPI:angular"],
        "lines": ["float state:angular:physics:velocity = 60"],
    }
    yield Form(
        "joint_state",
        "a velocity of the joint at the start",
        wheel(articulated=True, **state),
        1.0,
        (coordinate(1.0, 60, 0.6),),
    )
    for stiffness in (50.0, 500.0):  # per radian, unlike the gains of drives
        soft = {
            "apis": ["PhysxLimitAPI:angular"],
            "lines": [
                f"float physxLimit:angular:stiffness = {stiffness}",
                f"float physxLimit:angular:damping = {2 * math.sqrt(2 * stiffness)}",
            ],
        }
        angle = 0.0
        for _ in range(200):
            angle = (2 * G * math.cos(angle) / stiffness + angle) / 2
        yield Form(
            f"soft_limit_{stiffness:g}",
            f"a soft limit of {stiffness:g} N m/rad carries a lever",
            lever(0, limits=(-90, 0), **soft),
            2.0,
            (coordinate(2.0, math.degrees(angle), max(0.02 * math.degrees(angle), 0.05)),),
        )


def finger(links, stiffness, damping, target, most, articulated):
    """Light links in a row, each on a drive of its own; L0 to begin with hangs on the world."""
    parts = [drive("angular", "force", stiffness, damping, target, max_force=most)]
    prims = []
    for i in range(links):
        prims.append(
            body(
                f"L{i}",
                (0.02 + 0.04 * i, 0, 3),
                collides=False,
                mass=0.02,
                inertia=(2e-6,) * 3,
            )
        )
        before = f"/World/L{i - 1}" if i else None
        start = (0.02, 0, 0) if i else (0, 0, 3)
        prims.append(
            joint(
                "revolute",
                f"J{i}",
                before,
                f"/World/L{i}",
                start,
                (-0.02, 0, 0),
                axis="Y",
                limits=(-90, 90),
                parts=parts,
            )
        )
    return scene(*prims, gravity=WEIGHTLESS, articulated=articulated)


def fingers():
    """Drives that are stiff against the inertia of their links reach their targets and stay."""
    for links in (1, 2, 3, 5):
        for stiffness, most in ((1.0, 1.4), (5.0, 1.4), (5.0, None), (50.0, 0.5)):
            limit_words = "without a limit" if most is None else f"at most {most:g} N m"
            yield Form(
                f"finger_{links}_{stiffness:g}_{most or 'any'}",
                f"{links} light links on drives of {stiffness:g} N m/degree, {limit_words}",
                finger(links, stiffness, stiffness / 30, 20.0, most, articulated=True),
                1.0,
                tuple(coordinate(1.0, 20, 0.3, f"J{i}") for i in range(links)),
            )


KINDS = {
    "drives: sag": (sags,),
    "drives: step response": (steps, steps_of_others),
    "drives: stiff and light": (fingers,),
    "drives: speed": (velocities,),
    "drives: largest force": (saturations,),
    "settings of joints": (joint_settings, joint_speeds),
}
