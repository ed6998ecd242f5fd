# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""States in which windows of a log begin: those of its joints, out of positions alone, and those of
joints that close loops with them."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..dynamics import Dynamics
from ..errors import Error
from ..world import World
from .log import Array, Log

#: Seconds to both sides, from which speeds of joints in loops follow.
LITTLE = 1e-3


def initial_states(log: Log, at: npt.NDArray[np.int64], half: float = 0.025) -> tuple[Array, Array]:
    """Positions and velocities at samples, each shape (W, N): those of a cubic, or where the log
    begins or ends of a parabola, through the positions around, so that noise of single samples does
    not become speed. `half` [s]."""
    assert log.position is not None
    positions = np.empty((len(at), len(log.joints)))
    velocities = np.zeros_like(positions)
    for row, sample in enumerate(at):
        time = log.times[sample]
        near = np.abs(log.times - time) <= max(half, 2.01 * log.step)
        own = log.times[near] - time
        for column in range(len(log.joints)):
            values = log.position[near, column]
            good = np.isfinite(values)
            both = min(int((good & (own < 0)).sum()), int((good & (own > 0)).sum())) > 2
            degree = min(3 if both else 2, int(good.sum()) - 1)
            if degree < 1:
                positions[row, column] = np.nan if degree < 0 else values[good][0]
                continue
            fit = np.polynomial.polynomial.polyfit(own[good], values[good], degree)
            positions[row, column], velocities[row, column] = fit[0], fit[1]
    return positions, velocities


def closed(world: World, log: Log, positions: Array, velocities: Array) -> tuple[Array, Array]:
    """Start states (W, coordinates) in which loops are closed: joints that are not in the log go
    where those of the log have them. Joints that close loops stay as they are, for their states
    follow from those of the others. Without loops the same."""
    names = world.joint_names
    leaders = {joint.path for joint in world.scene.joints if not joint.mimics}
    moved = [names.index(joint) for joint in log.joints if joint in leaders]
    places, speeds = positions.copy(), velocities.copy()
    try:
        home = Dynamics(world.scene)
        tree = {each.joint: at for at, each in enumerate(home.coordinates)}
        if all(name in tree for name in names):
            return positions, velocities
        for row in range(len(positions)):
            now, before, after = (
                home.moved({names[at]: float(positions[row, at] + side * velocities[row, at])
                            for at in moved if names[at] in tree}).positions
                for side in (0.0, -LITTLE, LITTLE))
            for at, name in enumerate(names):
                if name in tree and name not in log.joints:
                    places[row, at] = now[tree[name]]
                    speeds[row, at] = (after[tree[name]] - before[tree[name]]) / (2 * LITTLE)
    except Error:  # what the algebra does not take
        return positions, velocities
    return places, speeds
