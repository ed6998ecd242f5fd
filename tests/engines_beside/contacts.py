# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes of things that touch, or are kept from it: shapes, materials, filters.

A box that slides lies on its floor from the start, at exact contact; it is flat, so that it does
not tip. It is slow, since plain MuJoCo, as Newton has it, lets what begins to slide fast hop. Rest
is compared where it is reached.
"""

from author import body, floor, group, material, place, plane, prim, scene, static
from row import NEWTON, OVPHYSX, Row

SETTLED = (1.0, 1.5)
SLAB = {"shape": ("Cube", 1), "scale": (0.4, 0.4, 0.1)}
ROUGH, SMOOTH = "/World/Rough", "/World/Smooth"
TILT = (0.9659258, 0, 0.2588190, 0)  # 30 degrees about Y
LEAN = (0.9961947, 0, 0.0871557, 0)  # 10 degrees about Y


def rough(friction=0.5, name="Rough", **more):
    return material(name, friction, **more)


def resting(name, shows, shape, height, engines=(OVPHYSX, NEWTON), **more):
    fallen = body("A", (0, 0, height + 0.02), shape, material=ROUGH, **more)
    return Row(name, shows, scene(rough(), floor(ROUGH), fallen), SETTLED, engines=engines)


def rest():
    yield resting("rest_box", "a box comes to rest", ("Cube", 0.4), 0.2)
    yield resting("rest_sphere", "a ball comes to rest", ("Sphere", 0.2), 0.2)
    yield resting(
        "rest_capsule", "a capsule comes to rest on its side", ("Capsule", 0.1, 0.4, "X"), 0.1
    )
    yield resting(
        "rest_cylinder",
        "a cylinder comes to rest on its end",
        ("Cylinder", 0.2, 0.2, "Z"),
        0.1,
        engines=(OVPHYSX,),
    )
    yield resting(
        "rest_scaled", "a scaled box comes to rest", ("Cube", 1), 0.15, scale=(0.4, 0.5, 0.3)
    )
    yield resting(
        "rest_turned",
        "a turned box comes to rest",
        ("Cube", 0.4),
        0.2,
        turn=(0.7071068, 0.7071068, 0, 0),
    )


def planes():
    yield Row(
        "rest_plane",
        "a box on a plane",
        scene(
            rough(), plane(material=ROUGH), body("A", (0, 0, 0.22), ("Cube", 0.4), material=ROUGH)
        ),
        SETTLED,
    )
    yield Row(
        "rest_plane_y",
        "a box on a plane across Y, where Y is up",
        scene(
            rough(),
            plane(material=ROUGH, axis="Y"),
            body("A", (0, 0.22, 0), ("Cube", 0.4), material=ROUGH),
            up="Y",
        ),
        SETTLED,
    )


def stacks():
    yield Row(
        "stack",
        "two boxes on one another",
        scene(
            rough(),
            floor(ROUGH),
            body("A", (0, 0, 0.21), ("Cube", 0.4), material=ROUGH),
            body("B", (0, 0, 0.63), ("Cube", 0.4), material=ROUGH),
        ),
        SETTLED,
    )
    yield Row(
        "on_disabled",
        "a box on a body that is disabled",
        engines=(OVPHYSX,),
        layer=scene(
            rough(),
            body(
                "F",
                (0, 0, -0.5),
                ("Cube", 1),
                scale=(9, 9, 1),
                material=ROUGH,
                lines=["bool physics:rigidBodyEnabled = false"],
            ),
            body("A", (0, 0, 0.22), ("Cube", 0.4), material=ROUGH),
        ),
        times=SETTLED,
    )
    yield Row(
        "on_kinematic",
        "a box on a kinematic body",
        scene(
            rough(),
            body(
                "F",
                (0, 0, -0.5),
                ("Cube", 1),
                scale=(9, 9, 1),
                material=ROUGH,
                lines=["bool physics:kinematicEnabled = true"],
            ),
            body("A", (0, 0, 0.22), ("Cube", 0.4), material=ROUGH),
        ),
        SETTLED,
    )


def mesh(name, kind, at, approximation, points, counts, indices, scale=None):
    """A mesh that collides by an approximation; kind "body" or "static"."""
    lines = [
        f"point3f[] points = [{', '.join(str(p) for p in points)}]",
        f"int[] faceVertexCounts = {counts}",
        f"int[] faceVertexIndices = {indices}",
        'uniform token subdivisionScheme = "none"',
        f'uniform token physics:approximation = "{approximation}"',
    ]
    shape = ("Mesh",)
    apis = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "MaterialBindingAPI"]
    if kind == "body":
        apis += ["PhysicsRigidBodyAPI", "PhysxRigidBodyAPI"]
        lines.append("float physxRigidBody:angularDamping = 0.0")
    return prim(
        shape[0],
        name,
        apis,
        [*lines, *place(at, None, scale), f"rel material:binding:physics = <{ROUGH}>"],
    )


BOX = (
    [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)],
    [4] * 6,
    [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5],
)
WEDGE = (
    [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (-1, -1, 1), (-1, 1, 1)],
    [4, 4, 4, 3, 3],
    [0, 3, 2, 1, 0, 4, 5, 3, 4, 1, 2, 5, 0, 1, 4, 3, 5, 2],
)


def meshes():
    for token in ("convexHull", "boundingCube", "convexDecomposition", "none"):
        yield Row(
            f"mesh_{token}",
            f"a box as a mesh, {token}",
            scene(rough(), floor(ROUGH), mesh("A", "body", (0, 0, 0.22), token, *BOX, (0.2,) * 3)),
            SETTLED,
            engines=(OVPHYSX,),
        )
    yield Row(
        "mesh_boundingSphere",
        "a box as a mesh, boundingSphere: rests at half its diagonal",
        scene(
            rough(),
            floor(ROUGH),
            mesh("A", "body", (0, 0, 0.37), "boundingSphere", *BOX, (0.2,) * 3),
        ),
        SETTLED,
    )
    yield Row(
        "mesh_floor",
        "a box slides down a wedge of triangles",
        scene(
            rough(0.2),
            mesh("F", "static", (0, 0, 0), "none", *WEDGE, (3, 3, 1.5)),
            body(
                "A",
                (-1.5, 0, 1.2),
                turn=(0.9732490, 0, 0.2297529, 0),
                shape=("Cube", 1),
                scale=(0.4, 0.4, 0.1),
                material=ROUGH,
            ),
        ),
        (0.25, 0.5),
        0.004,
        0.3,
        engines=(OVPHYSX,),
    )


def slide(name, shows, materials, of_floor, of_box, speed=0.8, times=(0.1, 0.3), **more):
    return Row(
        name,
        shows,
        scene(
            *materials,
            floor(of_floor),
            body("A", (0, 0, 0.05), velocity=(speed, 0, 0), material=of_box, **SLAB),
        ),
        times,
        0.006,
        1.0,
        **more,
    )


def friction():
    yield slide("slide", "friction 0.5 brakes a box", [rough()], ROUGH, ROUGH)
    yield slide("slide_slow", "friction 0.1 brakes a box", [rough(0.1)], ROUGH, ROUGH)
    yield slide(
        "slide_fast",
        "a box that begins to slide at 5 m/s",
        [rough()],
        ROUGH,
        ROUGH,
        speed=5.0,
        times=(0.1, 0.5),
        engines=(OVPHYSX,),
    )
    yield slide("slide_free", "no friction", [rough(0.0)], ROUGH, ROUGH, engines=(OVPHYSX,))
    yield slide(
        "slide_stop",
        "where friction 0.8 has stopped it",
        [rough(0.8)],
        ROUGH,
        ROUGH,
        times=(0.3, 0.5),
    )
    yield slide(
        "friction_average",
        "0.8 and 0.2 are averaged",
        [rough(0.8), rough(0.2, "Smooth")],
        ROUGH,
        SMOOTH,
        engines=(OVPHYSX,),
    )
    for mode in ("min", "max", "multiply"):
        lines = [f'uniform token physxMaterial:frictionCombineMode = "{mode}"']
        yield slide(
            f"friction_{mode}",
            f"0.8 and 0.2 by the mode {mode}",
            [rough(0.8, apis=["PhysxMaterialAPI"], lines=lines), rough(0.2, "Smooth")],
            ROUGH,
            SMOOTH,
            engines=(OVPHYSX,),
        )
    yield slide("unbound", "no material: 0.5", [], None, None, engines=(OVPHYSX,))

    def ramp(turn, friction_of_ramp, **more):
        return scene(
            rough(friction_of_ramp, **more),
            static("Ramp", (0, 0, 0), ("Cube", 1), turn, (10, 4, 1), material=ROUGH),
            body(
                "A",
                tuple(
                    0.55 * x
                    for x in ((0.5, 0, 0.8660254) if turn is TILT else (0.1736482, 0, 0.9848078))
                ),
                turn=turn,
                material=ROUGH,
                **SLAB,
            ),
        )

    yield Row(
        "incline_slides",
        "30 degrees, friction 0.3",
        ramp(TILT, 0.3),
        (0.3, 0.6),
        0.006,
        1.0,
        beside_newton=(0.004, 0.5),
    )
    yield Row("incline_holds", "10 degrees, friction 0.5", ramp(LEAN, 0.5), (0.5, 1.0), 0.006, 1.0)


def bounce():
    def ball(restitution, floor_restitution=None, lines=(), apis=()):
        other = restitution if floor_restitution is None else floor_restitution
        return scene(
            rough(restitution=restitution, lines=lines, apis=apis),
            rough(name="Smooth", restitution=other),
            floor(SMOOTH),
            body("A", (0, 0, 1.2), ("Sphere", 0.2), material=ROUGH),
        )

    yield Row("bounce", "restitution 0.7", ball(0.7), (0.6, 0.8), 0.04, engines=(OVPHYSX,))
    yield Row(
        "bounce_average",
        "restitutions 1 and 0.4 are averaged",
        ball(1.0, 0.4),
        (0.6, 0.8),
        0.04,
        engines=(OVPHYSX,),
    )
    yield Row(
        "bounce_max",
        "restitutions 0.2 and 0.7 by the mode max",
        ball(
            0.2,
            0.7,
            ['uniform token physxMaterial:restitutionCombineMode = "max"'],
            ["PhysxMaterialAPI"],
        ),
        (0.6, 0.8),
        0.04,
        engines=(OVPHYSX,),
    )
    yield Row("no_bounce", "restitution 0", ball(0.0), SETTLED, 0.004, 180)


def filters():
    def two(*more, upper=(), lower=(), rows=()):
        return scene(
            rough(),
            floor(ROUGH),
            body(
                "A",
                (0, 0, 0.2),
                ("Cube", 0.4),
                material=ROUGH,
                apis=lower and ["PhysicsFilteredPairsAPI"],
                lines=lower,
            ),
            body(
                "B",
                (0, 0, 0.61),
                ("Cube", 0.4),
                material=ROUGH,
                apis=upper and ["PhysicsFilteredPairsAPI"],
                lines=upper,
            ),
            *more,
        )

    a, b = "/World/A", "/World/B"
    ga = "/World/GA"
    yield Row(
        "pair_filter",
        "a filtered pair: the upper box falls through the lower",
        two(upper=["rel physics:filteredPairs = </World/A>"]),
        SETTLED,
    )
    yield Row(
        "group_filter",
        "two groups, one filters the other",
        two(group("GA", [a]), group("GB", [b], [ga])),
        SETTLED,
    )
    yield Row("group_self", "a group that filters itself", two(group("GA", [a, b], [ga])), SETTLED)
    yield Row(
        "group_none", "two groups without filters", two(group("GA", [a]), group("GB", [b])), SETTLED
    )
    yield Row(
        "no_collision",
        "a collider that is switched off",
        scene(
            rough(),
            floor(ROUGH),
            body(
                "A",
                (0, 0, 2),
                material=ROUGH,
                lines=["bool physics:collisionEnabled = false"],
                mass=1.0,
                inertia=(0.01, 0.01, 0.01),
            ),
        ),
        (0.5, 0.7),
        0.004,
    )
    yield Row(
        "trigger",
        "a trigger touches nothing",
        scene(
            rough(),
            static("F", (0, 0, 0.5), apis=["PhysxTriggerAPI"]),
            body("A", (0, 0, 2), material=ROUGH),
        ),
        (0.5, 0.7),
        0.004,
        engines=(OVPHYSX,),
    )


def rolls():
    spin = (-286.4789, 0, 0)  # of 1 m/s along Y on a radius of 0.2 m
    for name, shape in (("ball", ("Sphere", 0.2)), ("capsule", ("Capsule", 0.2, 0.4, "X"))):
        yield Row(
            f"roll_{name}",
            f"a {name} rolls",
            scene(
                rough(),
                floor(ROUGH),
                body("A", (0, 0, 0.2), shape, material=ROUGH, velocity=(0, 1, 0), spin=spin),
            ),
            (0.5, 1.0),
            engines=(OVPHYSX,),
        )
    yield Row(
        "roll_down",
        "a ball rolls down 10 degrees",
        scene(
            rough(0.8),
            static("Ramp", shape=("Cube", 1), turn=LEAN, scale=(10, 4, 1), material=ROUGH),
            body("A", (0.7 * 0.1736482, 0, 0.7 * 0.9848078), ("Sphere", 0.2), material=ROUGH),
        ),
        engines=(OVPHYSX,),
    )
    yield resting(
        "rest_cone", "a cone comes to rest", ("Cone", 0.2, 0.2, "Z"), 0.1, engines=(OVPHYSX,)
    )
    yield Row(
        "asleep_on_floor",
        "what falls onto a sleeper",
        scene(
            rough(),
            floor(ROUGH),
            body(
                "A",
                (0, 0, 0.2),
                ("Cube", 0.4),
                material=ROUGH,
                lines=["uniform bool physics:startsAsleep = true"],
            ),
            body("B", (0, 0, 0.62), ("Cube", 0.4), material=ROUGH),
        ),
        SETTLED,
        engines=(OVPHYSX,),
    )
    yield Row(
        "head_on",
        "a smooth box stops at another",
        scene(
            rough(0.0),
            body("A", (0, 0, 3), mass=2.0, material=ROUGH),
            body("B", (0.5, 0, 3), mass=2.0, velocity=(-1, 0, 0), material=ROUGH),
            gravity=["float physics:gravityMagnitude = 0"],
        ),
        engines=(OVPHYSX,),
    )


def kinematics():
    yield Row(
        "kinematic_push",
        "a kinematic body pushes a box",
        scene(
            rough(0.2),
            floor(ROUGH),
            body(
                "K",
                (-0.5, 0, 0.2),
                ("Sphere", 0.2),
                material=ROUGH,
                lines=[
                    "bool physics:kinematicEnabled = true",
                    "double3 xformOp:translate.timeSamples = "
                    "{ 0: (-0.5, 0, 0.2), 24: (0.5, 0, 0.2) }",
                ],
            ),
            body("A", (0, 0, 0.2), ("Cube", 0.4), material=ROUGH),
        ).replace("metersPerUnit", "timeCodesPerSecond = 24\n    metersPerUnit"),
        (0.5, 0.8),
        0.01,
        1.0,
        moves={"/World/K": (1, 0, 0)},
        engines=(OVPHYSX,),
    )
    yield Row(
        "conveyor",
        "a surface velocity carries a box",
        scene(
            rough(0.5),
            body(
                "K",
                (0, 0, -0.5),
                ("Cube", 1),
                scale=(20, 20, 1),
                material=ROUGH,
                apis=["PhysxSurfaceVelocityAPI"],
                lines=[
                    "bool physics:kinematicEnabled = true",
                    "vector3f physxSurfaceVelocity:surfaceVelocity = (0.5, 0, 0)",
                    "bool physxSurfaceVelocity:surfaceVelocityLocalSpace = false",
                ],
            ),
            body("A", (0, 0, 0.05), material=ROUGH, **SLAB),
        ),
        (0.5, 1.0),
        0.01,
        1.0,
        engines=(OVPHYSX,),
    )


def scenes():
    for part in (rest, planes, stacks, meshes, friction, bounce, filters, rolls, kinematics):
        yield from part()
