# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""add_usd(): the passes of an import, one after the other."""

from __future__ import annotations

import logging
import math
from typing import Any

from .. import _tenon
from .articulations import add_articulations, add_bases, add_loops, add_others
from .bodies import start_free_joints
from .filters import add_filters
from .importing import Importing, warn
from .masses import Masses
from .mimics import add_equalities, set_mimics
from .options import DEFORMABLE_KEYS, Options, Result, libraries, options_of, stage_of
from .poses import IDENTITY, Pose, compose, pose_of_transform, rotate, vector_of
from .prims import Prims, PrimView
from .refusals import refuse
from .resolvers import Resolvers
from .rows import add_rows, drive_joints
from .shapes import add_colliders
from .variants import advice, selections
from .visuals import add_static

logger = logging.getLogger(__name__)

#: newton:timeStepsPerSecond where nothing is authored.
STEPS_PER_SECOND = 1000


def add_usd(
    builder: Any, source: Any, *, physics: str = "", units: str = "stage", **options: Any
) -> Result:
    """Adds what a stage has to a newton.ModelBuilder, as builder.add_usd(source, **options) does.

    `source` is a path, a tenon_usd.Stage, or a pxr.Usd.Stage, which is read as it is now; `physics`
    selects the variant of the variant sets "Physics" of a path. `units`: "stage" converts lengths
    and masses by metersPerUnit and kilogramsPerUnit; "newton" takes them as they are, as Newton
    does. `options` are the arguments of newton.ModelBuilder.add_usd, with its names, meanings and
    defaults; root_path imports one subtree, a prototype to be replicated. The answer has its keys
    and "physics_variants", "advice".

    Warns with ImportedWarning, which names the prim, where Newton's model cannot hold what the
    asset says. Raises MissingError without Newton, TypeError for an unknown argument or another
    source, InvalidError (a ValueError) for a value that cannot be used, UnsupportedError, with the
    prim, for what is not imported, and what tenon_usd.open() raises.
    """
    given = options_of(options)
    builder._validate_base_joint_params(given.floating, given.base_joint, given.parent_body)
    stage = stage_of(source, physics, units)
    importing = _begin(builder, stage, given)
    refuse(importing)
    _tell_findings(importing)
    first_joint = builder.joint_count
    scene_attributes = _read_scene(importing)
    masses = Masses(importing)
    handled = add_articulations(importing)
    add_others(importing, handled)
    add_static(importing)
    colliders = add_colliders(importing, masses)
    masses.give()
    add_bases(importing)
    add_loops(importing, handled)
    add_filters(importing, colliders, first_joint)
    add_equalities(importing)
    collapsed, moved = _collapse(importing, scene_attributes)
    start_free_joints(importing)
    set_mimics(importing)
    result = _result(importing, stage, scene_attributes, collapsed, moved)
    add_rows(importing, result)
    drive_joints(importing)
    if given.verbose:
        logger.info("%s: %d bodies, %d joints, %d shapes", stage.path, len(importing.bodies),
                    len(importing.joints), len(importing.shapes))
    return result


def _begin(builder: Any, stage: _tenon.Stage, options: Options) -> Importing:
    taken = libraries()
    prims = Prims(stage, options.root_path, options.ignore_paths or ())
    resolvers = Resolvers(taken, options.schema_resolvers, builder)
    importing = Importing(builder, taken, options, prims, stage.physics(), resolvers)
    _tell_units(importing)
    importing.turn = _turn_up(importing)
    importing.incoming = importing.turn
    if options.xform is not None:
        placed = pose_of_transform(taken.warp.transform(*options.xform))
        importing.incoming = compose(placed, importing.turn)
    return importing


#: Findings that are told one by one.
MOST_FINDINGS = 50
#: A rule that does not hold here: resolvers read attributes whose schema is not applied, too.
NOT_TOLD = "attribute.api-missing"


def _tell_findings(importing: Importing) -> None:
    """What reading the physics found wrong on prims that are imported."""
    found = [
        each
        for each in importing.scene.diagnostics
        if each.severity != "info"
        and each.rule != NOT_TOLD
        and importing.prims.is_wanted(each.prim)
    ]
    for each in found[:MOST_FINDINGS]:
        warn(each.prim, f"{each.message} [{each.rule}]")
    if len(found) > MOST_FINDINGS:
        warn(importing.prims.stage.path, f"{len(found) - MOST_FINDINGS} findings more")


def _tell_units(importing: Importing) -> None:
    """Newton takes stages for metres and kilograms; here they are converted."""
    length, mass = importing.scene.meters_per_unit, importing.scene.kilograms_per_unit
    if length != 1.0 or mass != 1.0:
        warn(
            importing.prims.stage.path,
            f"metersPerUnit {length:g}, kilogramsPerUnit {mass:g} (0.01 and 1 where they are not "
            'authored): numbers are converted; units="newton" takes them as they are, as '
            "newton.ModelBuilder.add_usd does",
        )


def up_axis(importing: Importing) -> Any:
    """newton.Axis of the stage's up."""
    up = importing.scene.up.tolist()
    return getattr(importing.libraries.newton.Axis, "XYZ"[up.index(max(up))])


def _turn_up(importing: Importing) -> Pose:
    axis = up_axis(importing)
    if importing.options.apply_up_axis_from_stage:
        importing.builder.up_axis = axis
        return IDENTITY
    newton = importing.libraries.newton
    turn = newton.math.quat_between_axes(axis, importing.builder.up_axis)
    x, y, z, w = (float(each) for each in turn)
    return (0.0, 0.0, 0.0), (x, y, z, w)


def _scene_prim(prims: Prims) -> PrimView | None:
    for prim in prims:
        if prim.type_name == "PhysicsScene" and not prims.is_ignored(prim.path):
            return prim
    return None


def _read_scene(importing: Importing) -> dict[str, Any]:
    """Gravity, gains and custom attributes of the first scene; the values of its prim."""
    importing.gains_scale = importing.options.joint_drive_gains_scaling
    prim = importing.scene_prim = _scene_prim(importing.prims)
    if prim is None:
        return {}
    values = {name: prim.value(name) for name in prim.prim.properties
              if not isinstance(prim.value(name), list) or name in prim.names}
    scale = prim.authored("newton:joint_drive_gains_scaling")
    if scale is not None and math.isfinite(scale):
        importing.gains_scale = float(scale)
    _set_gravity(importing, prim)
    importing.resolvers.collect(prim)
    custom = importing.custom_values(prim, "ONCE", "WORLD")
    if not importing.options.parse_mujoco_options:
        custom = {key: each for key, each in custom.items() if not key.startswith("mujoco:")}
    for key, value in custom.items():
        importing.builder.custom_attributes[key].values[0] = value
    return {**values, **custom}


def _set_gravity(importing: Importing, prim: PrimView) -> None:
    builder, warp = importing.builder, importing.libraries.warp
    found = [each.gravity for each in importing.scene.scenes if each.path == prim.path]
    if not found:
        return
    place = importing.turn if importing.options.override_root_xform else importing.incoming
    vector = rotate(place[1], vector_of(found[0]))
    if not importing.resolvers.value(prim, "SCENE", "gravity_enabled", True):
        vector = (0.0, 0.0, 0.0)
    if builder.current_world >= 0:
        builder.world_gravity[builder.current_world] = warp.vec3(*vector)
    else:
        builder.gravity = warp.vec3(*vector)


def _collapse(
    importing: Importing, scene: dict[str, Any]
) -> tuple[dict[str, Any] | None, dict[str, Any]]:
    """Merges bodies that fixed joints tie, where that is asked for; numbers follow."""
    builder = importing.builder
    wanted = scene.get("newton:collapse_fixed_joints", importing.options.collapse_fixed_joints)
    if not wanted:
        return None, {}
    labels = list(builder.joint_label)
    made: dict[str, Any] = builder.collapse_fixed_joints()
    remap, parents = made["body_remap"], made["body_merged_parent"]
    moved = {}
    for path, body in importing.bodies.items():
        if body in remap:
            importing.bodies[path] = remap[body]
        elif body in parents:
            moved[path] = made["body_merged_transform"][body]
            importing.bodies[path] = remap.get(parents[body], parents[body])
    numbers = {label: number for number, label in enumerate(builder.joint_label)}
    kept = {path: numbers[labels[joint]] for path, joint in importing.joints.items()
            if labels[joint] in numbers}
    importing.joints.clear()
    importing.joints.update({**numbers, **kept})
    return made, moved


def _result(
    importing: Importing,
    stage: _tenon.Stage,
    scene: dict[str, Any],
    collapsed: dict[str, Any] | None,
    moved: dict[str, Any],
) -> Result:
    prim, resolvers = importing.scene_prim, importing.resolvers
    step = iterations = None
    if prim is not None:
        rate = resolvers.value(prim, "SCENE", "time_steps_per_second", STEPS_PER_SECOND)
        step = 1.0 / rate if rate > 0 else 1.0 / STEPS_PER_SECOND
        iterations = resolvers.value(prim, "SCENE", "max_solver_iterations")
    start, end = (stage.metadata(name) or 0.0 for name in ("startTimeCode", "endTimeCode"))
    variants = selections(importing.prims)
    result: Result = {
        "fps": _number(stage.metadata("framesPerSecond"), 24.0),
        "duration": _number(end, 0.0) - _number(start, 0.0),
        "up_axis": up_axis(importing),
        "path_body_map": importing.bodies,
        "path_joint_map": importing.joints,
        "path_shape_map": importing.shapes,
        "path_shape_scale": importing.shape_scales,
        "path_particle_map": {},
        "mass_unit": importing.scene.kilograms_per_unit,
        "linear_unit": importing.scene.meters_per_unit,
        "scene_attributes": scene,
        "physics_scene_path": None if prim is None else prim.path,
        "physics_dt": step,
        "collapse_results": collapsed,
        "schema_attrs": resolvers.attributes,
        "path_body_relative_transform": moved,
        "max_solver_iterations": iterations,
        "particle_scene_path": None,
        "actuator_count": 0,
        "physics_variants": variants,
        "advice": advice(importing, variants),
    }
    if importing.options.return_deformable_results:
        for key in DEFORMABLE_KEYS:
            result[key] = {}  # type: ignore[literal-required]
    return result


def _number(value: object, default: float) -> float:
    return float(value) if isinstance(value, (int, float)) else default
