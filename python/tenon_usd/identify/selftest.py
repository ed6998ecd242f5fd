# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A test with known truth: an asset with other parameters makes a log, with the noise of encoders,
and the parameters are identified from the asset as it is.

A trajectory that fits proves little: it also fits with a wrong joint, a wrong scale or parameters
that only appear together. Here each family is scored against what made the log.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import InvalidError, UnstableError
from ..world import World
from .description import describe, is_described
from .identifiable import Identifiability
from .log import Array, Log
from .model import INTEGRATORS, Model, inertia_of, is_stiff, largest_speed
from .parameters import FAMILIES, Parameter, Row, select, summed
from .solve import Shown, Solution, look, solve
from .stribeck import DECAY, RestFriction

#: What is identified where nothing is named.
DEFAULT_FAMILIES = ("friction", "damping", "armature", "stiffness", "driveDamping", "delay")
#: How far off each family may be: a part of the truth; of delays a part of the time step.
ALLOWED = {"friction": 0.05, "damping": 0.05, "armature": 0.05, "stiffness": 0.02,
           "driveDamping": 0.02, "delay": 0.5, "mass": 0.05, "maxForce": 0.02,
           "effortScale": 0.02, "offset": 0.05, "contactFriction": 0.1, "stribeck": 0.25,
           "stribeckSpeed": 0.25, "mimicRatio": 0.02, "velocityLimit": 0.02,
           "centerOfMassX": 0.1, "centerOfMassY": 0.1, "centerOfMassZ": 0.1,
           "secondMomentX": 0.1, "secondMomentY": 0.1, "secondMomentZ": 0.1}


#: Of their largest speed, how fast commands are; of their size, how small at the smallest.
MOST_SPEED, LEAST_SIZE = 0.6, 0.3


@dataclasses.dataclass(frozen=True)
class Sensors:
    """What a log loses: `counts` of encoders in a turn (of sliding joints: in a metre), deviation
    of the noise of positions [counts] and of efforts [part of their own deviation], `period` of
    samples [s]."""

    counts: int = 1 << 16
    noise: float = 0.5
    effort_noise: float = 0.01
    period: float = 0.004


@dataclasses.dataclass(frozen=True)
class Score:
    """One parameter: the truth, what was found with its interval of 95 % [SI, rad], how far off,
    and how far it may be."""

    parameter: Parameter
    truth: float
    found: float
    low: float
    high: float
    error: float
    allowed: float

    @property
    def passed(self) -> bool:
        return self.error <= self.allowed


@dataclasses.dataclass(frozen=True)
class SelfTest:
    """What came of it: scores of what was identified; what the log cannot tell, with the reasons;
    the log itself."""

    scores: tuple[Score, ...]
    refused: tuple[Parameter, ...]
    told: Identifiability
    solution: Solution
    log: Log
    step: float

    @property
    def passed(self) -> bool:
        return bool(self.scores) and all(score.passed for score in self.scores)


def commands(world: World, seed: int, duration: float, period: float, size: float = 1.0) -> Log:
    """Position commands of all drives that hold positions: sums of sines of other phases in each
    half, with soft steps, within the limits of joints, of their speeds too; `size` is a part of
    that. Raises InvalidError where no drive holds a position."""
    random = np.random.default_rng([seed, 1])
    times: Array = np.asarray(np.arange(0, duration + 0.5 * period, period), np.float64)
    scene, names = world.scene, world.drive_names
    start = dict(zip(world.joint_names, world.joint_positions[0]))
    followers = {joint.path for joint in scene.joints if len(joint.mimics)}
    joints, columns = [], []
    for path in names:
        joint = next(each for each in scene.joints if each.path == path)
        if joint.drives[0].stiffness <= 0 or path in followers or path not in start:
            continue
        low, high = _range(joint, float(start[path]))
        if not joint.lower <= start[path] <= joint.upper:
            start[path] = min(max(start[path], low), high)
        joints.append(path)
        made = _excited(random, times, low, high, float(start[path])) - start[path]
        fastest = float(np.abs(np.diff(made)).max()) / period
        part = size * min(1.0, MOST_SPEED * largest_speed(joint) / max(fastest, 1e-9))
        columns.append(start[path] + part * made)
    if not joints:
        raise InvalidError("the asset has no drive that holds a position, so that nothing would "
                           "move: give it drives (tenon drives)")
    # What follows is measured, too.
    measured = [*joints, *(path for path in world.joint_names if path in followers)]
    made = np.full((len(times), len(measured)), np.nan)
    made[:, :len(joints)] = np.stack(columns, axis=1)
    return Log(times, tuple(measured), position=np.zeros_like(made), command_position=made)


def _range(joint: Any, start: float) -> tuple[float, float]:
    reach = 0.05 if joint.type == "prismatic" else 0.6
    low = joint.lower if math.isfinite(joint.lower) and abs(joint.lower) < 1e6 else -math.inf
    high = joint.upper if math.isfinite(joint.upper) and abs(joint.upper) < 1e6 else math.inf
    if math.isfinite(low) and math.isfinite(high):
        margin = 0.15 * (high - low)
        low, high = low + margin, high - margin
        middle = min(max(start, low + 0.5 * min(2 * reach, high - low)),
                     high - 0.5 * min(2 * reach, high - low))
        return max(low, middle - reach), min(high, middle + reach)
    return start - reach, start + reach


def _excited(random: np.random.Generator, times: Array, low: float, high: float,
             start: float) -> Array:
    """Sines and soft steps between two bounds, from `start` on."""
    made = np.zeros_like(times)
    # From one half into the other within half a second, without a jump.
    later = 0.5 + 0.5 * np.sin(np.pi * np.clip((times - times[-1] / 2) / 0.5, -0.5, 0.5))
    for part in (1 - later, later):
        for frequency in np.geomspace(0.15, 2.5, 7):
            phase = random.uniform(0, 2 * np.pi)
            made += part * np.sin(2 * np.pi * frequency * random.uniform(0.9, 1.1) * times
                                  + phase) / frequency ** 0.5
    period = random.uniform(1.1, 1.7)
    made += 1.2 * np.tanh(3 * np.sin(2 * np.pi * times / period
                                     + random.uniform(0, 2 * np.pi)))
    made = (made - made.min()) / (made.max() - made.min())
    soft = np.clip(times / 0.5, 0, 1)
    return np.asarray(start + soft * (low + made * (high - low) - start))


def _give(world: World, parameters: Sequence[Parameter],
          values: Array) -> dict[str, dict[str, float]]:
    """Sets what a world has of the numbers. Returns others by family and path."""
    describe(world, parameters, np.asarray(values)[None])
    others = {family: dict[str, float]() for family, each in FAMILIES.items() if not each.sets}
    for parameter, value in zip(parameters, values):
        name = FAMILIES[parameter.family].sets
        for path, share in parameter.parts:
            if name and not is_described(parameter):
                world.set_parameter(name, path, share * value)
            elif not name:
                others[parameter.family][path] = value
    return others


def simulated(asset: Any, parameters: Sequence[Parameter], values: Array, commanded: Log, *,
              step: float, engine: str | None = None, touches: list[float] | None = None,
              **options: Any) -> Log:
    """The log that the asset with these numbers makes, without noise: commands hold until the next
    one and come late by the delay, in whole steps. It steps on its own, apart from the model of a
    fit. `touches` gets the times at which more touches than in the first step. As in a Model, an
    asset that is too stiff for rk4 goes without."""
    given: dict[str, Any] = {"step": step, "engine": engine, "touches": touches, **options}
    if "integrator" in options:
        return _simulated(asset, parameters, values, commanded, **given)
    plain = World(asset, engine, 1, time_step=step, **options)
    best = INTEGRATORS.get(plain.engine, "")
    try:
        return _simulated(asset, parameters, values, commanded, integrator=best, **given)
    except UnstableError:
        if not is_stiff(plain):
            raise
    if touches:
        touches.clear()
    return _simulated(asset, parameters, values, commanded, integrator="", **given)


def _simulated(asset: Any, parameters: Sequence[Parameter], values: Array, commanded: Log, *,
               step: float, engine: str | None, touches: list[float] | None, **options: Any
               ) -> Log:
    world = World(asset, engine, 1, time_step=step, outputs=["efforts"] + (
        [] if touches is None else ["contacts"]), **options)
    others = _give(world, parameters, values)
    delays, offsets = others["delay"], others["offset"]
    rest = _rest(world, parameters, values, others, step)
    assert commanded.command_position is not None
    joints = list(commanded.joints)
    columns = [world.joint_names.index(joint) for joint in joints]
    aimed = [(j, world.drive_names.index(joint), delays.get(joint, 0.0))
             for j, joint in enumerate(joints) if np.isfinite(commanded.command_position[0, j])]
    targets = world._targets.copy()
    shift = np.array([offsets.get(joint, 0.0) for joint in joints])
    now = _begin(world, commanded, columns, shift)
    place, speed, force = (np.full((len(commanded), len(joints)), np.nan) for _ in range(3))
    place[0], speed[0] = now[columns] + shift, 0.0
    at, first, steps = 1, 0, round(commanded.duration / step)
    before = np.concatenate([now[columns] + shift, np.zeros(len(joints))])
    for k in range(steps):
        time = k * step
        for column, drive, delay in aimed:
            late = round(delay / step) * step
            sample = max(0, int(np.searchsorted(commanded.times, time - late + 1e-9, "right")) - 1)
            targets[0, drive] = commanded.command_position[sample, column] - shift[column]
        world.set_drive_targets(targets)
        if rest is not None:
            world.set_efforts(rest.effort(world.joints()[1]))
        world.step()
        if touches is not None:
            count = int(world.contact_counts[0])
            first = count if k == 0 else first
            if count > first:
                touches.append(time)
        own, rate = world.joints()
        after = np.concatenate([own[0, columns] + shift, rate[0, columns]])
        while at < len(commanded) and commanded.times[at] <= time + step * (1 + 1e-9):
            part = min(max((commanded.times[at] - time) / step, 0), 1)
            mixed = (1 - part) * before + part * after
            place[at], speed[at] = mixed[:len(joints)], mixed[len(joints):]
            at += 1
        before = after
    for column, _, delay in aimed:
        law = world.scene.joints[world.joint_paths.index(joints[column])].drives[0]
        number = {"stiffness": law.stiffness, "driveDamping": law.damping,
                  "maxForce": law.max_force}
        number |= {each.family: value for each, value in zip(parameters, values)
                   if joints[column] in each.paths}
        force[:, column] = _exerted(number, commanded, column, round(delay / step) * step,
                                    place[:, column], speed[:, column])
    return dataclasses.replace(commanded, position=place, velocity=speed, effort=force,
                               source="self-test")


def _rest(world: World, parameters: Sequence[Parameter], values: Array,
          others: dict[str, dict[str, float]], step: float) -> RestFriction | None:
    """Of all coordinates: (1, joints)."""
    if not others["stribeck"]:
        return None
    names = world.joint_names
    extra, decay = (np.array([[others[family].get(name, usual) for name in names]])
                    for family, usual in (("stribeck", 0.0), ("stribeckSpeed", DECAY)))
    inertia = inertia_of(world)
    for each, value in zip(parameters, values):
        if each.family == "armature" and each.paths[0] in inertia:
            inertia[each.paths[0]] += value - each.nominal
    return RestFriction(extra, decay, np.array([[inertia.get(name, np.inf) for name in names]]),
                        step)


def _begin(world: World, commanded: Log, columns: list[int], shift: Array) -> Array:
    """Where all joints begin: as in the asset, but for those that are outside of their limits
    there, which would be thrown back: they begin where they are told to be. Shape (joints,)."""
    now = np.array(world.joint_positions[0])
    assert commanded.command_position is not None
    moved = False
    for j, column in enumerate(columns):
        joint = next(each for each in world.scene.joints if each.path == commanded.joints[j])
        aim = commanded.command_position[0, j] - shift[j]
        if np.isfinite(aim) and not joint.lower <= now[column] <= joint.upper:
            now[column], moved = aim, True
    if moved:
        world.set_joints(now[None], np.zeros((1, len(now))))
    return now


def _exerted(number: dict[str, float], commanded: Log, column: int, late: float, place: Array,
             speed: Array) -> Array:
    """What a drive exerts by its law, on commands that are late."""
    assert commanded.command_position is not None
    before_it = np.searchsorted(commanded.times, commanded.times - late - 1e-9) - 1
    aim = commanded.command_position[np.maximum(before_it, 0), column]
    asked = number["stiffness"] * (aim - place) - number["driveDamping"] * speed
    return np.asarray(np.clip(asked, -number["maxForce"], number["maxForce"]))


def measured(log: Log, sensors: Sensors, seed: int, sliding: Sequence[str] = ()) -> Log:
    """A log as sensors have it: positions rounded to counts, speeds of them, noise."""
    random = np.random.default_rng([seed, 2])
    assert log.position is not None and log.effort is not None
    place = log.position.copy()
    for column, joint in enumerate(log.joints):
        count = (1.0 if joint in sliding else 2 * np.pi) / sensors.counts
        noisy = place[:, column] + sensors.noise * count * random.standard_normal(len(log))
        place[:, column] = np.round(noisy / count) * count
    effort = log.effort.copy()
    size = np.array([np.nanstd(effort[:, j]) if np.isfinite(effort[:, j]).any() else 0.0
                     for j in range(effort.shape[1])])
    effort += sensors.effort_noise * size * random.standard_normal(effort.shape)
    return dataclasses.replace(log, position=place, velocity=None, effort=effort)


def perturbed(parameters: Sequence[Parameter], seed: int, step: float, finer: int = 1) -> Array:
    """Other numbers than the asset's: what it has times 0.6 to 1.6, else a part of the scale.
    Delays are whole steps of the log, `finer` in one of the model."""
    random = np.random.default_rng([seed, 3])
    made = np.empty(len(parameters))
    for at, parameter in enumerate(parameters):
        part = random.uniform(0.6, 1.6)
        if parameter.family == "delay":
            made[at] = round(6 * part * finer) * step / finer
        elif parameter.family == "offset":
            made[at] = parameter.scale * (part - 1)
        elif parameter.is_place:
            made[at] = parameter.nominal + parameter.scale * (part - 1)
        elif parameter.family == "mimicRatio":
            made[at] = parameter.nominal * (0.8 + 0.25 * part)
        elif parameter.nominal > 0 and math.isfinite(parameter.nominal):
            made[at] = parameter.nominal * part
        else:
            made[at] = parameter.scale * part
        made[at] = min(max(made[at], parameter.low), parameter.high)
    return made


def self_test(asset: Any, rows: Sequence[Row] = (), *, engine: str | None = None, seed: int = 0,
              duration: float = 10.0, step: float = 0.0, finer: int = 4,
              sensors: Sensors | None = None, solver: str = "gauss-newton", window: float = 0.0,
              threads: int = 0, shown: Shown | None = None, **options: Any) -> SelfTest:
    """Makes a log with other parameters at a time step `finer` times smaller, identifies them from
    the asset, and compares. What the log cannot tell is held at the truth, and named."""
    sensors = sensors or Sensors()
    world = World(asset, engine, 1, time_step=step, **options)
    step = world.time_step
    commanded, plain = _clear(asset, world, seed, duration, sensors.period, engine, options)
    about = Model(asset, plain, engine=engine, step=step, window=duration, threads=threads,
                  **options)
    single = select(rows or [Row(family) for family in DEFAULT_FAMILIES], about.plant, plain,
                    sums=False)
    real = perturbed(single, seed, step, finer)
    sliding = [joint.path for joint in world.scene.joints if joint.type == "prismatic"]
    log = measured(simulated(asset, single, real, commanded, step=step / finer, engine=engine,
                             **options), sensors, seed, sliding)
    parameters = summed(single, about.plant)
    known = {(each.family, path): value for each, value in zip(single, real)
             for path in each.paths}
    truth = np.array([sum(weight * known[each.family, path] for path, weight in
                          zip(each.paths, each.weights or (1.0,))) for each in parameters])
    model = Model(asset, log, engine=engine, step=step, window=window, threads=threads, **options)
    told = look(model, parameters)
    refused = tuple(parameters[i] for i in told.refused)
    fitted = [each if i not in told.refused else
              dataclasses.replace(each, prior=float(truth[i]), deviation=0.0, start=float(truth[i]))
              for i, each in enumerate(parameters)]
    solution = solve(model, fitted, solver=solver, seed=seed, shown=shown)
    scores = []
    for at, (parameter, real) in enumerate(zip(parameters, truth)):
        if at not in told.refused:
            scores.append(_score(parameter, float(real), solution, at, step))
    return SelfTest(tuple(scores), refused, told, solution, log, step)


def _clear(asset: Any, world: World, seed: int, duration: float, period: float,
           engine: str | None, options: dict[str, Any]) -> tuple[Log, Log]:
    """Commands, and what the asset does with them: smaller ones until nothing touches that does
    not at the start. What touches moves otherwise at every time step."""
    size = 1.0
    while True:
        touches: list[float] = []
        commanded = commands(world, seed, duration, period, size)
        plain = simulated(asset, [], np.zeros(0), commanded, step=world.time_step, engine=engine,
                          touches=touches, **options)
        if not touches or size < LEAST_SIZE:
            return commanded, plain
        size *= 0.8


def _score(parameter: Parameter, truth: float, solution: Solution, at: int, step: float) -> Score:
    found, low, high = (float(each[at]) for each in (solution.values, solution.low, solution.high))
    apart = abs(found - truth)
    whole = step if parameter.family == "delay" else (
        parameter.scale if parameter.is_place else abs(truth))
    return Score(parameter, truth, found, low, high, apart / whole, ALLOWED[parameter.family])
