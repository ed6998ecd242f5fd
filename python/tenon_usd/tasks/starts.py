# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Where joints and bodies are when an episode starts, in place of the asset's."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from .._toml import Fault
from ..actuators import fitting
from ..errors import NotFoundError
from ..observations import AXES
from ..world import World
from .pushes import drawn
from .task import Start

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


class Starts:
    """The rows [[reset]] of a task in a world; `faults` are those that name what it has not."""

    def __init__(self, world: World, rows: Sequence[Start]) -> None:
        self._world, self._rows = world, rows
        self.faults: list[Fault] = []
        self._which: list[list[int]] = []
        for i, row in enumerate(rows, 1):
            names = world.joint_names if row.of.startswith("joint") else world.body_names
            path = row.of.partition("@")[2]
            try:
                self._which.append(fitting(path, names) if path else list(range(len(names))))
            except (NotFoundError, ValueError) as error:
                self.faults.append(Fault(f"reset {i}", row.line, str(error)))
                self._which.append([])
        self._values = [np.zeros((world.envs, len(which))) for which in self._which]

    def draw(self, env: int, random: np.random.Generator) -> None:
        """Values for the next episode of an environment."""
        for row, values in zip(self._rows, self._values):
            values[env] = [drawn(row.value, random) for _ in values[env]]

    def started(self, envs: Mask) -> None:
        """Puts joints, then bodies, of environments that were reset."""
        self._place_joints(envs)
        bodies = {body for row, which in zip(self._rows, self._which)
                  if not row.of.startswith("joint") for body in which}
        for body in sorted(bodies):
            self._place_body(body, envs)

    def _place_joints(self, envs: Mask) -> None:
        positions, velocities = self._world.joints()
        for row, which, values in zip(self._rows, self._which, self._values):
            if row.of.startswith("joint"):
                to = velocities if row.of.startswith("jointVelocity") else positions
                for column, value in zip(which, values.T):
                    to[envs, column] = value[envs]
        self._world.set_joints(positions, velocities)

    def _place_body(self, body: int, envs: Mask) -> None:
        poses = self._world.body_poses[:, body].copy()
        for row, which, values in zip(self._rows, self._which, self._values):
            kind, _, axis = row.of.partition("@")[0].partition(".")
            if row.of.startswith("joint") or body not in which:
                continue
            value = values[envs, which.index(body)]
            if kind == "position":
                poses[envs, AXES.index(axis)] = value
            else:
                poses[envs, 3:] = _turned(poses[envs, 3:], value)
        self._world.set_body(body, poses, self._world.body_velocities[:, body])


def _turned(orientations: Array, angles: Array) -> Array:
    """Orientations (w, x, y, z), turned by angles [rad] about z of the world."""
    c, s = np.cos(angles / 2), np.sin(angles / 2)
    w, x, y, z = orientations.T
    return np.stack([c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w], axis=1)


__all__ = ["Starts"]
