# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The runner that simulates: a World of one environment for each model that a plan needs, kept from
case to case. A case starts with reset(), so that it knows nothing of those before it."""

from __future__ import annotations

import collections
import dataclasses
import math
import os
from collections.abc import Sequence
from typing import Any

from .. import __version__, engines, open as open_stage
from .._toml import Fault
from ..errors import Error, FileError, NotFoundError, check_file
from ..world import World
from .cases import Case, Cases
from .plan import Metric, Plan, PlanError, Vary
from .signals import UnknownName, find_setter, find_signal, outputs_of
from .work import FAILED, MISSING, OK, UNSTABLE, Outcome

KEPT_MODELS = 8
#: Readings that are taken at once, so that long cases take no more memory than short ones.
BLOCK = 1024


@dataclasses.dataclass(frozen=True)
class Key:
    """What a model of its own is made for."""

    asset: str
    engine: str | None
    overrides: tuple[str, ...]


def _text(value: Any) -> str:
    """A value as text layers write it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) and value != int(value) else str(
        int(value) if isinstance(value, float) else value)


def key_of(plan: Plan, case: Case) -> Key:
    asset, engine, overrides = plan.asset, plan.engine, []
    for row, value in zip(plan.vary, case.values, strict=True):
        if row.kind == "asset":
            asset = value
        elif row.kind == "engine":
            engine = value
        elif row.kind == "set":
            overrides.append(f"{row.target}={_text(value)}")
    return Key(asset, engine, tuple(overrides))


class Model:
    """A compiled model with what the plan's rows mean in it. Errors: those of World;
    UnknownName."""

    def __init__(self, plan: Plan, key: Key) -> None:
        options: dict[str, Any] = {"physics": plan.physics} if plan.physics else {}
        self.world = World(plan.asset_path(key.asset), key.engine, threads=1,
                           time_step=plan.step or 0.0, overrides=list(key.overrides),
                           outputs=outputs_of([metric.of for metric in plan.metrics]), **options)
        step = self.world.time_step
        self.steps = max(0, round(plan.duration / step))
        self.every = max(1, round(plan.sample / step))
        self.setters = [None if row.kind in ("asset", "engine", "set")
                        else find_setter(row.kind, row.target, self.world) for row in plan.vary]
        self.signals = [find_signal(metric.of, self.world) for metric in plan.metrics]
        self.metrics = plan.metrics
        takes = [metric.take for metric in plan.metrics]
        #: Metrics that are read at the start, with each sample and at the end.
        self.first = [at for at, take in enumerate(takes) if take != "final"]
        self.sampled = [at for at, take in enumerate(takes) if take in ("min", "max", "mean")]
        self.final = [at for at, take in enumerate(takes) if take == "final"]

    def run(self, case: Case) -> Outcome:
        """Errors: Error, of a value that cannot be used."""
        self.world._batch.reset([0])
        for setter, value in zip(self.setters, case.values, strict=True):
            if setter is not None:
                setter(self.world, value)
        takes = [_Take(metric) for metric in self.metrics]
        batch, done = self.world._batch, 0
        stride = self.every if self.sampled else max(self.steps, 1)
        sampled = [self.signals[at] for at in self.sampled]
        self._read(takes, self.first)
        while done < self.steps:
            count = min(BLOCK * stride, self.steps - done)
            samples, failed = batch.record(sampled, count, stride)
            if failed:
                reason = batch.failures()[0]
                assert reason is not None
                return Outcome(UNSTABLE, float(batch.times()[0]), (), reason.rule, str(reason))
            done += count
            for at, values in zip(self.sampled, samples[:, 0].T.tolist(), strict=True):
                takes[at].add(values)
        self._read(takes, self.final)
        return Outcome(OK, float(batch.times()[0]), tuple(take.value() for take in takes))

    def _read(self, takes: Sequence[_Take], which: Sequence[int]) -> None:
        values = self.world._batch.read([self.signals[at] for at in which])[0].tolist()
        for at, value in zip(which, values, strict=True):
            takes[at].add([value])


class _Take:
    """One metric over the samples of a case."""

    def __init__(self, metric: Metric) -> None:
        self.take = metric.take
        self.number = math.nan
        self.sum, self.count = 0.0, 0

    def add(self, values: Sequence[float]) -> None:
        """The next samples, at least one."""
        if self.count == 0:
            self.number = values[0]
        self.count += len(values)
        if self.take == "min":
            self.number = min(self.number, *values)
        elif self.take == "max":
            self.number = max(self.number, *values)
        elif self.take == "mean":
            for value in values:  # in their order: sum() adds otherwise from Python 3.12 on
                self.sum += value

    def value(self) -> float:
        return self.sum / self.count if self.take == "mean" else self.number


class Simulator:
    """Runs cases one after the other; keeps the models that were used last."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self._models: collections.OrderedDict[Key, Model] = collections.OrderedDict()
        self._bad: dict[Key, Outcome] = {}

    def model(self, key: Key) -> Model:
        if key in self._models:
            self._models.move_to_end(key)
        else:
            self._models[key] = Model(self.plan, key)
            if len(self._models) > KEPT_MODELS:
                self._models.popitem(last=False)
        return self._models[key]

    def run(self, cases: Sequence[Case]) -> list[Outcome]:
        return [self._outcome(case) for case in cases]

    def _outcome(self, case: Case) -> Outcome:
        key = key_of(self.plan, case)
        if key in self._bad:
            return self._bad[key]
        try:
            model = self.model(key)
        except (Error, UnknownName) as error:
            missing = isinstance(error, (FileError, NotFoundError, UnknownName))
            outcome = Outcome(MISSING if missing else FAILED, 0.0, (), getattr(error, "rule", ""),
                              str(error))
            if len(self._bad) < 10000:
                self._bad[key] = outcome
            return outcome
        try:
            return model.run(case)
        except Error as error:
            return Outcome(FAILED, float(model.world.time[0]), (), error.rule, str(error))


def make_runner(plan: Plan) -> Simulator:
    return Simulator(plan)


# ---- what a plan's digest is made of

def _assets(plan: Plan) -> list[str]:
    varied = [value for row in plan.vary if row.kind == "asset" for value in row.values]
    return varied or [plan.asset]


def _engines(plan: Plan) -> list[str | None]:
    varied = [value for row in plan.vary if row.kind == "engine" for value in row.values]
    return varied or [plan.engine]


def _files(plan: Plan, asset: str) -> dict[str, bytes]:
    """The bytes of an asset's files by name; b"" of one that cannot be read."""
    path = plan.asset_path(asset)
    options: dict[str, Any] = {"physics": plan.physics} if plan.physics else {}
    try:
        names = open_stage(path, **options).layers
    except Error:
        names = [path]
    found: dict[str, bytes] = {}
    for name in names:
        inside = os.path.relpath(name, os.path.abspath(plan.folder or ".")) \
            if os.path.isabs(name) else os.path.relpath(name, plan.folder or ".")
        try:
            check_file(name)
            with open(name, "rb") as file:
                found[f"{asset}:{inside}"] = file.read()
        except OSError:  # a file of a package, or a missing one
            found[f"{asset}:{inside}"] = b""
    return found


def digest_of(plan: Plan) -> str:
    """The digest that names the results: of the plan, of the files that the asset is read from, of
    tenon and its engines. The first case's model is made to see that the plan's rows mean
    something. Errors: PlanError."""
    check_rows(plan)
    files: dict[str, bytes] = {}
    for asset in _assets(plan):
        files.update(_files(plan, asset))
    versions = [__version__, *(f"{row['name']} {row['version']}" for row in engines())]
    return plan.digest(files, "\n".join(versions))


def check_rows(plan: Plan) -> None:
    """Errors: PlanError, for each row that names what is not there. A plan over several assets or
    engines is not checked: a case whose row names nothing is a row of the result."""
    if len(_assets(plan)) > 1 or len(_engines(plan)) > 1:
        return
    bare = dataclasses.replace(plan, vary=(), metrics=())
    key = key_of(plan, Cases(plan)[0])
    try:
        world = Model(bare, dataclasses.replace(key, overrides=())).world
    except Error as error:
        raise PlanError(plan.source, [Fault("", 0, str(error))]) from error
    faults: list[Fault] = []

    def look(row: Vary | Metric, name: str, find: Any) -> None:
        try:
            find()
        except UnknownName as error:
            faults.append(Fault(name, row.line, str(error)))

    for number, row in enumerate(plan.vary, 1):
        if row.kind in ("scale", "value", "target"):
            look(row, f"vary {number}", lambda row=row: find_setter(row.kind, row.target, world))
    for number, metric in enumerate(plan.metrics, 1):
        look(metric, f"metric {number}", lambda metric=metric: find_signal(metric.of, world))
    for number, row in enumerate(plan.vary, 1):
        if row.kind == "set":
            overrides = (f"{row.target}={_text(Cases(plan)[0].values[number - 1])}",)
            try:
                Model(bare, dataclasses.replace(key, overrides=overrides))
            except Error as error:
                faults.append(Fault(f"vary {number}", row.line, str(error)))
    if faults:
        raise PlanError(plan.source, faults)
