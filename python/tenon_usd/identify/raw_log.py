# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A table as a log file has it, before its columns are known to be of joints: what all readers
give, and what is refused whatever the format is."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from .log import Array, Finding, LogError, Rows

#: Files and tables above these are refused (docs/identify-logs.md).
MAX_BYTES = 1 << 30
MAX_VALUES = 100_000_000
MAX_COLUMNS = 10_000
#: Names of columns that are times, without what tells their unit.
TIME_NAMES = ("time", "timestamp", "t", "stamp", "seconds", "secs", "sec", "time_stamp",
              "elapsed", "log_time")
TIME_UNITS = {"s": 1.0, "sec": 1.0, "seconds": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
#: Times that begin later than this are those of a clock, and count from the first sample.
CLOCK_SECONDS = 1e6
#: A gap is a time between samples that is so many times the usual one.
GAP = 5.0
#: Times that are nearer to each other [s] are in another unit.
LEAST_STEP = 1e-6


@dataclasses.dataclass
class RawLog:
    """Columns of one file: T samples."""

    source: str
    times: Array
    """Seconds from `origin`, shape (T,)."""
    columns: dict[str, Array]
    """Each of shape (T,); NaN: no value."""
    rows: Rows
    """Of each sample its row in the file, counted from 1, shape (T,)."""
    origin: float = 0.0
    """What the clock showed at time 0 [s]."""
    head: int = 0
    """The row with the names; 0: they are not in a row."""
    time_name: str = "time"
    in_stage_units: bool = False
    """Angles are in degrees and lengths in units of the stage, as `tenon sim` writes."""

    def refuse(self, rule: str, message: str, fix: str, sample: int | None = None,
               channel: str = "") -> LogError:
        """The error about one sample and column."""
        row = 0 if sample is None else int(self.rows[sample])
        return LogError(Finding(rule, message, self.source, row, channel, fix))


def time_column(names: Iterable[str], wanted: str, source: str, row: int = 0) -> tuple[str, float]:
    """The column with the times and its unit [s]. Raises LogError where there is none."""
    names = list(names)
    if wanted:
        if wanted not in names:
            raise LogError(Finding("log.no-time", f"there is no column `{wanted}`", source, row,
                                   wanted, f"columns are {listed(names)}"))
        return wanted, _time_unit(wanted)
    for name in names:
        words = [word for word in re.split(r"[^a-z]+", name.lower()) if word]
        plain = [word for word in words if word not in TIME_UNITS]
        if name.lower() in TIME_NAMES or "_".join(plain) in TIME_NAMES:
            return name, _time_unit(name)
    raise LogError(Finding("log.no-time", "no column has a name of times", source, row, "",
                           f"say which has them with --time NAME; columns are {listed(names)}"))


def _time_unit(name: str) -> float:
    words = [word for word in re.split(r"[^a-z]+", name.lower()) if word]
    return next((TIME_UNITS[word] for word in reversed(words[1:]) if word in TIME_UNITS), 1.0)


def listed(names: Iterable[str], most: int = 8) -> str:
    """Names for a message, the first of many."""
    names = list(names)
    rest = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(name if len(name) <= 80 else name[:80] + "..."
                     for name in names[:most]) + rest


def seconds_of(values: Any, unit: float) -> tuple[Array, float]:
    """Times in seconds and the clock's origin; integers of clocks lose no digit."""
    values = np.asarray(values)
    if not len(values):
        return np.zeros(0), 0.0
    whole = values.dtype.kind in "iu"
    first = values[0]
    if not whole and not np.isfinite(first):
        return np.asarray(values, dtype=np.float64) * unit, 0.0
    if unit == 1.0 and abs(float(first)) > 1e15:  # nobody counts so many seconds
        unit = 1e-9
    origin = float(first) * unit
    if abs(origin) < CLOCK_SECONDS:
        return np.asarray(values, dtype=np.float64) * unit, 0.0
    # Unsigned numbers would wrap around where times go back.
    since = values.astype(np.int64) - np.int64(first) if whole else values - first
    return np.asarray(since, dtype=np.float64) * unit, origin


def check_times(raw: RawLog, allow_gaps: bool, notes: list[Finding]) -> None:
    """Times are finite and increase; gaps are refused, or told where they are allowed."""
    if len(raw.times) < 2:
        raise raw.refuse("log.samples", f"has {len(raw.times)} rows; a motion takes at least two",
                         "give a file with samples")
    bad = np.flatnonzero(~np.isfinite(raw.times))
    if bad.size:
        raise raw.refuse("log.time", "is no finite number", "take the row out", int(bad[0]),
                         raw.time_name)
    steps = np.diff(raw.times)
    wrong = np.flatnonzero(steps <= 0)
    if wrong.size:
        _refuse_order(raw, int(wrong[0]) + 1)
    usual = float(np.median(steps))
    if usual < LEAST_STEP:
        raise raw.refuse("log.time", f"rows are {usual:.3g} s apart", "give times in seconds, or "
                         "name the unit in the column: time_ms", 1, raw.time_name)
    gaps = np.flatnonzero(steps > GAP * usual)
    if gaps.size:
        at = int(gaps[0])
        message = (f"{steps[at]:.4g} s without a row before it, where rows are {usual:.4g} s apart"
                   + (f"; {gaps.size} such gaps" if gaps.size > 1 else ""))
        fix = "--allow-gaps interpolates over them; better, log again or cut the file there"
        if not allow_gaps:
            raise raw.refuse("log.gap", message, fix, at + 1, raw.time_name)
        notes.append(Finding("log.gap", message, raw.source, int(raw.rows[at + 1]), raw.time_name,
                             "states are interpolated over it", "warning"))


def _refuse_order(raw: RawLog, at: int) -> None:
    now, before = raw.times[at], raw.times[at - 1]
    same = all(np.array_equal(column[at], column[at - 1], equal_nan=True)
               for column in raw.columns.values())
    if now == before and same:
        raise raw.refuse("log.repeated-row", f"is the same as row {int(raw.rows[at - 1])}, time "
                         "and values", "delete one of the two", at, raw.time_name)
    word = "stands still" if now == before else "goes back"
    raise raw.refuse("log.time-order", f"{word}: {now:.9g} s after {before:.9g} s",
                     "sort the rows, or cut the file where the recording began anew", at,
                     raw.time_name)


def table_of(names: list[str], columns: Mapping[str, Any], source: str, wanted_time: str,
             head: int = 0, rows: Any = None) -> RawLog:
    """A table with its times found. `columns` are numbers of one length. Raises LogError."""
    if len(names) > MAX_COLUMNS:
        raise LogError(Finding("log.too-large", f"{len(names)} columns; at most {MAX_COLUMNS}",
                               source, head, "", "leave out what is not of joints"))
    name, unit = time_column(names, wanted_time, source, head)
    shape, kind = np.shape(columns[name]), np.asarray(columns[name]).dtype
    if len(shape) != 1 or kind.kind not in "fiub":
        raise LogError(Finding("log.time", f"is an array of {kind} of the shape {shape}", source,
                               head, name, "a number for each row"))
    times, origin = seconds_of(columns[name], unit)
    count = len(times)
    numbers = np.arange(1, count + 1, dtype=np.int64) if rows is None else np.asarray(rows)
    rest = {key: np.asarray(columns[key], dtype=np.float64) for key in names if key != name}
    for key, values in rest.items():
        if values.shape != (count,):
            raise LogError(Finding("log.ragged", f"has the shape {values.shape}, while there are "
                                   f"{count} times", source, 0, key, "one value for each time"))
    return RawLog(source, times, rest, numbers.astype(np.int64), origin, head, name)


def lined(rows: Sequence[Sequence[str]], left: int = 1) -> list[str]:
    """Rows as lines; the first `left` columns are flush left, others right."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return ["  ".join(cell.ljust(widths[k]) if k < left else cell.rjust(widths[k])
                      for k, cell in enumerate(row)).rstrip() for row in rows]
