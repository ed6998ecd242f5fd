# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Fits from several starts, one behind the other or on a cluster of Ray; the one counts that leaves
least. Where a fit is not smooth, it ends in the valley that it begins in.

Each fit is the same wherever it is made, and so is which one counts.
"""

from __future__ import annotations

import contextlib
import dataclasses
import importlib.util
import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import InvalidError
from ..sweep.cases import ExtraMissing
from ..sweep.work import ray_cluster
from .identifiable import prior_rows, residuals, weights_of
from .linear import linear_start
from .log import Array, Log
from .model import Model
from .overlay import temporary_overlay
from .parameters import Parameter
from .solve import Shown, Solution, cost_of, solve

#: By which factor a start is at most off the first one; of delays by how many time steps.
SPREAD, SPREAD_STEPS = 4.0, 4.0
#: Of the least cost, by which part another one may be above it and count as the same valley.
SAME = 0.01
MAX_STARTS = 1000


@dataclasses.dataclass(frozen=True)
class Many:
    """What came of several starts: `best` and, of each start, the `costs` of what was found in
    deviations of the noise of the log (cost_of()), shape (starts,)."""

    best: Solution
    costs: Array


def alike(costs: Array) -> int:
    """How many starts end as low as the best."""
    return int(np.sum(costs <= (1 + SAME) * costs.min()))


@dataclasses.dataclass(frozen=True)
class Task:
    """A fit that can be made anywhere: the asset as a path, and a layer over it where the engine
    changes only what the asset has (`missing`, `given`)."""

    asset: Any
    log: Log
    parts: tuple[int, ...]
    how: dict[str, Any]
    parameters: tuple[Parameter, ...]
    missing: tuple[Parameter, ...]
    given: Array
    solver: str
    seed: int

    def run(self, first: Array) -> Solution:
        """Raises what solve() does."""
        with contextlib.ExitStack() as stack:
            asset = self.asset if not self.missing else stack.enter_context(
                temporary_overlay(self.asset, self.missing, self.given))
            model = Model(asset, self.log, parts=self.parts, **self.how)
            return solve(model, list(self.parameters), solver=self.solver, seed=self.seed,
                         first=first)


def starts_of(model: Model, parameters: list[Parameter], count: int, seed: int) -> list[Array]:
    """The start that the log tells, and others around it: `count` arrays (P,)."""
    first = linear_start(model, parameters)
    made = [first]
    for number in range(1, count):
        random = np.random.default_rng([seed, 4, number])
        other = first.copy()
        for at, (each, part) in enumerate(zip(parameters,
                                              random.uniform(-1, 1, len(parameters)))):
            if each.family == "delay":
                other[at] += SPREAD_STEPS * model.step * part
            elif each.low < 0:
                other[at] += each.scale * part
            else:
                other[at] = max(other[at], 0.1 * each.scale) * SPREAD ** part
        made.append(np.clip(other, [each.low for each in parameters],
                            [each.high for each in parameters]))
    return made


def check_place(place: str) -> None:
    """Raises InvalidError for a place that is not known, ExtraMissing where Ray is not there."""
    if place and place.partition("=")[0] != "ray":
        raise InvalidError(f"--on {place}: expected ray or ray=ADDRESS")
    if place and importlib.util.find_spec("ray") is None:
        raise ExtraMissing("Ray", "ray", "--on ray")


def solve_many(task: Task, model: Model, count: int, place: str, shown: Shown) -> Many:
    """Fits from `count` starts: here, or where `place` says ("ray", "ray=ADDRESS"). Ctrl-C ends it
    with the best of those that are done. Raises InvalidError for other places and for assets that
    are no path, ExtraMissing without Ray, and what solve() does."""
    check_place(place)
    firsts = starts_of(model, list(task.parameters), count, task.seed)
    if place and not isinstance(task.asset, (str, os.PathLike)):
        raise InvalidError("--on takes the asset as a path, which its workers read")
    done: list[Solution | None] = [None] * count
    finished = True
    try:
        if place:
            _on_ray(task, firsts, place.partition("=")[2] or None, done, shown)
        else:
            for number, first in enumerate(firsts):
                done[number] = one = task.run(first)
                _tell(done, shown)
                if not one.finished:
                    break
    except KeyboardInterrupt:
        finished = False
    there = [each for each in done if each is not None]
    if not there:
        raise KeyboardInterrupt
    costs = _costs(model, list(task.parameters), there)
    best = there[int(np.argmin(costs))]
    return Many(dataclasses.replace(best, finished=best.finished and finished), costs)


def _costs(model: Model, parameters: list[Parameter], found: Sequence[Solution]) -> Array:
    """With the weights of the log's noise, for each fit ends with weights of its own."""
    sets = np.array([each.values for each in found])
    apart = residuals(model, model.predict(parameters, sets), weights_of(model))
    known = [prior_rows(parameters, values)[0] for values in sets]
    return np.array([cost_of(np.concatenate(rows)) for rows in zip(apart, known)])


def _tell(done: Sequence[Solution | None], shown: Shown) -> None:
    there = [each for each in done if each is not None]
    shown(f"start {len(there)} of {len(done)}", sum(each.simulations for each in there),
          min(each.cost for each in there))


def _on_ray(task: Task, firsts: Sequence[Array], address: str | None,
            done: list[Solution | None], shown: Shown) -> None:
    alone = dataclasses.replace(task, asset=os.path.abspath(task.asset),
                                how={**task.how, "threads": 1})
    with ray_cluster(address, task.how.get("threads") or None) as ray:
        run = ray.remote(num_cpus=1, max_retries=-1)(Task.run)
        shared = ray.put(alone)
        running = {run.remote(shared, first): number for number, first in enumerate(firsts)}
        while running:
            (ended,), _ = ray.wait(list(running))
            done[running.pop(ended)] = ray.get(ended)
            _tell(done, shown)
