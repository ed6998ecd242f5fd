# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Fits parameters: what is linear first, by least squares of efforts, then by simulation, with
Gauss-Newton steps of SciPy or, where that is not smooth, CMA-ES.

Weights are the inverse of what is left of each channel and joint, found in rounds: the first with
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

from ..sweep.cases import ExtraMissing
from ..sweep.chunks import write_whole
from .identifiable import (Identifiability, judge, prior_rows, residuals, scales_of, sensitivity,
                           weights_of)
from .linear import linear_start, scipy
from .log import Array
from .model import Model
from .parameters import Parameter

SOLVERS = ("gauss-newton", "cma")
ROUNDS = 3
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
    `told` is what the log says about them at the end; `cost` what is left (cost_of), in deviations;
    `finished` is False where Ctrl-C ended it: the best that was found."""

    values: Array
    errors: Array
    told: Identifiability
    cost: float
    simulations: int
    finished: bool

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
        """The round and the values; None where there are none of this digest."""
        if not self.path:
            return None
        try:
            with open(self.path, encoding="utf-8") as file:
                note = json.load(file)
            values = np.array(note["values"], dtype=np.float64)
            round_ = int(note["round"])
        except (OSError, ValueError, KeyError, TypeError):
            return None
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


class _Fit:
    """One fit: residuals of a model as functions of parameters by their scales."""

    def __init__(self, model: Model, parameters: list[Parameter], shown: Shown) -> None:
        self.model, self.parameters, self.shown = model, parameters, shown
        self.low = np.array([each.low for each in parameters])
        self.high = np.array([each.high for each in parameters])
        self.weights = weights_of(model)
        self.simulations = 0
        self.round = 0
        self.best: tuple[float, Array] | None = None
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

    def derivatives(self, values: Array) -> Array:
        _, own = sensitivity(self.model, self.parameters, values, self.weights)
        self.simulations += len(values) + 1
        return np.concatenate([own, prior_rows(self.parameters, values)[1]])

    def scan_delays(self, values: Array) -> Array:
        """The delays around that leave least, with all else as it is: where commands hold, what is
        left jumps with a delay, so that no slope leads there."""
        reach = 1.5 * max(self.model.step, self.model.log.step)
        for at, parameter in enumerate(self.parameters):
            if parameter.family == "delay":
                sets = np.repeat(values[None], SCANNED, axis=0)
                sets[:, at] += np.linspace(-reach, reach, SCANNED)
                sets = self.clipped(sets)
                values = sets[int(np.argmin([cost_of(row) for row in self.apart(sets)]))]
        return values

    def reweigh(self, values: Array) -> None:
        """Weights that make what is left of every channel and joint 1."""
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
            self.weights[name] = 1.0 / np.maximum(left, np.nan_to_num(least, nan=1.0))

    def inflation(self, values: Array) -> float:
        """How many neighbouring residuals say the same thing: 1 + 2 sum of autocorrelations up to
        the first that is not above 0, the mean of all joints and channels."""
        found = []
        for name, predicted in self.model.predict(self.parameters, values[None]).items():
            apart = predicted[0] - self.model.measured[name]
            for column in range(apart.shape[-1]):
                for row in apart[:, 1:, column]:
                    found.append(_persistence(row[np.isfinite(row)]))
        return max(1.0, float(np.mean(found))) if found else 1.0


def _persistence(values: Array) -> float:
    if values.size < 8 or float(np.var(values)) == 0:
        return 1.0
    own = values - values.mean()
    whole = np.fft.rfft(own, 2 * own.size)
    correlation = np.fft.irfft(np.abs(whole) ** 2)[:own.size]
    correlation /= correlation[0]
    negative = np.flatnonzero(correlation <= 0)
    end = int(negative[0]) if negative.size else own.size
    return float(1 + 2 * correlation[1:end].sum())


def look(model: Model, parameters: list[Parameter]) -> Identifiability:
    """What the log tells about parameters, at their start."""
    at = linear_start(model, parameters)
    # Away from the bounds: friction 0 has another slope than friction.
    at = np.array([max(value, 0.1 * each.scale) if each.low >= 0 and value <= 0
                   and each.high >= 0.1 * each.scale and each.family != "delay" else value
                   for each, value in zip(parameters, at)])
    _, jacobian = sensitivity(model, parameters, at, weights_of(model))
    return judge(parameters, jacobian, at)


def solve(model: Model, parameters: list[Parameter], *, solver: str = "gauss-newton",
          seed: int = 0, state: str = "", shown: Shown | None = None) -> Solution:
    """Fits. Ctrl-C ends it with the best that was found. Raises ExtraMissing, and errors of the
    model."""
    optimize = scipy("optimize")
    fit = _Fit(model, parameters, shown or (lambda *_: None))
    fit.state = State(state, digest_of(model, parameters, solver, seed))
    known = fit.state.read(len(parameters))
    start, values = known if known else (0, fit.clipped(linear_start(model, parameters)))
    finished = True
    try:
        if start > 0:
            fit.reweigh(values)
        for fit.round in range(start, ROUNDS):
            fit.best = None
            values = fit.scan_delays(values)
            if solver == "cma":
                values = _by_cma(fit, values, seed + fit.round)
            else:
                values = _by_newton(optimize, fit, values)
            fit.reweigh(values)
    except KeyboardInterrupt:
        finished = False
        fit.state, fit.shown = State("", ""), (lambda *_: None)
        if fit.best is not None:
            values = fit.best[1]
        fit.reweigh(values)
    cost = cost_of(fit.apart(values)[0])
    _, jacobian = sensitivity(model, parameters, values, fit.weights)
    told = judge(parameters, jacobian, values, fit.inflation(values))
    if finished:
        fit.state.remove()
    return Solution(values, told.errors, told, cost, fit.simulations, finished)


def _by_newton(optimize: Any, fit: _Fit, values: Array) -> Array:
    scales = scales_of(fit.parameters, values)
    low, high = fit.low / scales, fit.high / scales
    room = np.where(np.isfinite(low) & np.isfinite(high), high - low, 1.0)
    inside = np.clip(values / scales, low + 1e-9 * room, high - 1e-9 * room)
    done = optimize.least_squares(
        lambda x: fit.apart(x * scales)[0], inside,
        jac=lambda x: fit.derivatives(x * scales) * scales, bounds=(low, high), method="trf",
        loss="soft_l1", f_scale=OUTLIER, x_scale="jac", xtol=1e-4, gtol=1e-10, max_nfev=8,
        ftol=1e-3 if fit.round + 1 < ROUNDS else 1e-4)
    best = fit.best[1] if fit.best is not None else np.asarray(done.x) * scales
    return fit.clipped(best)


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
