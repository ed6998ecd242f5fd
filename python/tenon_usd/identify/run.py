# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Identification from beginning to end: logs and an asset in; numbers with intervals, what the log
could not tell, and what they are worth on motion that was held out.

    found = identify("arm.usda", [log], rows)
    if found.improved: ...
"""

from __future__ import annotations

import contextlib
import dataclasses
import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..errors import Error, InvalidError
from ..functions import engines as all_engines
from .identifiable import Identifiability, reasons
from .joints import asset_joints
from .linear import smoothed
from .log import Array, Log
from .model import CHANNELS, Model, has, joined_logs
from .overlay import temporary_overlay
from .parameters import FAMILIES, Parameter, Row, select
from .quality import Quality, assess
from .selftest import DEFAULT_FAMILIES
from .solve import Shown, Solution, look, solve
from .starts import Task, solve_many

#: Of what a joint does beside its command, or of its effort, the part that may stay unexplained
#: before the log counts as one of another robot.
UNEXPLAINED = 0.35
#: Correlation of a joint with its own command, below which another's is looked for.
FOLLOWS = 0.7
#: Of the squares of efforts, what a drive explains at least where their sign is clear, and the
#: longest delay that is tried [s].
CLEAR, LONGEST = 0.8, 0.1
#: Fits parameters; the costs are those of Identified.
Solved = Callable[[list[Parameter]], tuple[Solution, Array]]


class RefusedError(Error):
    """Parameters that the log does not tell, or a log that is not of this asset: `lines` say why,
    each with what to do."""

    def __init__(self, lines: Sequence[str], diagnostics: Any = ()) -> None:
        self.lines = (lines,) if isinstance(lines, str) else tuple(lines)
        super().__init__("\n".join(self.lines), diagnostics)


@dataclasses.dataclass(frozen=True)
class Residuals:
    """Of one channel, in its unit: root mean squares of residuals of each joint, shape (N,),
    with the asset's numbers and with the identified ones; NaN where the log has nothing."""

    channel: str
    before: Array
    after: Array


@dataclasses.dataclass(frozen=True)
class Replay:
    """A replay on one engine: root mean squares of all joints' positions [rad, m] over the motion
    that was held out, before and after; `why` where it cannot be made."""

    engine: str
    before: float
    after: float
    why: str = ""


@dataclasses.dataclass(frozen=True)
class Check:
    """What comes before a fit."""

    quality: Quality
    parameters: tuple[Parameter, ...]
    told: Identifiability
    reasons: tuple[str, ...]
    """Why each refused parameter is refused."""


@dataclasses.dataclass(frozen=True)
class Identified:
    """What came of it. `parameters` are those that were fitted, `held` those that keep the asset's
    number because the log does not tell them. `unexplained` is, of each joint, the part of its
    effort, or of its motion beside the command, that the model does not explain (held out)."""

    check: Check
    parameters: tuple[Parameter, ...]
    held: tuple[Parameter, ...]
    solution: Solution
    training: tuple[Residuals, ...]
    held_out: tuple[Residuals, ...]
    score: tuple[float, float]
    """Of the held-out motion before and after: root mean square of residuals in deviations of what
    was left of the training part."""
    unexplained: Array
    replays: tuple[Replay, ...]
    costs: Array
    """Of each start the residual where it ended, in deviations of the noise of the log; empty of a
    single one."""
    motion: dict[str, Array]
    """Of the held-out part: "time" (W, samples), "log", "before", "after" (W, samples, N)."""
    joints: tuple[str, ...]
    engine: str
    step: float

    @property
    def improved(self) -> bool:
        """Held-out motion is predicted better than by the asset as it is."""
        return self.score[1] < self.score[0]

    @property
    def foreign(self) -> tuple[str, ...]:
        """Joints whose motion no identified number explains."""
        return tuple(joint for joint, part in zip(self.joints, self.unexplained)
                     if part > UNEXPLAINED)

    @property
    def at_bounds(self) -> tuple[Parameter, ...]:
        """Those that ended at a bound that was asked for, or at 0."""
        return tuple(each for each, value in zip(self.parameters, self.solution.values)
                     if min(abs(value - each.low), abs(value - each.high)) < 1e-6 * each.scale)


def check_mapping(log: Log) -> None:
    """Raises RefusedError where a joint follows the command of another: joints are mixed up."""
    if log.command_position is None or log.position is None:
        return
    speeds = [np.diff(np.nan_to_num(values), axis=0)
              for values in (log.command_position, log.position)]
    width = max(1, round(0.1 / max(log.step, 1e-9)))
    window = np.ones(width) / width
    smooth = [np.stack([np.convolve(column, window, "same") for column in values.T], axis=1)
              for values in speeds]
    lags = range(0, max(1, min(len(log) // 4, round(0.2 / max(log.step, 1e-9)))),
                 max(1, width // 4))
    count = len(log.joints)
    best = np.zeros((count, count))
    for lag in lags:
        commands, states = smooth[0][:len(smooth[0]) - lag], smooth[1][lag:]
        best = np.maximum(best, _correlations(commands, states))
    lines = []
    for joint in range(count):
        if not np.ptp(smooth[0][:, joint]) or not np.ptp(smooth[1][:, joint]):
            continue
        other = int(np.argmax(best[:, joint]))
        if other != joint and best[joint, joint] < FOLLOWS < best[other, joint] - 0.1:
            lines.append(f"{log.joints[joint]} follows the command of {log.joints[other]} "
                         f"(correlation {best[other, joint]:.2f}), not its own "
                         f"({best[joint, joint]:.2f}): joints are mixed up; --map NAME=JOINT says "
                         "which is which")
    if lines:
        raise RefusedError(lines)


def check_efforts(model: Model) -> None:
    """Raises RefusedError where efforts are those of a drive of the other sign, which pushes away
    from its commands."""
    log, lines = model.log, []
    assert log.position is not None
    for column, _, command, speeds in model._aimed:
        joint = log.joints[column]
        if command is None or not has(log.effort, column) or not has(log.position, column):
            continue
        assert log.effort is not None
        good = np.isfinite(log.effort[:, column])
        place, speed, _ = smoothed(log.times, log.position[:, column], 3 * log.step + 0.01)
        effort = log.effort[good, column]
        found = []
        for delay in np.linspace(0, LONGEST, 11):
            times = log.times - delay
            wanted = speeds.at(times) if speeds is not None else 0.0
            law = np.stack([command.at(times) - place, wanted - speed], axis=1)[good]
            gains = np.linalg.lstsq(law, effort, rcond=None)[0]
            found.append((float(((effort - law @ gains) ** 2).sum()), float(gains[0])))
        left, stiffness = min(found)
        if stiffness < 0 and left < (1 - CLEAR) * float((effort ** 2).sum()):
            lines.append(f"the efforts of {joint} push away from its commands, as no drive does: "
                         f"--sign {joint.rpartition('/')[2]}.effort=-1")
    if lines:
        raise RefusedError(lines)


def _correlations(commands: Array, states: Array) -> Array:
    """Of each command with each state: (commands, states)."""
    a, b = (values - values.mean(axis=0) for values in (commands, states))
    with np.errstate(invalid="ignore", divide="ignore"):
        made = (a.T @ b) / np.sqrt(np.outer((a ** 2).sum(axis=0), (b ** 2).sum(axis=0)))
    return np.asarray(np.nan_to_num(made))


def identify(asset: Any, logs: Sequence[Log], rows: Sequence[Row] = (), *,
             held_out: Sequence[Log] = (), engine: str | None = None, step: float = 0.0,
             window: float = 0.0, training: float = 0.7, hold: bool | None = None,
             solver: str = "gauss-newton", seed: int = 0, state: str = "", starts: int = 1,
             on: str = "", threads: int = 0, replay: bool = True, check_only: bool = False,
             shown: Shown | None = None, **options: Any) -> Identified | Check:
    """Identifies the parameters that `rows` mean; without rows those that logs usually tell.

    Of each log the first `training` part of the time is fitted and the rest held out, unless
    `held_out` are logs of their own. `hold`: what the logs do not tell keeps the asset's number;
    otherwise it is refused (None: refused where rows name it). `starts` fits are made from as many
    starts, `on` this process or "ray", "ray=ADDRESS" (solve_many()). `check_only` fits nothing and
    returns the Check. `options` are those of tenon_usd.open(). Raises RefusedError, ExtraMissing
    and errors of tenon_usd.errors.
    """
    for log in logs:
        check_mapping(log)
    if hold is None:
        hold = not rows
    parts = [(log, None) for log in logs] if held_out else [log.split(training) for log in logs]
    fitted, begins = joined_logs([first for first, _ in parts])
    rest, rests = joined_logs(list(held_out) or [last for _, last in parts if last is not None])
    how: dict[str, Any] = {"engine": engine, "step": step, "window": window, "threads": threads,
                           **options}
    with contextlib.ExitStack() as stack:
        settable, model, parameters, given = _settable(asset, fitted, begins, rows, how, stack)
        check_efforts(model)
        check = _checked(model, parameters)
        if check_only:
            return check

        def solved(parameters: list[Parameter]) -> tuple[Solution, Array]:
            if starts == 1 and not on:
                return solve(model, parameters, solver=solver, seed=seed, state=state,
                             shown=shown), np.zeros(0)
            task = Task(asset, fitted, begins, how, tuple(parameters), *given, solver, seed)
            many = solve_many(task, model, starts, on, shown or (lambda *_: None))
            return many.best, many.costs
        return _solved((asset, settable), model, (rest, rests), check, hold, how, solved, replay)


def _solved(assets: tuple[Any, Any], model: Model, later_logs: tuple[Log, Sequence[int]],
            check: Check, hold: bool, how: dict[str, Any], solved: Solved, replay: bool
            ) -> Identified:
    """`assets` are the one that was given, and the one whose numbers the engine can set."""
    (asset, settable), (rest, rests) = assets, later_logs
    if check.reasons and not hold:
        raise RefusedError(check.reasons)
    left = set(check.told.refused)
    parameters = [each for at, each in enumerate(check.parameters) if at not in left]
    if not parameters:
        raise RefusedError(check.reasons)
    held = tuple(check.parameters[at] for at in sorted(left))
    solution, costs = solved(parameters)
    later = Model(settable, rest, parts=rests, **how)
    pairs = [_both(asset, each, parameters, solution.values, how, asset is settable)
             for each in (model, later)]
    before, after = _residuals(model, pairs[0]), _residuals(later, pairs[1])
    return Identified(
        check, tuple(parameters), held, solution, before, after, _score(before, after),
        _unexplained(later, pairs[1]),
        _replays(asset, rest, rests, parameters, solution.values, how, after,
                 model.engine) if replay else (),
        costs, {"time": rest.times[later.at], "log": later.measured["position"],
         "before": pairs[1]["position"][0], "after": pairs[1]["position"][1]},
        rest.joints, model.engine, model.step)


def _both(asset: Any, model: Model, parameters: list[Parameter], values: Array,
          how: dict[str, Any], is_of_asset: bool) -> dict[str, Array]:
    """What the asset does as it is and with other numbers: (2, W, samples, N) by channel."""
    plain = model if is_of_asset else Model(asset, model.log, parts=model.parts, **how)
    own = [each for each in parameters if is_of_asset or not FAMILIES[each.family].sets]
    before = plain.predict(own, np.array([[each.nominal for each in own]]))
    after = model.predict(parameters, values[None])
    return {name: np.concatenate([before[name], after[name]]) for name in after}


def _selected(rows: Sequence[Row], model: Model) -> list[Parameter]:
    if rows:
        return select(rows, model.plant, model.log)
    made: list[Parameter] = []
    for family in DEFAULT_FAMILIES:
        try:
            made += select([Row(family)], model.plant, model.log)
        except Error:
            continue  # no drives, say
    return made


def _settable(asset: Any, log: Log, parts: Sequence[int], rows: Sequence[Row],
              how: dict[str, Any], stack: contextlib.ExitStack
              ) -> tuple[Any, Model, list[Parameter], tuple[tuple[Parameter, ...], Array]]:
    """The asset, its model and the parameters that the engine can set. Some engines change only
    what the asset has: a layer over it, of this run alone, gives it that, which comes last."""
    model = Model(asset, log, parts=parts, **how)
    parameters = _selected(rows, model)
    missing = [each for each, _ in model.check(parameters)]
    given: tuple[tuple[Parameter, ...], Array] = ((), np.zeros(0))
    if missing and isinstance(asset, (str, os.PathLike)):
        starts = np.array([max(each.start, min(0.1 * each.scale, each.high)) for each in missing])
        given = (tuple(missing), starts)
        asset = stack.enter_context(temporary_overlay(os.fspath(asset), missing, starts))
        model = Model(asset, log, parts=parts, **how)
    refused = model.check(parameters)
    if refused and rows:
        raise InvalidError("; ".join(f"{each.name} cannot be set on {model.engine}: {why}"
                                     for each, why in refused))
    left = [each for each, _ in refused]
    return asset, model, [each for each in parameters if each not in left], given


def _checked(model: Model, parameters: list[Parameter]) -> Check:
    quality = assess(model.log, asset_joints(model.scene))
    told = look(model, parameters)
    return Check(quality, tuple(parameters), told, tuple(reasons(parameters, told)))


# ---- what it is worth


def _residuals(model: Model, predicted: dict[str, Array]) -> tuple[Residuals, ...]:
    made = []
    for name in CHANNELS:
        if name in model.measured:
            apart = predicted[name] - model.measured[name][None]
            with np.errstate(invalid="ignore"):
                count = np.isfinite(apart).sum(axis=(1, 2))
                rms = np.sqrt(np.nansum(apart ** 2, axis=(1, 2)) / np.where(count, count, np.nan))
            made.append(Residuals(name, rms[0], rms[-1]))
    return tuple(made)


def _score(training: Sequence[Residuals], held_out: Sequence[Residuals]) -> tuple[float, float]:
    parts: tuple[list[Array], list[Array]] = ([], [])
    units = {each.channel: each.after for each in training}
    for each in held_out:
        size = np.maximum(units.get(each.channel, each.after), 1e-12)
        parts[0].append((each.before / size) ** 2)
        parts[1].append((each.after / size) ** 2)
    whole = [np.concatenate(each) for each in parts]
    # A run that became unstable is worse than every other.
    before, after = (float(np.sqrt(np.nanmean(each))) if np.isfinite(each).any() else np.inf
                     for each in whole)
    return before, after


def _unexplained(model: Model, predicted: dict[str, Array]) -> Array:
    """Of each joint the larger part of two: of the deviation of its effort, and of its motion
    beside the command."""
    log = model.log
    worst = np.zeros(len(log.joints))
    for name in ("position", "effort"):
        if name not in model.measured:
            continue
        real = model.measured[name]
        apart = predicted[name][1] - real
        signal = real
        if name == "position" and log.command_position is not None:
            signal = real - log.command_position[model.at]
        for column in range(len(log.joints)):
            size = float(np.nanstd(signal[:, :, column])) if np.isfinite(
                signal[:, :, column]).any() else 0.0
            if name == "position":  # a joint that follows its command well is no other robot's
                size = max(size, 0.02 * float(np.nanstd(real[:, :, column])))
            if size > 0:
                left = float(np.sqrt(np.nanmean(apart[:, :, column] ** 2)))
                worst[column] = max(worst[column], left / size)
    return worst


def _replays(asset: Any, log: Log, parts: Sequence[int], parameters: list[Parameter],
             values: Array, how: dict[str, Any], own: Sequence[Residuals], engine: str
             ) -> tuple[Replay, ...]:
    """The held-out motion on each engine there is, with the asset as it is and with the layer that
    would be written."""
    made = []
    for row in all_engines():
        name = row["name"]
        try:
            if name == engine:
                found = [(each.before, each.after) for each in own if each.channel == "position"]
            elif row["available"] and isinstance(asset, (str, os.PathLike)):
                found = [_on(asset, log, parts, parameters, values, {**how, "engine": name})]
            else:
                continue
        except Error as error:
            made.append(Replay(name, float("nan"), float("nan"), str(error)))
            continue
        before, after = (float(np.sqrt(np.nanmean(each ** 2))) for each in found[0])
        made.append(Replay(name, before, after))
    return tuple(made)


def _on(asset: Any, log: Log, parts: Sequence[int], parameters: list[Parameter], values: Array,
        how: dict[str, Any]) -> tuple[Array, Array]:
    """The residual of positions on another engine, before and after."""
    of_log = [at for at, each in enumerate(parameters) if not FAMILIES[each.family].sets]
    rest = [parameters[at] for at in of_log]
    before = Model(asset, log, parts=parts, **how)
    first = _residuals(before, before.predict(rest, np.array([[each.nominal for each in rest]])))
    with temporary_overlay(os.fspath(asset), parameters, values) as path:
        after = Model(path, log, parts=parts, **how)
        last = _residuals(after, after.predict(rest, values[None, of_log]))
    return first[0].before, last[0].before
