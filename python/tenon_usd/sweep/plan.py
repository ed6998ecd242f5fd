# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A plan: what is simulated, what varies and what is measured, read from TOML and checked.

Everything that a case depends on is in the plan; its digest, with the bytes of the asset's files,
names the results, so that results of another plan are never mixed with them.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import math
import os
from collections.abc import Iterable, Mapping
from typing import Any

from .._toml import Fault, FileError, Reader, is_number, read_toml, rows_of

MAX_PLAN_BYTES = 1 << 20
MAX_CASES = 1_000_000
MAX_CHUNK = 100_000
#: How a row says what it varies: a number of the running model, times a factor or as it is; a
#: property of the asset; a target of drives; the asset or the engine itself.
TARGETS = ("scale", "value", "set", "target", "asset", "engine")
#: How a row says with which values.
DRAWS = ("grid", "random", "sobol")
DISTRIBUTIONS = ("uniform", "log", "normal")
TAKES = ("final", "first", "min", "max", "mean")
RESERVED = ("case", "status", "time", "rule", "error")


class PlanError(FileError):
    """A plan that cannot be used: `path`, and a Fault for each thing that is wrong."""


@dataclasses.dataclass(frozen=True)
class Vary:
    """One row `[[vary]]`. `kind` is one of TARGETS and `target` what it says there; `draw` is one
    of DRAWS; `values` are those of a grid, or low and high (mean and deviation of "normal")."""

    name: str
    kind: str
    target: str
    draw: str
    values: tuple[Any, ...]
    distribution: str = "uniform"
    line: int = dataclasses.field(default=0, compare=False)


@dataclasses.dataclass(frozen=True)
class Metric:
    """One row `[[metric]]`: `of` is a signal ("position.z@/World/Can"), `take` one of TAKES."""

    name: str
    of: str
    take: str = "final"
    line: int = dataclasses.field(default=0, compare=False)


@dataclasses.dataclass(frozen=True)
class Plan:
    """A sweep as a value. `asset` is a path relative to `folder`, durations are in seconds;
    `step` None: the asset's own. `chunk` cases are written together."""

    asset: str
    folder: str
    engine: str | None = None
    physics: str | None = None
    duration: float = 1.0
    step: float | None = None
    sample: float = 0.02
    samples: int = 1
    seed: int = 0
    chunk: int = 64
    vary: tuple[Vary, ...] = ()
    metrics: tuple[Metric, ...] = ()
    source: str = "plan"

    @property
    def grid_points(self) -> int:
        """How many combinations the grids have."""
        return math.prod(len(row.values) for row in self.vary if row.draw == "grid")

    @property
    def case_count(self) -> int:
        """Combinations of the grids times samples."""
        return self.grid_points * self.samples

    @property
    def chunk_count(self) -> int:
        return -(-self.case_count // self.chunk)

    def chunk_cases(self, number: int) -> range:
        """The cases of one chunk."""
        return range(number * self.chunk, min((number + 1) * self.chunk, self.case_count))

    def canonical(self) -> str:
        """All that the cases depend on as text, the same for the same plan wherever it lies."""
        value = dataclasses.asdict(self)
        del value["folder"], value["source"]
        for row in [*value["vary"], *value["metrics"]]:
            del row["line"]
        return json.dumps(value, sort_keys=True, separators=(",", ":"))

    def digest(self, files: Mapping[str, bytes] | None = None, versions: str = "") -> str:
        """SHA-256 of the plan, of the asset's files by name, and of what runs it."""
        whole = hashlib.sha256(self.canonical().encode())
        for name, contents in sorted((files or {}).items()):
            whole.update(f"\0{name}\0".encode() + hashlib.sha256(contents).digest())
        whole.update(f"\0{versions}".encode())
        return whole.hexdigest()

    def asset_path(self, asset: str) -> str:
        return os.path.join(self.folder, asset)


def _range_of(reader: Reader, row: Mapping[str, Any], draw: str) -> tuple[Any, ...] | None:
    """Low and high of `random` and `sobol`."""
    value, distribution = row[draw], row.get("distribution", "uniform")
    if distribution not in DISTRIBUTIONS:
        reader.fault(f"distribution is {distribution!r}; there are {', '.join(DISTRIBUTIONS)}")
        return None
    if not isinstance(value, list) or len(value) != 2 or not all(map(is_number, value)):
        reader.fault(f"{draw} is {value!r}; expected two numbers")
        return None
    low, high = map(float, value)
    if distribution == "normal":
        if high < 0:
            reader.fault("a deviation is not below 0")
            return None
    elif low > high or (distribution == "log" and low <= 0):
        reader.fault(f"{draw} is {value!r}; the first is not above the second"
                     + (", and both are above 0" if distribution == "log" else ""))
        return None
    return low, high


def _grid_of(reader: Reader, row: Mapping[str, Any]) -> tuple[Any, ...] | None:
    """A list of values, or {from, to, count}."""
    value = row["grid"]
    if isinstance(value, dict):
        reader.unknown(value, ("from", "to", "count"))
        low: Any = value.get("from")
        high: Any = value.get("to")
        count = value.get("count")
        if (not is_number(low) or not is_number(high) or isinstance(count, bool)
                or not isinstance(count, int) or not 1 <= count <= MAX_CASES):
            reader.fault(f"a grid has from, to and a count from 1 to {MAX_CASES}")
            return None
        last = max(count - 1, 1)
        return tuple(float(low + (high - low) * i / last) for i in range(count))
    if not isinstance(value, list) or not value:
        reader.fault(f"grid is {value!r}; expected a list of values, or from, to and count")
        return None
    if not all(is_number(each) or isinstance(each, bool)
               or (isinstance(each, str) and each.isprintable()) for each in value):
        reader.fault("a value of a grid is a number, a text of one line, or true or false")
        return None
    return tuple(float(each) if is_number(each) else each for each in value)


def _wrong_values(kind: str, values: tuple[Any, ...]) -> str | None:
    """What is wrong with values of that kind."""
    if kind in ("asset", "engine") and not all(isinstance(each, str) for each in values):
        return f"{kind} varies over texts"
    if kind in ("scale", "value", "target") and not all(map(is_number, values)):
        return f"{kind} varies over numbers"
    return None


def _read_vary(reader: Reader, row: Mapping[str, Any]) -> Vary | None:
    reader.unknown(row, ("name", "distribution", *TARGETS, *DRAWS))
    kinds = [kind for kind in TARGETS if kind in row]
    draws = [draw for draw in DRAWS if draw in row]
    # `asset` and `engine` are lists: what and with which values in one.
    if kinds in (["asset"], ["engine"]) and not draws and isinstance(row[kinds[0]], list):
        row = {**row, "grid": row[kinds[0]], kinds[0]: kinds[0]}
        draws = ["grid"]
    if len(kinds) != 1:
        reader.fault(f"one of {', '.join(TARGETS)} says what varies; here are {kinds or 'none'}")
        return None
    if len(draws) != 1:
        reader.fault(f"one of {', '.join(DRAWS)} says with which values; here are "
                     f"{draws or 'none'}")
        return None
    kind, draw = kinds[0], draws[0]
    target = reader.text(row, kind)
    values = _grid_of(reader, row) if draw == "grid" else _range_of(reader, row, draw)
    if target is None or values is None:
        return None
    if fault := _wrong_values(kind, values):
        reader.fault(fault)
        return None
    name = reader.text(row, "name", target) or target
    return Vary(name, kind, target, draw, values, row.get("distribution", "uniform"),
                reader.line)


def _read_metric(reader: Reader, row: Mapping[str, Any]) -> Metric | None:
    reader.unknown(row, ("name", "of", "take"))
    of, take = reader.text(row, "of"), reader.text(row, "take", "final")
    if of is None:
        reader.fault("`of` says what is measured, such as \"position.z@/World/Can\"")
        return None
    if take not in TAKES:
        reader.fault(f"take is {take!r}; there are {', '.join(TAKES)}")
        return None
    return Metric(reader.text(row, "name", f"{take}({of})") or of, of, take, reader.line)


def _check_names(reader: Reader, vary: list[Vary], metrics: list[Metric]) -> None:
    seen: set[str] = set(RESERVED)
    rows: list[Vary | Metric] = [*vary, *metrics]
    for number, row in enumerate(rows):
        is_vary = number < len(vary)
        reader.at("vary" if is_vary else "metric", number + 1 - (0 if is_vary else len(vary)))
        if row.name in seen:
            reader.fault(f'a column "{row.name}" is there already; give the row another name')
        seen.add(row.name)


_KEYS = ("asset", "engine", "physics", "duration", "step", "sample", "samples", "seed", "chunk",
         "vary", "metric")


def plan_from_table(table: Mapping[str, Any], folder: str, path: str = "plan",
                    text: str = "") -> Plan:
    """The plan that a table says, as TOML gives it. Errors: PlanError with all faults."""
    reader = Reader(text)
    reader.unknown(table, _KEYS)
    reader.at_top("asset")
    asset = reader.text(table, "asset")
    rows: list[Vary] = []
    points = 1
    for number, row in enumerate(rows_of(reader, table, "vary"), 1):
        reader.at("vary", number)
        # Grids that are too large together are not made, each with all of its values.
        if points <= MAX_CASES and (read := _read_vary(reader, row)) is not None:
            rows.append(read)
            points *= len(read.values) if read.draw == "grid" else 1
    metrics: list[Metric] = []
    for number, row in enumerate(rows_of(reader, table, "metric"), 1):
        reader.at("metric", number)
        if (metric := _read_metric(reader, row)) is not None:
            metrics.append(metric)
    _check_names(reader, rows, metrics)
    reader.at_top()
    if asset is None and not any(row.kind == "asset" for row in rows):
        reader.fault('an asset is missing: asset = "hand.usda"')
    step = None
    if "step" in table:
        step = float(reader.number(table, "step", 0.002, 1e-9, 1))
    plan = Plan(
        asset or "", folder, reader.text(table, "engine"), reader.text(table, "physics"),
        float(reader.number(table, "duration", 1.0, 0, 1e6)), step,
        float(reader.number(table, "sample", 0.02, 1e-6, 1e6)),
        reader.whole(table, "samples", 1, 1, MAX_CASES),
        reader.whole(table, "seed", 0, 0, (1 << 63) - 1),
        reader.whole(table, "chunk", 64, 1, MAX_CHUNK), tuple(rows), tuple(metrics), path)
    if not reader.faults and plan.case_count > MAX_CASES:
        reader.fault(f"{plan.case_count} cases or more; at most {MAX_CASES}")
    if plan.samples > 1 and all(row.draw == "grid" for row in rows) and not reader.faults:
        reader.fault("samples are draws of random and sobol, and no row draws")
    if reader.faults:
        raise PlanError(path, reader.faults)
    return plan


def load_plan(path: str, more: Iterable[str] = (), **changes: Any) -> Plan:
    """Reads a plan file, or makes a plan of an asset alone (a name that does not end in .toml).

    `more` are rows as the command line has them (--vary); `changes` replace keys of the file.
    Errors: OSError; PlanError.
    """
    text = ""
    if path.endswith(".toml"):
        text, table = read_toml(path, MAX_PLAN_BYTES, PlanError)
    else:
        table = {"asset": os.path.basename(path)}
    folder = os.path.dirname(os.path.abspath(path))
    table.update({key: value for key, value in changes.items() if value is not None})
    given = [vary_from_text(each, path) for each in more]
    if given:
        rows = table.get("vary", [])
        table["vary"] = [*(rows if isinstance(rows, list) else []), *given]
    return plan_from_table(table, folder, path, text)


def vary_from_text(text: str, path: str = "--vary") -> dict[str, Any]:
    """A row of the command line: NAME=LOW..HIGH draws at random, NAME=LOW:HIGH:COUNT is a grid,
    NAME=A,B,C a list. NAME is a number of the model as `tenon bench --vary` names it, whose values
    are factors, or PATH.PROPERTY of the asset, "asset" or "engine". Errors: PlanError."""
    # A property may hold no "=" but its name may hold ":"; the values stand behind the last "=".
    name, sign, values = text.rpartition("=")
    row: dict[str, Any] = {}
    if not sign or not name or not values:
        raise PlanError("--vary", [Fault("", 0, f"{text!r}: expected NAME=LOW..HIGH, "
                                         "NAME=LOW:HIGH:COUNT or NAME=A,B,C")])
    if name in ("asset", "engine"):
        return {name: values.split(",")}
    row["set" if name.startswith("/") else "scale"] = name
    try:
        if ".." in values:
            low, high = values.split("..", 1)
            row["random"] = [float(low), float(high)]
        elif values.count(":") == 2:
            low, high, count = values.split(":")
            row["grid"] = {"from": float(low), "to": float(high), "count": int(count)}
        else:
            row["grid"] = [_value_of(each) for each in values.split(",")]
    except ValueError as error:
        raise PlanError("--vary", [Fault("", 0, f"{text!r}: {error}")]) from error
    return row


def _value_of(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text
