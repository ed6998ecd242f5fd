# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The degrees of freedom of an asset, as logs and trajectories name them, with what limits them."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .._tenon import Drive, Joint, PhysicsScene

INFINITE = math.inf


@dataclasses.dataclass(frozen=True)
class AssetJoint:
    """One degree of freedom of a joint [SI, rad]; numbers of the drive are 0 where there is none,
    limits infinite."""

    name: str
    """As Log.joints has it: the path, with ":rotX" behind it where the joint has several."""
    path: str
    dof: str
    """"transX" to "transZ", "rotX" to "rotZ"."""
    rotates: bool
    """It turns (rad, N m); else it slides (m, N)."""
    lower: float = -INFINITE
    """rad or m."""
    upper: float = INFINITE
    """rad or m."""
    velocity_limit: float = INFINITE
    """rad/s or m/s, the least of joint and drive."""
    effort_limit: float = INFINITE
    """N m or N, of the drive."""
    stiffness: float = 0.0
    """Of the drive: N m/rad or N/m; 1/s^2 where it is of the type acceleration."""
    damping: float = 0.0
    """Of the drive: N m s/rad or N s/m; 1/s where it is of the type acceleration."""
    is_acceleration: bool = False
    """The gains of the drive are per unit of inertia."""
    friction: float = 0.0
    """Coulomb friction [N m or N]."""
    armature: float = 0.0
    """kg m^2 or kg."""
    passive_damping: float = 0.0
    """Of the joint itself: N m s/rad or N s/m."""
    has_drive: bool = False
    leader: str = ""
    """Name of the one that it follows by a mimic law; empty: it is free."""
    several: bool = False
    """The joint has other degrees of freedom beside this one."""

    @property
    def short(self) -> str:
        """The name of the prim, with the degree of freedom where there are several."""
        return self.name.rpartition("/")[2]

    @property
    def span(self) -> float:
        """From the lower to the upper limit [rad or m]; infinite where one is missing."""
        return self.upper - self.lower

    @property
    def unit(self) -> str:
        """Of its position: "rad" or "m"."""
        return "rad" if self.rotates else "m"


def asset_joints(scene: PhysicsScene) -> tuple[AssetJoint, ...]:
    """All degrees of freedom of a scene's joints, in the order of Dynamics.coordinates.

    Joints that close loops, and what floats, have none. Raises nothing.
    """
    from ..dynamics import Dynamics

    coordinates = [each for each in Dynamics(scene).coordinates if each.joint is not None]
    counts: dict[str, int] = {}
    for each in coordinates:
        counts[str(each.joint)] = counts.get(str(each.joint), 0) + 1
    by_path = {joint.path: joint for joint in scene.joints}
    paths = [joint.path for joint in scene.joints]
    return tuple(_one(by_path[str(each.joint)], each.dof, counts, paths) for each in coordinates)


def _named(path: str, dof: str, counts: dict[str, int]) -> str:
    return f"{path}:{dof}" if counts.get(path, 1) > 1 else path


def _bounds(joint: Joint, dof: str) -> tuple[float, float]:
    for limit in joint.limits:
        if limit.dof == dof:
            return _finite(limit.lower, -INFINITE), _finite(limit.upper, INFINITE)
    if joint.type in ("spherical", "d6"):
        return -INFINITE, INFINITE
    return _finite(joint.lower, -INFINITE), _finite(joint.upper, INFINITE)


def _finite(value: float | None, otherwise: float) -> float:
    return otherwise if value is None else float(value)


def _drive(joint: Joint, dof: str, several: bool) -> Drive | None:
    for drive in joint.drives:
        if drive.dof == dof or not several:
            return drive
    return None


def _one(joint: Joint, dof: str, counts: dict[str, int], paths: list[str]) -> AssetJoint:
    several = counts[joint.path] > 1
    lower, upper = _bounds(joint, dof)
    drive = _drive(joint, dof, several)
    speed = _finite(joint.velocity_limit, INFINITE)
    if drive is not None:
        speed = min(speed, _finite(drive.max_velocity, INFINITE))
    leader = ""
    for mimic in joint.mimics:
        if mimic.dof == dof or not several:
            leader = _named(paths[mimic.leader], mimic.leader_dof, counts)
    return AssetJoint(
        _named(joint.path, dof, counts), joint.path, dof, dof.startswith("rot"), lower, upper,
        speed, INFINITE if drive is None else _finite(drive.max_force, INFINITE),
        0.0 if drive is None else drive.stiffness, 0.0 if drive is None else drive.damping,
        drive is not None and bool(drive.type), joint.friction, joint.armature, joint.damping,
        drive is not None, leader, several)


def find_joint(name: str, joints: tuple[AssetJoint, ...]) -> AssetJoint | None:
    """The one of that path or name; None where none or several have it."""
    exact = [joint for joint in joints if joint.name == name]
    if exact:
        return exact[0]
    short = [joint for joint in joints if joint.short == name]
    if not short:  # as descriptions name joints whose prims had to be named otherwise
        plain = [_plain(joint.short) for joint in joints]
        short = [joint for joint, each in zip(joints, plain, strict=True) if each == _plain(name)]
    return short[0] if len(short) == 1 else None


def _plain(name: str) -> str:
    return "".join(c if c.isalnum() else "_" for c in name).lower()
