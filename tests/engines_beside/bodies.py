# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes of single bodies: flight, gravity, units, mass, settings."""

from author import body, drive, joint, material, prim, scene, static
from row import OVPHYSX, Row

WEIGHTLESS = ["float physics:gravityMagnitude = 0"]


def flight():
    yield Row("free_fall", "a box falls", scene(body("A", (0, 0, 5))))
    yield Row("throw", "a velocity, under gravity", scene(body("A", (0, 0, 5), velocity=(2, 1, 3))))
    yield Row(
        "spin",
        "an angular velocity about a principal axis",
        scene(body("A", spin=(0, 0, 90)), gravity=WEIGHTLESS),
    )
    yield Row(
        "tumble",
        "a turning body of three moments",
        scene(
            body("A", spin=(20, 170, 40), mass=1.0, inertia=(0.01, 0.02, 0.03)), gravity=WEIGHTLESS
        ),
    )
    yield Row(
        "tilted_axes",
        "principal axes of the authored moments",
        scene(
            body(
                "A",
                spin=(0, 120, 60),
                mass=1.0,
                inertia=(0.01, 0.02, 0.025),
                axes=(0.9238795, 0, 0.3826834, 0),
            ),
            gravity=WEIGHTLESS,
        ),
    )
    yield Row(
        "center_of_mass",
        "a body turns about its centre of mass",
        scene(
            body("A", spin=(0, 0, 120), mass=1.0, inertia=(0.02, 0.02, 0.02), com=(0.3, 0, 0)),
            gravity=WEIGHTLESS,
        ),
    )
    yield Row(
        "velocity_of_center",
        "the velocity is that of the centre of mass",
        scene(
            body(
                "A",
                velocity=(1, 0, 0),
                spin=(0, 0, 120),
                mass=1.0,
                inertia=(0.02, 0.02, 0.02),
                com=(0, 0.2, 0),
            ),
            gravity=WEIGHTLESS,
        ),
    )
    yield Row(
        "turned_body",
        "a velocity of a turned body",
        scene(body("A", turn=(0.7071068, 0, 0, 0.7071068), velocity=(1, 0, 0)), gravity=WEIGHTLESS),
        engines=(OVPHYSX,),
    )


def gravity():
    yield Row(
        "gravity_direction",
        "gravity along (0, 0.6, 0.8)",
        scene(
            body("A"),
            gravity=[
                "vector3f physics:gravityDirection = (0, 0.6, 0.8)",
                "float physics:gravityMagnitude = 5",
            ],
        ),
    )
    yield Row(
        "gravity_moon",
        "a magnitude of 1.62",
        scene(body("A"), gravity=["float physics:gravityMagnitude = 1.62"]),
        (0.5, 1.0),
    )
    yield Row("y_up", "down is -Y where Y is up", scene(body("A", (0, 5, 0)), up="Y"))
    yield Row(
        "no_scene",
        "no PhysicsScene: earth's gravity",
        scene(body("A", (0, 0, 5))).replace(
            'def PhysicsScene "PhysicsScene"', 'def Scope "NoScene"'
        ),
    )


def spring(meters, kilograms, length, mass, stiffness):
    """A body on a spring along X: its period tells mass and stiffness."""
    weighed = {"mass": mass} if mass else {}
    return scene(
        body("A", (length, 0, 0), ("Cube", length / 5), **weighed),
        joint(
            "prismatic",
            "Slide",
            None,
            "/World/A",
            axis="X",
            parts=[drive("linear", stiffness=stiffness)],
        ),
        gravity=WEIGHTLESS,
        meters=meters,
        kilograms=kilograms,
    )


def units():
    yield Row(
        "centimetres",
        "a fall in a stage of centimetres",
        scene(body("A", (0, 0, 500), ("Cube", 20)), meters=0.01),
        engines=(OVPHYSX,),
    )
    yield Row(
        "spring_metres",
        "period of a mass on a spring",
        spring(1, 1, 1, 2.0, 50.0),
        engines=(OVPHYSX,),
    )
    yield Row(
        "spring_centimetres",
        "a mass in kilograms, lengths in centimetres",
        spring(0.01, 1, 100, 2.0, 50.0),
        engines=(OVPHYSX,),
    )
    yield Row(
        "spring_grams",
        "kilogramsPerUnit 0.001",
        spring(1, 0.001, 1, 2000.0, 50000.0),
        engines=(OVPHYSX,),
    )
    yield Row(
        "spring_density",
        "the default density in centimetres and grams",
        spring(0.01, 0.001, 100, None, 200000.0),
        engines=(OVPHYSX,),
    )


def damping():
    yield Row(
        "linear_damping",
        "physxRigidBody:linearDamping",
        scene(
            body("A", velocity=(2, 0, 0), lines=["float physxRigidBody:linearDamping = 1"]),
            gravity=WEIGHTLESS,
        ),
        engines=(OVPHYSX,),
    )
    yield Row(
        "angular_damping",
        "physxRigidBody:angularDamping",
        scene(body("A", spin=(0, 0, 180), damping=1.0), gravity=WEIGHTLESS),
        engines=(OVPHYSX,),
    )
    yield Row(
        "no_gravity",
        "physxRigidBody:disableGravity",
        scene(
            body(
                "A",
                (0, 0, 5),
                velocity=(1, 0, 0),
                lines=["bool physxRigidBody:disableGravity = true"],
            )
        ),
        engines=(OVPHYSX,),
    )


def forces():
    yield Row(
        "largest_speed",
        "physxRigidBody:maxLinearVelocity",
        scene(body("A", (0, 0, 9), lines=["float physxRigidBody:maxLinearVelocity = 3"])),
        engines=(OVPHYSX,),
    )
    yield Row(
        "force_at_center",
        "PhysxForceAPI on the body",
        scene(
            body(
                "A",
                mass=2.0,
                apis=["PhysxForceAPI"],
                lines=[
                    "vector3f physxForce:force = (4, 0, 0)",
                    'uniform token physxForce:mode = "force"',
                ],
            ),
            gravity=WEIGHTLESS,
        ),
        engines=(OVPHYSX,),
    )
    yield Row(
        "locked_axis",
        "physxRigidBody:lockedPosAxis",
        scene(
            body("A", (0, 0, 5), velocity=(1, 1, 0), lines=["int physxRigidBody:lockedPosAxis = 2"])
        ),
        engines=(OVPHYSX,),
    )
    yield Row(
        "asleep",
        "a body that starts asleep",
        scene(body("A", (0, 0, 5), lines=["uniform bool physics:startsAsleep = true"])),
        engines=(OVPHYSX,),
    )


def nesting():
    yield Row(
        "nested_body",
        "a body below a body falls by itself",
        scene(
            body(
                "A",
                (0, 0, 5),
                velocity=(1, 0, 0),
                children=[
                    body("B", (1, 0, 0), lines=["bool physxRigidBody:disableGravity = true"])
                ],
            )
        ),
        engines=(OVPHYSX,),
    )
    yield Row(
        "compound",
        "three shapes of one body fall and turn",
        scene(
            body(
                "A",
                (0, 0, 5),
                None,
                spin=(0, 90, 0),
                collides=False,
                children=[
                    static("Left", (-0.4, 0, 0), ("Cube", 0.2)),
                    static("Right", (0.6, 0, 0.1), ("Sphere", 0.15)),
                    static("Top", (0, 0, 0.5), ("Cube", 0.1), scale=(1, 2, 3)),
                ],
            )
        ),
        engines=(OVPHYSX,),
    )


def held(*children, **words):
    """A body on a hinge through its origin, which its centre of mass turns down."""
    return scene(
        body("A", (0, 0, 3), children=children, **words),
        joint("revolute", "J", None, "/World/A", (0, 0, 3), axis="Y"),
    )


def on_spring(*more, **words):
    return scene(
        *more,
        body("A", (1, 0, 0), **words),
        joint(
            "prismatic",
            "S",
            None,
            "/World/A",
            axis="X",
            parts=[drive("linear", stiffness=50.0)],
        ),
        gravity=WEIGHTLESS
    )


apis = ["PhysicsMassAPI"]


def masses():
    yield Row("density_body", "a density of the body", on_spring(density=250.0), engines=(OVPHYSX,))
    yield Row(
        "density_material",
        "a density of the material",
        on_spring(material("D", density=400.0), material="/World/D"),
        engines=(OVPHYSX,),
    )
    yield Row(
        "no_mass",
        "neither mass nor colliders: 1 kg",
        scene(
            body("A", (1, 0, 0), None, collides=False),
            joint(
                "prismatic", "S", None, "/World/A", axis="X", parts=[drive("linear", stiffness=5.0)]
            ),
            gravity=WEIGHTLESS,
        ),
        engines=(OVPHYSX,),
    )
    yield Row(
        "center_of_pendulum",
        "a centre of mass and moments about it",
        held(mass=2.0, inertia=(0.1, 0.2, 0.3), com=(0.5, 0, 0.1)),
        engines=(OVPHYSX,),
    )
    yield Row(
        "center_scaled",
        "a centre of mass on a scaled body",
        held(shape=("Cube", 1), scale=(0.4, 0.2, 0.2), mass=2.0, com=(0.5, 0, 0)),
        engines=(OVPHYSX,),
    )


def parts():
    yield Row(
        "masses_of_parts",
        "masses of two colliders",
        held(
            static("C", (0.3, 0, 0), ("Cube", 0.2), apis=apis, lines=["float physics:mass = 3"]),
            static(
                "D", (-0.3, 0, 0.1), ("Sphere", 0.1), apis=apis, lines=["float physics:mass = 1"]
            ),
            shape=None,
            collides=False,
        ),
        engines=(OVPHYSX,),
    )
    yield Row(
        "two_gravities",
        "two scenes of different gravity",
        scene(
            prim("PhysicsScene", "S2", (), ["float physics:gravityMagnitude = 1"]),
            body("A", (0, 0, 5)),
            body("B", (2, 0, 5), lines=["rel physics:simulationOwner = </World/S2>"]),
        ),
        engines=(OVPHYSX,),
    )
    yield Row(
        "no_gyroscope",
        "physxRigidBody:enableGyroscopicForces switched off",
        scene(
            body(
                "A",
                spin=(20, 170, 40),
                mass=1.0,
                inertia=(0.01, 0.02, 0.03),
                lines=["bool physxRigidBody:enableGyroscopicForces = false"],
            ),
            gravity=WEIGHTLESS,
        ),
        engines=(OVPHYSX,),
    )


def scenes():
    for part in (flight, gravity, units, damping, forces, nesting, masses, parts):
        yield from part()
