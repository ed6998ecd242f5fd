# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Joints and articulations that PhysX treats otherwise, with and without what does it."""

from articulations import BASE, hinge, link, weld
from author import body, drive, joint, limit, scene
from joints import A, B, HINGE, WEIGHTLESS, bob
from row import beside_physx


def arm(apart, **words):
    inertia = (0.02,) * 3
    if apart:
        return scene(
            bob(inertia=inertia),
            joint("revolute", "J", None, A, HINGE, (-1, 0, 0), axis="Y", **words),
        )
    return scene(
        link("Base", (0, 0, 3)),
        bob(inertia=inertia),
        weld(),
        hinge("J", BASE, A, (0, 0, 0), (-1, 0, 0), **words),
        articulated=True,
    )


SPRING = {"parts": [drive("angular", stiffness=20.0, damping=5.0)]}
PUSH = {
    "parts": [drive("angular", "acceleration", stiffness=1.0, damping=0.1, target_position=30.0)]
}
LOW = (0, 0, 2)
ROPE = joint(
    "distance",
    "J",
    None,
    A,
    HINGE,
    lines=["float physics:maxDistance = 1", "float physics:minDistance = -1"],
)
SLIDE = joint("prismatic", "S", None, A, HINGE, axis="Z")
STRUT = joint(
    "distance",
    "J",
    None,
    A,
    (0, 0, 2),
    lines=["float physics:maxDistance = -1", "float physics:minDistance = 0.9"],
)
STOPPED = joint("prismatic", "S", None, A, HINGE, axis="Z", limits=(-0.1, 1.0))
ROD = joint("spherical", "J", None, A, HINGE, (0, 0, 1), axis="Z")


def turns(high):
    return scene(
        body("A", (0, 0, 3), mass=2.0, inertia=(0.1,) * 3),
        joint(
            "revolute",
            "J",
            None,
            A,
            HINGE,
            axis="Z",
            limits=(-90, high),
            parts=[drive("angular", damping=0.05, target_velocity=240.0)],
        ),
    )


def ball(a, b):
    return scene(
        bob(damping=4.0),
        joint(
            "spherical",
            "J",
            None,
            A,
            HINGE,
            (-1, 0, 0),
            axis="X",
            lines=[
                f"float physics:coneAngle0Limit = {a}",
                f"float physics:coneAngle1Limit = {b}",
            ],
        ),
    )


def pair(gap):
    return scene(
        bob(),
        bob("B", (2, 0, 3)),
        joint("fixed", "J", A, B, (0.5, 0, 0), (-0.5 - gap, 0, 0)),
        gravity=WEIGHTLESS,
    )


def held(gap):
    return scene(bob(), joint("fixed", "J", None, A, HINGE, (-1 + gap, 0, 0)))


def hang(articulated):
    return scene(
        link("Base", (0, 0, 3)),
        body("A", (0, 0, 2.5), mass=0.5, inertia=(0.001,) * 3),
        body("B", (0, 0, 2), mass=5000.0, inertia=(50.0,) * 3),
        weld(),
        joint("spherical", "J", BASE, A, (0, 0, 0), (0, 0, 0.5), axis="X"),
        joint("spherical", "K", A, B, (0, 0, 0), (0, 0, 0.5), axis="X"),
        articulated=articulated,
    )


def driven():
    yield beside_physx(
        "far_drive",
        "an angular spring carries a body 1 m off the joint",
        "off-center",
        "a joint outside of articulations, the body far from it",
        [arm(True, **SPRING), arm(False, **SPRING)],
        (1.0, 1.5),
    )
    yield beside_physx(
        "far_limit",
        "a limit carries a body 1 m off the joint",
        "off-center",
        "a joint outside of articulations, the body far from it",
        [arm(True, limits=(-30, 0)), arm(False, limits=(-30, 0))],
        (0.25, 0.5),
    )
    yield beside_physx(
        "acceleration_drive",
        "an acceleration drive of a body 1 m off the joint",
        "acceleration-drive",
        "a joint outside of articulations",
        [arm(True, **PUSH), arm(False, **PUSH)],
        (0.25, 0.5),
        0.006,
        0.6,
    )


def bounded():
    yield beside_physx(
        "crossed_limits",
        "a hinge whose lower limit is above the upper",
        "limit-range",
        "the limits",
        [
            scene(
                bob(), joint("revolute", "J", None, A, HINGE, (-1, 0, 0), axis="Y", limits=(1, -1))
            ),
            scene(bob(), joint("fixed", "J", None, A, HINGE, (-1, 0, 0))),
        ],
    )
    yield beside_physx(
        "crossed_slide",
        "a slide whose lower limit is above the upper",
        "limit-range",
        "the limits",
        [
            scene(bob(), joint("prismatic", "J", None, A, (1, 0, 3), axis="Z", limits=(0.1, -0.1))),
            scene(bob(), joint("fixed", "J", None, A, (1, 0, 3))),
        ],
    )
    yield beside_physx(
        "far_range",
        "a wheel between the limits -90 and 400 degrees turns up",
        "limit-range",
        "a limit beyond half a turn",
        [turns(400), turns(90)],
        (2.0, 2.5),
        0.003,
        0.5,
    )
    yield beside_physx(
        "cone_of_two_angles",
        "a ball rests on a cone of 20 and 50 degrees",
        "cone-axes",
        "two angles",
        [ball(20, 50), ball(20, 20)],
        (2.0, 2.5),
        0.01,
        180.0,
    )


def carried():
    yield beside_physx(
        "open_slide",
        "a slide with a lower limit alone",
        "limit-range",
        "the missing upper limit",
        [
            scene(bob(), joint("prismatic", "J", None, A, (1, 0, 3), axis="Z", limits=limits))
            for limits in ((-0.1, float("inf")), (-0.1, 1.0))
        ],
        (0.5, 1.0),
    )
    yield beside_physx(
        "rope",
        "a body hangs on a rope",
        "distance-tolerance",
        "a distance joint that carries",
        [scene(bob(at=LOW), ROPE), scene(bob(at=LOW), ROD)],
        (1.0, 2.0),
        0.001,
    )
    yield beside_physx(
        "strut",
        "a body comes to rest on a minDistance",
        "distance-tolerance",
        "a distance joint that carries",
        [scene(bob(at=HINGE), SLIDE, STRUT), scene(bob(at=HINGE), STOPPED)],
        (1.0, 2.0),
        0.001,
    )


def apart():
    yield beside_physx(
        "pair_apart",
        "two bodies whose fixed frames are 0.2 m apart",
        "frames-apart",
        "the gap",
        [pair(0.2), pair(0)],
    )
    yield beside_physx(
        "world_apart",
        "a body whose fixed frame is 0.2 m off the world's",
        "frames-apart",
        "the gap",
        [held(0.2), held(0)],
    )
    yield beside_physx(
        "unequal_masses",
        "5000 kg hang on a link of 0.5 kg",
        "mass-ratio",
        "a ratio of masses of 10000, outside of articulations",
        [hang(False), hang(True)],
        (0.5, 1.0),
        0.001,
    )


def root(fixed):
    links = [link("A", (0.5, 0, 3)), link("B", (1.5, 0, 3))]
    if fixed:
        return scene(
            link("Base", (0, 0, 3)),
            *links,
            weld(),
            hinge("J", BASE, A, (0, 0, 0)),
            hinge("K", A, B, (0.5, 0, 0)),
            articulated=True,
        )
    return scene(
        *links, hinge("J", None, A, HINGE), hinge("K", A, B, (0.5, 0, 0)), articulated=True
    )


BREAKS = ["float physics:breakForce = 5"]
MIMIC = [
    "float physxMimicJoint:rotY:gearing = -0.5",
    "rel physxMimicJoint:rotY:referenceJoint = </World/J>",
    'uniform token physxMimicJoint:rotY:referenceJointAxis = "rotY"',
]
SOFT = [
    "float physxMimicJoint:rotY:naturalFrequency = 2",
    "float physxMimicJoint:rotY:dampingRatio = 0.5",
]


def fork(limits, lines):
    return scene(
        link("Base", (0, 0, 3)),
        link("A", (0.5, 0.3, 3)),
        link("B", (0.5, -0.3, 3)),
        weld(),
        hinge(
            "J",
            BASE,
            A,
            (0, 0.3, 0),
            limits=limits,
            parts=[drive("angular", stiffness=5.0, damping=0.5, target_position=30.0)],
        ),
        hinge(
            "K",
            BASE,
            B,
            (0, -0.3, 0),
            limits=(-90, 90),
            apis=["PhysxMimicJointAPI:rotY"],
            lines=lines,
        ),
        articulated=True,
    )


def wrist(*axes):
    locked = [
        limit(axis, 1, -1)
        for axis in ("transX", "transY", "transZ", "rotX", "rotY", "rotZ")
        if axis not in axes
    ]
    driven = [
        drive(axis, stiffness=5.0, damping=1.0, target_position=target)
        for axis, target in zip(axes, (20.0, 45.0))
    ]
    return scene(
        link("Base", (0, 0, 3)),
        link("A", (0.5, 0, 3)),
        weld(),
        joint("d6", "J", BASE, A, (0, 0, 0), (-0.5, 0, 0), parts=[*locked, *driven]),
        articulated=True,
        gravity=WEIGHTLESS,
    )


def roots():
    yield beside_physx(
        "hinged_root",
        "an articulation whose root hangs on a hinge",
        "articulation-root",
        "the hinge to the world",
        [root(False), root(True)],
        (0.2, 0.4),
        0.006,
        0.6,
    )
    yield beside_physx(
        "link_breaks",
        "a link's weld that breaks at 5 N under 9.8 N",
        "break-in-articulation",
        "the break force",
        [
            scene(
                link("Base", (0, 0, 3)),
                link("A", (1, 0, 3)),
                weld(),
                joint("fixed", "J", BASE, A, (0.5, 0, 0), (-0.5, 0, 0), lines=lines),
                articulated=True,
            )
            for lines in (BREAKS, [])
        ],
    )


def mimics():
    yield beside_physx(
        "mimic_open_leader",
        "a mimic whose leader has no limits",
        "mimic-limits",
        "the leader's missing limits",
        [fork(None, MIMIC), fork((-90, 90), MIMIC)],
        (2.5, 3.0),
        0.006,
        0.8,
    )
    yield beside_physx(
        "mimic_soft",
        "a mimic of a natural frequency of 2",
        "soft-mimic",
        "the natural frequency",
        [fork((-90, 90), MIMIC + SOFT), fork((-90, 90), MIMIC)],
        (2.5, 3.0),
        0.006,
        0.8,
    )
    yield beside_physx(
        "two_drives",
        "a joint driven about Y and Z",
        "several-drives",
        "the second drive",
        [wrist("rotY", "rotZ"), wrist("rotY")],
        (2.0, 2.5),
        0.006,
        0.8,
    )


def measured():
    def turned(target):
        locked = [limit(axis, 1, -1) for axis in ("transX", "transY", "transZ", "rotX", "rotY")]
        spring = drive("rotZ", stiffness=0.05, damping=0.005, target_position=target)
        return scene(
            bob(), joint("d6", "J", None, A, (1, 0, 3), parts=[*locked, spring]), gravity=WEIGHTLESS
        )

    yield beside_physx(
        "far_target",
        "a joint driven about Z to 120 degrees",
        "drive-angle",
        "an angle of 120 degrees",
        [turned(120.0), turned(15.0)],
        (0.1, 0.25),
        degrees=0.5,
    )

    def round_and_round(limits):
        spring = [drive("angular", stiffness=0.5, damping=0.1, target_position=400.0)]
        return scene(
            link("Base", (0, 0, 3)),
            link("A", (0.5, 0, 3)),
            weld(),
            hinge("J", BASE, A, (0, 0, 0), limits=limits, parts=spring),
            articulated=True,
            gravity=WEIGHTLESS,
        )

    yield beside_physx(
        "far_turn",
        "a hinge without limits, driven to 400 degrees",
        "drive-turns",
        "no limits",
        [round_and_round(None), round_and_round((-1000, 1000))],
        (0.1, 0.5),
        degrees=0.5,
    )
    rebound = ["float physxLimit:angular:restitution = 0.5"]
    yield beside_physx(
        "rebound",
        "a pendulum that falls onto its limit",
        "limit-rebound",
        "the limit's restitution",
        [
            scene(
                bob(inertia=(2.0,) * 3),
                joint(
                    "revolute",
                    "J",
                    None,
                    A,
                    HINGE,
                    (-1, 0, 0),
                    axis="Y",
                    limits=(-90, 20),
                    apis=["PhysxLimitAPI:angular"],
                    lines=lines,
                ),
            )
            for lines in (rebound, [])
        ],
        (0.25, 0.5),
    )


def scenes():
    for part in (driven, bounded, carried, apart, measured, roots, mimics):
        yield from part()
