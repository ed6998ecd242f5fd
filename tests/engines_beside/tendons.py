# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes of tendons and gears, weightless: under load PhysX's tendons hold by other forces."""

from articulations import BASE, hinge, link, weld
from author import body, drive, joint, prim, scene
from row import OVPHYSX, Row, beside_physx

A, B = "/World/A", "/World/B"
WEIGHTLESS = ["float physics:gravityMagnitude = 0"]
ROOT, BRANCH = ["PhysxTendonAxisRootAPI:t"], ["PhysxTendonAxisAPI:t"]
LED = [drive("angular", stiffness=5.0, damping=0.5, target_position=30.0)]
DAMPED = [drive("angular", damping=0.05)]


def axis(gearing, *lines):
    return [
        f"float[] physxTendon:t:gearing = [{gearing}]",
        f"float[] physxTendon:t:forceCoefficient = [{gearing}]",
        *lines,
    ]


def root(offset=0.0):
    return axis(
        1,
        "float physxTendon:t:stiffness = 50",
        "float physxTendon:t:damping = 5",
        f"float physxTendon:t:offset = {offset}",
    )


def along(gearing, offset=0.0):
    """A finger of two links, the second joint by a tendon from the first."""
    return scene(
        link("Base", (0, 0, 3)),
        link("A", (0.5, 0, 3)),
        link("B", (1.5, 0, 3)),
        weld(),
        hinge("J", BASE, A, (0, 0, 0), parts=LED, apis=ROOT, lines=root(offset)),
        hinge("K", A, B, (0.5, 0, 0), parts=DAMPED, apis=BRANCH, lines=axis(gearing)),
        articulated=True,
        gravity=WEIGHTLESS,
    )


def aside():
    """Two fingers on one base."""
    return scene(
        link("Base", (0, 0, 3)),
        link("A", (0.5, 0.3, 3)),
        link("B", (0.5, -0.3, 3)),
        weld(),
        hinge("J", BASE, A, (0, 0.3, 0), parts=LED, apis=ROOT, lines=root()),
        hinge("K", BASE, B, (0, -0.3, 0), parts=DAMPED, apis=BRANCH, lines=axis(-1)),
        articulated=True,
        gravity=WEIGHTLESS,
    )


def spatial():
    """A leaf 0.2 m along a link, pulled toward a point above the base."""
    return scene(
        link(
            "Base",
            (0, 0, 3),
            apis=["PhysxTendonAttachmentRootAPI:r"],
            lines=[
                "float physxTendon:r:stiffness = 100",
                "float physxTendon:r:damping = 10",
                "point3f physxTendon:r:localPos = (0, 0, 0.5)",
            ],
        ),
        link(
            "A",
            (0.5, 0, 3),
            apis=["PhysxTendonAttachmentLeafAPI:l"],
            lines=[
                "rel physxTendon:l:parentLink = </World/Base>",
                'token physxTendon:l:parentAttachment = "r"',
                "float physxTendon:l:restLength = 0.6",
                "point3f physxTendon:l:localPos = (0.2, 0, 0)",
            ],
        ),
        weld(),
        hinge("J", BASE, A, (0, 0, 0), parts=DAMPED),
        articulated=True,
        gravity=WEIGHTLESS,
    )


def wheel(name, x):
    return body(name, (x, 0, 3), mass=1.0, inertia=(0.02,) * 3, collides=False)


def gear():
    lines = [
        "rel physics:body0 = </World/A>",
        "rel physics:body1 = </World/B>",
        "float physics:gearRatio = -2",
        "rel physics:hinge0 = </World/J>",
        "rel physics:hinge1 = </World/K>",
    ]
    return scene(
        wheel("A", 0),
        wheel("B", 1),
        joint(
            "revolute",
            "J",
            None,
            A,
            (0, 0, 3),
            axis="Z",
            parts=[drive("angular", damping=0.01, target_velocity=90.0)],
        ),
        joint("revolute", "K", None, B, (1, 0, 3), axis="Z"),
        prim("PhysxPhysicsGearJoint", "G", (), lines),
        gravity=WEIGHTLESS,
    )


def scenes():
    for name, gearing in (("tendon_same", 1), ("tendon_opposite", -1)):
        yield Row(
            name,
            f"a fixed tendon of gearing {gearing}",
            along(gearing),
            (2.0, 3.0),
            engines=(OVPHYSX,),
        )
    yield Row(
        "tendon_offset",
        "a fixed tendon with an offset of 10 degrees",
        along(1, 10.0),
        (2.0, 3.0),
        engines=(OVPHYSX,),
    )
    yield Row(
        "tendon_spatial",
        "where a spatial tendon has pulled a link",
        spatial(),
        (3.0, 4.0),
        engines=(OVPHYSX,),
    )
    yield Row("gear", "two wheels by a gear of ratio -2", gear(), (0.5, 1.0), engines=(OVPHYSX,))
    yield beside_physx(
        "tendon_aside",
        "two fingers on one base, by a tendon",
        "tendon-branch",
        "a joint whose parent is no link of the tendon",
        [aside(), along(-1)],
        (2.0, 3.0),
    )
