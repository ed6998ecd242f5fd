# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Logs of a World: its states and every output that it was asked for, by the names that logs of
`tenon sim` have (docs/simulation.md)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import seconds
from .log import AXES, BODY, SI_UNITS, Log, make_log

if TYPE_CHECKING:
    from .world import World

WRENCH = tuple(f"reaction{what}{axis}" for what in ("Force", "Torque") for axis in AXES)
ACCELERATION = tuple(f"{what}Acceleration{axis}" for what in ("linear", "angular") for axis in AXES)
#: What readings of sensors are called in logs, where it is not their name in camel case.
SENSOR = {
    "frame": {"position": "framePosition", "orientation": "frameOrientation",
              "linear_velocity": "frameLinearVelocity",
              "angular_velocity": "frameAngularVelocity"},
    "joint": {"position": "sensorPosition", "velocity": "sensorVelocity",
              "effort": "sensorEffort"},
    "rays": {"distances": "distance"},
}


def record(world: World, duration: float, every: float = 1 / 60, env: int = 0,
           contacts: bool | None = None) -> Log:
    """Steps a World for `duration` [s] and logs environment `env` every so many seconds, from the
    state that it is in, with all outputs that the World was made with. `contacts` says whether
    contacts are among them; None: where the World has them. SI and radians."""
    step = world.time_step
    total = round(seconds("duration", duration) / step)
    stride = max(1, round(seconds("every", every) / step))
    taken = _Taken(world, env, "contacts" in world.outputs if contacts is None else contacts)
    done = 0
    while True:
        taken.sample()
        if done >= total:
            break
        count = min(stride, total - done)
        world.step(count)
        done += count
    return taken.log()


class _Taken:
    """What was read of one environment so far."""

    def __init__(self, world: World, env: int, contacts: bool) -> None:
        self.world, self.env, self.contacts = world, env, contacts
        self.colliders = world.scene.colliders.column("path") if contacts else []
        self.times: list[float] = []
        self.rows: list[list[float]] = []
        self.names: list[str] = []
        self.touched: dict[str, list[Any]] = {}

    def sample(self) -> None:
        self.times.append(float(self.world.time[self.env]))
        row = self._states() | self._outputs()
        self.names = self.names or list(row)
        self.rows.append([row[name] for name in self.names])
        if self.contacts:
            self._touch()

    def log(self) -> Log:
        values = np.array(self.rows, dtype=np.float64).reshape(len(self.rows), len(self.names))
        found = {name: np.array(each) for name, each in self.touched.items()}
        columns = {name: values[:, i] for i, name in enumerate(self.names)}
        return make_log(self.times, columns, found if self.contacts else None, SI_UNITS)

    def _states(self) -> dict[str, float]:
        world, env = self.world, self.env
        poses, velocities = world._batch.body_states()
        positions, rates = world.joints()
        row: dict[str, float] = {}
        of_body = [what + axis for what, axes in BODY.items() for axis in axes]
        for i, path in enumerate(world.body_names):
            _add(row, path, of_body, (*poses[env, i], *velocities[env, i]))
        for i, path in enumerate(world.joint_names):
            _add(row, path, ("position", "velocity"), (positions[env, i], rates[env, i]))
        _add(row, "energy", ("kinetic", "potential"), world.energy[env])
        return row

    def _outputs(self) -> dict[str, float]:
        world, env, row = self.world, self.env, dict[str, float]()
        if "efforts" in world.outputs:
            for name, effort in zip(world.drive_names, world.drive_efforts()[env]):
                path, _, axis = name.partition(":")
                row[f"{path}.driveEffort" + (f".{axis}" if axis else "")] = float(effort)
        if "reactions" in world.outputs:
            for path, wrench in zip(world.joint_paths, world.joint_reactions()[env]):
                _add(row, path, WRENCH, wrench)
        if "accelerations" in world.outputs:
            for path, change in zip(world.body_names, world.body_accelerations()[env]):
                _add(row, path, ACCELERATION, change)
            for path, one in zip(world.joint_names, world.joint_accelerations()[env]):
                row[f"{path}.acceleration"] = float(one)
        if "work" in world.outputs:
            row.update({f"work.{part}": float(done[env]) for part, done in world.work().items()})
        if "sensors" in world.outputs:
            for reading in world.sensors(env):
                _add_reading(row, reading)
        return row

    def _touch(self) -> None:
        world = self.world
        found = world.contacts(self.env)
        bodies = world.body_names
        row: dict[str, Any] = {"time": [self.times[-1]] * len(found["depth"])}
        for side in range(2):
            row[f"collider{side}"] = [self.colliders[i] for i in found[f"collider{side}"]]
            row[f"body{side}"] = [bodies[i] if i >= 0 else "" for i in found[f"body{side}"]]
        friction = found["force"] - found["normal_force"][:, None] * found["normal"]
        for key, values in (("point", found["point"]), ("normal", found["normal"]),
                            ("frictionForce", friction),
                            ("frictionTorque", found["friction_torque"])):
            row.update({key + axis: values[:, k].tolist() for k, axis in enumerate(AXES)})
        row.update(depth=found["depth"].tolist(), normalForce=found["normal_force"].tolist())
        for name, each in row.items():
            self.touched.setdefault(name, []).extend(each)


def _add(row: dict[str, float], path: str, names: Any, values: Any) -> None:
    row.update({f"{path}.{name}": float(value)
                for name, value in zip(names, values, strict=True)})


def _add_reading(row: dict[str, float], reading: Mapping[str, Any]) -> None:
    names = SENSOR.get(reading["kind"], {})
    for key, value in reading.items():
        if key in ("path", "kind", "time"):
            continue
        first, *rest = key.split("_")
        name = names.get(key, first + "".join(word.capitalize() for word in rest))
        parts = np.atleast_1d(np.asarray(value, dtype=np.float64))
        many = reading["kind"] in ("rays", "joint")
        labels = ([""] if len(parts) == 1 else [f".{k}" for k in range(len(parts))] if many
                  else BODY["orientation"] if len(parts) == 4 else AXES)
        _add(row, reading["path"], [name + label for label in labels], parts)


__all__ = ["record"]
