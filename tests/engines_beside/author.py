# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Small physics scenes as USD text, from Python values.

A body is authored with PhysxRigidBodyAPI and no angular damping, since PhysX takes 0.05 per second
where nothing is said (portability.angular-damping); `damping=None` leaves both out.
"""

KINDS = {
    "fixed": "PhysicsFixedJoint",
    "revolute": "PhysicsRevoluteJoint",
    "prismatic": "PhysicsPrismaticJoint",
    "spherical": "PhysicsSphericalJoint",
    "distance": "PhysicsDistanceJoint",
    "d6": "PhysicsJoint",
}
FLOOR = 0.0


def value(what):
    """A Python value as it stands in a layer."""
    if isinstance(what, bool):
        return "true" if what else "false"
    if isinstance(what, str):
        return f'"{what}"'
    if isinstance(what, (tuple, list)):
        return "(" + ", ".join(value(part) for part in what) + ")"
    return "inf" if what == float("inf") else "-inf" if what == -float("inf") else repr(what)


def indent(text):
    return "".join("    " + line + "\n" if line else "\n" for line in text.rstrip("\n").split("\n"))


def prim(kind, name, apis=(), lines=(), children=()):
    """One `def`; `lines` are authored as they are."""
    head = f'def {kind} "{name}"' if kind else f'def "{name}"'
    if apis:
        head += " (\n    prepend apiSchemas = [" + ", ".join(f'"{api}"' for api in apis) + "]\n)"
    inside = "".join(line + "\n" for line in lines if line) + "".join(children)
    return f"{head}\n{{\n{indent(inside) if inside else ''}}}\n"


def place(at, turn=None, scale=None):
    """Transform operations; `turn` is a quaternion (w, x, y, z)."""
    lines, order = [f"double3 xformOp:translate = {value(at)}"], ["xformOp:translate"]
    if turn:
        lines.append(f"quatd xformOp:orient = {value(turn)}")
        order.append("xformOp:orient")
    if scale:
        lines.append(f"float3 xformOp:scale = {value(scale)}")
        order.append("xformOp:scale")
    names = ", ".join(f'"{name}"' for name in order)
    return [*lines, f"uniform token[] xformOpOrder = [{names}]"]


def shape_lines(shape):
    """("Cube", size), ("Sphere", radius), ("Capsule", "Cylinder", "Cone": radius, height, axis)"""
    if shape[0] == "Cube":
        return [f"double size = {shape[1]}"]
    if shape[0] == "Sphere":
        return [f"double radius = {shape[1]}"]
    return [
        f"double radius = {shape[1]}",
        f"double height = {shape[2]}",
        f'uniform token axis = "{shape[3]}"',
    ]


def material_of(path):
    return f"rel material:binding:physics = <{path}>" if path else ""


def mass_lines(mass=None, inertia=None, com=None, axes=None, density=None):
    rows = (
        ("float physics:mass", mass),
        ("float physics:density", density),
        ("float3 physics:diagonalInertia", inertia),
        ("point3f physics:centerOfMass", com),
        ("quatf physics:principalAxes", axes),
    )
    return [f"{name} = {value(number)}" for name, number in rows if number is not None]


def body(
    name,
    at=(0, 0, 0),
    shape=("Cube", 0.2),
    turn=None,
    scale=None,
    velocity=None,
    spin=None,
    material=None,
    damping=0.0,
    collides=True,
    apis=(),
    lines=(),
    children=(),
    **mass,
):
    """A rigid body with its own shape; `mass`: mass, inertia, com, axes, density."""
    weighed = mass_lines(**mass)
    applied = [
        "PhysicsRigidBodyAPI",
        *(["PhysicsCollisionAPI"] if collides else []),
        *(["PhysicsMassAPI"] if weighed else []),
        *(["PhysxRigidBodyAPI"] if damping is not None else []),
        *(["MaterialBindingAPI"] if material else []),
        *apis,
    ]
    rows = [
        *(shape_lines(shape) if shape else []),
        *weighed,
        *place(at, turn, scale),
        f"vector3f physics:velocity = {value(velocity)}" if velocity else "",
        f"vector3f physics:angularVelocity = {value(spin)}" if spin else "",
        f"float physxRigidBody:angularDamping = {damping}" if damping is not None else "",
        material_of(material),
        *lines,
    ]
    return prim(shape[0] if shape else "Xform", name, applied, rows, children)


def static(
    name, at=(0, 0, 0), shape=("Cube", 1), turn=None, scale=None, material=None, apis=(), lines=()
):
    """A collider that does not move."""
    applied = ["PhysicsCollisionAPI", *(["MaterialBindingAPI"] if material else []), *apis]
    return prim(
        shape[0],
        name,
        applied,
        [*shape_lines(shape), *place(at, turn, scale), material_of(material), *lines],
    )


def floor(material=None, name="Floor"):
    """A wide box whose upper side is z = 0."""
    return static(name, (0, 0, -0.5), ("Cube", 1), scale=(40, 40, 1), material=material)


def plane(name="Floor", at=(0, 0, 0), axis="Z", material=None):
    return prim(
        "Plane",
        name,
        ["PhysicsCollisionAPI", *(["MaterialBindingAPI"] if material else [])],
        [f'uniform token axis = "{axis}"', *place(at), material_of(material)],
    )


def material(
    name, friction=0.5, restitution=0.0, static_friction=None, density=None, lines=(), apis=()
):
    rows = [
        f"float physics:staticFriction = {static_friction or friction}",
        f"float physics:dynamicFriction = {friction}",
        f"float physics:restitution = {restitution}",
        f"float physics:density = {density}" if density else "",
        *lines,
    ]
    return prim("Material", name, ["PhysicsMaterialAPI", *apis], rows)


def target(name, path):
    return f"rel physics:{name} = <{path}>" if path else ""


def limit(axis, low, high):
    """-> (API, lines) of a limit of a D6 joint."""
    return (
        f"PhysicsLimitAPI:{axis}",
        [
            f"float limit:{axis}:physics:low = {value(low)}",
            f"float limit:{axis}:physics:high = {value(high)}",
        ],
    )


def drive(
    axis,
    kind="force",
    stiffness=0.0,
    damping=0.0,
    target_position=0.0,
    target_velocity=0.0,
    max_force=None,
):
    """-> (API, lines) of a drive."""
    rows = [
        f'uniform token drive:{axis}:physics:type = "{kind}"',
        f"float drive:{axis}:physics:stiffness = {stiffness}",
        f"float drive:{axis}:physics:damping = {damping}",
        f"float drive:{axis}:physics:targetPosition = {target_position}",
        f"float drive:{axis}:physics:targetVelocity = {target_velocity}",
    ]
    if max_force is not None:
        rows.append(f"float drive:{axis}:physics:maxForce = {max_force}")
    return f"PhysicsDriveAPI:{axis}", rows


def joint(
    kind,
    name,
    body0=None,
    body1=None,
    pos0=(0, 0, 0),
    pos1=(0, 0, 0),
    rot0=None,
    rot1=None,
    axis=None,
    limits=None,
    parts=(),
    apis=(),
    lines=(),
):
    """`parts`: what limit() and drive() give; `limits`: (lower, upper) of the joint itself."""
    rows = [
        target("body0", body0),
        target("body1", body1),
        f"point3f physics:localPos0 = {value(pos0)}",
        f"point3f physics:localPos1 = {value(pos1)}",
        f"quatf physics:localRot0 = {value(rot0)}" if rot0 else "",
        f"quatf physics:localRot1 = {value(rot1)}" if rot1 else "",
        f'uniform token physics:axis = "{axis}"' if axis else "",
    ]
    if limits:
        rows += [
            f"float physics:lowerLimit = {value(limits[0])}",
            f"float physics:upperLimit = {value(limits[1])}",
        ]
    for _, part in parts:
        rows += part
    return prim(KINDS[kind], name, [*(api for api, _ in parts), *apis], [*rows, *lines])


def group(name, members, filters=(), lines=()):
    rows = ["rel collection:colliders:includes = [" + ", ".join(f"<{m}>" for m in members) + "]"]
    if filters:
        rows.append("rel physics:filteredGroups = [" + ", ".join(f"<{f}>" for f in filters) + "]")
    return prim("PhysicsCollisionGroup", name, ["CollectionAPI:colliders"], [*rows, *lines])


def scene(
    *prims,
    gravity=(),
    meters=1,
    kilograms=1,
    up="Z",
    articulated=False,
    apis=(),
    physics_apis=(),
    world=True,
):
    """A whole layer. `gravity`: lines of the PhysicsScene, `physics_apis` its schemas;
    `articulated`: the root API stands on /World."""
    applied = [*(["PhysicsArticulationRootAPI"] if articulated else []), *apis]
    inside = [prim("PhysicsScene", "PhysicsScene", physics_apis, gravity), *prims]
    head = (
        '#usda 1.0\n(\n    defaultPrim = "World"\n'
        f"    kilogramsPerUnit = {kilograms}\n    metersPerUnit = {meters}\n"
        f'    upAxis = "{up}"\n)\n\n'
    )
    return head + (prim("Xform", "World", applied, (), inside) if world else "".join(inside))
