# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Values and contacts that PhysX reads or treats otherwise, with and without what does it."""

from author import body, drive, floor, group, joint, place, prim, scene, static
from contacts import ROUGH, SETTLED, SLAB, rough
from joints import A, B, HINGE, WEIGHTLESS
from row import beside_physx

TURNED = (0.7071068, 0, 0, 0.7071068)  # a quarter turn about Z


FAST = ["float physxRigidBody:maxAngularVelocity = 20000"]


def between(above, on):
    inner = static(
        "C",
        shape=("Cube", 0.2),
        apis=["PhysicsMassAPI"] if on else [],
        lines=["float physics:mass = 5"] if on else [],
    )
    holder = prim(
        "Xform",
        "M",
        ["PhysicsMassAPI"] if above else [],
        ["float physics:mass = 5"] if above else [],
        [inner],
    )
    return scene(
        body("A", (1, 0, 0), None, collides=False, children=[holder]),
        joint("prismatic", "S", None, A, axis="X", parts=[drive("linear", stiffness=50.0)]),
        gravity=WEIGHTLESS,
    )


def velocities():
    yield beside_physx(
        "turned_parent",
        "a velocity under a turned parent",
        "velocity-space",
        "the parent's turn",
        [
            scene(
                prim("Xform", "Group", (), place((0, 0, 3), turn), [body("A", velocity=(1, 0, 0))]),
                gravity=WEIGHTLESS,
            )
            for turn in (TURNED, None)
        ],
    )
    yield beside_physx(
        "scaled_parent",
        "a velocity under a scaled parent",
        "velocity-space",
        "the parent's scale",
        [
            scene(
                prim(
                    "Xform",
                    "Group",
                    (),
                    place((0, 0, 3), None, (scale,) * 3),
                    [body("A", velocity=(1, 0, 0))],
                ),
                gravity=WEIGHTLESS,
            )
            for scale in (2, 1)
        ],
    )


def gravity():
    yield beside_physx(
        "long_direction",
        "gravity along (0, 3, 4)",
        "gravity",
        "a direction of length 5",
        [
            scene(
                body("A"),
                gravity=[
                    f"vector3f physics:gravityDirection = {along}",
                    "float physics:gravityMagnitude = 5",
                ],
            )
            for along in ("(0, 3, 4)", "(0, 0.6, 0.8)")
        ],
    )
    yield beside_physx(
        "negative_gravity",
        "a magnitude of -5",
        "gravity",
        "the negative magnitude",
        [
            scene(body("A"), gravity=lines)
            for lines in (["float physics:gravityMagnitude = -5"], [])
        ],
    )
    yield beside_physx(
        "kinematic_velocity",
        "a box on a kinematic body with a velocity",
        "kinematic-velocity",
        "the velocity",
        [
            scene(
                rough(),
                body(
                    "K",
                    (0, 0, -0.5),
                    ("Cube", 1),
                    scale=(20, 20, 1),
                    material=ROUGH,
                    velocity=speed,
                    lines=["bool physics:kinematicEnabled = true"],
                ),
                body("A", (0, 0, 0.05), material=ROUGH, **SLAB),
            )
            for speed in ((0.5, 0, 0), None)
        ],
        (0.5, 1.0),
    )


def damping():
    yield beside_physx(
        "spin_default",
        "10 rad/s, no damping authored",
        "angular-damping",
        "angular damping that is not authored",
        [
            scene(body("A", spin=(0, 0, 572.9578), damping=damping), gravity=WEIGHTLESS)
            for damping in (None, 0.0)
        ],
        (0.5, 1.0),
        degrees=0.5,
    )
    yield beside_physx(
        "swing_default",
        "a pendulum, no damping authored",
        "angular-damping",
        "angular damping that is not authored",
        [
            scene(
                body("A", (0.5, 0, 3), mass=1.0, inertia=(2.0,) * 3, damping=damping),
                joint("revolute", "J", None, A, HINGE, (-0.5, 0, 0), axis="Y"),
            )
            for damping in (None, 0.0)
        ],
        (1.5, 2.0),
        0.01,
        1.0,
    )
    yield beside_physx(
        "spin_fast",
        "150 rad/s",
        "speed-cap",
        "a speed above PhysX's cap",
        [
            scene(body("A", spin=(0, 0, 8594.367), lines=lines), gravity=WEIGHTLESS)
            for lines in ([], FAST)
        ],
        (0.05, 0.1),
        degrees=1.0,
    )


def three_points():
    apis = ["PhysicsCollisionAPI", "PhysicsRigidBodyAPI", "PhysxRigidBodyAPI", "MaterialBindingAPI"]
    lines = [
        "point3f[] points = [(0, 0, 0), (0.4, 0, 0), (0, 0.4, 0)]",
        "float[] widths = [0.2, 0.2, 0.2]",
        f"rel material:binding:physics = <{ROUGH}>",
    ]
    return prim("Points", "A", apis, [*lines, *place((0, 0, 0.12))])


def three_balls():
    places = {"P": (0, 0, 0), "Q": (0.4, 0, 0), "R": (0, 0.4, 0)}
    balls = [static(name, at, ("Sphere", 0.1), material=ROUGH) for name, at in places.items()]
    return body("A", (0, 0, 0.12), None, collides=False, children=balls)


def slid_box(scale):
    """A box turned by 45 degrees below a prim of some scale; its body falls along a slide."""
    box = static("C", turn=(0.9238795, 0, 0.3826834, 0), shape=("Cube", 0.2), material=ROUGH)
    return scene(
        rough(),
        floor(ROUGH),
        body(
            "A",
            (0, 0, 0.5),
            None,
            collides=False,
            mass=1.0,
            inertia=(0.02,) * 3,
            children=[prim("Xform", "Scaled", (), place((0, 0, 0), None, scale), [box])],
        ),
        joint("prismatic", "S", None, A, (0, 0, 0.5), axis="Z"),
    )


def shapes():
    yield beside_physx(
        "points",
        "a body of three points at rest",
        "points",
        "Points as colliders",
        [scene(rough(), floor(ROUGH), what()) for what in (three_points, three_balls)],
        SETTLED,
    )
    yield beside_physx(
        "stretched_sphere",
        "a sphere of scale (1, 2, 1) at rest",
        "stretched-sphere",
        "the uneven scale",
        [
            scene(
                rough(),
                floor(ROUGH),
                body("A", (0, 0, 0.22), ("Sphere", 0.2), scale=scale, material=ROUGH),
            )
            for scale in ((1, 2, 1), (1, 1, 1))
        ],
        SETTLED,
        0.003,
        180.0,
    )
    yield beside_physx(
        "sheared",
        "a box turned under a scale of (2, 1, 1), on a slide",
        "sheared",
        "the scale above the turned box",
        [slid_box(scale) for scale in ((2, 1, 1), None)],
        SETTLED,
    )
    yield beside_physx(
        "mass_between",
        "a mass between the body and its collider",
        "mass-between",
        "the mass on a prim that is neither",
        [between(True, False), between(False, True)],
    )


def contacts():
    def lean(friction):
        return scene(
            rough(0.1, static_friction=friction),
            static(
                "Ramp",
                shape=("Cube", 1),
                turn=(0.9961947, 0, 0.0871557, 0),
                scale=(10, 4, 1),
                material=ROUGH,
            ),
            body(
                "A",
                (0.55 * 0.1736482, 0, 0.55 * 0.9848078),
                turn=(0.9961947, 0, 0.0871557, 0),
                material=ROUGH,
                **SLAB,
            ),
        )

    yield beside_physx(
        "static_friction",
        "10 degrees, static friction 0.5, dynamic 0.1",
        "static-friction",
        "a static friction above the dynamic one",
        [lean(0.5), lean(0.1)],
        (0.5, 1.0),
        0.006,
        1.0,
    )

    def two(*more):
        return scene(
            rough(),
            floor(ROUGH),
            body("A", (0, 0, 0.2), ("Cube", 0.4), material=ROUGH),
            body("B", (0, 0, 0.61), ("Cube", 0.4), material=ROUGH),
            *more,
        )

    ga, gb, floor_path = "/World/GA", "/World/GB", "/World/Floor"
    merged = ['string physics:mergeGroup = "m"']
    inverted = ["bool physics:invertFilteredGroups = true"]
    yield beside_physx(
        "merged_groups",
        "of two merged groups one filters itself",
        "group-settings",
        "mergeGroup",
        [
            two(group("GA", [A], (), merged), group("GB", [B], [gb], merged)),
            two(group("GA", [A, B], [ga])),
        ],
        SETTLED,
    )
    yield beside_physx(
        "inverted_group",
        "an inverted group lists the other one",
        "group-settings",
        "invertFilteredGroups",
        [
            two(group("GA", [A, floor_path]), group("GB", [B], [ga], inverted)),
            two(group("GA", [A, floor_path]), group("GB", [B], [gb])),
        ],
        SETTLED,
    )

    def bullet(lines):
        return scene(
            static("Wall", (1.15, 0, 1), ("Cube", 1), scale=(0.02, 2, 2)),
            body(
                "A",
                (0, 0, 1),
                ("Sphere", 0.02),
                velocity=(20, 0, 0),
                mass=0.1,
                inertia=(1e-5,) * 3,
                lines=lines,
            ),
            gravity=[*WEIGHTLESS, "bool physxScene:enableCCD = true"],
            physics_apis=["PhysxSceneAPI"],
        )

    yield beside_physx(
        "bullet",
        "20 m/s toward a wall of 2 cm, in PhysX's own step",
        "tunnel",
        "a way per step beyond the wall",
        [bullet([]), bullet(["bool physxRigidBody:enableCCD = true"])],
        (0.2, 0.3),
        0.2,
        180.0,
        step=1 / 60,
    )


def scenes():
    for part in (velocities, gravity, damping, shapes, contacts):
        yield from part()
