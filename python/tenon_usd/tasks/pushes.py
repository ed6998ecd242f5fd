# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Pushes of bodies during episodes, at times and with forces that are drawn."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ..actuators import Number, fitting
from ..world import World
from .task import Push

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


def drawn(value: Number, random: np.random.Generator) -> float:
    """A number as it is, or one of its distribution."""
    return float(value) if isinstance(value, (int, float)) else float(value.sample(random, (1,))[0])


class Pushes:
    """Pushes of the bodies of a world, in whole frames: the first after `every` seconds, each for
    `lasts` seconds, the next `every` seconds after the end of the one before."""

    def __init__(self, world: World, rows: Sequence[Push]) -> None:
        self._world, self._rows = world, rows
        self.bodies = [fitting(row.body, world.body_names)[0] for row in rows]
        shape = (len(rows), world.envs)
        self._first = np.zeros(shape)
        self._next = np.zeros(shape)  # when a push begins, or the one that acts ends [s]
        self._acts = np.zeros(shape, dtype=bool)
        self.forces: Array = np.zeros((*shape, 3))
        """What acts now [N], shape (rows, envs, 3)."""

    def draw(self, env: int, random: np.random.Generator) -> None:
        """When the first push of the next episode of an environment begins."""
        for i, row in enumerate(self._rows):
            self._first[i, env] = drawn(row.every, random)

    def started(self, envs: Mask) -> None:
        """For environments that were reset, and with them what acted on their bodies."""
        self._next[:, envs] = self._first[:, envs]
        self._acts[:, envs] = False
        self.forces[:, envs] = 0

    def act(self, randoms: Sequence[np.random.Generator]) -> None:
        """Sets the forces of the next frame; each environment draws from its own generator."""
        time = self._world.time
        for i, (row, body) in enumerate(zip(self._rows, self.bodies)):
            due = np.flatnonzero(time >= self._next[i] - 1e-9)
            for env in due:
                if self._acts[i, env]:
                    self.forces[i, env] = 0
                    wait = drawn(row.every, randoms[env])
                else:
                    self.forces[i, env] = [drawn(each, randoms[env]) for each in row.force]
                    wait = row.lasts
                self._acts[i, env] = not self._acts[i, env]
                self._next[i, env] = time[env] + wait
            if len(due):
                self._world.set_wrench(body, self._together(body))

    def _together(self, body: int) -> Array:
        """The sum of what rows exert on one body, shape (envs, 6)."""
        wrench = np.zeros((self._world.envs, 6))
        for i, each in enumerate(self.bodies):
            if each == body:
                wrench[:, :3] += self.forces[i]
        return wrench


__all__ = ["Pushes"]
