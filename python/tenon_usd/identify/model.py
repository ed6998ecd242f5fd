# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What an asset would have done in place of the robot: a log's commands, simulated in windows that
begin where the robot was, for many sets of parameters at the same time.

Each environment of a World is one window with one set of parameters. Commands hold until the next
one; a command that changes within a time step counts by the part of the step, so that what comes
out changes smoothly with delays.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .. import _tenon
from ..dynamics import Dynamics
from ..errors import Error, InvalidError, NotFoundError, UnsupportedError
from ..options import PathLike
from ..world import World
from .description import describe, follow, is_described
from .log import Array, Log
from .parameters import FAMILIES, NO_LIMIT, Parameter, Plant, plant_of
from .states import closed, initial_states
from .stribeck import DECAY, RestFriction, resisted

#: Steps, and parts of the way to the next ones.
Places = tuple[npt.NDArray[np.int64], Array]
#: Environments of one world, and numbers that the states of one run may take.
MAX_ENVS, MAX_NUMBERS = 2048, 1 << 26
MAX_STEPS = 20_000_000
#: Of the time between samples, how exactly a log tells which came first, a sample or a command.
CLOCK = 0.1
#: Of its largest speed, from where on a drive counts as held back by it.
NEAR_LIMIT = 0.9
#: Below so many environments threads cost more than they save.
FEW_ENVS = 64
#: Lengths of windows [s]. Each begins with an error of the state, from which drives bring a joint
#: back, while under efforts alone it grows.
WINDOW, OPEN_WINDOW = 4.0, 0.5
#: Time constants until what a window begins with is forgotten, and the part of it that is at most
#: skipped for that.
FORGOTTEN, MOST_LEFT_OUT = 4.0, 0.25
#: The integrator of highest order of an engine, where it can be chosen, and the part of its speed
#: that damping may take from a joint within a step: an explicit one becomes unstable beyond.
INTEGRATORS = {"mujoco": "rk4"}
MOST_DAMPED = 1.0
#: What is compared, in this order.
CHANNELS = ("position", "velocity", "effort")


@dataclasses.dataclass(frozen=True)
class Windows:
    """Parts of a log, each of which begins with a reset to the state that the log has there."""

    first: npt.NDArray[np.int64]
    """Sample where each begins, shape (W,)."""
    samples: int
    """How many samples each has, the first one included."""

    def __len__(self) -> int:
        return len(self.first)


def windows_of(log: Log, length: float, parts: Sequence[int] = (0,)) -> Windows:
    """Windows of about so many seconds, one behind the other, in each of the parts of a log that
    begin at the samples `parts`. Raises InvalidError where no part is that long."""
    ends = [*parts[1:], len(log)]
    longest = max(end - begin - 1 for begin, end in zip(parts, ends))
    samples = max(2, round(length / max(log.step, 1e-9)))
    samples = min(samples, longest)
    samples = max(2, longest // max(1, longest // samples))
    first = [begin + k * samples for begin, end in zip(parts, ends)
             for k in range((end - begin - 1) // samples)]
    if not first:
        raise InvalidError(f"the log has {len(log)} samples; a window takes at least 3")
    return Windows(np.array(first, dtype=np.int64), samples + 1)


def joined_logs(logs: Sequence[Log]) -> tuple[Log, tuple[int, ...]]:
    """Several logs of the same joints behind each other, a second apart, and the sample at which
    each begins. Raises InvalidError where joints or signals differ."""
    first = logs[0]
    if len(logs) == 1:
        return first, (0,)
    made: dict[str, list[Array]] = {name: [] for name in first.signals}
    times, parts, at, count = [], [], 0.0, 0
    for log in logs:
        if set(log.joints) != set(first.joints) or log.signals != first.signals:
            raise InvalidError(f"{log.source or 'a log'} has other joints or signals than "
                               f"{first.source or 'the first'}: identify them one by one")
        own = log.select(first.joints)
        times.append(own.times - own.times[0] + at)
        at = float(times[-1][-1]) + 1.0
        parts.append(count)
        count += len(own)
        for name in first.signals:
            made[name].append(getattr(own, name))
    joined: dict[str, Any] = {name: np.concatenate(values) for name, values in made.items()}
    return Log(np.concatenate(times), first.joints, source=first.source, **joined), tuple(parts)


class Held:
    """A command that holds until the next one, and its mean over time steps."""

    def __init__(self, times: Array, values: Array) -> None:
        good = np.isfinite(values)
        self.times, values = times[good], values[good]
        self.values = values
        self.first, self.last = float(values[0]), float(values[-1])
        self.whole = np.concatenate([[0.0], np.cumsum(values[:-1] * np.diff(self.times))])

    def integral(self, times: Array) -> Array:
        """Of the command from its first time on, up to `times` [s]."""
        at = np.interp(times, self.times, self.whole)
        at += self.first * np.minimum(times - self.times[0], 0)
        return np.asarray(at + self.last * np.maximum(times - self.times[-1], 0))

    def at(self, times: Array) -> Array:
        """The command at `times` [s]."""
        place = np.searchsorted(self.times, times, side="right") - 1
        return np.asarray(self.values[np.maximum(place, 0)])

    def means(self, edges: Array) -> Array:
        """Means between neighbours of `edges` [s]; shape (len(edges) - 1,)."""
        return np.asarray(np.diff(self.integral(edges)) / np.diff(edges))


def has(values: Array | None, column: int) -> bool:
    """Whether a signal of a log has numbers of a joint."""
    return values is not None and bool(np.isfinite(values[:, column]).any())


class Model:
    """An asset beside a log.

    `engine` is a name as of tenon_usd.engines(); `step` [s] the time step, 0: the asset's; `window`
    the length of windows [s], 0: WINDOW, or of efforts that are commanded OPEN_WINDOW; `parts` the
    samples at which parts of the log begin. MuJoCo steps with rk4, so that what is found does not
    depend on the time step, except assets that become unstable with it. Raises errors of
    tenon_usd.errors: InvalidError where the log has no positions, or joints and commands that the
    asset has no place for; UnsupportedError where the engine cannot begin at the log's states.
    """

    def __init__(self, asset: PathLike | _tenon.Stage, log: Log, *, engine: str | None = None,
                 step: float = 0.0, window: float = 0.0, threads: int = 0,
                 parts: Sequence[int] = (0,), **options: Any) -> None:
        if log.position is None:
            raise InvalidError("the log has no positions of joints")
        self.log = log
        self._given: dict[str, Any] = {"engine": engine, "window": window, "threads": threads,
                                       "parts": parts, **options}
        self._asset = asset
        self._reads_efforts = False
        world = World(asset, engine, 1, threads=1, time_step=step, **options)
        self.engine, self.step = world.engine, world.time_step
        chosen = options.setdefault("integrator", INTEGRATORS.get(self.engine, ""))
        self._make: Any = lambda envs: World(
            asset, engine, envs, threads=threads or (1 if envs < FEW_ENVS else 0), time_step=step,
            outputs=["efforts"] if self._reads_efforts else [], **options)
        self._worlds: dict[tuple[int, bool], World] = {}
        self.scene = world.scene
        self.parts = tuple(parts)
        self.columns = self._columns(world)
        self.plant = plant_of(world, inertia_of(world))
        self._find_commands(world)
        self.windows = windows_of(
            log, window or (OPEN_WINDOW if self._pushed else WINDOW), parts)
        self._initial = initial_states(log, self.windows.first)
        self._starts(world)
        length = log.times[np.minimum(self.windows.first + self.windows.samples - 1,
                                      len(log) - 1)] - log.times[self.windows.first]
        self.steps = max(1, math.ceil(float(length.max()) / self.step - 1e-6))
        if self.steps * len(self.windows) > MAX_STEPS:
            raise InvalidError(f"{log.duration:g} s at {self.step:g} s take "
                               f"{self.steps * len(self.windows)} steps, of {MAX_STEPS} at most: "
                               "take a part of the log, or a longer time step")
        self._samples()
        if "integrator" not in self._given and chosen and is_stiff(world) and not np.isfinite(
                self.predict([], np.zeros((1, 0)))["position"]).all():
            options["integrator"] = ""
            self._worlds.clear()

    # ---- what there is

    def finer(self, times: int = 2) -> Model:
        """The same with a time step so many times smaller. Raises what the class does."""
        return Model(self._asset, self.log, step=self.step / times, **self._given)

    def world(self, envs: int, described: bool = False) -> World:
        """A world of so many environments, made once; another one where numbers of its description
        change."""
        if (envs, described) not in self._worlds:
            self._worlds[envs, described] = self._make(envs)
        return self._worlds[envs, described]

    def _columns(self, world: World) -> list[int]:
        names = world.joint_names
        missing = [joint for joint in self.log.joints if joint not in names]
        if missing:
            raise NotFoundError(f"the asset has no joint {missing[0]}; it has "
                                + ", ".join(names[:8]) + (" ..." if len(names) > 8 else ""))
        return [names.index(joint) for joint in self.log.joints]

    def _find_commands(self, world: World) -> None:
        """Which command goes to which drive or joint."""
        log, drives = self.log, world.drive_names
        self._aimed: list[tuple[int, int, Held | None, Held | None]] = []
        self._pushed: list[tuple[int, int, Held]] = []
        self._driven = dict[int, int]()
        for column, joint in enumerate(log.joints):
            by_effort = has(log.command_effort, column)
            place, speed = (Held(log.times, values[:, column]) if values is not None
                            and has(values, column) else None
                            for values in (log.command_position, log.command_velocity))
            if joint in drives:
                self._driven[column] = drives.index(joint)
            if place is not None or speed is not None:
                if joint not in drives:
                    raise InvalidError(
                        f"the log commands a position of {joint}, and the asset has no drive there "
                        "that takes it: give it one first (tenon drives), or log the efforts")
                self._aimed.append((column, drives.index(joint), place, speed))
            elif by_effort:
                assert log.command_effort is not None
                self._pushed.append((column, self.columns[column],
                                     Held(log.times, log.command_effort[:, column])))
        self._reads_efforts = any(not is_plain(self.plant.drives[log.joints[column]])
                                  for column in self._driven)
        if not self._aimed and not self._pushed:
            raise InvalidError("the log has no commands: what moved the joints is not known")

    def _starts(self, world: World) -> None:
        """Start states of all coordinates of the asset: the log's, followers where their leaders
        say, others where the asset starts."""
        names, scene = world.joint_names, world.scene
        positions = np.tile(world.joint_positions[0], (len(self.windows), 1))
        velocities = np.zeros_like(positions)
        own, speed = self._initial
        for column, coordinate in enumerate(self.columns):
            good = np.isfinite(own[:, column])
            positions[good, coordinate] = own[good, column]
            velocities[good, coordinate] = speed[good, column]
        follow(scene, names, self.log.joints, positions, velocities, [], np.zeros((1, 0)))
        self.start = closed(world, self.log, positions, velocities)

    def _samples(self) -> None:
        """Where the samples of windows are in time, and what the log has there."""
        log, windows = self.log, self.windows
        at = windows.first[:, None] + np.arange(windows.samples)[None, :]
        self.at = np.minimum(at, len(log) - 1)
        since = log.times[self.at] - log.times[windows.first][:, None]
        place = np.clip(since / self.step, 0, self.steps)
        self._places = {"position": _neighbours(place, self.steps - 1)}
        self._places["velocity"] = self._places["position"]
        # The mean effort of a step is that of its middle.
        self._places["effort"] = _neighbours(np.clip(place + 0.5, 1, self.steps), self.steps - 1)
        assert log.position is not None
        speeds = np.abs(np.gradient(log.position, log.times, axis=0)
                        if log.velocity is None else log.velocity)
        #: (W, samples, N) for each channel that is compared; NaN where there is nothing.
        self.measured: dict[str, Array] = {}
        for name in CHANNELS:
            values = getattr(log, name)
            if values is None:
                continue
            taken = values[self.at].copy()
            # The state at the start is the log's, with its error.
            taken[:, :1 + int(self._memory() / max(log.step, 1e-9))] = np.nan
            for column in range(len(log.joints)):
                if name == "effort" and (column not in self._driven or any(
                        each[0] == column for each in self._pushed)):
                    taken[:, :, column] = np.nan
                elif name == "effort":
                    # What holds a drive back at its largest speed is not in its law.
                    most = NEAR_LIMIT * largest_speed(self.plant.joints[log.joints[column]])
                    taken[..., column][speeds[self.at][..., column] > most] = np.nan
            if np.isfinite(taken).any():
                self.measured[name] = taken

    def _memory(self) -> float:
        """How long an error of the state at the start of a window counts [s]: drives bring joints
        back, the slowest of them last."""
        longest = 0.0
        for column, _, place, _ in self._aimed:
            joint = self.log.joints[column]
            drive, inertia = self.plant.drives[joint], self.plant.inertia.get(joint, 0.0)
            if place is None or drive.type or drive.stiffness <= 0:
                continue
            damping = drive.damping + self.plant.joints[joint].damping
            root = damping ** 2 - 4 * inertia * drive.stiffness
            constant = 2 * inertia / damping if root <= 0 < damping else (
                (damping + math.sqrt(max(root, 0.0))) / (2 * drive.stiffness))
            longest = max(longest, constant)
        return min(FORGOTTEN * longest,
                   MOST_LEFT_OUT * self.windows.samples * self.log.step)

    # ---- simulation

    def predict(self, parameters: list[Parameter], sets: Array, clock: Array | None = None
                ) -> dict[str, Array]:
        """What the joints do: `sets` (S, P) -> for each channel of `measured` an array (S, W,
        samples, N); NaN where the simulation became unstable. Efforts at a sample are those of the
        command that counts there by the delays of `clock` (S, P); None: of `sets`."""
        sets = np.atleast_2d(sets)
        clock = sets if clock is None else clock
        wide = len(self.windows)
        numbers = self.steps * wide * len(self.log.joints) * 3
        together = max(1, min(len(sets), MAX_ENVS // max(wide, 1), MAX_NUMBERS // max(numbers, 1)))
        parts = []
        for begin in range(0, len(sets), together):
            chunk = np.stack([each[begin:begin + together] for each in (sets, clock)])
            rows = chunk.shape[1]
            if rows < together:  # worlds are made once
                chunk = np.concatenate(
                    [chunk, np.repeat(chunk[:, -1:], together - rows, axis=1)], axis=1)
            made = self._run(parameters, chunk[0], chunk[1])
            parts.append({name: values[:rows] for name, values in made.items()})
        return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}

    def check(self, parameters: list[Parameter]) -> list[tuple[Parameter, str]]:
        """Those that the engine cannot set while it runs, with the reason."""
        refused = []
        world = self.world(1, True)
        world.reset()
        for parameter in parameters:
            try:
                start = np.array([parameter.start])
                if not describe(world, [parameter], start[None]):
                    self._set(world, parameter, start)
            except Error as error:
                refused.append((parameter, str(error)))
        return refused

    def _set(self, world: World, parameter: Parameter, values: Array) -> None:
        name = FAMILIES[parameter.family].sets
        if name and not is_described(parameter):
            for path, share in parameter.parts:
                if share:  # of a sum; the others stay 0, which not every engine can set
                    world.set_parameter(name, path, share * values)

    def _special(self, parameters: list[Parameter], sets: Array, family: str,
                 rest: float) -> Array:
        """Numbers of one family for each set and joint of the log: (S, N)."""
        made = np.full((len(sets), len(self.log.joints)), rest)
        for at, parameter in enumerate(parameters):
            if parameter.family == family:
                for path in parameter.paths:
                    made[:, self.log.joints.index(path)] = sets[:, at]
        return made

    def _run(self, parameters: list[Parameter], sets: Array, clock: Array) -> dict[str, Array]:
        wide, count = len(self.windows), len(sets)
        world = self.world(count * wide, any(map(is_described, parameters)))
        if not describe(world, parameters, np.repeat(sets, wide, axis=0)):
            world.reset()
        for at, parameter in enumerate(parameters):
            self._set(world, parameter, np.repeat(sets[:, at], wide))
        offsets = self._special(parameters, sets, "offset", 0.0)
        scales = self._special(parameters, sets, "effortScale", 1.0)
        positions = np.tile(self.start[0], (count, 1))
        for column, coordinate in enumerate(self.columns):
            positions[:, coordinate] -= np.repeat(offsets[:, column], wide)
        velocities = np.tile(self.start[1], (count, 1))
        if any(each.family == "mimicRatio" for each in parameters):
            follow(self.scene, world.joint_names, self.log.joints, positions, velocities,
                   parameters, np.repeat(sets, wide, axis=0))
        try:
            world.set_joints(positions, velocities)
        except UnsupportedError as error:
            raise UnsupportedError(f"{self.engine} cannot begin at the states of the log: "
                                   f"{error}") from None
        first = self._where(world)
        targets = self._targets(world, sets, parameters, offsets)
        efforts = self._efforts(world, sets, parameters, scales)
        rest = self._rest(parameters, sets)
        if rest is not None and efforts is None:
            none = np.zeros((1, world.envs, len(world.joint_names)))
            efforts = np.broadcast_to(none, (self.steps, *none.shape[1:]))
        states = self._step(world, first, targets, efforts, rest)
        made = {}
        for name, values in states.items():
            made[name] = self._sampled(values, count, self._places[name])
        if "effort" in made:
            delays = self._special(parameters, clock, "delay", 0.0)
            self._lawful_efforts(world, parameters, sets, offsets, delays, made)
            made["effort"] *= scales[:, None, None, :]
        made["position"] += offsets[:, None, None, :]
        return {name: made[name] for name in self.measured}

    def _rest(self, parameters: list[Parameter], sets: Array) -> RestFriction | None:
        if not any(each.family == "stribeck" for each in parameters):
            return None
        own = np.array([self.plant.inertia.get(joint, 0.0) for joint in self.log.joints])
        named = np.array([self.plant.joints[joint].armature for joint in self.log.joints])
        armature = self._special(parameters, sets, "armature", np.nan)
        inertia = np.maximum(np.where(np.isnan(armature), own, own - named + armature), 1e-9)
        return RestFriction(self._special(parameters, sets, "stribeck", 0.0),
                            self._special(parameters, sets, "stribeckSpeed", DECAY), inertia,
                            self.step).rows(len(self.windows))

    def _lawful_efforts(self, world: World, parameters: list[Parameter], sets: Array,
                        offsets: Array, delays: Array, made: dict[str, Array]) -> None:
        """What drives exert at the moment of each sample, by their law: what an engine tells is
        the mean of a step, in which the command may have changed."""
        aims = {column: (position, velocity) for column, _, position, velocity in self._aimed}
        for column, drive in self._driven.items():
            law = self.plant.drives[self.log.joints[column]]
            if not is_plain(law):
                continue
            stiffness, damping, most = (
                self._special(parameters, sets, family, value)[:, column, None, None]
                for family, value in (("stiffness", law.stiffness), ("driveDamping", law.damping),
                                      ("maxForce", law.max_force)))
            position, velocity = aims.get(column, (None, None))
            forces = []
            for shift in (-CLOCK * self.log.step, CLOCK * self.log.step):
                place = world._first_targets[drive] if position is None else self._now(
                    position, delays[:, column] - shift) - offsets[:, column, None, None]
                speed = world._first_velocities[drive] if velocity is None else self._now(
                    velocity, delays[:, column] - shift)
                force = (stiffness * (place - made["position"][..., column])
                         + damping * (speed - made["velocity"][..., column]))
                forces.append(np.clip(force, -most, most))
            # Where commands change right at the samples either may have been measured: the same one
            # all over a window, for the nearer one of each sample would make up for wrong numbers.
            scale = self._special(parameters, sets, "effortScale", 1.0)[:, column, None, None]
            real = self.measured["effort"][None, :, :, column] / scale
            apart = [np.nansum(np.abs(force - real), axis=2, keepdims=True) for force in forces]
            made["effort"][..., column] = np.where(apart[1] < apart[0], forces[1], forces[0])

    def _now(self, held: Held, delays: Array) -> Array:
        """A command at the samples: (S, W, samples)."""
        times = self.log.times[self.at]
        return np.stack([held.at(times - delay) for delay in delays])

    def _where(self, world: World) -> dict[str, Array]:
        own, speed = world._batch.joints()
        return {"position": own[:, self.columns], "velocity": speed[:, self.columns],
                "effort": np.zeros((world.envs, len(self.columns)))}

    def _edges(self, window: int) -> Array:
        begin = self.log.times[self.windows.first[window]]
        return np.asarray(begin + self.step * np.arange(self.steps + 1))

    def _over(self, held: Held, delays: Array) -> Array:
        """A command in each window and set: (steps, S * W)."""
        wide = len(self.windows)
        made = np.empty((self.steps, len(delays), wide))
        known: dict[float, Array] = {}
        for at, delay in enumerate(delays):
            if delay not in known:
                known[delay] = np.stack([held.means(self._edges(w) - delay) for w in range(wide)],
                                        axis=1)
            made[:, at] = known[delay]
        return made.reshape(self.steps, -1)

    def _targets(self, world: World, sets: Array, parameters: list[Parameter],
                 offsets: Array) -> tuple[Array, Array] | None:
        """Targets of all drives, each (steps, envs, drives)."""
        if not self._aimed:
            return None
        delays = self._special(parameters, sets, "delay", 0.0)
        shape = (self.steps, world.envs, len(world.drive_names))
        places = np.broadcast_to(world._targets, shape).copy()
        speeds = np.broadcast_to(world._target_velocities, shape).copy()
        wide = len(self.windows)
        for column, drive, position, velocity in self._aimed:
            if position is not None:
                places[:, :, drive] = self._over(position, delays[:, column]) - np.repeat(
                    offsets[:, column], wide)
            if velocity is not None:
                speeds[:, :, drive] = self._over(velocity, delays[:, column])
        return places, speeds

    def _efforts(self, world: World, sets: Array, parameters: list[Parameter],
                 scales: Array) -> Array | None:
        """Efforts along all coordinates (steps, envs, joints)."""
        if not self._pushed:
            return None
        delays = self._special(parameters, sets, "delay", 0.0)
        made = np.zeros((self.steps, world.envs, len(world.joint_names)))
        for column, coordinate, held in self._pushed:
            made[:, :, coordinate] = self._over(held, delays[:, column]) / np.repeat(
                scales[:, column], len(self.windows))
        return made

    def _step(self, world: World, first: dict[str, Array], targets: tuple[Array, Array] | None,
              efforts: Array | None, rest: RestFriction | None) -> dict[str, Array]:
        """The states after each step, the start included: (steps + 1, envs, N) by channel."""
        effort = "effort" in self.measured
        wanted = [name for name in CHANNELS if name == "position" or effort
                  or name in self.measured]
        made = {name: np.empty((self.steps + 1, *first[name].shape)) for name in wanted}
        for name in wanted:
            made[name][0] = first[name]
        batch = world._batch
        drives = [(column, drive) for column, drive in self._driven.items()
                  if not is_plain(self.plant.drives[self.log.joints[column]])]
        columns, places, speeds = _as_slice(self.columns), made["position"], made.get("velocity")
        changed = _changes(targets, self.steps)
        turning = first["velocity"]
        for k in range(self.steps):
            if targets is not None and changed[k]:
                batch.set_targets(targets[0][k], targets[1][k])
            if efforts is not None:
                batch.set_efforts(resisted(efforts[k], rest, columns, turning))
            batch.step(1)
            own, speed = batch.joints()
            turning = speed[:, columns]
            places[k + 1] = own[:, columns]
            if speeds is not None:
                speeds[k + 1] = turning
            if effort and drives:
                force = batch.drive_efforts()
                for column, drive in drives:
                    made["effort"][k + 1, :, column] = force[:, drive]
        lost = [at for at, failure in enumerate(batch.failures()) if failure is not None]
        for values in made.values():
            values[:, lost] = np.nan
        return made

    def _sampled(self, states: Array, count: int, places: Places) -> Array:
        """States of all steps at the times of the samples: (S, W, samples, N)."""
        wide = len(self.windows)
        by_set = states.reshape(self.steps + 1, count, wide, -1)
        made = np.empty((count, wide, self.windows.samples, states.shape[-1]))
        for w in range(wide):
            before, part = places[0][w], places[1][w][:, None, None]
            with np.errstate(invalid="ignore", over="ignore"):  # of what became unstable
                made[:, w] = np.moveaxis((1 - part) * by_set[before, :, w]
                                         + part * by_set[before + 1, :, w], 0, 1)
        return made


def _as_slice(columns: list[int]) -> slice | list[int]:
    """Of columns next to each other their slice, which NumPy takes many times faster."""
    first = columns[0]
    together = columns == list(range(first, first + len(columns)))
    return slice(first, first + len(columns)) if together else columns


def _changes(targets: tuple[Array, Array] | None, steps: int) -> list[bool]:
    """Whether targets are others than those of the step before."""
    made = np.ones(steps, dtype=bool)
    if targets is not None:
        made[1:] = np.any([np.any(each[1:] != each[:-1], axis=(1, 2)) for each in targets], axis=0)
    return [bool(each) for each in made]


def is_stiff(world: World) -> bool:
    """Whether damping takes so much within a time step that INTEGRATORS may become unstable; where
    friction holds such joints they do not."""
    inertia = inertia_of(world)
    return any((joint.damping + sum(each.damping for each in joint.drives[:1])) * world.time_step
               > MOST_DAMPED * inertia.get(joint.path, math.inf) for joint in world.scene.joints)


def is_plain(drive: Any) -> bool:
    """Whether a drive exerts what its gains say, up to its maxForce, whatever it has to move and,
    below its largest speed, however fast it is."""
    return not drive.type and drive.speed_effort_gradient == 0


def largest_speed(joint: Any) -> float:
    """Of a joint with its drive [rad/s or m/s]; infinite where nothing limits it."""
    limits = [joint.velocity_limit, *(drive.max_velocity for drive in joint.drives[:1])]
    return min((float(limit) for limit in limits if limit is not None and 0 < limit < NO_LIMIT),
               default=math.inf)


def _neighbours(place: Array, last: int) -> Places:
    """The step before each place and what part of the way to the next one it is."""
    before = np.minimum(place.astype(np.int64), last)
    return before, np.asarray(place - before)


def inertia_of(world: World) -> dict[str, float]:
    """What each joint has to accelerate with the others held [kg m^2 or kg]."""
    try:
        dynamics = Dynamics(world.scene)
        held, _ = dynamics.effective_inertia()
    except Error:
        return {}
    return {each.joint: float(value) for each, value in zip(dynamics.coordinates, held)
            if each.joint and math.isfinite(value)}


__all__ = ["Array", "CHANNELS", "Held", "Model", "Plant", "Windows", "has", "windows_of"]
