# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What environments observe, by names, and what each number is.

    from tenon_usd.observations import Observer

    observer = Observer(world, ["jointPosition", "position@/World/can", "sensor@/World/imu"])
    for entry in observer.entries:
        print(entry.name, entry.unit, entry.low, entry.high)
    numbers = observer.read()                   # (envs, len(observer.entries))

Names are those of metrics of sweeps (docs/sweep.md): "jointPosition@/hand/joint",
"position.z@/World/can", "driveEffort@/hand/joint", "contactForce@/World/can", "energy". Without an
axis there are all three; without an object those of all joints, drives or bodies; an object is a
path, its last element, or a regular expression. "orientation@BODY" is w, x, y, z, "sensor@PATH"
what a sensor of the asset reads, "sensor.position@PATH" and "sensor.position.x@PATH" a part of it,
"jointPosition.cos@JOINT" and "jointPosition.sin@JOINT" those of an angle. What entries are called
are names, too.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from ._lists import no_such
from .actuators import fitting
from .errors import NotFoundError
from .world import World

Array = npt.NDArray[np.float64]
AXES = ("x", "y", "z")
QUATERNION = ("w", *AXES)
#: Of angles.
TURNS = {"cos": np.cos, "sin": np.sin}


@dataclasses.dataclass(frozen=True)
class Entry:
    """One number of an observation or an action: `name`, `unit` (empty: none), and the range that
    it may have by the asset, infinite where nothing says."""

    name: str
    unit: str = ""
    low: float = -math.inf
    high: float = math.inf


@dataclasses.dataclass(frozen=True)
class _Kind:
    """A signal: of what, its unit, and whether it has axes."""

    of: str
    unit: str
    axes: bool = False
    low: float = -math.inf


_KINDS = {
    "jointPosition": _Kind("joint", "rad or m"),
    "jointVelocity": _Kind("joint", "rad/s or m/s"),
    "driveEffort": _Kind("drive", "N m or N"),
    "position": _Kind("body", "m", True),
    "velocity": _Kind("body", "m/s", True),
    "angularVelocity": _Kind("body", "rad/s", True),
    "speed": _Kind("body", "m/s", low=0.0),
    "angularSpeed": _Kind("body", "rad/s", low=0.0),
    "contactForce": _Kind("body", "N", low=0.0),
    "energy": _Kind("", "J"),
    "kineticEnergy": _Kind("", "J", low=0.0),
    "potentialEnergy": _Kind("", "J"),
    "contactCount": _Kind("", "", low=0.0),
}
#: Names beside those of metrics.
_MORE = ("orientation", "sensor")
#: Units of what sensors read.
_OF_SENSORS = {
    "in_contact": "", "normal_force": "N", "linear_acceleration": "m/s^2",
    "angular_velocity": "rad/s", "orientation": "", "force": "N", "torque": "N m",
    "position": "m", "linear_velocity": "m/s", "distances": "m",
}
_OF_JOINT_SENSORS = {"position": "rad or m", "velocity": "rad/s or m/s", "effort": "N m or N"}

#: What _tenon.Batch.read() is asked for.
_Signal = tuple[str, int, int]
_Read = Callable[[], Array]


def outputs_of(names: Iterable[str]) -> list[str]:
    """The outputs that a World needs for these names."""
    kinds = {name.partition("@")[0].partition(".")[0] for name in names}
    needed = {"driveEffort": "efforts", "contactForce": "contacts", "sensor": "sensors"}
    return [output for kind, output in needed.items() if kind in kinds]


class Observer:
    """Reads numbers of a world by names: one entry for each number, in the order of the names.

    Raises NotFoundError for a name that there is not. What a name needs of `outputs`, the world has
    to be made with (outputs_of()).
    """

    def __init__(self, world: World, names: Iterable[str]) -> None:
        self.world = world
        self.entries: tuple[Entry, ...] = ()
        """What each number is."""
        self.counts: list[int] = []
        """How many numbers each name gives."""
        self._limits: dict[str, tuple[float, float]] | None = None
        # Runs of signals are read at once.
        self._reads: list[list[_Signal] | _Read] = []
        for name in names:
            entries = self._add(name)
            self.entries += tuple(entries)
            self.counts.append(len(entries))

    def read(self) -> Array:
        """The numbers now, shape (envs, len(entries))."""
        parts = [self.world._batch.read(each) if isinstance(each, list) else each()
                 for each in self._reads]
        return np.concatenate(parts, axis=1) if parts else np.zeros((self.world.envs, 0))

    def _add(self, text: str) -> list[Entry]:
        head, at, path = text.partition("@")
        name, _, axis = head.partition(".")
        if name == "orientation":
            return self._add_orientations(path, axis)
        if name == "sensor":
            return self._add_sensors(path, axis)
        if name == "jointPosition" and axis in TURNS:
            return self._add_turns(path, axis)
        kind = _KINDS.get(name)
        if kind is None or (axis and not kind.axes) or (at and not kind.of):
            raise NotFoundError(no_such(text, [*_KINDS, *_MORE]))
        if axis and axis not in AXES:
            raise NotFoundError(f"{name} has the axes x, y and z, not {axis!r}")
        axes = [AXES.index(axis)] if axis else list(range(3 if kind.axes else 1))
        signals: list[_Signal] = []
        entries: list[Entry] = []
        for index, of in self._objects(kind.of, path):
            for part in axes:
                signals.append((_own_name(name, of), index, part))
                entries.append(self._entry(name, kind, of, AXES[part] if kind.axes else ""))
        if self._reads and isinstance(self._reads[-1], list):
            self._reads[-1] += signals
        else:
            self._reads.append(signals)
        return entries

    def _objects(self, of: str, path: str) -> list[tuple[int, str]]:
        if not of:
            return [(0, "")]
        names = {"joint": self.world.joint_names, "drive": self.world.drive_names,
                 "body": self.world.body_names}[of]
        which = fitting(path, names) if path else range(len(names))
        return [(i, names[i]) for i in which]

    def _entry(self, name: str, kind: _Kind, of: str, axis: str) -> Entry:
        low, high, unit = kind.low, math.inf, kind.unit
        if kind.of == "joint":
            low, high, straight = self._joint(of)
            if name == "jointVelocity":
                low, high = -math.inf, math.inf
            unit = unit.split(" or ")[straight]
        elif kind.of == "drive" and of in self.world.joint_names:
            unit = unit.split(" or ")[self._joint(of)[2]]
        return Entry(f"{name}{'.' + axis if axis else ''}{'@' + of if of else ''}", unit, low, high)

    def _joint(self, name: str) -> tuple[float, float, int]:
        """Limits [rad or m] of a coordinate, and 1 where it is straight."""
        paths = self.world.joint_paths
        joints = self.world.scene.joints
        if name in paths:
            joint = joints[paths.index(name)]
            return float(joint.lower), float(joint.upper), int(joint.type == "prismatic")
        return -math.inf, math.inf, int(":trans" in name)

    def _add_orientations(self, path: str, part: str) -> list[Entry]:
        if part and part not in QUATERNION:
            raise NotFoundError(f"orientation has w, x, y and z, not {part!r}")
        bodies = self._objects("body", path)
        which = [i for i, _ in bodies]
        parts = [part] if part else list(QUATERNION)
        at = [3 + QUATERNION.index(each) for each in parts]
        self._reads.append(lambda: np.asarray(
            self.world._batch.body_poses()[:, which][:, :, at]).reshape(self.world.envs, -1))
        return [Entry(f"orientation.{each}@{body}", "", -1.0, 1.0)
                for _, body in bodies for each in parts]

    def _add_turns(self, path: str, turn: str) -> list[Entry]:
        joints = self._objects("joint", path)
        for _, joint in joints:
            if self._joint(joint)[2]:
                raise NotFoundError(f"{joint} slides: it has no {turn}")
        which = [i for i, _ in joints]
        self._reads.append(lambda: np.asarray(TURNS[turn](self.world.joints()[0][:, which])))
        return [Entry(f"jointPosition.{turn}@{joint}", "", -1.0, 1.0) for _, joint in joints]

    def _add_sensors(self, path: str, part: str) -> list[Entry]:
        rows = self.world.sensors(0)
        if not rows:
            raise NotFoundError("the asset has no sensors")
        paths = [row["path"] for row in rows]
        which = fitting(path, paths) if path else list(range(len(paths)))
        kept = {i: [at for at, (name, _) in enumerate(_numbers(rows[i]))
                    if not part or name == part or name.startswith(part + ".")] for i in which}
        if not any(kept.values()):
            parts = dict.fromkeys(name.partition(".")[0] for i in which
                                  for name, _ in _numbers(rows[i]))
            raise NotFoundError(f"sensor.{part}: {no_such(part, list(parts))}")
        self._reads.append(lambda: np.array([
            [numbers[at][1] for i in which for numbers in (_numbers(rows_of[i]),)
             for at in kept[i]]
            for rows_of in map(self.world.sensors, range(self.world.envs))]))
        entries = []
        for i in which:
            units = _OF_JOINT_SENSORS if rows[i]["kind"] == "joint" else _OF_SENSORS
            named = _numbers(rows[i])
            entries += [Entry(f"sensor.{named[at][0]}@{paths[i]}",
                              units.get(named[at][0].partition(".")[0], "")) for at in kept[i]]
        return entries


def _own_name(name: str, of: str) -> str:
    """What the library calls it: all contact forces together have a name of their own."""
    return "contactForceOfAll" if name == "contactForce" and not of else name


def _numbers(row: dict[str, Any]) -> list[tuple[str, float]]:
    """The numbers of a reading, in its order."""
    found: list[tuple[str, float]] = []
    for name, value in row.items():
        if name in ("path", "kind", "time"):
            continue
        flat = np.asarray(value, dtype=np.float64).reshape(-1)
        if np.ndim(value) == 0:
            found.append((name, float(flat[0])))
        else:
            parts = QUATERNION if name == "orientation" else AXES
            found += [(f"{name}.{parts[i] if len(flat) == len(parts) else i}", float(each))
                      for i, each in enumerate(flat)]
    return found


__all__ = ["Entry", "Observer", "outputs_of"]
