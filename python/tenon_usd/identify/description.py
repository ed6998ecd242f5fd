# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers that engines do not change while they run: where the mass of a body is, ratios of mimics,
limits of velocity. Worlds get them in their description, and are made again with it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..world import World
from .log import Array
from .moments import axes_of, inertia_of_moments
from .parameters import FAMILIES, Parameter

#: (list, path, field, how many numbers) of the description, in the order of their values.
Keys = list[tuple[str, str, str, int]]
_AXES = "XYZ"


def is_described(parameter: Parameter) -> bool:
    """Whether it is a number of the description rather than one of World.set_parameter()."""
    return "." in FAMILIES[parameter.family].sets


def fields_of(scene: Any, parameters: Sequence[Parameter], sets: Array) -> tuple[Keys, Array]:
    """What `sets` (S, P) say of the description of `scene`: keys, and their values (S, numbers)."""
    bodies = {body.path: body for body in scene.bodies}
    told: dict[tuple[str, str], dict[int, Array]] = {}
    made: dict[tuple[str, str, str, int], Array] = {}
    for at, each in enumerate(parameters):
        place, _, field = FAMILIES[each.family].sets.partition(".")
        for path, share in each.parts if field else ():
            if place == "bodies":
                told.setdefault((path, field), {})[_AXES.index(each.family[-1])] = sets[:, at]
            else:
                made[place, path, field, 1] = share * sets[:, at, None]
    for (path, field), axes in told.items():
        body = bodies[path]
        if field == "centerOfMass":
            values = _with(np.asarray(body.center_of_mass), axes, len(sets))
        else:
            turn, moments = axes_of(np.asarray(body.inertia))
            values = inertia_of_moments(turn, _with(moments, axes, len(sets))).reshape(-1, 9)
            # World.set_parameter() changes inertia with the mass, in proportion.
            values = values * _mass_ratio(body, parameters, sets)
        made["bodies", path, field, values.shape[1]] = values
    keys = list(made)
    return keys, np.concatenate([made[key] for key in keys], axis=1) if keys else np.zeros(
        (len(sets), 0))


def _with(own: Array, axes: dict[int, Array], count: int) -> Array:
    values = np.tile(own.astype(np.float64), (count, 1))
    for axis, column in axes.items():
        values[:, axis] = column
    return values


def _mass_ratio(body: Any, parameters: Sequence[Parameter], sets: Array) -> Array:
    for at, each in enumerate(parameters):
        if each.family == "mass" and body.path in each.paths:
            return np.asarray(body.mass / sets[:, at, None])
    return np.ones((len(sets), 1))


def describe(world: World, parameters: Sequence[Parameter], sets: Array) -> bool:
    """Gives each environment the numbers of a row of `sets` (envs, P). Whether there were any: the
    world is at its start then. Raises errors of tenon_usd.errors."""
    keys, values = fields_of(world.scene, parameters, sets)
    if keys:
        world._batch.set_fields(keys, np.ascontiguousarray(values))
    return bool(keys)


def follow(scene: Any, names: Sequence[str], measured: Sequence[str], positions: Array,
           velocities: Array, parameters: Sequence[Parameter], sets: Array) -> None:
    """Puts joints that follow others, and are not measured, where their leaders say: `positions`
    and `velocities` (rows, coordinates), by the ratios of `sets` (rows, P)."""
    ratios = {path: sets[:, at] for at, each in enumerate(parameters)
              if each.family == "mimicRatio" for path in each.paths}
    for _ in range(8):  # followers of followers
        for joint in scene.joints:
            if joint.path not in names or joint.path in measured:
                continue
            for mimic in joint.mimics[:1]:
                leader = scene.joints[mimic.leader].path
                if leader in names:
                    at, of = names.index(joint.path), names.index(leader)
                    ratio = ratios.get(joint.path, mimic.multiplier)
                    positions[:, at] = ratio * positions[:, of] + mimic.offset
                    velocities[:, at] = ratio * velocities[:, of]
