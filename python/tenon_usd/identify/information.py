# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""How much a motion tells of the friction, armature and masses of a robot."""

from __future__ import annotations

import math

import numpy as np

from .log import Array
from .moving import Mover

#: Noise of efforts, as a part of what drives can exert: singular values below it are drowned.
DROWNED = 1e-3
#: Taken where the asset has no limit of speed [rad/s, m/s].
USUAL_SPEED = (2.0, 0.25)


def information(values: Array) -> float:
    """log det of the information on unknowns that are known to their usual size before; what
    noise drowns counts for nothing."""
    return float(np.sum(np.log1p((values / DROWNED) ** 2)))


class Judge:
    """How much motions tell: singular values of the regressor, in efforts of the drives, for
    unknowns of a usual size."""

    def __init__(self, mover: Mover, middle: Array) -> None:
        self.mover = mover
        inertia, weight = mover.inertia(middle), np.abs(mover.weight(middle))
        self.limits = np.array([joint.effort_limit if math.isfinite(joint.effort_limit)
                                else weight[k] + 10 * inertia[k] + 1e-6
                                for k, joint in enumerate(mover.joints)])
        sizes: list[float] = []
        for k, joint in enumerate(mover.joints):
            speed = joint.velocity_limit if math.isfinite(joint.velocity_limit) \
                else USUAL_SPEED[0 if joint.rotates else 1]
            sizes += [float(inertia[k]), 0.05 * float(self.limits[k]) / speed,
                      0.05 * float(self.limits[k])]
        origins = mover.posed(middle).body_positions
        for index in mover.bodies:
            body = mover.scene.bodies[index]
            # As large as what is around it, from its origin to the next ones.
            others = np.linalg.norm(origins - origins[index], axis=1)
            reach = max(float(np.min(others[others > 1e-6], initial=1.0)), 0.01)
            sizes += [body.mass] + 3 * [body.mass * reach / 2]
            if mover.has_inertias:
                sizes += 6 * [body.mass * reach * reach / 12]
        self.sizes = np.array(sizes)

    def rows(self, position: Array, velocity: Array, acceleration: Array) -> Array:
        """Shape (samples N, unknowns), without a unit."""
        made = self.mover.regressors(position, velocity, acceleration)
        made = made * self.sizes / self.limits[None, :, None]
        return np.asarray(made.reshape(-1, made.shape[-1]))

    def singular(self, rows: Array) -> Array:
        """Per sample, the largest first."""
        return np.asarray(np.linalg.svd(rows / math.sqrt(len(rows)), compute_uv=False))

    def score(self, rows: Array) -> float:
        return information(self.singular(rows))
