# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What Newton reads or moves otherwise, with and without what does it."""

from articulations import BASE, chain, hinge, link, weld
from author import body, drive, floor, joint, limit, prim, scene
from contacts import ROUGH, SLAB, SMOOTH, rough
from differences import TURNED
from joints import A, B, HINGE, WEIGHTLESS, bob, on_base
from row import beside_newton


def spring_arm(meters):
    n = 1 / meters
    return scene(
        link("Base", (0, 0, 3 * n)),
        body("A", (0.5 * n, 0, 3 * n), ("Cube", 0.2 * n)),
        joint("fixed", "Weld", None, BASE, (0, 0, 3 * n)),
        hinge(
            "J",
            BASE,
            A,
            (0, 0, 0),
            (-0.5 * n, 0, 0),
            parts=[drive("angular", stiffness=5.0 * n * n, damping=1.0 * n * n)],
        ),
        meters=meters,
        articulated=True,
    )


def on(of_floor, of_box):
    return scene(
        rough(of_floor),
        rough(of_box, "Smooth"),
        floor(ROUGH),
        body("A", (0, 0, 0.05), velocity=(1, 0, 0), material=SMOOTH, **SLAB),
    )


def d6(*free):
    locked = [limit(axis, 1, -1) for axis in ("transX", "transY", "transZ", "rotX", "rotZ")]
    return scene(
        link("Base", (0, 0, 3)),
        link("A", (0.5, 0, 3)),
        weld(),
        joint("d6", "J", BASE, A, (0, 0, 0), (-0.5, 0, 0), parts=[*locked, *free]),
        articulated=True,
    )


def ball(*lines):
    return scene(
        link("Base", (0, 0, 3)),
        link("A", (0.5, 0, 3)),
        weld(),
        joint("spherical", "J", BASE, A, (0, 0, 0), (-0.5, 0, 0), axis="X", lines=lines),
        articulated=True,
    )


LOOSE = scene(bob(), joint("revolute", "J", None, A, HINGE, (-1, 0, 0), axis="Y"))


def values():
    yield beside_newton(
        "turned_body_newton",
        "a velocity of a turned body",
        "velocity-axes",
        "the body's turn",
        [
            scene(body("A", turn=turn, velocity=(1, 0, 0)), gravity=WEIGHTLESS)
            for turn in (TURNED, None)
        ],
    )
    yield beside_newton(
        "asleep_newton",
        "a body that starts asleep",
        "asleep",
        "startsAsleep",
        [
            scene(body("A", (0, 0, 5), lines=[f"uniform bool physics:startsAsleep = {flag}"]))
            for flag in ("true", "false")
        ],
    )


def two_boxes():
    """The same two boxes, by an instancer and one by one."""
    box = body("Box", lines=[f"rel material:binding:physics = <{ROUGH}>"])
    lines = [
        "rel prototypes = </World/Many/Box>",
        "int[] protoIndices = [0, 0]",
        "point3f[] positions = [(0, 0, 5), (1, 0, 5)]",
    ]
    many = prim("PointInstancer", "Many", (), lines, [box])
    return [
        scene(rough(), many),
        scene(rough(), body("A", (0, 0, 5), material=ROUGH), body("B", (1, 0, 5), material=ROUGH)),
    ]


def materials():
    yield beside_newton(
        "instancer_newton",
        "two boxes of a point instancer",
        "point-instancer",
        "the instancer",
        two_boxes(),
    )
    yield beside_newton(
        "unbound_newton",
        "a box on a floor without materials",
        "unbound-friction",
        "no material",
        [
            scene(
                *more, floor(of), body("A", (0, 0, 0.05), velocity=(1, 0, 0), material=of, **SLAB)
            )
            for more, of in (([], None), ([rough()], ROUGH))
        ],
        (0.2, 0.4),
        0.008,
        1.5,
    )
    yield beside_newton(
        "friction_newton",
        "0.8 and 0.2",
        "friction-combine",
        "two frictions",
        [on(0.8, 0.2), on(0.5, 0.5)],
        (0.2, 0.4),
        0.008,
        1.5,
    )
    yield beside_newton(
        "restitution_newton",
        "a ball of restitution 0.7",
        "restitution",
        "the restitution",
        [
            scene(
                rough(restitution=value),
                floor(ROUGH),
                body("A", (0, 0, 1.2), ("Sphere", 0.2), material=ROUGH),
            )
            for value in (0.7, 0.0)
        ],
        (0.6, 0.8),
        0.02,
        180.0,
    )


def joints():
    yield beside_newton(
        "break_newton",
        "a weld to the world that breaks at 10 N under 19.6 N",
        "break-ignored",
        "the break force",
        [
            scene(
                bob(),
                joint(
                    "fixed",
                    "J",
                    None,
                    A,
                    (1, 0, 3),
                    lines=[f"float physics:breakForce = {force}"],
                ),
            )
            for force in ("10", "inf")
        ],
    )
    yield beside_newton(
        "acceleration_newton",
        "an acceleration drive",
        "drive-type",
        "the type",
        [
            chain(
                first={
                    "parts": [
                        drive("angular", kind, stiffness=5.0, damping=1.0, target_position=30.0)
                    ]
                },
                gravity=WEIGHTLESS,
            )
            for kind in ("acceleration", "force")
        ],
        (0.25, 0.5),
        0.001,
        0.1,
    )
    yield beside_newton(
        "d6_newton",
        "a D6 that is free about Y",
        "d6-axes",
        "no limit on the free axis",
        [d6(), d6(limit("rotY", -float("inf"), float("inf")))],
    )
    yield beside_newton(
        "cone_newton",
        "a ball with a cone of 20 degrees",
        "cone-ignored",
        "the cone",
        [ball("float physics:coneAngle0Limit = 20", "float physics:coneAngle1Limit = 20"), ball()],
        (0.4, 0.5),
        0.001,
        0.1,
    )


def roots():
    yield beside_newton(
        "loose_newton",
        "a hinge between two bodies, no articulation",
        "joint-without-articulation",
        "no articulation",
        [
            scene(
                bob(spin=(0, 60, 0)),
                bob("B", (2, 0, 3)),
                joint("revolute", "J", A, B, (0.5, 0, 0), (-0.5, 0, 0), axis="Y"),
                gravity=WEIGHTLESS,
                articulated=flag,
            )
            for flag in (False, True)
        ],
    )
    yield beside_newton(
        "hinge_newton",
        "a hinge to the world, no articulation",
        "joint-without-articulation",
        "no articulation",
        [LOOSE, on_base(LOOSE)],
        (0.25, 0.5),
        0.001,
    )
    yield beside_newton(
        "reversed_newton",
        "a joint whose body0 is the child",
        "joint-direction",
        "the order of the bodies",
        [
            scene(
                link("Base", (0, 0, 3)),
                link("A", (0.5, 0, 3)),
                weld(),
                joint("revolute", "J", *ends, axis="Y"),
                articulated=True,
            )
            for ends in ((A, BASE, (-0.5, 0, 0), (0, 0, 0)), (BASE, A, (0, 0, 0), (-0.5, 0, 0)))
        ],
        (0.2, 0.4),
    )


def units():
    yield beside_newton(
        "two_gravities_newton",
        "two scenes of different gravity",
        "several-gravities",
        "the second gravity",
        [
            scene(
                prim("PhysicsScene", "S2", (), [f"float physics:gravityMagnitude = {g}"]),
                rough(),
                body("A", (0, 0, 5), material=ROUGH),
                body(
                    "B",
                    (2, 0, 5),
                    material=ROUGH,
                    lines=["rel physics:simulationOwner = </World/S2>"],
                ),
            )
            for g in (1, 9.81)
        ],
    )
    yield beside_newton(
        "centimetres_newton",
        "a chain in centimetres, driven by springs",
        "units",
        "the unit of length",
        [spring_arm(0.01), spring_arm(1)],
        (0.25, 0.5),
        0.001,
        0.1,
    )


def scenes():
    for part in (
        values,
        materials,
        joints,
        roots,
        units,
    ):
        yield from part()
