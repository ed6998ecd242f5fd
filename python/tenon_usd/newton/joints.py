# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Joints of the description into the builder, one by one or several as one."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..errors import UnsupportedError
from .importing import Importing, warn
from .joint_values import (
    ANGULAR,
    AXES,
    SPRING_KEYS,
    DofValues,
    damping_of,
    limit_gains,
    one_dof,
    solref_values,
    state_of,
    target_arguments,
)
from .poses import (
    NEAR,
    Pose,
    Quaternion,
    compose,
    conjugate,
    is_identity,
    multiply,
    pose_of,
    rotate,
)
from .prims import PrimView

#: Joints between the same two bodies that become one joint with several degrees of freedom.
MERGED_TYPES = ("revolute", "prismatic")


def ends(importing: Importing, joint: Any, among: Mapping[str, int]) -> tuple[int, int, bool]:
    """Numbers of parent and child in `among`, -1 for the world, and whether body0 is the child.
    Both are -1 where neither end is in it."""
    paths = importing.body_paths
    parent = -1 if joint.body0 is None else among.get(paths[joint.body0], -1)
    child = -1 if joint.body1 is None else among.get(paths[joint.body1], -1)
    return (child, parent, True) if child == -1 else (parent, child, False)


def frames(joint: Any, swapped: bool) -> tuple[Pose, Pose]:
    """Where the joint is in its parent and in its child, or in the world [m]."""
    frame0 = pose_of(joint.frame0_position, joint.frame0_orientation)
    frame1 = pose_of(joint.frame1_position, joint.frame1_orientation)
    return (frame1, frame0) if swapped else (frame0, frame1)


def world_frame(importing: Importing, joint: Any, among: Mapping[str, int], own: bool) -> Pose:
    """Of a joint to the world: its frame there. Where the asset leaves it at the origin, and with
    `own` always, it is where the child's frame is, as Newton has it: the joint starts at zero."""
    _, _, swapped = ends(importing, joint, among)
    parent, child = frames(joint, swapped)
    if not own and not is_identity(parent):
        return parent
    number = joint.body0 if swapped else joint.body1
    return compose(importing.body_pose(number), child)


def add_joint(
    importing: Importing, path: str, world: Pose | None = None, incoming: Pose | None = None
) -> int | None:
    """Adds a joint of the description. `world`: its frame in the world, in place of the asset's;
    `incoming`: what the world of the builder is to it. None where it is switched off."""
    joint = importing.scene.joints[importing.joint_numbers[path]]
    if not joint.enabled and importing.options.only_load_enabled_joints:
        return None
    prim = importing.prims[path]
    importing.resolvers.collect(prim)
    _tell_breaks(joint)
    arguments = _common(importing, joint, world, incoming)
    number = _MAKERS[joint.type](importing, joint, prim, arguments)
    importing.joints[path] = number
    return number


def _common(
    importing: Importing, joint: Any, world: Pose | None, incoming: Pose | None
) -> dict[str, Any]:
    parent, child, swapped = ends(importing, joint, importing.bodies)
    parent_frame, child_frame = frames(joint, swapped)
    if world is not None:
        parent_frame = world
    if incoming is not None:
        parent_frame = compose(incoming, parent_frame)
    return {
        "parent": parent,
        "child": child,
        "parent_xform": importing.transform(parent_frame),
        "child_xform": importing.transform(child_frame),
        "label": joint.path,
        "collision_filter_parent": parent != -1 and not joint.collision_enabled,
        "enabled": joint.enabled,
    }


def _tell_breaks(joint: Any) -> None:
    if math.isfinite(joint.break_force) or math.isfinite(joint.break_torque):
        warn(joint.path, "physics:breakForce and breakTorque: joints of Newton do not break")


def _fixed(importing: Importing, joint: Any, prim: PrimView, arguments: dict[str, Any]) -> int:
    custom = importing.custom_values(prim, "JOINT", "JOINT_DOF", "JOINT_COORD")
    number: int = importing.builder.add_joint_fixed(**arguments, custom_attributes=custom)
    return number


def _turning_or_sliding(
    importing: Importing, joint: Any, prim: PrimView, arguments: dict[str, Any]
) -> int:
    builder = importing.builder
    values = one_dof(importing, joint, prim)
    axis = getattr(importing.libraries.newton.Axis, joint.axis)
    add = builder.add_joint_revolute if joint.type == "revolute" else builder.add_joint_prismatic
    number: int = add(
        **arguments, axis=axis, **values.arguments, custom_attributes=values.custom
    )
    _start(importing, number, 0, values)
    return number


def _start(importing: Importing, joint: int, dof: int, values: DofValues) -> None:
    builder = importing.builder
    if values.position is not None:
        builder.joint_q[builder.joint_q_start[joint] + dof] = values.position
    if values.velocity is not None:
        builder.joint_qd[builder.joint_qd_start[joint] + dof] = values.velocity


def _passive(importing: Importing, prim: PrimView, custom: dict[str, Any]) -> dict[str, Any]:
    """Armature, friction and spring of joints with several degrees of freedom."""
    resolvers, config = importing.resolvers, importing.builder.default_joint_cfg
    stiffness, _ = (custom.pop(key, None) for key in SPRING_KEYS)
    default = config.stiffness if stiffness is None else stiffness
    return {
        "armature": resolvers.value(prim, "JOINT", "armature", config.armature),
        "friction": resolvers.value(prim, "JOINT", "friction", config.friction),
        "stiffness": resolvers.value(prim, "JOINT", "stiffness", default),
    }


def _ball(importing: Importing, joint: Any, prim: PrimView, arguments: dict[str, Any]) -> int:
    if math.isfinite(joint.cone_angle0) or math.isfinite(joint.cone_angle1):
        warn(joint.path, "physics:coneAngle0Limit, coneAngle1Limit: balls of Newton have no cone")
    custom = importing.custom_values(prim, "JOINT", "JOINT_DOF", "JOINT_COORD")
    passive = _passive(importing, prim, custom)
    _, damping = damping_of(importing, prim)
    number: int = importing.builder.add_joint_ball(
        **arguments, **passive, damping=damping, custom_attributes=custom
    )
    return number


def _distance(importing: Importing, joint: Any, prim: PrimView, arguments: dict[str, Any]) -> int:
    custom = importing.custom_values(prim, "JOINT", "JOINT_DOF", "JOINT_COORD")
    number: int = importing.builder.add_joint_distance(
        **arguments,
        min_distance=joint.lower if math.isfinite(joint.lower) else -1.0,
        max_distance=joint.upper if math.isfinite(joint.upper) else -1.0,
        custom_attributes=custom,
    )
    return number


def _free_axes(joint: Any) -> list[tuple[str, float, float]]:
    """Degrees of freedom of a D6 joint and their bounds: all that no limit locks."""
    bounds = {limit.dof: (limit.lower, limit.upper) for limit in joint.limits}
    made = [(dof, *bounds.get(dof, (-math.inf, math.inf))) for dof in AXES]
    return [each for each in made if each[1] < each[2]]


def _d6(importing: Importing, joint: Any, prim: PrimView, arguments: dict[str, Any]) -> int:
    if any(limit.dof == "distance" for limit in joint.limits):
        raise UnsupportedError(f"{joint.path}: a D6 joint that limits a distance")
    builder, resolvers = importing.builder, importing.resolvers
    custom = importing.custom_values(prim, "JOINT", "JOINT_DOF", "JOINT_COORD")
    for key, name in (("dof_ref", "mjc:ref"), ("dof_springref", "mjc:springref")):
        if custom.pop(f"mujoco:{key}", None) is not None:
            warn(joint.path, f"{name}: D6 joints count from zero")
    passive = _passive(importing, prim, custom)
    damping = damping_of(importing, prim)
    speed = resolvers.value(prim, "JOINT", "velocity_limit")
    made: list[tuple[str, Any, DofValues]] = []
    gains = []
    for dof, lower, upper in _free_axes(joint):
        angular = dof in ANGULAR
        unit = math.pi / 180 if angular else 1.0
        of_limit = limit_gains(importing, prim, f"limit_{dof}", angular)
        gains.append(of_limit)
        values = {
            "axis": AXES[dof], "limit_lower": lower, "limit_upper": upper,
            "limit_ke": of_limit[0], "limit_kd": of_limit[1], "damping": damping[angular],
            "velocity_limit": builder.default_joint_cfg.velocity_limit,
            "effort_limit": math.inf, **passive,
        }
        if speed is not None and math.isfinite(speed):
            values["velocity_limit"] = float(speed) * unit
        values.update(target_arguments(importing, joint, prim, dof, alone=False))
        config = importing.libraries.newton.ModelBuilder.JointDofConfig(**values)
        made.append((dof, config, DofValues(values, *state_of(importing, prim, dof, unit))))
    custom.update(solref_values(importing, gains))
    number: int = builder.add_joint_d6(
        **arguments,
        linear_axes=[config for dof, config, _ in made if dof not in ANGULAR],
        angular_axes=[config for dof, config, _ in made if dof in ANGULAR],
        custom_attributes=custom,
    )
    for at, (_, _, values_of) in enumerate(made):
        _start(importing, number, at, values_of)
    return number


_MAKERS: dict[str, Callable[[Importing, Any, PrimView, dict[str, Any]], int]] = {
    "fixed": _fixed,
    "revolute": _turning_or_sliding,
    "prismatic": _turning_or_sliding,
    "spherical": _ball,
    "distance": _distance,
    "d6": _d6,
}


def _axis_in(joint: Any, swapped: bool, first: Quaternion) -> tuple[float, float, float]:
    """The axis of a joint in the frame of the first one of its group."""
    own = frames(joint, swapped)[0][1]
    axis = AXES[f"rot{joint.axis}"]
    if abs(sum(a * b for a, b in zip(own, first, strict=True))) > 1 - NEAR:
        return axis
    return rotate(multiply(conjugate(first), own), axis)


def add_merged(
    importing: Importing,
    paths: Sequence[str],
    world: Pose | None = None,
    incoming: Pose | None = None,
) -> int | None:
    """Adds revolute and prismatic joints between the same two bodies as one joint, sliding before
    turning; the frame is that of the first one. None where all are switched off."""
    joints = [importing.scene.joints[importing.joint_numbers[path]] for path in paths]
    if importing.options.only_load_enabled_joints:
        joints = [joint for joint in joints if joint.enabled]
    if not joints:
        return None
    builder, first = importing.builder, joints[0]
    for joint in joints:
        if joint.type not in MERGED_TYPES:
            raise UnsupportedError(
                f"{joint.path}: a {joint.type} joint between the bodies of another joint"
            )
    _, _, swapped = ends(importing, first, importing.bodies)
    _tell_anchors(joints, swapped)
    joints.sort(key=lambda joint: joint.type == "revolute")
    made = []
    for joint in joints:
        prim = importing.prims[joint.path]
        importing.resolvers.collect(prim)
        values = one_dof(importing, joint, prim)
        values.arguments.setdefault("effort_limit", math.inf)
        axis = _axis_in(joint, swapped, frames(first, swapped)[0][1])
        config = importing.libraries.newton.ModelBuilder.JointDofConfig(
            axis=axis, **values.arguments
        )
        made.append((joint, config, values))
    arguments = _common(importing, first, world, incoming)
    arguments["collision_filter_parent"] = arguments["parent"] != -1 and not all(
        joint.collision_enabled for joint in joints
    )
    custom = _merged_custom(importing, first, made)
    number: int = builder.add_joint_d6(
        **arguments,
        linear_axes=[each[1] for each in made if each[0].type == "prismatic"] or None,
        angular_axes=[each[1] for each in made if each[0].type == "revolute"] or None,
        custom_attributes=custom,
    )
    for at, (joint, _, values) in enumerate(made):
        importing.joints[joint.path] = number
        importing.merged_dofs[joint.path] = at
        _start(importing, number, at, values)
    return number


def _tell_anchors(joints: Sequence[Any], swapped: bool) -> None:
    first = frames(joints[0], swapped)
    for joint in joints[1:]:
        for one, other in zip(frames(joint, swapped), first, strict=True):
            if max(abs(a - b) for a, b in zip(one[0], other[0], strict=True)) > NEAR:
                warn(joint.path, f"merged with {joints[0].path}, whose anchor is another one")
                return


def _merged_custom(
    importing: Importing, first: Any, made: Sequence[tuple[Any, Any, DofValues]]
) -> dict[str, Any]:
    """Custom attributes: those of the joint are the first one's, the others each its own."""
    custom = importing.custom_values(importing.prims[first.path], "JOINT")
    whole = set(custom)
    for at, (_, _, values) in enumerate(made):
        for key, value in values.custom.items():
            if key not in whole:
                custom.setdefault(key, {})[at] = value
    if "mujoco:joint_dof_label" in importing.builder.custom_attributes:
        custom["mujoco:joint_dof_label"] = [joint.path for joint, _, _ in made]
    return custom
