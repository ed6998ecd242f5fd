# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Models of actuators: what lies between a command and the effort at a joint.

    from tenon_usd.actuators import Actuator, Actuators, DCMotor, Delay, PD

    motors = Actuators(world, [
        Actuator("/arm/elbow", Delay(0.01), PD(stiffness=40, damping=2, rate=500),
                 DCMotor(stall_effort=3, no_load_speed=20)),
    ])
    motors.set_commands([[0.5]])                # rad, shape (envs, joints of the actuators)
    motors.step(100)                            # in place of world.step(100)

Stages work in their order. Numbers of stages may be distributions (tenon_usd.draws): each joint and
environment draws its own, from draw() on. Efforts are applied once each time step, where the step
begins, on every engine alike; a drive that the asset has at such a joint is switched off.
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Iterable, Sequence
from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from ._arrays import counted, environments, finite
from ._lists import no_such
from ._patterns import compile_pattern
from .draws import Distribution
from .errors import InvalidError
from .world import World

Array = npt.NDArray[np.float64]
#: A number: the same in all episodes, or drawn at the start of each.
Number = float | Distribution
COMMANDS = {"position": "rad or m", "velocity": "rad/s or m/s", "effort": "N m or N"}
#: The longest delay, in time steps.
MAX_DELAY = 10_000
#: Gains of a drive that is switched off: PhysX keeps the old ones where it is given zeros.
OFF = 1e-9


@dataclasses.dataclass(frozen=True)
class Delay:
    """What goes in comes out `time` [s] later, rounded to whole time steps, at most 10,000. Until
    then: the position at the reset, or no velocity or effort."""

    time: Number

    def __post_init__(self) -> None:
        _check(self)


@dataclasses.dataclass(frozen=True)
class PD:
    """A position command becomes the effort stiffness (command - position) - damping velocity, a
    velocity command the effort damping (command - velocity).

    `stiffness` [N m/rad or N/m], `damping` [N m s/rad or N s/m]. It is computed `rate` times a
    second [Hz], rounded to whole time steps, and held in between; 0: in each time step.
    """

    stiffness: Number
    damping: Number
    rate: Number = 0.0

    def __post_init__(self) -> None:
        _check(self)


@dataclasses.dataclass(frozen=True)
class PID:
    """A PD with `bias` [N m or N] and the integral of the error of what is commanded over time, of
    which at most `integral_limit` [that error times s] either way counts, times `integral`.

    `rate` as PD has it; the integral is 0 from each reset on.
    """

    stiffness: Number
    damping: Number
    integral: Number
    integral_limit: Number = math.inf
    bias: Number = 0.0
    rate: Number = 0.0

    def __post_init__(self) -> None:
        _check(self)


@dataclasses.dataclass(frozen=True)
class DCMotor:
    """The efforts that a motor of direct current with its gears reaches at the joint's velocity v:
    from -stall_effort (1 + v / no_load_speed) to stall_effort (1 - v / no_load_speed), and at most
    `max_effort` either way, which its current allows.

    `stall_effort` and `max_effort` [N m or N], `no_load_speed` [rad/s or m/s], above 0.
    """

    stall_effort: Number
    no_load_speed: Number
    max_effort: Number = math.inf

    def __post_init__(self) -> None:
        _check(self)


@dataclasses.dataclass(frozen=True)
class Saturation:
    """The effort is at most `effort` [N m or N] either way. Without a PD before it, it is the
    largest effort of the asset's own drive."""

    effort: Number

    def __post_init__(self) -> None:
        _check(self)


Stage = Delay | PD | PID | DCMotor | Saturation
#: Numbers that may not be 0, those that may be infinite, and those that may be below 0.
_ABOVE_ZERO = ("no_load_speed", "stall_effort")
_INFINITE = ("max_effort", "integral_limit")
_SIGNED = ("bias",)


def _check(stage: Stage) -> None:
    for field in dataclasses.fields(stage):
        value = getattr(stage, field.name)
        if isinstance(value, (int, float)):
            _check_number(type(stage).__name__, field.name, np.array([float(value)]))
        elif not hasattr(value, "sample"):
            raise TypeError(f"{type(stage).__name__}.{field.name} is a number or a distribution of "
                            f"tenon_usd.draws, not {value!r}")


def _check_number(stage: str, name: str, values: Array) -> None:
    bad = np.isnan(values) | ((values == 0) if name in _ABOVE_ZERO else False)
    if name not in _SIGNED:
        bad |= values < 0
    if name not in _INFINITE:
        bad |= np.isinf(values)
    if bad.any():
        least = "" if name in _SIGNED else (
            " and above 0" if name in _ABOVE_ZERO else " and 0 or more")
        raise InvalidError(f"{stage}.{name} must be finite{least}, not {values[bad][0]:g}")


class Actuator:
    """The stages between commands and some joints of one degree of freedom.

    `joints` is the path of a joint, its last element, or a regular expression that fits one of
    these whole. `command` is what is commanded: "position" [rad or m], "velocity" [rad/s or m/s] or
    "effort" [N m or N]. `low` and `high` are the range of commands that environments offer, in the
    same unit; None: the limits of the joint (one turn where it has none), or what the stages can
    exert or reach.
    """

    def __init__(
        self, joints: str, *stages: Stage, command: str = "position", low: float | None = None,
        high: float | None = None
    ) -> None:
        if command not in COMMANDS:
            raise InvalidError(f"command: {no_such(command, list(COMMANDS))}")
        self.joints, self.stages, self.command = joints, stages, command
        self.low, self.high = low, high
        if low is not None and high is not None and not low < high:
            raise InvalidError(f"the range of {joints} is from {low:g} to {high:g}")
        effort = command == "effort"
        for stage in stages:
            if isinstance(stage, (PD, PID)):
                if effort:
                    raise InvalidError(f"a {type(stage).__name__} takes positions or velocities; "
                                       "before it are efforts")
                effort = True
            elif isinstance(stage, DCMotor) and not effort:
                raise InvalidError("a DCMotor limits efforts: a PD or PID stands before it, or the "
                                   'command is "effort"')
        #: Whether efforts come out; else targets of the asset's own drive.
        self.exerts = effort

    def _key(self) -> tuple[Any, ...]:
        return self.joints, self.stages, self.command, self.low, self.high

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Actuator) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash(self._key())

    def __repr__(self) -> str:
        told = ", ".join([repr(self.joints), *map(repr, self.stages)])
        return f"Actuator({told}, command={self.command!r})"


def fitting(pattern: str, names: Sequence[str]) -> list[int]:
    """The numbers of the names that a path, its last element or a regular expression means. Raises
    NotFoundError where it is none, InvalidError where it is no regular expression, or one whose
    search could go on for long."""
    last = [name.rpartition("/")[2] for name in names]
    for exact in (names, last):
        found = [i for i, name in enumerate(exact) if name == pattern]
        if found:
            return found
    try:
        fits = compile_pattern(pattern, names).fullmatch
    except re.error as reason:
        raise InvalidError(f"{pattern!r} is no regular expression: {reason}") from None
    found = [i for i in range(len(names)) if fits(names[i]) or fits(last[i])]
    if not found:
        from .errors import NotFoundError

        raise NotFoundError(no_such(pattern, names))
    return found


# ---- stages at work: arrays are of shape (envs, joints)


class _Numbers:
    """The numbers of one stage for each environment and joint."""

    def __init__(self, stage: Stage, shape: tuple[int, int]) -> None:
        self._stage = stage
        self.held: dict[str, Array] = {}
        self.drawn: dict[str, Distribution] = {}
        for field in dataclasses.fields(stage):
            value = getattr(stage, field.name)
            if isinstance(value, (int, float)):
                self.held[field.name] = np.full(shape, float(value))
            else:
                self.drawn[field.name] = value
                # Until the first draw: the middle of what may be drawn.
                middle = float(np.median(value.sample(np.random.default_rng(0), (1001,))))
                self.held[field.name] = np.full(shape, middle)

    def draw(self, env: int, random: np.random.Generator) -> None:
        for name, distribution in self.drawn.items():
            values = distribution.sample(random, self.held[name][env].shape)
            _check_number(type(self._stage).__name__, name, values)
            self.held[name][env] = values


class _Delayed:
    """The inputs of the last ticks, a ring that grows where a longer delay is drawn."""

    def __init__(self, numbers: _Numbers, time_step: float, shape: tuple[int, int]) -> None:
        self._numbers, self._step, self._shape = numbers, time_step, shape
        self._lag = np.zeros(shape, dtype=np.int64)
        self._ring = np.zeros((1, *shape))
        self._tick = 0
        self._env, self._joint = np.indices(shape)

    def reset(self, mask: npt.NDArray[np.bool_], rest: Array) -> None:
        steps = self._numbers.held["time"] / self._step
        if steps.max(initial=0.0) > MAX_DELAY:
            raise InvalidError(f"a delay of {steps.max() * self._step:g} s is more than "
                               f"{MAX_DELAY} time steps of {self._step:g} s")
        self._lag[mask] = np.rint(steps)[mask]
        length = int(self._lag.max(initial=0)) + 1
        if length > len(self._ring):
            order = [(self._tick - 1 - age) % len(self._ring) for age in range(len(self._ring))]
            longer = np.zeros((length, *self._shape))
            for age, at in enumerate(order):
                longer[(self._tick - 1 - age) % length] = self._ring[at]
            self._ring = longer
        self._ring[:, mask] = rest[mask]

    def apply(self, signal: Array, position: Array, velocity: Array) -> Array:
        length = len(self._ring)
        self._ring[self._tick % length] = signal
        at = (self._tick - self._lag) % length
        self._tick += 1
        delayed: Array = self._ring[at, self._env, self._joint]
        return delayed


class _Controlled:
    """A PD or PID that computes at its own ticks and holds in between."""

    def __init__(self, numbers: _Numbers, time_step: float, shape: tuple[int, int],
                 command: str) -> None:
        self._numbers, self._step, self._command = numbers, time_step, command
        self._held = np.zeros(shape)
        self._tick = np.zeros(shape, dtype=np.int64)
        self._period = np.ones(shape, dtype=np.int64)
        self._sum = np.zeros(shape)

    def reset(self, mask: npt.NDArray[np.bool_], rest: Array) -> None:
        rate = self._numbers.held["rate"]
        with np.errstate(divide="ignore"):
            period = np.where(rate > 0, np.rint(1 / (rate * self._step)), 1)
        self._period[mask] = np.maximum(np.minimum(period, 1 << 40), 1)[mask]
        self._tick[mask] = 0
        self._held[mask] = 0
        self._sum[mask] = 0

    def apply(self, signal: Array, position: Array, velocity: Array) -> Array:
        held = self._numbers.held
        if self._command == "position":
            error = signal - position
            effort = held["stiffness"] * error - held["damping"] * velocity
        else:
            error = signal - velocity
            effort = held["damping"] * error
        now = self._tick % self._period == 0
        if "integral" in held:
            most = held["integral_limit"]
            grown = np.clip(self._sum + error * self._period * self._step, -most, most)
            self._sum = np.where(now, grown, self._sum)
            effort = effort + held["integral"] * self._sum + held["bias"]
        self._held = np.where(now, effort, self._held)
        self._tick += 1
        return self._held


class _Bounded:
    """A DC motor or a saturation: nothing is remembered."""

    def __init__(self, stage: Stage, numbers: _Numbers) -> None:
        self.is_motor = isinstance(stage, DCMotor)
        self._numbers = numbers

    def reset(self, mask: npt.NDArray[np.bool_], rest: Array) -> None:
        """Nothing to forget."""

    def apply(self, signal: Array, position: Array, velocity: Array) -> Array:
        held = self._numbers.held
        if not self.is_motor:
            return np.clip(signal, -held["effort"], held["effort"])
        stall, most = held["stall_effort"], held["max_effort"]
        share = velocity / held["no_load_speed"]
        low, high = -stall * (1 + share), stall * (1 - share)
        return np.clip(np.clip(signal, low, high), -most, most)


_Work = _Delayed | _Controlled | _Bounded


class _Row:
    """One Actuator with its joints in a world."""

    def __init__(self, world: World, actuator: Actuator) -> None:
        self.actuator = actuator
        self.columns = fitting(actuator.joints, world.joint_names)
        scene = world.scene
        paths = world.joint_paths
        self.names = [world.joint_names[i] for i in self.columns]
        for name in self.names:
            if name not in paths:
                raise InvalidError(f"{name} is one of several degrees of freedom of a joint; "
                                   "actuators are for joints of one")
        self.joints = [scene.joints[paths.index(name)] for name in self.names]
        if not actuator.exerts:
            for name in self.names:
                if name not in world.drive_names:
                    raise InvalidError(f"{name} has no drive that takes a {actuator.command}; add "
                                       "a PD or PID to its stages")
        self.shape = (world.envs, len(self.columns))
        self.numbers: list[_Numbers] = []
        self.work: list[_Work] = []
        self.most: _Numbers | None = None  # of the asset's own drive
        exerts = actuator.command == "effort"
        for stage in actuator.stages:
            numbers = _Numbers(stage, self.shape)
            self.numbers.append(numbers)
            if isinstance(stage, Delay):
                self.work.append(_Delayed(numbers, world.time_step, self.shape))
            elif isinstance(stage, (PD, PID)):
                self.work.append(
                    _Controlled(numbers, world.time_step, self.shape, actuator.command))
                exerts = True
            elif isinstance(stage, Saturation) and not exerts:
                self.most = numbers
            else:
                self.work.append(_Bounded(stage, numbers))
        self.low, self.high = np.array([self._range(joint) for joint in self.joints]).T

    def _range(self, joint: Any) -> tuple[float, float]:
        low, high = self.actuator.low, self.actuator.high
        if low is not None and high is not None:
            return low, high
        if self.actuator.command == "position":
            own = max(joint.lower, -2 * math.pi), min(joint.upper, 2 * math.pi)
        else:
            most = self._reach()
            own = -most, most
        return (own[0] if low is None else low), (own[1] if high is None else high)

    def _reach(self) -> float:
        """The largest effort or velocity that the stages name, without distributions."""
        wanted = (("effort", "max_effort", "stall_effort")
                  if self.actuator.command == "effort" else ("no_load_speed",))
        named = [float(value) for stage in self.actuator.stages for name in wanted
                 if isinstance(value := getattr(stage, name, None), (int, float))]
        finite = [value for value in named if math.isfinite(value)]
        if not finite:
            raise InvalidError(f"{self.actuator!r} does not say how far commands go: give low and "
                               f"high [{COMMANDS[self.actuator.command]}]")
        return min(finite)

    def rest(self, positions: Array) -> Array:
        """What is commanded before anything is."""
        if self.actuator.command == "position":
            return positions[:, self.columns].copy()
        return np.zeros(self.shape)


class Actuators:
    """Actuators of the joints of a world, all its environments at once.

    Arrays are of shape (envs, size), along `names`. Numbers that are distributions have the median
    of these until draw(). set_commands(), step() and reset() stand for those of the world.
    """

    def __init__(self, world: World, actuators: Iterable[Actuator]) -> None:
        self.world = world
        self._rows = [_Row(world, actuator) for actuator in actuators]
        self.names: list[str] = [name for row in self._rows for name in row.names]
        """Paths of the joints, in the order of all arrays."""
        for name in self.names:
            if self.names.count(name) > 1:
                raise InvalidError(f"{name} has several actuators")
        self.size: int = len(self.names)
        """How many joints."""
        units = [COMMANDS[row.actuator.command] for row in self._rows for _ in row.names]
        self.units: list[str] = [_unit_of(unit, joint) for unit, joint in zip(
            units, [joint for row in self._rows for joint in row.joints])]
        """Units of the commands."""
        self.low: Array = np.concatenate([row.low for row in self._rows] or [np.zeros(0)])
        """Least commands, shape (size,)."""
        self.high: Array = np.concatenate([row.high for row in self._rows] or [np.zeros(0)])
        """Largest commands, shape (size,)."""
        self._commands = np.zeros((world.envs, self.size))
        self._efforts = np.zeros((world.envs, len(world.joint_names)))
        self._targets = np.array(world.drive_targets)
        self._velocities = np.tile(world._first_velocities, (world.envs, 1))
        self._exerts = any(row.actuator.exerts for row in self._rows)
        self._aims = any(not row.actuator.exerts for row in self._rows)
        # Where nothing depends on time or velocity, one setting holds for all steps.
        self._steady = not any(
            isinstance(work, (_Delayed, _Controlled)) or work.is_motor
            for row in self._rows for work in row.work)
        self._started(np.ones(world.envs, dtype=bool))

    @property
    def commands(self) -> Array:
        """What was commanded last, in `units`, shape (envs, size): a copy."""
        return self._commands.copy()

    @property
    def efforts(self) -> Array:
        """What was exerted in the last time step [N m or N], shape (envs, size): a copy. 0 where
        the asset's own drive works."""
        columns = [column for row in self._rows for column in row.columns]
        return self._efforts[:, columns]

    @property
    def numbers(self) -> dict[str, Array]:
        """Every number of every stage by "JOINT.Stage.number", shape (envs,): a copy."""
        found: dict[str, Array] = {}
        for row in self._rows:
            for stage, numbers in zip(row.actuator.stages, row.numbers):
                for name, held in numbers.held.items():
                    for i, joint in enumerate(row.names):
                        found[f"{joint}.{type(stage).__name__}.{name}"] = held[:, i].copy()
        return found

    def set_commands(self, values: npt.ArrayLike) -> None:
        """Commands in `units`, shape (envs, size) or what broadcasts to it, until the next ones.

        InvalidError where one is not finite: nothing changes then.
        """
        self._commands = finite("commands", values, self._commands.shape).copy()

    def set_other_targets(self, targets: Array) -> None:
        """Position targets of all drives (envs, drives) [rad or m]; those of drives that actuators
        aim with are passed over."""
        keep = [i for row in self._rows if not row.actuator.exerts
                for i in self._drives(row)]
        held = self._targets[:, keep].copy()
        self._targets = np.array(targets, dtype=np.float64)
        self._targets[:, keep] = held
        if not self._aims:
            self.world.set_drive_targets(self._targets)

    def step(self, count: int = 1) -> int:
        """Takes so many time steps, with new efforts in each; returns how many environments stand
        still (World.failures)."""
        failed, count = 0, counted("count", count)
        stride = count if self._steady else 1
        for _ in range(0, count, max(stride, 1)):
            self._act()
            failed = self.world._batch.step(stride)
        return failed

    def draw(self, env: SupportsIndex, random: np.random.Generator) -> None:
        """The numbers of one environment for its next episode; they count from reset() on."""
        for row in self._rows:
            for numbers in row.numbers:
                numbers.draw(self.world._env(env), random)

    def reset(self, envs: Any = None) -> None:
        """World.reset(), and actuators as new: `envs` as World.reset has them."""
        self.world.reset(envs)
        self.restarted(envs)

    def restarted(self, envs: Any = None) -> None:
        """For those that called World.reset() themselves."""
        mask = np.zeros(self.world.envs, dtype=bool)
        mask[environments(envs, self.world.envs)] = True
        self._started(mask)

    def _started(self, mask: npt.NDArray[np.bool_]) -> None:
        positions, _ = self.world._batch.joints()
        start = 0
        for row in self._rows:
            rest = row.rest(positions)
            part = slice(start, start + len(row.names))
            self._commands[mask, part] = rest[mask]
            start = part.stop
            command = rest
            for work in row.work:
                work.reset(mask, command)
                if isinstance(work, _Controlled):
                    command = np.zeros(row.shape)
            self._set_drives(row)
        self._efforts[mask] = 0
        self._targets[mask] = self.world._first_targets
        self._velocities[mask] = self.world._first_velocities

    def _set_drives(self, row: _Row) -> None:
        """The asset's own drives: off, or with the largest effort that was drawn."""
        for i, (name, joint) in enumerate(zip(row.names, row.joints)):
            for number, drive in enumerate(joint.drives):
                if row.actuator.exerts:
                    for gain in ("stiffness", "damping"):
                        if getattr(drive, gain) > 0:
                            parameter = "drive" + gain.capitalize()
                            self.world.set_parameter(parameter, name, OFF, number)
                elif row.most is not None:
                    self.world.set_parameter("driveMaxForce", name, row.most.held["effort"][:, i],
                                             number)

    def _drives(self, row: _Row) -> list[int]:
        return [self.world.drive_names.index(name) for name in row.names]

    def _act(self) -> None:
        positions, velocities = self.world._batch.joints()
        start = 0
        for row in self._rows:
            signal = self._commands[:, start:start + len(row.names)]
            start += len(row.names)
            at, speed = positions[:, row.columns], velocities[:, row.columns]
            for work in row.work:
                signal = work.apply(signal, at, speed)
            if row.actuator.exerts:
                # Of an environment that stands still there may be no number.
                self._efforts[:, row.columns] = np.where(np.isfinite(signal), signal, 0.0)
            elif row.actuator.command == "position":
                self._targets[:, self._drives(row)] = signal
            else:
                self._velocities[:, self._drives(row)] = signal
        if self._exerts:
            self.world._batch.set_efforts(self._efforts)
        if self._aims:
            self.world.set_drive_targets(self._targets, self._velocities)


def _unit_of(either: str, joint: Any) -> str:
    """"rad or m" of a joint is one of the two."""
    first, _, second = either.partition(" or ")
    along = joint.type == "prismatic" or any(drive.dof.startswith("trans")
                                             for drive in joint.drives)
    return second if along else first


__all__ = ["COMMANDS", "Actuator", "Actuators", "DCMotor", "Delay", "Number", "PD", "PID",
           "Saturation", "Stage"]
