# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Friction that is larger at rest than while a joint turns (Stribeck). Engines have one friction
for both, so what comes on top of it is an effort along the joint, of the speed of the step before:

    -extra exp(-(v / decay)^2)

Around 0 it grows over the speed that it takes away in two steps, so that it does not push a joint
to and fro."""

from __future__ import annotations

import dataclasses

import numpy as np

from .log import Array

#: Over which it wears off where nothing says so, and builds up at least [rad/s or m/s].
DECAY, LEAST = 0.1, 1e-3


@dataclasses.dataclass(frozen=True)
class RestFriction:
    """Of joints, as arrays of one shape: `extra` [N m or N], `decay` [rad/s or m/s], and the
    `inertia` [kg m^2 or kg] that is accelerated within steps of `step` [s]."""

    extra: Array
    decay: Array
    inertia: Array
    step: float

    def effort(self, speed: Array) -> Array:
        """[N m or N]."""
        builds_up = np.maximum(LEAST, 2 * self.extra * self.step / self.inertia)
        worn = np.exp(-np.minimum((speed / self.decay) ** 2, 700.0))
        return np.asarray(-self.extra * worn * np.tanh(speed / builds_up))

    def rows(self, wide: int) -> RestFriction:
        """Each row `wide` times."""
        more = [np.repeat(each, wide, axis=0) for each in (self.extra, self.decay, self.inertia)]
        return RestFriction(more[0], more[1], more[2], self.step)


def resisted(efforts: Array, rest: RestFriction | None, columns: slice | list[int], speed: Array
             ) -> Array:
    """Efforts (envs, joints) with the friction of joints of the log at these speeds."""
    if rest is None:
        return efforts
    made = efforts.copy()
    made[:, columns] += rest.effort(speed)
    return made
