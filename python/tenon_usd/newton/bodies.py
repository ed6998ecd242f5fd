# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Rigid bodies into the builder, with the visuals and sites below each of them."""

from __future__ import annotations

import math

from .importing import Importing
from .poses import Pose, rotate, vector_of
from .visuals import add_below


def add_body(importing: Importing, path: str, root: Pose | None = None) -> int:
    """Adds a body of the description; `root`: the pose that its place is seen from, instead of
    the world. -1 where it is disabled and such bodies are left out."""
    body = importing.scene.bodies[importing.body_numbers[path]]
    if not body.enabled and importing.options.only_load_enabled_rigid_bodies:
        return -1
    builder, warp = importing.builder, importing.libraries.warp
    pose = importing.place(importing.body_pose(importing.body_numbers[path]), root)
    prim = importing.prims.get(path)
    number: int = builder.add_link(
        xform=importing.transform(pose),
        label=path,
        is_kinematic=body.kinematic,
        custom_attributes=importing.custom_values(prim, "BODY") if prim is not None else {},
    )
    turn = importing.incoming[1]
    linear = rotate(turn, vector_of(body.linear_velocity))
    angular = rotate(turn, vector_of(body.angular_velocity))
    builder.body_qd[number] = warp.spatial_vector(*linear, *angular)
    importing.bodies[path] = number
    if prim is not None:
        add_below(importing, prim, number, pose, root)
    return number


def start_free_joints(importing: Importing) -> None:
    """Velocities of free joints are those of their bodies, along the axes of the parent's frame."""
    builder = importing.builder
    free = importing.libraries.newton.JointType.FREE
    imported = set(importing.bodies.values())
    for joint, kind in enumerate(builder.joint_type):
        child = builder.joint_child[joint]
        if kind != free or child not in imported:
            continue
        twist = [float(number) for number in builder.body_qd[child]]
        if not any(twist) or not all(map(math.isfinite, twist)):
            continue
        turn = importing.libraries.warp.transform_get_rotation(builder.joint_X_p[joint])
        back = (-float(turn[0]), -float(turn[1]), -float(turn[2]), float(turn[3]))
        start = builder.joint_qd_start[joint]
        builder.joint_qd[start : start + 6] = [
            *rotate(back, vector_of(twist[:3])),
            *rotate(back, vector_of(twist[3:])),
        ]
