# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What rows of a plan name: signals that are measured, and numbers that vary, found in a World of
one environment. SI and radians, axes of the world."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..world import World

AXES = {"x": 0, "y": 1, "z": 2}
#: Signals of a body, without the axis that some have.
OF_BODIES = ("position", "speed", "velocity", "angularSpeed", "angularVelocity", "contactForce")
OF_JOINTS = ("jointPosition", "jointVelocity", "driveEffort")
OF_ALL = ("energy", "kineticEnergy", "potentialEnergy", "contactCount", "contactForce")
#: Numbers of a running model, and where their values are in the scene.
PARAMETERS = {
    "bodyMass": ("bodies", "mass"),
    "colliderFriction": ("colliders", "dynamic_friction"),
    "driveStiffness": ("drives", "stiffness"),
    "driveDamping": ("drives", "damping"),
    "driveMaxForce": ("drives", "max_force"),
    "jointDamping": ("joints", "damping"),
    "jointFriction": ("joints", "friction"),
    "jointArmature": ("joints", "armature"),
}
UNLIMITED = 1e300


class UnknownName(LookupError):
    """A signal or a number that there is not, or an object that the asset has not."""


#: What _tenon.Batch.read() and record() are asked for: a name, the number of the body, joint
#: coordinate or drive (0 where there is none), and an axis from 0.
Signal = tuple[str, int, int]


def outputs_of(signals: Sequence[str]) -> list[str]:
    """The outputs of a World that these signals need."""
    names = {signal.partition("@")[0] for signal in signals}
    return [output for output, name in (("contacts", "contactForce"), ("efforts", "driveEffort"))
            if name in names]


def _at(names: Sequence[str], path: str, what: str) -> int:
    if path in names:
        return list(names).index(path)
    shown = ", ".join(names[:10]) + (" ..." if len(names) > 10 else "")
    raise UnknownName(f"there is no {what} {path!r}; there are {shown or 'none'}")


def _axis(name: str, axis: str) -> int:
    if axis not in AXES:
        raise UnknownName(f"{name} has an axis: {name}.x, {name}.y or {name}.z")
    return AXES[axis]


def _of_body(name: str, axis: str, body: int) -> Signal:
    if name in ("position", "velocity", "angularVelocity"):
        return name, body, _axis(name, axis)
    if axis:
        raise UnknownName(f"{name} has no axis")
    return name, body, 0


def find_signal(text: str, world: World) -> Signal:
    """The signal that a metric names: "position.z@/World/can", "jointPosition@/hand/joint",
    "energy". Errors: UnknownName."""
    name, _, path = text.partition("@")
    name, _, axis = name.partition(".")
    if not path and not axis and name in OF_ALL:
        return "contactForceOfAll" if name == "contactForce" else name, 0, 0
    if name in OF_BODIES and path:
        return _of_body(name, axis, _at(world.body_names, path, "body"))
    if name in OF_JOINTS and path and not axis:
        if name == "driveEffort":
            return name, _at(world.drive_names, path, "drive"), 0
        return name, _at(world.joint_names, path, "joint"), 0
    raise UnknownName(f"there is no signal {text!r}; there are " + ", ".join(
        [*(f"{each}@BODY" for each in OF_BODIES), *(f"{each}@JOINT" for each in OF_JOINTS),
         *OF_ALL]))


# ---- numbers that vary

#: Gives a world one value of a case.
Setter = Callable[[World, float], None]
Entry = tuple[int, int, float]  # object, part of it, value in the asset


def _drives(scene: Any, path: str, field: str) -> list[Entry]:
    return [(j, d, float(getattr(drive, field))) for j, joint in enumerate(scene.joints)
            for d, drive in enumerate(joint.drives) if path in ("", joint.path)]


def _frictions(scene: Any, path: str) -> list[Entry]:
    def friction(collider: Any) -> float:
        material = collider.material
        return float((scene.unbound if material is None else scene.materials[material])
                     .dynamic_friction)
    return [(c, 0, friction(collider)) for c, collider in enumerate(scene.colliders)
            if path in ("", collider.path)]


def _entries(name: str, path: str, scene: Any) -> list[Entry]:
    """Which numbers of the scene are meant. As with `tenon bench --vary`, what is zero or unlimited
    of joints and drives is passed over, and bodies that are moved by hand."""
    where, field = PARAMETERS[name]
    if where == "drives":
        found = _drives(scene, path, field)
    elif where == "colliders":
        return _frictions(scene, path)
    else:
        objects = getattr(scene, where)
        found = [(i, 0, float(getattr(each, field))) for i, each in enumerate(objects)
                 if each.path == path or (path == "" and not getattr(each, "kinematic", False))]
        if where == "bodies":
            return found
    return [entry for entry in found if path or 0 < entry[2] < UNLIMITED]


def _parameter(kind: str, name: str, path: str, world: World) -> Setter:
    entries = _entries(name, path, world.scene)
    if kind == "scale":
        entries = [entry for entry in entries if 0 < entry[2] < UNLIMITED]
    if not entries:
        raise UnknownName(f"nothing {f'at {path!r}' if path else 'of the asset'} has a {name}"
                          + (" that a factor changes" if kind == "scale" else ""))

    def put(world: World, value: float) -> None:
        for index, part, own in entries:
            number = own * value if kind == "scale" else value
            world._batch.set_parameter(name, index, part, np.array([number]))
    return put


def _gravity(kind: str, world: World) -> Setter:
    own = world.gravity
    length = math.sqrt(float((own[0] @ own[0])))
    if length == 0:
        raise UnknownName("the asset has no gravity whose direction could be kept")

    def put(world: World, value: float) -> None:
        world.gravity = own * (value if kind == "scale" else value / length)
    return put


def _start_joint(path: str, world: World) -> Setter:
    at = _at(world.joint_names, path, "joint")

    def put(world: World, value: float) -> None:
        positions, _ = world.joints()
        positions[0, at] = value
        world.set_joints(positions=positions)
    return put


def _start_body(path: str, axis: str, world: World) -> Setter:
    body, part = _at(world.body_names, path, "body"), _axis("bodyPosition", axis)

    def put(world: World, value: float) -> None:
        poses, velocities = world._batch.body_states()
        pose, velocity = poses[:, body].copy(), velocities[:, body].copy()
        pose[0, part] = value
        world._batch.set_body(body, pose, velocity)
    return put


def _target(path: str, world: World) -> Setter:
    drive = _at(world.drive_names, path, "drive")
    drives = [each for joint in world.scene.joints for each in joint.drives]
    velocities = np.array([[float(each.target_velocity) for each in drives]])

    def put(world: World, value: float) -> None:
        targets = np.full_like(velocities, np.nan)  # the others are left alone
        targets[0, drive] = value
        world._batch.set_targets(targets, velocities)
    return put


def find_setter(kind: str, target: str, world: World) -> Setter:
    """What gives a world a value of a row that needs no model of its own. Errors: UnknownName."""
    if kind == "target":
        return _target(target, world)
    name, _, path = target.partition("@")
    if name in PARAMETERS:
        return _parameter(kind, name, path, world)
    if name == "gravity" and not path:
        return _gravity(kind, world)
    if kind == "value" and path:
        name, _, axis = name.partition(".")
        if name == "jointPosition" and not axis:
            return _start_joint(path, world)
        if name == "bodyPosition":
            return _start_body(path, axis, world)
    raise UnknownName(f"there is no number {target!r} for {kind}; there are "
                      + ", ".join([*PARAMETERS, "gravity"])
                      + ", and as values jointPosition@JOINT and bodyPosition.x@BODY")
