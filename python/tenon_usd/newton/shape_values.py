# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of colliders: materials, contact response, offsets, fields of distances."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from .importing import Importing, warn
from .prims import PrimView

CONTACT_KEYS = ("ke", "kd", "kf", "ka")
TEXTURE_FORMATS = ("float32", "uint16", "uint8")
#: newton:sdfMaxResolution where the schema is applied and says nothing.
SDF_RESOLUTION = 64


@dataclasses.dataclass(frozen=True)
class Surface:
    """A material as Newton's shapes have it."""

    friction: float
    torsional: float
    rolling: float
    restitution: float
    density: float
    response: tuple[float | None, ...] = (None, None, None, None)


class Surfaces:
    """Materials of the description by number; None is the builder's default."""

    def __init__(self, importing: Importing) -> None:
        self._importing = importing
        self._found: dict[int | None, Surface] = {}
        for number, material in enumerate(importing.scene.materials):
            if importing.prims.is_wanted(material.path):
                self.of(number)

    def of(self, number: int | None) -> Surface:
        found = self._found.get(number)
        if found is None:
            found = self._found[number] = self._read(number)
        return found

    def _read(self, number: int | None) -> Surface:
        default = self._importing.builder.default_shape_cfg
        if number is None:
            return Surface(
                default.mu, default.mu_torsional, default.mu_rolling, default.restitution,
                default.density,
            )
        material = self._importing.scene.materials[number]
        resolvers, prim = self._importing.resolvers, self._importing.prims[material.path]
        if material.friction_combine != "average" or material.restitution_combine != "average":
            warn(material.path, "how coefficients of pairs are combined is the solver's in Newton")
        found = [resolvers.value(prim, "MATERIAL", key) for key in CONTACT_KEYS]
        ke, kd, kf, ka = (None if each is None else float(each) for each in found)
        return Surface(
            material.dynamic_friction,
            resolvers.value(prim, "MATERIAL", "mu_torsional", default.mu_torsional),
            resolvers.value(prim, "MATERIAL", "mu_rolling", default.mu_rolling),
            material.restitution,
            material.density if material.density else default.density,
            (ke, kd, kf, ka),
        )


def contact_arguments(importing: Importing, prim: PrimView, surface: Surface) -> dict[str, float]:
    """Friction and contact gains: the shape's own mjc:solref where MuJoCo's resolver comes before
    Newton's, else the material's, else the shape's, else the builder's."""
    resolvers, default = importing.resolvers, importing.builder.default_shape_cfg
    names = [each.name for each in resolvers.all if each.name in ("mjc", "newton")]
    solref = names[:1] == ["mjc"] and prim.authored("mjc:solref") is not None
    made = {
        "mu": surface.friction,
        "restitution": surface.restitution,
        "mu_torsional": surface.torsional,
        "mu_rolling": surface.rolling,
    }
    for key, of_material in zip(CONTACT_KEYS, surface.response, strict=True):
        own = resolvers.value(prim, "SHAPE", key)
        own = None if own is None or not math.isfinite(own) else float(own)
        if of_material is not None and not math.isfinite(of_material):
            of_material = None
        if own is not None and (of_material is None or solref and key in ("ke", "kd")):
            made[key] = own
        else:
            made[key] = getattr(default, key) if of_material is None else of_material
    return made


def offsets(importing: Importing, prim: PrimView) -> tuple[float, float | None]:
    """Margin and gap [m]; a gap of None is the builder's rigid_gap."""
    resolvers, default = importing.resolvers, importing.builder.default_shape_cfg
    margin, resolver = resolvers.found(prim, "SHAPE", "margin")
    if margin is None:
        margin = default.margin
    gap = resolvers.value(prim, "SHAPE", "gap")
    if gap == -math.inf:
        gap = default.gap
    if importing.options.legacy_margin_gap and resolver is not None and resolver.name == "mjc":
        margin = float(margin) - float(prim.authored("mjc:gap") or 0.0)
    return float(margin), gap


def _positive(importing: Importing, prim: PrimView, key: str, name: str, least: float) -> Any:
    """A setting of distance fields; None where it is not given or cannot be used."""
    value = importing.resolvers.value(prim, "SHAPE", key)
    if value is None or value == -math.inf:
        return None
    if value < least or least == 0.0 and value < 0:
        warn(prim.path, f"newton:{name} = {value} cannot be used; the builder's default is taken")
        return None
    return value


def sdf_arguments(importing: Importing, prim: PrimView) -> tuple[dict[str, Any], bool]:
    """Settings of a field of distances, and whether the schema for it is applied."""
    resolvers, default = importing.resolvers, importing.builder.default_shape_cfg
    applied = prim.HasAPI("NewtonSDFCollisionAPI")
    tiny = math.ulp(0.0)
    voxel = _positive(importing, prim, "sdf_target_voxel_size", "sdfTargetVoxelSize", tiny)
    voxel = default.sdf_target_voxel_size if voxel is None else voxel
    resolution = _positive(importing, prim, "sdf_max_resolution", "sdfMaxResolution", 1)
    if resolution is not None and (resolution % 8 or voxel is not None):
        warn(prim.path, f"newton:sdfMaxResolution = {resolution} is not used: it has to be a "
             "multiple of 8, without newton:sdfTargetVoxelSize")
        resolution = None
    if resolution is None:
        wanted = applied and voxel is None
        resolution = SDF_RESOLUTION if wanted else default.sdf_max_resolution
    sides = ("inner", "outer")
    band = [resolvers.value(prim, "SHAPE", f"sdf_narrow_band_{side}") for side in sides]
    kept = [
        fallback if value is None or value == -math.inf else value
        for value, fallback in zip(band, default.sdf_narrow_band_range, strict=True)
    ]
    texture = resolvers.value(prim, "SHAPE", "sdf_texture_format")
    return {
        "sdf_max_resolution": resolution,
        "sdf_target_voxel_size": voxel,
        "sdf_narrow_band_range": tuple(kept),
        "sdf_texture_format": texture if texture in TEXTURE_FORMATS else default.sdf_texture_format,
        "sdf_padding": _positive(importing, prim, "sdf_padding", "sdfPadding", 0.0),
    }, applied


def hydroelastic(
    importing: Importing, prim: PrimView, sdf: dict[str, Any], applied: bool, mesh: bool
) -> tuple[bool, float]:
    """Whether contacts are hydroelastic, and their stiffness [N/m^3]."""
    resolvers, default = importing.resolvers, importing.builder.default_shape_cfg
    wanted = resolvers.value(prim, "SHAPE", "hydroelastic_enabled")
    if not isinstance(wanted, bool):
        wanted = False if applied else default.is_hydroelastic
    stiffness = _positive(importing, prim, "kh", "hydroelasticStiffness", math.ulp(0.0))
    if wanted and mesh and not sdf["sdf_max_resolution"] and not sdf["sdf_target_voxel_size"]:
        warn(prim.path, "newton:hydroelasticEnabled on a mesh needs newton:sdfMaxResolution")
        wanted = False
    return wanted, default.kh if stiffness is None else stiffness


def shell(importing: Importing, prim: PrimView, margin: float) -> tuple[bool, float, bool]:
    """Whether the shape is solid, the thickness that counts for its mass [m], and whether that is
    another one than the margin."""
    resolvers = importing.resolvers
    solid = resolvers.value(prim, "SHAPE", "mass_model", "solid") != "shell"
    thickness = resolvers.value(prim, "SHAPE", "shell_thickness")
    if thickness is None or not math.isfinite(thickness):
        return solid, margin, False
    if thickness < 0:
        warn(prim.path, f"newton:shellThickness = {thickness} cannot be used")
        return solid, margin, True
    return solid, float(thickness), True
