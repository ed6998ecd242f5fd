# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Fits parameters: what is linear first, by least squares of efforts, then by simulation, with
Gauss-Newton steps of SciPy or, where that is not smooth, CMA-ES.

Weights are the inverse of the residual of each channel and joint, found in rounds: the first with
the noise of the log, the next with the residuals of the one before. Outliers count less.
"""

from __future__ import annotations

import dataclasses
import hashlib
import importlib
import json
import os
from collections.abc import Callable
from typing import Any

import numpy as np

from ..errors import Error, InvalidError, check_file
from ..sweep.cases import ExtraMissing
from ..sweep.chunks import write_whole
from .identifiable import (DOUBT, Around, Identifiability, judge, moments_of, prior_rows, residuals,
                           scales_of, sensitivity, weights_of)
from .intervals import sum_deviation
from .linear import linear_start, scipy
from .log import Array
from .model import Model
from .parameters import Parameter

SOLVERS = ("gauss-newton", "cma")
#: At most; the first with weights that nothing is known of yet, so that it ends early.
ROUNDS = 4
#: Of the cost, what a step gains at least in the first round and in the others.
ENOUGH = (1e-2, 1e-4)
#: By how much weights may change for a round to be the last.
SETTLED = 0.05
#: Steps of the first round and of the others at most; factors of the damping that each of them
#: tries, the first alone where it gains at least this part of what the slopes promise.
STEPS = (4, 30)
DAMPINGS = (1e-3, 1.0, 1e2, 1e4)
PROMISED = 0.7
MOST_DAMPING = 1e6
#: Differences of more deviations count less: where commands jump, moments of the clock decide.
OUTLIER = 3.0
#: Delays that are tried around the last one.
SCANNED = 13
#: 95 % of a normal distribution.
INTERVAL = 1.959964
Shown = Callable[[str, int, float], None]


@dataclasses.dataclass(frozen=True)
class Solution:
    """`values`, `errors` (standard errors) and `low` to `high` (95 %) of the parameters [SI, rad];
    `told` is what the log says about them at the end; `cost` the residual (cost_of), in deviations;
    `finished` is False where Ctrl-C ended it: the best that was found."""

    values: Array
    errors: Array
    told: Identifiability
    cost: float
    simulations: int
    finished: bool
    settled: bool = True
    """More steps would not have found less; False where they were used up."""

    @property
    def low(self) -> Array:
        return self.values - INTERVAL * self.errors

    @property
    def high(self) -> Array:
        return self.values + INTERVAL * self.errors


def _cma() -> Any:
    try:
        return importlib.import_module("cma")
    except ImportError as error:
        raise ExtraMissing("cma", "identify", "the solver cma") from error


def digest_of(model: Model, parameters: list[Parameter], solver: str, seed: int) -> str:
    """What a state file is of: the same log, parameters and engine."""
    whole = hashlib.sha256(json.dumps(
        [solver, seed, model.engine, model.step, len(model.windows), model.windows.samples,
         [dataclasses.asdict(each) for each in parameters]], sort_keys=True).encode())
    for name in ("times", "position", "velocity", "effort", "command_position",
                 "command_velocity", "command_effort"):
        values = getattr(model.log, name)
        whole.update(b"\0" if values is None else np.ascontiguousarray(values).tobytes())
    return whole.hexdigest()


class State:
    """The best so far in a file, so that the same command goes on from there."""

    def __init__(self, path: str, digest: str) -> None:
        self.path, self.digest = path, digest

    def read(self, count: int) -> tuple[int, Array] | None:
        """The round and the values; None where there are none of this digest. Raises InvalidError
        for a file that is no state, which would be written over; OSError."""
        if not self.path or not os.path.exists(self.path):
            return None
        try:
            check_file(self.path)
            with open(self.path, encoding="utf-8") as file:
                note = json.load(file)
            values = np.array(note["values"], dtype=np.float64)
            round_ = int(note["round"])
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError):
            raise InvalidError(f"{self.path} is there and is no state that --state wrote: name "
                               "another file") from None
        good = (note.get("digest") == self.digest and values.shape == (count,)
                and np.isfinite(values).all() and 0 <= round_ < ROUNDS)
        return (round_, values) if good else None

    def write(self, round_: int, values: Array) -> None:
        """Errors: OSError."""
        if self.path:
            note = {"tenon.identify": 1, "digest": self.digest, "round": round_,
                    "values": values.tolist()}
            write_whole(os.path.abspath(self.path),
                        (json.dumps(note, sort_keys=True) + "\n").encode())

    def remove(self) -> None:
        if self.path and os.path.exists(self.path):
            os.unlink(self.path)


def cost_of(apart: Array) -> float:
    """Half of the sum of squares, where differences beyond OUTLIER count by their size alone."""
    square = (apart / OUTLIER) ** 2
    return float(OUTLIER ** 2 * (np.sqrt(1 + square) - 1).sum())


def slopes_of(apart: Array) -> Array:
    """Roots of the weights with which squares of residuals have the derivatives of cost_of()."""
    return np.asarray((1 + (apart / OUTLIER) ** 2) ** -0.25)


class _Fit:
    """One fit: residuals of a model as functions of parameters by their scales."""

    def __init__(self, model: Model, parameters: list[Parameter], shown: Shown) -> None:
        self.model, self.parameters, self.shown = model, parameters, shown
        self.low = np.array([each.low for each in parameters])
        self.high = np.array([each.high for each in parameters])
        self.weights = weights_of(model)
        self.simulations = 0
        self.round = 0
        self.settled = True
        self.best: tuple[float, Array] | None = None
        self._slopes: tuple[Array, Array, Array] | None = None
        self._around: Around | None = None
        self.state = State("", "")

    def clipped(self, values: Array) -> Array:
        return np.asarray(np.clip(values, self.low, self.high))

    def apart(self, sets: Array) -> Array:
        """Residuals, priors included, of sets of values: (S, numbers)."""
        sets = np.atleast_2d(sets)
        own = residuals(self.model, self.model.predict(self.parameters, sets), self.weights)
        known = [prior_rows(self.parameters, values)[0] for values in sets]
        self.simulations += len(sets)
        whole = np.concatenate([own, np.stack(known)], axis=1)
        for values, row in zip(sets, whole):
            self._keep(values, cost_of(row))
        return whole

    def _keep(self, values: Array, cost: float) -> None:
        if self.best is None or cost < self.best[0]:
            self.best = (cost, values.copy())
            self.state.write(self.round, values)
        self.shown(f"round {self.round + 1} of {ROUNDS}", self.simulations, self.best[0])

    def derivatives(self, values: Array) -> tuple[Array, Array]:
        """Residuals and their derivatives, those of priors behind the others."""
        apart, own = self.around(values).slopes(self.weights)
        priors = prior_rows(self.parameters, values)
        return np.concatenate([apart, priors[0]]), np.concatenate([own, priors[1]])

    def around(self, values: Array) -> Around:
        """Simulated where the last ones were of other values."""
        if self._around is None or not np.array_equal(self._around.values, values):
            self._around = Around(self.model, self.parameters, values)
            self.simulations += len(values) + 1
        return self._around

    def scan_delays(self, optimize: Any, values: Array) -> Array:
        """The delays around that leave least, with all else as it is and with what would suit each
        of them best: where commands hold, residuals jump with a delay, so that no slope leads
        there, and damping makes up for most of a delay that is wrong."""
        reach = 1.5 * max(self.model.step, self.model.log.step)
        for at, parameter in enumerate(self.parameters):
            if parameter.family != "delay":
                continue
            sets = np.repeat(values[None], SCANNED, axis=0)
            sets[:, at] += np.linspace(-reach, reach, SCANNED)
            sets = self.clipped(sets)
            suited = [self._suited(optimize, values, own[at], at) for own in sets]
            sets = np.concatenate([sets, suited])
            values = sets[int(np.argmin([cost_of(row) for row in self.apart(sets)]))]
        return values

    def _suited(self, optimize: Any, values: Array, delay: float, at: int) -> Array:
        """The values that the slopes say to go best with a delay."""
        if self._slopes is None or self._slopes[0] is not values:
            self._slopes = (values, *self.derivatives(values))
        _, apart, jacobian = self._slopes
        others = np.arange(len(values)) != at
        apart = apart + jacobian[:, at] * (delay - values[at])
        weights = slopes_of(apart)
        scales = scales_of(self.parameters, values)[others]
        own = jacobian[:, others] * scales * weights[:, None]
        low, high = ((bound[others] - values[others]) / scales for bound in (self.low, self.high))
        made = values.copy()
        made[at] = delay
        if others.any():
            _, triangle = np.linalg.qr(own)
            made[others] += scales * _step(optimize, triangle, -own.T @ (weights * apart), 1e-6,
                                           low, high)
        return self.clipped(made)

    def reweigh(self, values: Array) -> float:
        """Weights that make the residual of every channel and joint 1. By which part the one that
        changes most does."""
        changed = 0.0
        if self._around is not None and np.array_equal(self._around.values, values):
            predicted = {name: made[:1] for name, made in self._around.predicted.items()}
        else:
            predicted = self.model.predict(self.parameters, values[None])
            self.simulations += 1
        noise = weights_of(self.model)
        for name, values_of in predicted.items():
            apart = np.abs(values_of[0] - self.model.measured[name]).reshape(
                -1, values_of.shape[-1])
            left = np.array([1.4826 * float(np.median(column[np.isfinite(column)]))
                             if np.isfinite(column).any() else 1.0 for column in apart.T])
            # Of efforts some are known within bounds alone, where a command changes.
            least = (0.5 if name == "effort" else 1e-3) / noise[name]
            made = 1.0 / np.maximum(left, np.nan_to_num(least, nan=1.0))
            change = np.nan_to_num(np.abs(made / self.weights[name] - 1))
            changed = max(changed, float(change.max(initial=0.0)))
            self.weights[name] = made
        return changed


def look(model: Model, parameters: list[Parameter]) -> Identifiability:
    """What the log tells about parameters, at their start."""
    at = linear_start(model, parameters)
    # Away from the bounds: friction 0 has another slope than friction.
    at = np.array([max(value, 0.1 * each.scale) if each.low >= 0 and value <= 0
                   and each.high >= 0.1 * each.scale and each.family != "delay" else value
                   for each, value in zip(parameters, at)])
    _, jacobian = sensitivity(model, parameters, at, weights_of(model))
    return judge(parameters, jacobian, at, DOUBT)


def solve(model: Model, parameters: list[Parameter], *, solver: str = "gauss-newton",
          seed: int = 0, state: str = "", first: Array | None = None,
          shown: Shown | None = None) -> Solution:
    """Fits, from `first` on, shape (P,), or from what the log tells without a simulation. Ctrl-C
    ends it with the best that was found. Raises ExtraMissing, and errors of the model."""
    optimize = scipy("optimize")
    fit = _Fit(model, parameters, shown or (lambda *_: None))
    fit.state = State(state, digest_of(model, parameters, solver, seed))
    known = fit.state.read(len(parameters))
    first = fit.clipped(linear_start(model, parameters) if first is None else first)
    start, values = known if known else (0, first)
    finished = True
    try:
        fit.reweigh(values if start else first)
        for fit.round in range(start, ROUNDS):
            fit.best = None
            values = fit.scan_delays(optimize, values)
            if solver == "cma":
                values = _by_cma(fit, values, seed + fit.round)
            else:
                values = _by_newton(optimize, fit, values)
            if fit.reweigh(values) < SETTLED:
                break
    except KeyboardInterrupt:
        finished = False
        fit.state, fit.shown = State("", ""), (lambda *_: None)
        if fit.best is not None:
            values = fit.best[1]
        fit.reweigh(values)
    apart, jacobian = fit.derivatives(values)
    told = judge(parameters, jacobian[:len(jacobian) - len(prior_rows(parameters, values)[0])],
                 values)
    errors = np.hypot(np.maximum(told.errors, _deviations(fit, apart, jacobian)),
                      _of_time_step(fit, values, jacobian) if finished else 0.0)
    if finished:
        fit.state.remove()
    return Solution(values, errors, dataclasses.replace(told, errors=errors), cost_of(apart),
                    fit.simulations, finished, fit.settled and finished)


def _deviations(fit: _Fit, apart: Array, jacobian: Array) -> Array:
    """Standard errors of the parameters with what neighbouring residuals share."""
    weights = slopes_of(apart)
    inverse = _inverse(jacobian * weights[:, None])
    moves = (jacobian * (weights ** 2 * apart)[:, None]) @ inverse
    times, signals = moments_of(fit.model)

    def squares(own: Array) -> Array:
        series = np.zeros((int(times.max()) + 1, moves.shape[1]))
        np.add.at(series, times[own], moves[:len(times)][own])
        return np.asarray(np.array([sum_deviation(column) for column in series.T]) ** 2)

    # Signals may share what the model lacks, and each has a memory of its own: whatever is more.
    together = squares(np.ones(len(times), dtype=bool))
    alone = sum((squares(signals == each) for each in np.unique(signals)), np.zeros_like(together))
    # A prior is one number with a deviation of its own.
    known = (jacobian[len(times):] @ inverse) ** 2
    return np.asarray(np.sqrt(np.maximum(together, alone) + known.sum(axis=0)))


def _of_time_step(fit: _Fit, values: Array, jacobian: Array) -> Array:
    """By how much numbers are off because the model takes steps of time: half of the step changes
    what the joints do by about half of what is wrong with it."""
    try:
        finer = fit.model.finer()
        apart = [residuals(model, model.predict(fit.parameters, values[None]), fit.weights)[0]
                 for model in (fit.model, finer)]
    except Error:  # more steps than a run may have
        return np.zeros(len(values))
    fit.simulations += 2
    own = jacobian[:len(apart[0])] * slopes_of(apart[0])[:, None]
    change = slopes_of(apart[0]) * np.clip(apart[1] - apart[0], -1e2, 1e2)
    return np.asarray(2 * np.abs(_inverse(jacobian) @ (own.T @ change)))


def _inverse(jacobian: Array) -> Array:
    """Of J'J, without what nothing tells."""
    sizes = np.maximum(np.linalg.norm(jacobian, axis=0), 1e-150)  # squares are not 0
    scaled = jacobian / sizes
    return np.asarray(np.linalg.pinv(scaled.T @ scaled, rcond=1e-12, hermitian=True)
                      / np.outer(sizes, sizes))


def _by_newton(optimize: Any, fit: _Fit, values: Array) -> Array:
    """Steps of Gauss-Newton within the bounds, each with several dampings (Levenberg-Marquardt), of
    which the one counts that leaves least."""
    scales = scales_of(fit.parameters, values)
    low, high = fit.low / scales, fit.high / scales
    at, damping, small = np.clip(values / scales, low, high), 1e-3, 0
    enough = ENOUGH[min(fit.round, 1)]
    fit.settled = False
    for _ in range(STEPS[min(fit.round, 1)]):
        apart, jacobian = fit.derivatives(at * scales)
        cost = cost_of(apart)
        weights = slopes_of(apart)
        _, triangle = np.linalg.qr(jacobian * scales * weights[:, None])
        wanted = -(jacobian * scales).T @ (weights ** 2 * apart)
        tried = np.stack([_step(optimize, triangle, wanted, damping * factor, low - at, high - at)
                          for factor in DAMPINGS])
        tried = np.clip(at + tried, low, high)
        promised = cost - cost_of(apart + jacobian @ ((tried[0] - at) * scales))
        if promised < enough * cost and damping <= 1:  # with much damping that says little
            fit.settled = True
            break
        costs = [cost_of(row) for row in fit.apart(tried[:1] * scales)]
        if cost - costs[0] < PROMISED * promised:
            costs += [cost_of(row) for row in fit.apart(tried[1:] * scales)]
        best = int(np.argmin(costs))
        if costs[best] >= cost:
            if damping >= MOST_DAMPING:
                fit.settled = True
                break
            damping *= 1e3
            continue
        at, gain = tried[best], 1 - costs[best] / cost
        damping = float(np.clip(damping * DAMPINGS[best] ** 0.5, 1e-6, MOST_DAMPING))
        small = small + 1 if gain < enough else 0
        if small > (0 if best < 2 else 2):
            fit.settled = True
            break
    return fit.clipped(at * scales)


def _step(optimize: Any, triangle: Array, wanted: Array, damping: float, low: Array, high: Array
          ) -> Array:
    """The step that leaves least of R'R x = wanted, damped, within bounds."""
    sizes = np.maximum(np.linalg.norm(triangle, axis=0), 1e-9)
    _, whole = np.linalg.qr(np.concatenate([triangle, np.sqrt(damping) * np.diag(sizes)]))
    right = scipy("linalg").solve_triangular(whole, wanted, trans="T")
    done = optimize.lsq_linear(whole, right, bounds=(np.minimum(low, -1e-12),
                                                     np.maximum(high, 1e-12)), method="bvls")
    return np.asarray(done.x)


def _by_cma(fit: _Fit, values: Array, seed: int) -> Array:
    cma = _cma()
    scales = scales_of(fit.parameters, values)
    low = np.where(np.isfinite(fit.low), fit.low / scales, -1e6)
    high = np.where(np.isfinite(fit.high), fit.high / scales, 1e6)
    search = cma.CMAEvolutionStrategy(
        (values / scales).tolist(), 0.2,
        {"bounds": [low.tolist(), high.tolist()], "seed": seed + 1, "verbose": -9,
         "tolfun": 1e-6, "tolx": 1e-4, "maxiter": 60 + 10 * len(values)})
    while not search.stop():
        asked = search.ask()
        apart = fit.apart(np.array(asked) * scales)
        search.tell(asked, [cost_of(row) for row in apart])
    assert fit.best is not None
    return fit.clipped(fit.best[1])
