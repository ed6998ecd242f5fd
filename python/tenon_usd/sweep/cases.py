# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What each case is: the values of the rows of a plan, which depend on the plan and the case's
number alone, never on who works on it or on what came before."""

from __future__ import annotations

import dataclasses
import hashlib
import importlib
import math
import statistics
from collections.abc import Callable
from typing import Any

from .plan import Plan, Vary


class ExtraMissing(RuntimeError):
    """An optional package is not installed; the message says how to get it."""

    def __init__(self, package: str, extra: str, what: str) -> None:
        self._about = (package, extra, what)
        super().__init__(f"{what} needs {package}: pip install 'tenon-usd[{extra}]'")

    def __reduce__(self) -> tuple[Any, ...]:
        return ExtraMissing, self._about


@dataclasses.dataclass(frozen=True)
class Case:
    """Case `index` of a plan with a value for each of its rows, in their order."""

    index: int
    values: tuple[Any, ...]


def _uniform(seed: int, row: int, sample: int) -> float:
    """A number of (0, 1) with 52 bits, made of nothing but these."""
    digest = hashlib.sha256(f"{seed}/{row}/{sample}".encode()).digest()
    return ((int.from_bytes(digest[:8], "big") >> 12) + 0.5) / (1 << 52)


def _placed(row: Vary, unit: float) -> float:
    """A number of (0, 1) as one of the row's distribution."""
    first, second = (float(value) for value in row.values)
    if row.distribution == "normal":
        return statistics.NormalDist(first, second).inv_cdf(unit) if second > 0 else first
    if row.distribution == "log":
        return min(max(math.exp(math.log(first) + unit * (math.log(second) - math.log(first))),
                       first), second)
    return min(first + unit * (second - first), second)


class _Sobol:
    """Points of a scrambled Sobol sequence by number."""

    def __init__(self, dimensions: int, seed: int) -> None:
        try:
            qmc: Any = importlib.import_module("scipy.stats.qmc")
        except ImportError as error:
            raise ExtraMissing("SciPy", "sobol", "sobol") from error
        self._make: Callable[[], Any] = lambda: qmc.Sobol(dimensions, scramble=True, seed=seed)
        self._sequence: Any = None
        self._next = 0

    def point(self, number: int) -> list[float]:
        """Those of a scrambled sequence may be 0."""
        if self._sequence is None or number < self._next:
            self._sequence, self._next = self._make(), 0
        if number > self._next:
            self._sequence.fast_forward(number - self._next)
        self._next = number + 1
        return [min(max(float(unit), 2.0**-53), 1 - 2.0**-53)
                for unit in self._sequence.random(1)[0]]


class Cases:
    """The cases of a plan by number. One that needs SciPy raises ExtraMissing where it is made. Not
    for several threads at a time."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._sobol_rows = [at for at, row in enumerate(plan.vary) if row.draw == "sobol"]
        self._sobol = _Sobol(len(self._sobol_rows), plan.seed) if self._sobol_rows else None

    def __getitem__(self, index: int) -> Case:
        if not 0 <= index < self.plan.case_count:
            raise IndexError(f"there is no case {index} of {self.plan.case_count}")
        point, sample = divmod(index, self.plan.samples)
        units = self._sobol.point(sample) if self._sobol else []
        values: list[Any] = []
        # The last grid changes fastest, as loops in the order of the rows would.
        grid: dict[int, Any] = {}
        for at, row in reversed(list(enumerate(self.plan.vary))):
            if row.draw == "grid":
                point, own = divmod(point, len(row.values))
                grid[at] = row.values[own]
        for at, row in enumerate(self.plan.vary):
            if row.draw == "grid":
                values.append(grid[at])
            elif row.draw == "random":
                values.append(_placed(row, _uniform(self.plan.seed, at, sample)))
            else:
                values.append(_placed(row, units[self._sobol_rows.index(at)]))
        return Case(index, tuple(values))
