# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What a motion of chosen joints takes, by the algebra of the scene: efforts, the regressor of
friction and inertia, and the bodies that touch on the way.

Followers of mimics and loops of joints move along; bodies that float are held.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..dynamics import Dynamics
from .joints import AssetJoint
from .log import Array

if TYPE_CHECKING:
    from .._tenon import PhysicsScene

#: Seconds to both sides, from which speeds and accelerations of what is tied follow.
AROUND = 1e-3
#: rad or m to both sides, for derivatives by a joint.
ASIDE = 1e-5
#: Bodies, above which a regressor has masses and first moments alone.
WHOLE_BODIES = 12


class Mover:
    """A scene whose chosen joints move and whose others stay."""

    def __init__(self, scene: PhysicsScene, joints: Sequence[AssetJoint]) -> None:
        self.scene = scene
        self.joints = tuple(joints)
        self.base = Dynamics(scene)
        self.at = [self.base.coordinate(joint.path, joint.dof) for joint in joints]
        self.start: Array = np.array(self.base.positions)[self.at]
        self._bodies: list[int] | None = None
        self._tied = self.ties(self.start)
        coordinates = {each.joint for each in self.base.coordinates}
        # Of loops, and of mimic laws with squares, it depends on the posture.
        self._changing = any(
            (joint.type != "fixed" and joint.enabled and joint.path not in coordinates)
            or any(np.any(mimic.higher) for mimic in joint.mimics) for joint in scene.joints)
        by_path = {joint.path: joint for joint in scene.joints}
        self.springs = [(by_path[joint.path].stiffness, by_path[joint.path].spring_reference)
                        if not joint.several else (0.0, 0.0) for joint in joints]

    def posed(self, position: Array) -> Dynamics:
        """The scene with the chosen joints at positions [rad or m], shape (N,)."""
        return self.base.moved({joint.name: float(value)
                                for joint, value in zip(self.joints, position)})

    # ---- efforts

    def effort(self, position: Array, velocity: Array, acceleration: Array) -> Array:
        """What the drives exert in that state of motion [N m or N], shape (N,): inertia, weight,
        friction, damping and springs of the asset."""
        here = self.posed(position)
        whole = np.nan_to_num(here.positions)
        turn = acceleration * AROUND * AROUND / 2
        after = np.nan_to_num(self.posed(position + velocity * AROUND + turn).positions)
        before = np.nan_to_num(self.posed(position - velocity * AROUND + turn).positions)
        speeds = (after - before) / (2 * AROUND)
        turns = (after - 2 * whole + before) / (AROUND * AROUND)
        forces = here.mass_matrix() @ turns + here.bias_forces(speeds) - here.gravity_forces()
        own = np.asarray(here.along_held(forces)[self.at])
        for k, joint in enumerate(self.joints):
            stiffness, reference = self.springs[k]
            own[k] += joint.friction * np.sign(velocity[k]) + joint.passive_damping * velocity[k]
            own[k] += stiffness * (position[k] - reference)
        return own

    def weight(self, position: Array) -> Array:
        """What holds the joints still there [N m or N], shape (N,)."""
        here = self.posed(position)
        return np.asarray(here.along_held(-here.gravity_forces())[self.at])

    def inertia(self, position: Array) -> Array:
        """What each joint accelerates with the others held [kg m^2 or kg], shape (N,)."""
        return np.asarray(self.posed(position).effective_inertia()[0][self.at])

    # ---- information

    @property
    def bodies(self) -> list[int]:
        """Bodies that the chosen joints move, by their places in scene.bodies."""
        if self._bodies is None:
            self._bodies = [b for b in range(len(self.scene.bodies))
                            if np.any(np.abs(self.base.jacobian(b) @ self._tied) > 1e-9)]
        return self._bodies

    @property
    def has_inertias(self) -> bool:
        """The regressor has inertias of bodies, too."""
        return len(self.bodies) <= WHOLE_BODIES

    def ties(self, position: Array) -> Array:
        """How all coordinates move with the chosen joints, shape (n, N): followers and loops."""
        columns = []
        for k in range(len(self.joints)):
            aside = np.zeros(len(position))
            aside[k] = ASIDE
            up, down = self.posed(position + aside), self.posed(position - aside)
            columns.append(np.nan_to_num(up.positions - down.positions) / (2 * ASIDE))
        return np.stack(columns, axis=1)

    def regressors(self, position: Array, velocity: Array, acceleration: Array) -> Array:
        """Efforts as a product of it and unknowns, shape (P, N, columns) for P states of motion of
        shape (P, N): of each joint its armature, viscous and Coulomb friction, then of each moved
        body mass, first moment and, where they are few, inertia."""
        count = len(self.joints)
        own = np.zeros((len(position), count, 3 * count))
        for k in range(count):
            own[:, k, 3 * k:3 * k + 3] = np.stack(
                (acceleration[:, k], velocity[:, k], np.sign(velocity[:, k])), axis=1)
        states = [self._state(*each) for each in zip(position, velocity, acceleration, strict=True)]
        places, turns, ways = (np.stack(each) for each in zip(*states, strict=True))
        line = (places[:, 2] - 2 * places[:, 1] + places[:, 0]) / AROUND**2 - self._gravity()
        first = _turn(turns[:, 0], turns[:, 1]) / AROUND
        second = _turn(turns[:, 1], turns[:, 2]) / AROUND
        wrench = _wrench(line, (first + second) / 2, (second - first) / AROUND,
                         _matrices(turns[:, 1]), self.has_inertias)
        inertial = np.einsum("pbwn,pbwc->pnbc", ways, wrench)
        return np.concatenate((own, inertial.reshape(len(position), count, -1)), axis=2)

    def _state(self, position: Array, velocity: Array, acceleration: Array
               ) -> tuple[Array, Array, Array]:
        """Places (3, bodies, 3) and orientations (3, bodies, 4) of moved bodies before, at and
        after a moment, and how each moves with the joints (bodies, 6, N)."""
        turn = acceleration * AROUND * AROUND / 2
        here = self.posed(position)
        three = (self.posed(position - velocity * AROUND + turn), here,
                 self.posed(position + velocity * AROUND + turn))
        chosen = self.bodies
        places = np.stack([each.body_positions[chosen] for each in three])
        turns = np.stack([each.body_orientations[chosen] for each in three])
        tied = self.ties(position) if self._changing else self._tied
        ways = [here.jacobian(body, places[1, number]) @ tied
                for number, body in enumerate(chosen)]
        return places, turns, np.stack(ways)

    def _gravity(self) -> Array:
        scene = self.scene.scenes[0]
        return np.asarray(scene.gravity, dtype=np.float64)

    # ---- what touches

    def touching(self, positions: Array) -> list[tuple[int, int, int, float]]:
        """Colliders that overlap and that nothing keeps apart, at each of the positions (P, N):
        (which position, collider, collider, depth [m]). Raises MissingError without MuJoCo."""
        from .. import _tenon

        places = np.zeros((len(positions), len(self.scene.bodies), 7))
        for number, position in enumerate(positions):
            here = self.posed(position)
            places[number, :, :3] = here.body_positions
            places[number, :, 3:] = here.body_orientations
        found: list[tuple[int, int, int, float]] = _tenon.overlaps(self.scene, places)
        return found


def _turn(before: Array, after: Array) -> Array:
    """The small rotation from one to another as a vector [rad, world], shape (..., 3)."""
    w0, v0 = before[..., :1], -before[..., 1:]
    w1, v1 = after[..., :1], after[..., 1:]
    w = w1 * w0 - np.sum(v1 * v0, axis=-1, keepdims=True)
    v = w1 * v0 + w0 * v1 + np.cross(v1, v0)
    size = np.linalg.norm(v, axis=-1, keepdims=True)
    angle = 2 * np.arctan2(size, np.abs(w))
    factor = np.where(size > 1e-300, angle / np.maximum(size, 1e-300), 2.0)
    return np.asarray(v * np.where(w < 0, -1.0, 1.0) * factor)


def _matrices(quaternions: Array) -> Array:
    """Rotations body -> world, shape (..., 3, 3)."""
    w, x, y, z = np.moveaxis(quaternions, -1, 0)
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def _cross(v: Array) -> Array:
    """v x as a product, shape (..., 3, 3)."""
    made = np.zeros((*v.shape, 3))
    for row, column, part, sign in ((0, 1, 2, -1), (0, 2, 1, 1), (1, 0, 2, 1), (1, 2, 0, -1),
                                    (2, 0, 1, -1), (2, 1, 0, 1)):
        made[..., row, column] = sign * v[..., part]
    return made


def _wrench(line: Array, omega: Array, alpha: Array, rotation: Array, whole: bool) -> Array:
    """Force and torque about the origin of bodies, of mass, first moment (3) and inertia about the
    origin (xx, yy, zz, xy, xz, yz) in their own axes: shape (..., 6, 10), or (..., 6, 4) without
    inertia. `line` is the acceleration of the origin less gravity."""
    made = np.zeros((*line.shape[:-1], 6, 10 if whole else 4))
    made[..., :3, 0] = line
    made[..., :3, 1:4] = (_cross(alpha) + _cross(omega) @ _cross(omega)) @ rotation
    made[..., 3:, 1:4] = -_cross(line) @ rotation
    if whole:
        back = np.swapaxes(rotation, -1, -2)
        own, turn = (back @ omega[..., None])[..., 0], (back @ alpha[..., None])[..., 0]
        made[..., 3:, 4:] = rotation @ (_inertia_rows(turn) + _cross(own) @ _inertia_rows(own))
    return made


def _inertia_rows(v: Array) -> Array:
    """I v as a product with xx, yy, zz, xy, xz, yz of I, shape (..., 3, 6)."""
    made = np.zeros((*v.shape, 6))
    for row, columns in enumerate(((0, 3, 4), (3, 1, 5), (4, 5, 2))):
        for part, column in enumerate(columns):
            made[..., row, column] = v[..., part]
    return made
