# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Colliders of the description into the builder, and what replaces their meshes."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

from ..errors import UnsupportedError
from .importing import Importing, warn
from .looks import UNBOUND, displayed
from .masses import Masses
from .poses import Pose, compose, inverse, pose_of
from .prims import PrimView
from .shape_values import (
    Surfaces,
    contact_arguments,
    hydroelastic,
    offsets,
    sdf_arguments,
    shell,
)
from .visuals import along, axis_of, is_collider, seen_of

#: Types of colliders in the order in which their shapes come.
TYPES = ("Sphere", "Cube", "Capsule", "Cylinder", "Cone", "Plane", "Mesh")
#: physics:approximation -> the method of ModelBuilder.approximate_meshes.
METHODS = {
    "convexDecomposition": "coacd",
    "convexHull": "convex_hull",
    "boundingSphere": "bounding_sphere",
    "boundingCube": "bounding_box",
    "meshSimplification": "quadratic",
}
DECOMPOSITION = "PhysxConvexDecompositionCollisionAPI"


@dataclasses.dataclass
class Colliders:
    """What the passes behind this one need of colliders."""

    #: Numbers of the description of those that became a shape, by path.
    numbers: dict[str, int] = dataclasses.field(default_factory=dict)


def add_colliders(importing: Importing, masses: Masses) -> Colliders:
    """Adds all colliders that are wanted, then approximates meshes as the asset asks."""
    made = Colliders()
    surfaces = Surfaces(importing)
    wanted: list[tuple[int, int, int, PrimView]] = []
    for number, collider in enumerate(importing.scene.colliders):
        if not importing.prims.is_wanted(collider.path):
            continue
        prim = importing.prims.get(collider.path)
        if prim is None or prim.type_name not in TYPES:
            kind = "an instance of a point instancer" if prim is None else prim.type_name
            raise UnsupportedError(f"{collider.path}: a collider that is {kind}")
        place = importing.prims.ordinals[collider.path]
        wanted.append((TYPES.index(prim.type_name), place, number, prim))
    waiting: dict[tuple[str, tuple[tuple[str, Any], ...]], list[tuple[int, bool]]] = {}
    for _, _, number, prim in sorted(wanted, key=lambda each: each[:2]):
        made.numbers[prim.path] = number
        if prim.path in importing.shapes:
            continue  # switched off: it is a visual
        shape, split = _add(importing, masses, surfaces, number, prim)
        method = _method(importing, prim)
        if method is not None:
            waiting.setdefault(method, []).append((shape, split))
    _approximate(importing, waiting)
    return made


def _local(importing: Importing, collider: Any, prim: PrimView) -> Pose:
    """Body <- shape, or stage's world <- shape where it is static; of a mesh of the mesh itself,
    not of what it collides as."""
    if prim.type_name != "Mesh":
        return pose_of(collider.position, collider.orientation)
    pose = importing.prim_pose(prim.path, mirrored=True)
    if collider.body is None:
        return pose
    return compose(inverse(importing.body_pose(collider.body)), pose)


def _add(
    importing: Importing, masses: Masses, surfaces: Surfaces, number: int, prim: PrimView
) -> tuple[int, bool]:
    """-> the shape, and whether its mesh is seen, so that a copy of it stays."""
    builder, scene = importing.builder, importing.scene
    collider, seen = scene.colliders[number], seen_of(importing)
    importing.resolvers.collect(prim)
    path = importing.body_paths[collider.body] if collider.body is not None else ""
    body = importing.bodies.get(path, -1)
    enabled = is_collider(prim)
    _tell_settings(collider)
    local = _local(importing, collider, prim)
    if body == -1:
        local = compose(importing.incoming, local)
    surface = surfaces.of(collider.material)
    margin, gap = offsets(importing, prim)
    solid, thickness, restored = shell(importing, prim, margin)
    sdf, applied = sdf_arguments(importing, prim)
    mesh = prim.type_name == "Mesh"
    fluid, stiffness = hydroelastic(importing, prim, sdf, applied, mesh)
    drawn, hidden = seen.looks.is_drawn(prim), _is_hidden(importing, body)
    visible = (importing.options.force_show_colliders or drawn) and not hidden
    if not solid and enabled:
        masses.refuse_shell(path, prim.path)
    density = masses.density(path, surface.density) if enabled else 0.0
    config = {
        **contact_arguments(importing, prim, surface), **sdf, "margin": thickness, "gap": gap,
        "density": density, "collision_group": builder.default_shape_cfg.collision_group,
        "is_visible": visible, "has_shape_collision": enabled, "has_particle_collision": enabled,
        "is_hydroelastic": fluid, "kh": stiffness, "is_solid": solid,
    }
    arguments = {
        "body": body,
        "xform": local,
        "label": prim.path,
        "custom_attributes": importing.custom_values(prim, "SHAPE"),
        **_colours(importing, prim, visible),
    }
    shape = _MAKERS[prim.type_name](importing, prim, collider, config, arguments)
    if restored:
        builder.shape_margin[shape] = margin
    importing.shapes[prim.path] = shape
    importing.shape_scales[prim.path] = importing.libraries.warp.vec3(
        *importing.prims.scale(prim.path)
    )
    split = mesh and importing.options.load_visual_shapes and drawn and not hidden
    return shape, split


def _tell_settings(collider: Any) -> None:
    if collider.trigger:
        warn(collider.path, "a trigger: in Newton it is a collider as any other")
    if len(collider.face_materials):
        warn(collider.path, "materials of GeomSubsets: shapes of Newton have one material")


def _is_hidden(importing: Importing, body: int) -> bool:
    """Whether colliders of a body are hidden because visuals of it are there."""
    options = importing.options
    has_visuals = options.load_visual_shapes and body in importing.seen_bodies
    return options.hide_collision_shapes and has_visuals


def _colours(importing: Importing, prim: PrimView, visible: bool) -> dict[str, Any]:
    look = seen_of(importing).looks.look(prim)
    textured = look.textured and prim.type_name == "Mesh"
    made: dict[str, Any] = {"color": look.colour}
    if look.colour is None and visible and not textured:
        made["color"] = displayed(UNBOUND)
    if visible and look.opacity is not None:
        made["opacity"] = look.opacity
    return made


def _config(importing: Importing, values: dict[str, Any]) -> Any:
    return importing.libraries.newton.ModelBuilder.ShapeConfig(**values)


def _box(
    importing: Importing, prim: PrimView, collider: Any, config: Any, arguments: dict[str, Any]
) -> int:
    hx, hy, hz = collider.half_extents.tolist()
    number: int = importing.builder.add_shape_box(
        **arguments, cfg=_config(importing, config), hx=hx, hy=hy, hz=hz
    )
    return number


def _sphere(
    importing: Importing, prim: PrimView, collider: Any, config: Any, arguments: dict[str, Any]
) -> int:
    builder, made = importing.builder, _config(importing, config)
    if collider.shape == "ellipsoid":
        rx, ry, rz = collider.half_extents.tolist()
        number: int = builder.add_shape_ellipsoid(**arguments, cfg=made, rx=rx, ry=ry, rz=rz)
    else:
        number = builder.add_shape_sphere(**arguments, cfg=made, radius=collider.radius)
    return number


def _round(
    importing: Importing, prim: PrimView, collider: Any, config: Any, arguments: dict[str, Any]
) -> int:
    if collider.shape != prim.type_name.lower():
        raise UnsupportedError(
            f"{prim.path}: a {prim.type_name} that its scale makes a {collider.shape}"
        )
    axis = getattr(importing.libraries.newton.Axis, collider.axis)
    arguments["xform"] = along(arguments["xform"], axis)
    number: int = getattr(importing.builder, f"add_shape_{collider.shape}")(
        **arguments,
        cfg=_config(importing, config),
        radius=collider.radius,
        half_height=collider.half_height,
    )
    return number


def _plane(
    importing: Importing, prim: PrimView, collider: Any, config: Any, arguments: dict[str, Any]
) -> int:
    axis = axis_of(importing, prim)
    if int(axis) != 2:
        arguments["xform"] = along(arguments["xform"], axis)
    number: int = importing.builder.add_shape_plane(
        **arguments, cfg=_config(importing, config), width=0.0, length=0.0
    )
    return number


#: Settings that meshes have in lists of the builder instead, and what replaces them.
_OF_PRIMITIVES = {
    "sdf_max_resolution": None,
    "sdf_target_voxel_size": None,
    "sdf_narrow_band_range": (-0.1, 0.1),
    "sdf_texture_format": "uint16",
    "sdf_padding": None,
    "is_hydroelastic": False,
}


def _mesh(
    importing: Importing, prim: PrimView, collider: Any, config: Any, arguments: dict[str, Any]
) -> int:
    builder, seen = importing.builder, seen_of(importing)
    heavy = config["density"] > 0.0 and arguments["body"] >= 0
    drawn = config["is_visible"] or seen.looks.is_drawn(prim)
    mesh = seen.meshes.mesh(prim, heavy, drawn, **seen.looks.look(prim).of_mesh())
    most = importing.options.mesh_maxhullvert
    mesh.maxhullvert = importing.resolvers.value(
        prim, "SHAPE", "max_hull_vertices",
        type(mesh).MAX_HULL_VERTICES if most is None else most,
    )
    m = importing.scene.meters_per_unit
    scale = [each * m for each in importing.prims.mirrored_scale(prim.path)]
    number: int = builder.add_shape_mesh(
        **arguments,
        cfg=_config(importing, {**config, **_OF_PRIMITIVES}),
        scale=importing.libraries.warp.vec3(*scale),
        mesh=mesh,
    )
    for name in list(_OF_PRIMITIVES)[:-1]:
        getattr(builder, f"shape_{name}")[number] = config[name]
    builder.shape_material_kh[number] = config["kh"]
    if config["is_hydroelastic"]:
        builder.shape_flags[number] |= importing.libraries.newton.ShapeFlags.HYDROELASTIC
    return number


_MAKERS: dict[str, Callable[[Importing, PrimView, Any, Any, dict[str, Any]], int]] = {
    "Cube": _box,
    "Sphere": _sphere,
    "Capsule": _round,
    "Cylinder": _round,
    "Cone": _round,
    "Plane": _plane,
    "Mesh": _mesh,
}


def _method(
    importing: Importing, prim: PrimView
) -> tuple[str, tuple[tuple[str, Any], ...]] | None:
    """How a mesh is approximated: the builder's method and its arguments."""
    if prim.type_name != "Mesh" or importing.options.skip_mesh_approximation:
        return None
    asked = prim.authored("physics:approximation")
    if asked is None or asked == "none" or not is_collider(prim):
        return None
    if prim.HasAPI("NewtonSDFCollisionAPI"):
        warn(prim.path, f"physics:approximation = {asked} is not used with NewtonSDFCollisionAPI")
        return None
    method = METHODS.get(asked)
    if method is None:
        warn(prim.path, f"physics:approximation = {asked}: not in Newton; the mesh collides")
        return None
    most = None
    if method == "coacd" and prim.HasAPI(DECOMPOSITION):
        most = importing.resolvers.value(prim, "SHAPE", "convex_decomposition_max_hulls")
    return method, () if most is None else (("max_convex_hull", most), ("merge", True))


def _approximate(
    importing: Importing,
    waiting: dict[tuple[str, tuple[tuple[str, Any], ...]], list[tuple[int, bool]]],
) -> None:
    """Meshes that are seen keep a copy to be seen; the others are replaced."""
    builder = importing.builder
    visible = int(importing.libraries.newton.ShapeFlags.VISIBLE)
    for (method, arguments), shapes in waiting.items():
        split = [shape for shape, seen in shapes if seen]
        rest = [shape for shape, seen in shapes if not seen]
        for shape in split:
            builder.shape_flags[shape] |= visible
        for group, keep in ((split, True), (rest, False)):
            if group:
                builder.approximate_meshes(
                    method=method, shape_indices=group, keep_visual_shapes=keep, **dict(arguments)
                )
