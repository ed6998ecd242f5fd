# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Joints that follow others, and equality constraints of MuJoCo."""

from __future__ import annotations

import importlib
from typing import Any

from ..errors import UnsupportedError
from .articulations import EQUALITIES, is_equality, joint_key
from .importing import Importing, warn
from .joint_values import DEGREE
from .joints import ends
from .poses import Pose, conjugate, multiply, pose_of
from .prims import PrimView

OF_MUJOCO = "MjcEqualityJointAPI"


def _mujoco(part: str) -> Any:
    """A part of Newton's that builds MuJoCo's constraints, which has no public name."""
    try:
        return importlib.import_module(f"newton._src.solvers.mujoco.{part}")
    except ImportError as reason:
        raise UnsupportedError(
            f"equality constraints of MuJoCo, with this Newton: {reason}"
        ) from None


def add_equalities(importing: Importing) -> None:
    """Adds what MjcEquality*API author: rows for SolverMuJoCo, and joints or mimics of Newton in
    their place, without which (convert_mjc_equality_constraints=False) the rows stand alone."""
    ordered = sorted(importing.joint_numbers, key=lambda path: joint_key(importing, path))
    wanted = [path for path in ordered if _is_equality(importing, path)]
    if not wanted:
        return
    _mujoco("equality")._register_equality_constraint_attributes(importing.builder)
    for path in wanted:
        joint = importing.scene.joints[importing.joint_numbers[path]]
        if not joint.enabled and importing.options.only_load_enabled_joints:
            continue
        prim = importing.prims[path]
        custom = importing.custom_values(prim, "mujoco:equality_constraint")
        if is_equality(prim):
            importing.resolvers.collect(prim)
            _add_loop(importing, joint, prim.HasAPI(EQUALITIES[1]), custom)
        else:
            _add_coupling(importing, joint, custom)


def _is_equality(importing: Importing, path: str) -> bool:
    prim = importing.prims[path]
    return is_equality(prim) or prim.HasAPI(OF_MUJOCO)


def _frame(importing: Importing, joint: Any, side: int) -> Pose:
    """Of one side of a joint; in the world as it is authored: the description puts a fixed joint
    where its body is."""
    prim = importing.prims[joint.path]
    body, target = ((joint.body0, joint.target0), (joint.body1, joint.target1))[side]
    place, turn = (prim.authored(f"physics:local{what}{side}") for what in ("Pos", "Rot"))
    if body is None and not target and place is not None:
        m = importing.scene.meters_per_unit
        return pose_of([each * m for each in place], turn or (1.0, 0.0, 0.0, 0.0))
    if side:
        return pose_of(joint.frame1_position, joint.frame1_orientation)
    return pose_of(joint.frame0_position, joint.frame0_orientation)


def _loop_frames(importing: Importing, joint: Any, weld: bool) -> tuple[Any, Pose | None]:
    """The anchor, in body0 or of a weld in body1, and where a weld holds body1 in body0."""
    frame0 = _frame(importing, joint, 0)
    if not weld:
        return frame0[0], None
    frame1 = _frame(importing, joint, 1)
    return frame1[0], (frame0[0], multiply(frame0[1], conjugate(frame1[1])))


def _add_loop(importing: Importing, joint: Any, weld: bool, custom: dict[str, Any]) -> None:
    kinds = _mujoco("enums").EqType
    warp, builder = importing.libraries.warp, importing.builder
    paths = importing.body_paths
    body1, body2 = (
        -1 if each is None else importing.bodies.get(paths[each], -1)
        for each in (joint.body0, joint.body1)
    )
    if ends(importing, joint, importing.bodies)[1] == -1:
        warn(joint.path, "an equality constraint between nothing that is imported")
        return
    anchor, held = _loop_frames(importing, joint, weld)
    torque = importing.prims[joint.path].authored("mjc:torqueScale")
    relpose = None if held is None else importing.transform(held)
    kind = kinds.WELD if weld else kinds.CONNECT
    scale = (1.0 if torque is None else float(torque)) if weld else 0.0
    if importing.options.convert_mjc_equality_constraints:
        _, number = _mujoco("utils").mjc_add_equality_loop_joint(
            builder, kind, body1, body2, warp.vec3(*anchor), relpose, scale, joint.path,
            joint.enabled, custom, world_xform=importing.transform(importing.incoming),
        )
        importing.joints[joint.path] = number
        return
    more = {"relpose": relpose, "torquescale": scale} if weld else {}
    _mujoco("equality")._add_equality_constraint(
        builder, constraint_type=kind, body1=body1, body2=body2, anchor=warp.vec3(*anchor),
        label=joint.path, enabled=joint.enabled, custom_attributes=custom, **more,
    )


def _add_coupling(importing: Importing, joint: Any, custom: dict[str, Any]) -> None:
    """A joint that follows another one by a polynomial."""
    prim = importing.prims[joint.path]
    targets = prim.targets("newton:mimicJoint") or prim.targets("mjc:target")
    number = importing.joints.get(joint.path)
    leader = importing.joints.get(targets[0]) if targets else None
    if number is None or leader is None:
        warn(joint.path, "MjcEqualityJointAPI without a joint to follow that is imported")
        return
    terms = _terms(joint, prim)
    enabled = joint.enabled and prim.authored("newton:mimicEnabled") is not False
    if not importing.options.convert_mjc_equality_constraints:
        _mujoco("equality")._add_equality_constraint(
            importing.builder, constraint_type=_mujoco("enums").EqType.JOINT, joint1=number,
            joint2=leader, polycoef=terms, label=joint.path, enabled=enabled,
            custom_attributes=custom,
        )
        return
    if any(terms[2:]):
        warn(joint.path, "higher powers of the leader: only SolverMuJoCo has them")
    _mujoco("utils").mjc_add_equality_mimic(
        importing.builder, number, leader, terms, joint.path, enabled, custom
    )


def _terms(joint: Any, prim: PrimView) -> list[float]:
    """Coefficients of powers of the leader [rad or m], also of what is switched off, which the
    description does not have."""
    mimic = next((each for each in joint.mimics if each.schema == OF_MUJOCO), None)
    if mimic is not None:
        return [mimic.offset, mimic.multiplier, *mimic.higher.tolist()]
    offset = prim.authored("newton:mimicCoef0")
    if offset is None:
        offset = prim.authored("mjc:coef0") or 0.0
    elif joint.type == "revolute":
        offset *= DEGREE
    first = prim.authored("newton:mimicCoef1")
    if first is None:
        first = prim.authored("mjc:coef1")
    higher = [prim.authored(f"mjc:coef{power}") or 0.0 for power in (2, 3, 4)]
    return [float(offset), 1.0 if first is None else float(first), *map(float, higher)]


def set_mimics(importing: Importing) -> None:
    """Ties joints to the ones that they follow, by Newton's or by PhysX's schema. A joint that
    follows a follower follows that one's leader: Newton has no chains."""
    joints = importing.scene.joints
    for path, number in importing.joints.items():
        at = importing.joint_numbers.get(path)
        if at is None or importing.prims[path].HasAPI(OF_MUJOCO):
            continue
        for mimic in joints[at].mimics:
            offset, multiplier, first = _resolved(joints, mimic, path)
            leader = importing.joints.get(joints[first].path)
            if leader is None:
                warn(path, f"{mimic.schema}: the joint that it follows is not imported")
                continue
            if mimic.natural_frequency or mimic.damping_ratio:
                warn(path, f"{mimic.schema}: its compliance; joints of Newton follow rigidly")
            importing.builder.set_joint_mimic(
                joint=number, reference_joint=leader, coeffs=(offset, multiplier)
            )


def _resolved(joints: Any, mimic: Any, path: str) -> tuple[float, float, int]:
    """Offset, multiplier and the joint at the end of a chain of followers."""
    offset, multiplier, leader = mimic.offset, mimic.multiplier, mimic.leader
    for _ in range(len(joints)):
        above = [
            each
            for each in joints[leader].mimics
            if each.dof == mimic.leader_dof and each.schema != OF_MUJOCO
        ]
        if not above:
            return offset, multiplier, leader
        mimic = above[0]
        offset, multiplier = offset + multiplier * mimic.offset, multiplier * mimic.multiplier
        leader = mimic.leader
    raise UnsupportedError(f"{path}: joints that follow each other in a circle")
