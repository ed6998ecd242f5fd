# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The arguments of add_usd(), its answer, and the stage that its source means."""

from __future__ import annotations

import dataclasses
import importlib
import os
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypedDict

from .. import _tenon
from ..errors import InvalidError, MissingError
from ..functions import open as open_asset

#: A prim path -> the number of a body, joint or shape of the builder.
Numbers = dict[str, int]


class ImportedWarning(UserWarning):
    """Newton's model cannot hold what the asset says: the message names prim and value."""


class Result(TypedDict, total=False):
    """What add_usd() answers: the keys of newton.ModelBuilder.add_usd, and those of tenon."""

    fps: float
    """Frames per second of the stage."""
    duration: float
    """End time code minus start time code."""
    up_axis: Any
    """newton.Axis of the stage."""
    path_body_map: Numbers
    """Rigid body prims; with fixed joints collapsed, the body that each became a part of."""
    path_joint_map: Numbers
    """Joint prims; those that were merged into one joint share its number."""
    path_shape_map: Numbers
    """Geometry prims: colliders, visuals and sites."""
    path_shape_scale: dict[str, Any]
    """warp.vec3: the scale of each of those prims in the world."""
    path_particle_map: dict[str, tuple[int, int]]
    """Empty: stages with particles are refused."""
    mass_unit: float
    """kilogramsPerUnit of the stage. Numbers of the model are in kilograms whatever it is."""
    linear_unit: float
    """metersPerUnit of the stage. Numbers of the model are in metres whatever it is."""
    scene_attributes: dict[str, Any]
    """Values of the PhysicsScene prim by name."""
    physics_scene_path: str | None
    """The PhysicsScene prim; None where the stage has none."""
    physics_dt: float | None
    """Time step that the scene asks for [s]."""
    collapse_results: dict[str, Any] | None
    """What ModelBuilder.collapse_fixed_joints() answered; None where it was not called."""
    schema_attrs: dict[str, dict[str, dict[str, Any]]]
    """Attributes that resolvers know, by the resolver's name and by prim path."""
    path_body_relative_transform: dict[str, Any]
    """warp.transform of bodies that were collapsed, in the body that they became a part of."""
    max_solver_iterations: int | None
    """That the scene asks for."""
    particle_scene_path: str | None
    """None: stages with particles are refused."""
    actuator_count: int
    """0: stages with prims of type NewtonActuator are refused."""
    path_cable_map: dict[str, Any]
    """Empty, with the other keys of deformables (return_deformable_results)."""
    path_cloth_map: dict[str, Any]
    path_soft_map: dict[str, Any]
    path_deformable_visual_map: dict[str, Any]
    path_cable_attrs: dict[str, Any]
    path_cloth_attrs: dict[str, Any]
    path_soft_attrs: dict[str, Any]
    path_attachment_map: dict[str, Any]
    path_attachment_attrs: dict[str, Any]
    physics_variants: dict[str, str]
    """Of tenon: the selected variant of each variant set "Physics", by prim path."""
    advice: str
    """Of tenon: which variant to select instead, and why; empty where nothing is better."""


#: Keys that the result has with return_deformable_results alone.
DEFORMABLE_KEYS = (
    "path_cable_map", "path_cloth_map", "path_soft_map", "path_deformable_visual_map",
    "path_cable_attrs", "path_cloth_attrs", "path_soft_attrs", "path_attachment_map",
    "path_attachment_attrs",
)


class Libraries(NamedTuple):
    """The user's own packages, untyped."""

    newton: Any
    warp: Any


def libraries() -> Libraries:
    """Newton and Warp. Raises MissingError where they cannot be imported."""
    try:
        return Libraries(importlib.import_module("newton"), importlib.import_module("warp"))
    except ImportError as reason:
        raise MissingError(
            f"newton cannot be imported: {reason}; pip install 'newton[sim]'"
        ) from None


@dataclasses.dataclass
class Options:
    """The arguments of newton.ModelBuilder.add_usd, with its defaults."""

    xform: Any = None
    floating: bool | None = None
    base_joint: dict[str, Any] | None = None
    parent_body: int = -1
    only_load_enabled_rigid_bodies: bool = False
    only_load_enabled_joints: bool = True
    joint_drive_gains_scaling: float = 1.0
    verbose: bool = False
    ignore_paths: Sequence[str] | None = None
    collapse_fixed_joints: bool = False
    enable_self_collisions: bool = True
    apply_up_axis_from_stage: bool = False
    root_path: str = "/"
    joint_ordering: str | None = "dfs"
    bodies_follow_joint_ordering: bool = True
    skip_mesh_approximation: bool = False
    load_sites: bool = True
    load_visual_shapes: bool = True
    load_static_visual_shapes: bool = True
    hide_collision_shapes: bool = False
    force_show_colliders: bool = False
    parse_mujoco_options: bool = True
    mesh_maxhullvert: int | None = None
    schema_resolvers: Sequence[Any] | None = None
    force_position_velocity_actuation: bool = False
    convert_mjc_equality_constraints: bool = True
    override_root_xform: bool = False
    legacy_margin_gap: bool = False
    return_deformable_results: bool = False
    allow_unsafe_torch_checkpoints: bool = False

    def check(self) -> None:
        """Raises InvalidError for a value that is not served."""
        if self.joint_ordering not in ("bfs", "dfs", None):
            raise InvalidError(
                f'joint_ordering is "bfs", "dfs" or None, not {self.joint_ordering!r}'
            )
        if self.override_root_xform and self.xform is None:
            raise InvalidError("override_root_xform=True needs xform")
        if self.allow_unsafe_torch_checkpoints:
            raise InvalidError(
                "allow_unsafe_torch_checkpoints=True: actuator prims are not read here; "
                "use builder.add_usd() for stages that have them"
            )


def options_of(given: Mapping[str, Any]) -> Options:
    """Options of keyword arguments. Raises TypeError for an unknown one."""
    known = {field.name for field in dataclasses.fields(Options)}
    for name in given:
        if name not in known:
            raise TypeError(f"add_usd() got an unexpected keyword argument {name!r}")
    options = Options(**given)
    options.check()
    return options


#: Whose units numbers of a stage are in: those that it says, or metres and kilograms anyway.
UNITS = ("stage", "newton")


def stage_of(source: Any, physics: str, units: str = "stage") -> _tenon.Stage:
    """The composed stage of a path, of a tenon_usd.Stage, or of a pxr.Usd.Stage, which is taken
    over as it is now, flattened. Raises TypeError for anything else."""
    if units not in UNITS:
        raise InvalidError(f'units is "stage" or "newton", not {units!r}')
    if units == "newton" and isinstance(source, _tenon.Stage):
        raise InvalidError('units="newton" is for paths; set metersPerUnit of the stage')
    stage = _opened(source, physics)
    if units == "newton":
        stage.set_metadata("metersPerUnit", 1.0)
        stage.set_metadata("kilogramsPerUnit", 1.0)
    return stage


def _opened(source: Any, physics: str) -> _tenon.Stage:
    if isinstance(source, (str, os.PathLike)):
        if isinstance(source, str) and "://" in source:
            raise InvalidError(f"{source}: files are read, not addresses; download it first")
        return open_asset(source, physics=physics) if physics else open_asset(source)
    if physics:
        raise InvalidError("physics= selects the variant of a file; source is an open stage")
    if isinstance(source, _tenon.Stage):
        return source
    flattened = getattr(source, "ExportToString", None)
    if flattened is None or not hasattr(source, "GetPseudoRoot"):
        raise TypeError(
            "source is a path, a tenon_usd.Stage or a pxr.Usd.Stage, not "
            f"{type(source).__name__}"
        )
    name = os.path.join(os.getcwd(), "stage-in-memory.usda")
    return open_asset(name, contents={name: flattened()})
