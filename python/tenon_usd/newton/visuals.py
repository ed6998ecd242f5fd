# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Geometry that is seen and does not collide, and sites."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ..errors import UnsupportedError
from .importing import Importing
from .looks import UNBOUND, Look, Looks, displayed
from .meshes import Meshes
from .poses import Pose, Vector, inverse, matrix_of, multiply
from .prims import RIGID_BODY, PrimView

SITES = ("NewtonSiteAPI", "MjcSiteAPI")
TYPES = ("Cube", "Sphere", "Plane", "Capsule", "Cylinder", "Cone", "Mesh")


class Seen:
    """What visuals of one import share; kept by the import."""

    def __init__(self, importing: Importing) -> None:
        self.looks = Looks(importing)
        self.meshes = Meshes(importing)
        self._shape_config = importing.libraries.newton.ModelBuilder.ShapeConfig
        self._configs: dict[bool, Any] = {}

    def config(self, drawn: bool) -> Any:
        """What shapes have that do not collide."""
        if drawn not in self._configs:
            self._configs[drawn] = self._shape_config(
                density=0.0, has_shape_collision=False, has_particle_collision=False,
                is_visible=drawn,
            )
        return self._configs[drawn]


def seen_of(importing: Importing) -> Seen:
    found: Seen | None = importing.__dict__.get("seen")
    if found is None:
        found = importing.__dict__["seen"] = Seen(importing)
    return found


def is_collider(prim: PrimView) -> bool:
    """Whether the prim collides: its collisions are not switched off."""
    if not prim.HasAPI("PhysicsCollisionAPI"):
        return False
    return prim.authored("physics:collisionEnabled") is not False


def add_below(
    importing: Importing, body: PrimView, number: int, pose: Pose, root: Pose | None
) -> None:
    """Adds visuals and sites below a body, which is at `pose` of the builder's world; `root`: the
    pose that places are seen from, instead of the world."""
    options = importing.options
    if not options.load_sites and not options.load_visual_shapes:
        return
    waiting = [(child, options.load_visual_shapes) for child in reversed(body.GetChildren())]
    frame = matrix_of(inverse(pose)) if waiting else None
    while waiting:
        prim, wanted = waiting.pop()
        if prim.HasAPI(RIGID_BODY) or importing.prims.is_ignored(prim.path):
            continue
        collides = is_collider(prim)
        site = not collides and any(prim.HasAPI(name) for name in SITES)
        if site and not options.load_sites or prim.type_name.lower().endswith("joint"):
            continue
        if not collides and (site or wanted):
            _add(importing, prim, number, frame, root, site)
        below = wanted and not collides
        waiting.extend((child, below) for child in reversed(prim.GetChildren()))


def add_static(importing: Importing) -> None:
    """Adds visuals and sites that are below no body."""
    options = importing.options
    if not (options.load_visual_shapes and options.load_static_visual_shapes):
        return
    bodies = set(importing.body_paths)
    inside: dict[str, bool] = {"": False}
    for prim in importing.prims:
        path = prim.path
        above = inside.get(path.rpartition("/")[0], False)
        inside[path] = above or path in bodies
        if inside[path] or prim.type_name not in TYPES or path in importing.shapes:
            continue
        if importing.prims.is_ignored(path) or is_collider(prim) or prim.HasAPI(RIGID_BODY):
            continue
        site = any(prim.HasAPI(name) for name in SITES)
        if not site or options.load_sites:
            _add(importing, prim, -1, np.identity(4), None, site)


def _add(
    importing: Importing, prim: PrimView, body: int, frame: Any, root: Pose | None, site: bool
) -> None:
    make = _MAKERS.get(prim.type_name)
    if make is None or prim.path in importing.shapes:
        return
    warp, seen = importing.libraries.warp, seen_of(importing)
    place = importing.prims.world(prim.path)
    m = importing.scene.meters_per_unit
    if m != 1.0:
        place = place * np.array([[m, m, m, 1.0]])
    if root is not None:
        place = place @ matrix_of(inverse(root))
    place = place @ matrix_of(importing.incoming) @ frame
    xform, scale = importing.decompose(place)
    drawn = site or seen.looks.is_drawn(prim)
    look = seen.looks.look(prim)
    colour = look.colour
    if colour is None and drawn and not (look.textured and prim.type_name == "Mesh"):
        colour = displayed(UNBOUND)
    arguments = {"cfg": seen.config(drawn), "color": colour, "label": prim.path}
    if look.opacity is not None:
        arguments["opacity"] = look.opacity
    number = make(importing, prim, body, xform, scale, arguments, site, look)
    importing.shapes[prim.path] = number
    importing.shape_scales[prim.path] = warp.vec3(*(each / m for each in scale))
    if not site and drawn:
        importing.seen_bodies.add(body)


def axis_of(importing: Importing, prim: PrimView) -> Any:
    return getattr(importing.libraries.newton.Axis, str(prim.authored("axis") or "Z"))


#: Turns that bring z along x and along y.
_HALF = math.sqrt(0.5)
_ALONG = {0: (0.0, _HALF, 0.0, _HALF), 1: (-_HALF, 0.0, 0.0, _HALF)}


def along(pose: Pose, axis: Any) -> Pose:
    """A pose whose z is along an axis of the given one."""
    turn = _ALONG.get(int(axis))
    return pose if turn is None else (pose[0], multiply(pose[1], turn))


def _number(prim: PrimView, name: str, default: float) -> float:
    value = prim.authored(name)
    return default if value is None else float(value)


def _box(
    importing: Importing, prim: PrimView, body: int, xform: Pose, scale: Vector,
    arguments: dict[str, Any], site: bool, look: Look,
) -> int:
    hx, hy, hz = (float(each) * _number(prim, "size", 2.0) / 2 for each in scale)
    number: int = importing.builder.add_shape_box(
        body, xform=xform, hx=hx, hy=hy, hz=hz, as_site=site, **arguments
    )
    return number


def _sphere(
    importing: Importing, prim: PrimView, body: int, xform: Pose, scale: Vector,
    arguments: dict[str, Any], site: bool, look: Look,
) -> int:
    radius = _number(prim, "radius", 1.0) * max(float(each) for each in scale)
    number: int = importing.builder.add_shape_sphere(
        body, xform=xform, radius=radius, as_site=site, **arguments
    )
    return number


def _plane(
    importing: Importing, prim: PrimView, body: int, xform: Pose, scale: Vector,
    arguments: dict[str, Any], site: bool, look: Look,
) -> int:
    if site:
        raise UnsupportedError(f"{prim.path}: a site that is a plane")
    axis = axis_of(importing, prim)
    x, y, z = (float(each) for each in scale)
    number: int = importing.builder.add_shape_plane(
        body=body,
        xform=along(xform, axis),
        width=_number(prim, "width", 0.0) * (z if int(axis) == 0 else x),
        length=_number(prim, "length", 0.0) * (z if int(axis) == 1 else y),
        **arguments,
    )
    return number


def _round(
    importing: Importing, prim: PrimView, body: int, xform: Pose, scale: Vector,
    arguments: dict[str, Any], site: bool, look: Look,
) -> int:
    name = prim.type_name.lower()
    radius, height = (0.5, 1.0) if name == "capsule" else (1.0, 2.0)
    axis = axis_of(importing, prim)
    sizes = [float(each) for each in scale]
    along_axis = sizes.pop(int(axis))
    number: int = getattr(importing.builder, f"add_shape_{name}")(
        body,
        xform=along(xform, axis),
        radius=_number(prim, "radius", radius) * max(sizes),
        half_height=_number(prim, "height", height) / 2 * along_axis,
        as_site=site,
        **arguments,
    )
    return number


def _mesh(
    importing: Importing, prim: PrimView, body: int, xform: Pose, scale: Vector,
    arguments: dict[str, Any], site: bool, look: Look,
) -> int:
    if site:
        raise UnsupportedError(f"{prim.path}: a site that is a mesh")
    mesh = seen_of(importing).meshes.mesh(
        prim, inertia=False, drawn=True, **look.of_mesh()
    )
    number: int = importing.builder.add_shape_mesh(
        body, xform=xform, scale=scale, mesh=mesh, **arguments
    )
    return number


_MAKERS: dict[str, Callable[..., int]] = {
    "Cube": _box,
    "Sphere": _sphere,
    "Plane": _plane,
    "Capsule": _round,
    "Cylinder": _round,
    "Cone": _round,
    "Mesh": _mesh,
}
