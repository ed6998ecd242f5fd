# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Mimics, gears, racks, loops, and joints that break."""

import math

import ode
from form import G, WEIGHTLESS, Form, See, coordinate, moved, path_of, rate, stands

from author import body, drive, joint, prim, scene

HALF = math.pi / 180
WHEEL = {"mass": 1.0, "inertia": (0.05,) * 3, "collides": False}


def base():
    return body("Base", (0, 0, 3), collides=False, mass=5.0, inertia=(1.0,) * 3) + joint(
        "fixed", "Weld", None, "/World/Base", (0, 0, 3)
    )


def wheels(lead, *others, articulated=True, extra=()):
    """Wheels about Y beside one another on a welded base; `lead`, `others`: words of the joints."""
    parts = [base()]
    for i, words in enumerate((lead, *others)):
        parts.append(body(f"W{i}", (0.5 * i, 0, 3), **WHEEL))
        parts.append(
            joint(
                "revolute",
                f"J{i}",
                "/World/Base",
                f"/World/W{i}",
                (0.5 * i, 0, 0),
                axis="Y",
                **words,
            )
        )
    return scene(*parts, *extra, gravity=WEIGHTLESS, articulated=articulated)


def physx_mimic(gearing, offset=0.0, leader="J0"):
    return {
        "apis": ["PhysxMimicJointAPI:rotY"],
        "limits": (-3000, 3000),
        "lines": [
            f"float physxMimicJoint:rotY:gearing = {gearing}",
            f"float physxMimicJoint:rotY:offset = {offset}",
            f"rel physxMimicJoint:rotY:referenceJoint = </World/{leader}>",
            'uniform token physxMimicJoint:rotY:referenceJointAxis = "rotY"',
        ],
    }


def newton_mimic(factor, offset=0.0, leader="J0"):
    return {
        "apis": ["NewtonMimicAPI"],
        "limits": (-3000, 3000),
        "lines": [
            f"float newton:mimicCoef0 = {offset}",
            f"float newton:mimicCoef1 = {factor}",
            f"rel newton:mimicJoint = </World/{leader}>",
        ],
    }


def led(target=30.0, stiffness=20.0, damping=4.0):
    return {
        "limits": (-3000, 3000),
        "parts": [drive("angular", "force", stiffness * HALF, damping * HALF, target)],
    }


def ratio(name, factor, seconds, offset=0.0, leader="J0"):
    """How far a joint is from what its leader says."""
    return See(
        f"{name} less {factor:g} times {leader} at {seconds:g} s",
        lambda run: run.joint(name, seconds) - factor * run.joint(leader, seconds) - offset,
        0.0,
        0.3,
    )


def mimics():
    for gearing in (-0.5, -1.0, 1.0, -3.0, 2.0):
        yield Form(
            f"mimic_{gearing:g}",
            f"PhysxMimicJointAPI of gearing {gearing:g}",
            wheels(led(), physx_mimic(gearing)),
            1.5,
            (coordinate(1.5, 30, 0.5, "J0"), coordinate(1.5, -30 * gearing, 0.5, "J1")),
        )
    for factor in (0.5, 1.0, -2.0):
        yield Form(
            f"newton_mimic_{factor:g}",
            f"NewtonMimicAPI of factor {factor:g}",
            wheels(led(), newton_mimic(factor)),
            1.5,
            (coordinate(1.5, 30, 0.5, "J0"), coordinate(1.5, 30 * factor, 0.5, "J1")),
        )
    yield Form(
        "mimic_chain",
        "a mimic of a mimic",
        wheels(led(), physx_mimic(-1.5), physx_mimic(-1.5, leader="J1")),
        2.0,
        (coordinate(2.0, 45, 0.7, "J1"), coordinate(2.0, 67.5, 1.0, "J2")),
    )
    yield Form(
        "mimic_chain_fast",
        "a mimic of a mimic at 90 degrees/s by a drive of 5 per degree",
        wheels(
            {
                "limits": (-3000, 3000),
                "parts": [drive("angular", damping=5.0, target_velocity=90.0)],
            },
            physx_mimic(-1.5),
            physx_mimic(-1.5, leader="J1"),
        ),
        0.5,
        (rate(0.5, 90, 1.0, "J0"), rate(0.5, 202.5, 3.0, "J2")),
    )
    yield Form(
        "mimic_two",
        "two mimics of one leader",
        wheels(led(), physx_mimic(-1.5), physx_mimic(0.5)),
        2.0,
        (coordinate(2.0, 45, 0.7, "J1"), coordinate(2.0, -15, 0.5, "J2")),
    )


def mimics_and_inertia():
    for gearing in (-1.0, -3.0):
        moment = 0.05 * (1 + gearing**2)
        angle = math.degrees(0.2 / moment * 0.5**2 / 2)
        lead = {
            "limits": (-3000, 3000),
            "parts": [drive("angular", "force", 1e3, 0.0, 170.0, max_force=0.2)],
        }
        yield Form(
            f"mimic_inertia_{gearing:g}",
            "a torque of 0.2 N m moves leader and mimic",
            wheels(lead, physx_mimic(gearing)),
            0.5,
            (
                coordinate(0.5, angle, 0.02 * angle, "J0"),
                coordinate(0.5, -gearing * angle, -gearing * 0.02 * angle, "J1"),
            ),
        )
    moment = 0.05 + 0.05 * 4
    end = math.degrees(ode.oscillator(0.4, moment, 0.5, 5.0, target=math.radians(30))[0])
    yield Form(
        "mimic_step",
        "the step response of leader and mimic together",
        wheels(led(30.0, 5.0, 0.5), newton_mimic(2.0)),
        0.4,
        (coordinate(0.4, end, 0.02 * 30, "J0"), coordinate(0.4, 2 * end, 0.02 * 60, "J1")),
    )


def gear(number):
    return prim(
        "PhysxPhysicsGearJoint",
        "G",
        (),
        [
            "rel physics:body0 = </World/W0>",
            "rel physics:body1 = </World/W1>",
            f"float physics:gearRatio = {number}",
            "rel physics:hinge0 = </World/J0>",
            "rel physics:hinge1 = </World/J1>",
        ],
    )


def rack(number, articulated, parts):
    wheel = body("W0", (0, 0, 3), **WHEEL)
    bar = body("R", (0, 0, 3.5), **WHEEL)
    return scene(
        base(),
        wheel,
        bar,
        joint("revolute", "J0", "/World/Base", "/World/W0", axis="Y", parts=parts),
        joint("prismatic", "J1", "/World/Base", "/World/R", (0, 0, 0.5), axis="X"),
        prim(
            "PhysxPhysicsRackAndPinionJoint",
            "K",
            (),
            [
                "rel physics:body0 = </World/W0>",
                "rel physics:body1 = </World/R>",
                "rel physics:hinge = </World/J0>",
                "rel physics:prismatic = </World/J1>",
                f"float physics:ratio = {number}",
            ],
        ),
        gravity=WEIGHTLESS,
        articulated=articulated,
    )


def gears():
    for number in (1.0, -2.0, 3.0):
        pace = 90 * (1 - math.exp(-0.02 / HALF / (0.05 * (1 + number**2))))
        for articulated in (False, True):
            yield Form(
                f"gear_{number:g}" + "_articulated" * articulated,
                f"a gear of ratio {number:g} from a driven wheel",
                wheels(
                    {"parts": [drive("angular", damping=0.02, target_velocity=90.0)]},
                    {},
                    articulated=articulated,
                    extra=(gear(number),),
                ),
                1.0,
                (
                    rate(1.0, pace, 2.0, "J0"),
                    rate(1.0, -pace * number, 2.0 * abs(number), "J1"),
                    ratio("J1", -number, 1.0),
                ),
            )
    moment = 0.05 * (1 + 4)
    angle = math.degrees(0.2 / moment * 0.5**2 / 2)
    yield Form(
        "gear_inertia",
        "a torque of 0.2 N m moves both wheels",
        wheels(
            {"parts": [drive("angular", "force", 1e3, 0.0, 170.0, max_force=0.2)]},
            {},
            articulated=False,
            extra=(gear(2.0),),
        ),
        0.5,
        (
            coordinate(0.5, angle, 0.02 * angle, "J0"),
            coordinate(0.5, -2 * angle, 0.04 * angle, "J1"),
        ),
    )
    for number in (60.0, 300.0, 900.0):
        for articulated in (False, True):
            yield Form(
                f"rack_{number:g}" + "_articulated" * articulated,
                f"a rack of {number:g} degrees/m from a driven wheel",
                rack(number, articulated, [drive("angular", damping=0.5, target_velocity=90.0)]),
                1.0,
                (rate(1.0, 90, 2.0, "J0"), rate(1.0, 90 / number, 2.0 / number, "J1")),
            )


CRANK = -180.0


def crank_slider(radius, rod, damping, articulated):
    link = {"collides": False, "mass": 1.0}
    return scene(
        body("C", (radius / 2, 0, 0), inertia=(0.02,) * 3, **link),
        body("D", (radius + rod / 2, 0, 0), inertia=(0.05,) * 3, **link),
        body("P", (radius + rod, 0, 0), inertia=(0.02,) * 3, **link),
        joint(
            "revolute",
            "J",
            None,
            "/World/C",
            (0, 0, 0),
            (-radius / 2, 0, 0),
            axis="Y",
            parts=[drive("angular", damping=damping, target_velocity=CRANK)],
        ),
        joint(
            "revolute", "K", "/World/C", "/World/D", (radius / 2, 0, 0), (-rod / 2, 0, 0), axis="Y"
        ),
        joint("revolute", "L", "/World/D", "/World/P", (rod / 2, 0, 0), axis="Y"),
        joint(
            "prismatic",
            "M",
            None,
            "/World/P",
            (radius + rod, 0, 0),
            axis="X",
            lines=["uniform bool physics:excludeFromArticulation = true"],
        ),
        gravity=WEIGHTLESS,
        articulated=articulated,
    )


def piston(radius, rod, seconds):
    """Where the piston is for the angle that the crank has."""

    def measured(run):
        angle = math.radians(run.joint("J", seconds))
        return (
            run.place("P", seconds)[0]
            - radius * math.cos(angle)
            - math.sqrt(rod**2 - (radius * math.sin(angle)) ** 2)
        )

    return See(f"place of the piston away from its crank's at {seconds:g} s", measured, 0.0, 0.002)


def bar_drop(arm, seconds):
    """The bar of a parallelogram swings like a simple pendulum, its rods being light."""
    angle = ode.pendulum(seconds, math.radians(30), G / arm)[0]
    return -math.sin(angle) * arm + math.sin(math.radians(30)) * arm


def parallelogram(arm, articulated):
    turn = math.radians(30)
    half = turn / 2
    s, c = math.sin(turn), math.cos(turn)
    rods = []
    for name, x in (("L", -0.3), ("R", 0.3)):
        rods.append(
            body(
                name,
                (x - arm / 2 * s, 0, 3 - arm / 2 * c),
                collides=False,
                mass=0.01,
                inertia=(1e-5,) * 3,
                turn=(math.cos(half), 0, math.sin(half), 0),
            )
        )
    bar = body("A", (-arm * s, 0, 3 - arm * c), collides=False, mass=2.0, inertia=(0.05,) * 3)
    pins = [
        joint("revolute", f"P{n}", None, f"/World/{n}", (x, 0, 3), (0, 0, arm / 2), axis="Y")
        for n, x in (("L", -0.3), ("R", 0.3))
    ]
    ends = [
        joint(
            "revolute",
            f"Q{n}",
            f"/World/{n}",
            "/World/A",
            (0, 0, -arm / 2),
            (x, 0, 0),
            axis="Y",
            lines=["uniform bool physics:excludeFromArticulation = true"] if n == "R" else [],
        )
        for n, x in (("L", -0.3), ("R", 0.3))
    ]
    return scene(*rods, bar, *pins, *ends, articulated=articulated)


def loops():
    for radius, rod, damping in ((0.3, 1.0, 0.5), (0.2, 0.4, 0.5), (0.3, 1.0, 200.0)):
        for articulated in (False, True):
            stiff = damping > 100
            yield Form(
                f"crank_{radius:g}_{rod:g}_{damping:g}" + "_articulated" * articulated,
                f"a crank of {radius:g} m moves a piston, rod {rod:g} m",
                crank_slider(radius, rod, damping, articulated),
                1.0,
                (
                    piston(radius, rod, 0.5),
                    piston(radius, rod, 1.0),
                    *((coordinate(0.5, CRANK * 0.5, 2.0),) if stiff else ()),
                ),
            )
    for arm in (0.5, 1.0):
        for articulated in (False, True):
            seconds = 0.8
            yield Form(
                f"parallelogram_{arm:g}" + "_articulated" * articulated,
                f"a bar swings on two rods of {arm:g} m",
                parallelogram(arm, articulated),
                seconds,
                (
                    moved(seconds, "x", bar_drop(arm, seconds), 0.02, 0.01),
                    See("turn of the bar", lambda run: run.turn("A", 0.8)[2], 0.0, 0.003),
                ),
            )


def broken(name):
    """1: an event says that the joint broke."""

    def measured(run):
        return float(
            any(
                each.get("prim") == path_of(name) and "broke" in each.get("what", "")
                for each in run.answer.get("events", [])
            )
        )

    return measured


def breaks(name, layer, whether, sees, joint_name="J"):
    word = "breaks" if whether else "holds"
    return Form(
        f"{name}_{word}",
        f"{name.replace('_', ' ')}: {word}",
        layer,
        0.5,
        (See(f"{joint_name} broke", broken(joint_name), float(whether), 0.1), *sees),
    )


def fallen(whether, axis="z", name="A"):
    """What breaks in the first steps falls from the start on; a late break by 20 ms is let pass."""
    if whether:
        return (moved(0.5, axis, -G / 2 * 0.25, 0.09, name=name),)
    return (moved(0.5, axis, 0, name=name),)


def breaking():
    for mass in (0.5, 10.0, 500.0):
        for whether in (False, True):
            bound = mass * G * (0.94 if whether else 1.06)
            yield breaks(
                f"force_{mass:g}_kg",
                scene(
                    body("A", (0, 0, 2), collides=False, mass=mass, inertia=(mass / 600,) * 3),
                    joint(
                        "fixed",
                        "J",
                        None,
                        "/World/A",
                        (0, 0, 3),
                        (0, 0, 1),
                        lines=[f"float physics:breakForce = {bound}"],
                    ),
                ),
                whether,
                fallen(whether),
            )
    for arm in (0.2, 1.0):
        for whether in (False, True):
            bound = 2 * G * arm * (0.94 if whether else 1.06)
            yield breaks(
                f"torque_{arm:g}_m",
                scene(
                    body("A", (arm, 0, 3), ("Cube", 0.1), mass=2.0),
                    joint(
                        "fixed",
                        "J",
                        None,
                        "/World/A",
                        (0, 0, 3),
                        (-arm, 0, 0),
                        lines=[f"float physics:breakTorque = {bound}"],
                    ),
                ),
                whether,
                fallen(whether),
            )


def breaking_elsewhere():
    for whether in (False, True):
        bound = 2 * G * (0.94 if whether else 1.06)
        yield breaks(
            "force_on_arm",
            scene(
                body("A", (1, 0, 3), ("Cube", 0.1), mass=2.0),
                joint(
                    "fixed",
                    "J",
                    None,
                    "/World/A",
                    (0, 0, 3),
                    (-1, 0, 0),
                    lines=[f"float physics:breakForce = {bound}"],
                ),
            ),
            whether,
            fallen(whether),
        )
        yield breaks(
            "hinge",
            scene(
                body("A", (0, 0, 2), collides=False, mass=2.0, inertia=(0.02,) * 3),
                joint(
                    "revolute",
                    "J",
                    None,
                    "/World/A",
                    (0, 0, 3),
                    (0, 0, 1),
                    axis="Y",
                    lines=[f"float physics:breakForce = {bound}"],
                ),
            ),
            whether,
            fallen(whether),
        )


def breaking_in_motion():
    for whether in (False, True):
        bound = 5 * G * (0.94 if whether else 1.06)
        yield breaks(
            "upper_of_two",
            scene(
                body("A", (0, 0, 2), collides=False, mass=2.0, inertia=(0.02,) * 3),
                body("B", (0, 0, 1), collides=False, mass=3.0, inertia=(0.02,) * 3),
                joint(
                    "fixed",
                    "J",
                    None,
                    "/World/A",
                    (0, 0, 3),
                    (0, 0, 1),
                    lines=[f"float physics:breakForce = {bound}"],
                ),
                joint("fixed", "K", "/World/A", "/World/B", (0, 0, -0.5), (0, 0, 0.5)),
            ),
            whether,
            fallen(whether, name="B"),
        )
        bound = 2 * 36 * (0.94 if whether else 1.06)
        flight = (
            (stands(0.3, "x", 1.0, 0.06),) if whether else (stands(0.3, "x", math.cos(1.8), 0.03),)
        )
        yield breaks(
            "whirled",
            scene(
                body(
                    "A",
                    (1, 0, 3),
                    collides=False,
                    mass=2.0,
                    inertia=(0.001,) * 3,
                    velocity=(0, 6, 0),
                    spin=(0, 0, math.degrees(6.0)),
                ),
                joint(
                    "revolute",
                    "J",
                    None,
                    "/World/A",
                    (0, 0, 3),
                    (-1, 0, 0),
                    axis="Z",
                    lines=[f"float physics:breakForce = {bound}"],
                ),
                gravity=WEIGHTLESS,
            ),
            whether,
            flight,
        )


KINDS = {
    "mimics": (mimics, mimics_and_inertia),
    "gears and racks": (gears,),
    "loops": (loops,),
    "joints that break": (breaking, breaking_elsewhere, breaking_in_motion),
}
