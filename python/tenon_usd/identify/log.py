# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A log of a robot as a value: what its joints were told and what they did, in SI units.

    log = tenon_usd.identify.read_log("run.csv", scene)
    training, held_out = log.split(0.7)

`log_files.py` reads files, `channels.py` finds the joints of an asset in their columns, `delays.py`
tells how late joints follow, `quality.py` how good the data are.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from ..errors import Error

Array = npt.NDArray[np.float64]
Rows = npt.NDArray[np.int64]
#: What a log may hold of each joint, in the order of the fields of Log.
STATES = ("position", "velocity", "effort")
COMMANDS = ("command_position", "command_velocity", "command_effort")
SIGNALS = STATES + COMMANDS


@dataclasses.dataclass(frozen=True)
class Finding:
    """One thing about a log, with the attributes of tenon_usd.Diagnostic."""

    rule: str
    message: str
    file: str = ""
    line: int = 0
    """Row of the file: its line in texts, its place among the rows or messages in others, both
    counted from 1; 0 where it is unknown."""
    channel: str = ""
    """The column, or the topic; empty where it is unknown."""
    fix: str = ""
    severity: str = "error"
    column: int = 0
    prim: str = ""
    property_name: str = ""

    def __str__(self) -> str:
        row = f":{self.line}" if self.line else ""
        place = f"{self.file}{row}: " if self.file else ""
        what = f"`{self.channel}`: " if self.channel else ""
        return f"{place}{what}{self.message}" + (f" ({self.fix})" if self.fix else "")


class FindingError(Error, ValueError):
    """What is wrong with one thing: `file`, `line` (the row), `channel` and `fix` say where it is
    and what to do."""

    def __init__(self, finding: Finding | str, diagnostics: Sequence[Any] = ()) -> None:
        # Copies and pickles hand in the message and the list.
        findings = [finding] if isinstance(finding, Finding) else list(diagnostics)
        super().__init__(str(finding), cast("Sequence[Any]", findings))

    @property
    def channel(self) -> str:
        """The column or topic of the log, or the joint; empty where it is unknown."""
        return self._first("channel")


class LogError(FindingError):
    """A log that cannot be used."""


@dataclasses.dataclass(frozen=True, eq=False)
class Log:
    """What the joints of a robot were told and did: T samples of N degrees of freedom.

    A signal that no channel has is None; where single joints lack it, their columns are NaN. Raises
    LogError where shapes differ or times do not increase.
    """

    times: Array
    """Seconds, shape (T,), strictly increasing."""
    joints: tuple[str, ...]
    """Paths (or names) of N joints; ":rotX" behind one that has several degrees of freedom."""
    position: Array | None = None
    """rad or m, shape (T, N)."""
    velocity: Array | None = None
    """rad/s or m/s, shape (T, N)."""
    effort: Array | None = None
    """N m or N, shape (T, N): what the actuator exerts, as it was measured."""
    command_position: Array | None = None
    """rad or m, shape (T, N)."""
    command_velocity: Array | None = None
    """rad/s or m/s, shape (T, N)."""
    command_effort: Array | None = None
    """N m or N, shape (T, N)."""
    source: str = ""
    """The file that it was read from."""
    rows: Rows | None = None
    """Of each sample its row in the file, shape (T,), for messages; None: samples from 1 on."""

    def __post_init__(self) -> None:
        count, width = len(self.times), len(self.joints)
        if self.times.ndim != 1 or count == 0:
            self._refuse(0, "", f"has times of shape {self.times.shape}, and no samples",
                         "log at least two samples")
        for name in SIGNALS:
            values = getattr(self, name)
            if values is not None and values.shape != (count, width):
                self._refuse(0, name, f"has the shape {values.shape}, not {(count, width)}",
                             "one value for each time and joint")
        if self.rows is not None and self.rows.shape != (count,):
            self._refuse(0, "rows", f"has the shape {self.rows.shape}, not {(count,)}",
                         "one number for each time")
        bad = np.flatnonzero(~np.isfinite(self.times))
        if bad.size:
            self._refuse(int(bad[0]), "time", f"is {self.times[bad[0]]}, no finite number",
                         "take the row out")
        late = np.flatnonzero(np.diff(self.times) <= 0)
        if late.size:
            at = int(late[0]) + 1
            self._refuse(at, "time", f"{self.times[at]:g} s follows {self.times[at - 1]:g} s",
                         "times have to increase; sort the rows")

    def _refuse(self, sample: int, channel: str, message: str, fix: str) -> None:
        raise LogError(Finding("log.samples", message, self.source, self.row(sample), channel, fix))

    # ---- what there is

    def __len__(self) -> int:
        return len(self.times)

    def __repr__(self) -> str:
        return (f"<Log of {len(self)} samples, {len(self.joints)} joints, {self.duration:g} s: "
                f"{', '.join(self.signals)}>")

    def row(self, sample: int) -> int:
        """The row of a sample in the file, counted from 1."""
        if self.rows is None or not 0 <= sample < len(self.rows):
            return sample + 1
        return int(self.rows[sample])

    @property
    def signals(self) -> tuple[str, ...]:
        """Names of the signals that are there: "position", "command_position" and so on."""
        return tuple(name for name in SIGNALS if getattr(self, name) is not None)

    @property
    def duration(self) -> float:
        """From the first sample to the last [s]."""
        return float(self.times[-1] - self.times[0])

    @property
    def step(self) -> float:
        """The median time between samples [s]; 0 of a single sample."""
        return float(np.median(np.diff(self.times))) if len(self) > 1 else 0.0

    def column(self, joint: str) -> int:
        """The place of a joint, by its path or its last name. Raises LogError for others."""
        if joint in self.joints:
            return self.joints.index(joint)
        ends = [i for i, each in enumerate(self.joints) if each.rpartition("/")[2] == joint]
        if len(ends) != 1:
            raise LogError(Finding("log.joint", f"`{joint}` is {'no' if not ends else 'no single'}"
                                   " joint of the log", self.source,
                                   fix="joints are " + ", ".join(self.joints[:8])))
        return ends[0]

    # ---- parts

    def window(self, start: float, end: float) -> Log:
        """The samples from `start` to `end` [s, of the log], both included. Raises LogError where
        less than two are there."""
        return self._samples(np.flatnonzero((self.times >= start) & (self.times <= end)),
                             f"between {start:g} and {end:g} s")

    def split(self, fraction: float) -> tuple[Log, Log]:
        """The first `fraction` of the time for training, and the rest, which is held out.

        Raises LogError where one of the two has less than two samples.
        """
        if not 0 < fraction < 1:
            raise LogError(Finding("log.split", f"the training part is {fraction:g} of the log",
                                   self.source, fix="give a number above 0 and below 1"))
        border = self.times[0] + fraction * self.duration
        return (self._samples(np.flatnonzero(self.times <= border), "of the training part"),
                self._samples(np.flatnonzero(self.times > border), "that are held out"))

    def select(self, joints: tuple[str, ...]) -> Log:
        """The log of some of the joints, in the order given. Raises LogError for others."""
        columns = [self.column(joint) for joint in joints]
        return self._with(lambda name, values: values[:, columns],
                          joints=tuple(self.joints[i] for i in columns))

    def resample(self, step: float) -> Log:
        """The log at equal steps [s] from its first sample on.

        States are interpolated between neighbours, commands hold until the next one, as a
        controller sees them. Nothing is filtered. `rows` are those of the last sample before.
        """
        if not (np.isfinite(step) and step > 0) or len(self) < 2 or self.duration / step > 1e8:
            raise LogError(Finding("log.step", f"{step:g} s is no step for {len(self)} samples of "
                                   f"{self.duration:g} s", self.source,
                                   fix="give a step above 0, and far more than two samples"))
        count = int(np.floor(self.duration / step * (1 + 1e-12) + 1e-9)) + 1
        times = self.times[0] + step * np.arange(count)
        # A time that only rounding puts below a sample counts as that sample's.
        before = np.searchsorted(self.times, times + 1e-9 * step, side="right") - 1

        def resampled(name: str, values: Array) -> Array:
            if name in COMMANDS:
                return np.asarray(values[before])
            return np.stack([np.interp(times, self.times, column) for column in values.T], axis=1)

        rows = None if self.rows is None else self.rows[before]
        if not self.joints:
            return dataclasses.replace(self._with(lambda name, values: values[before]),
                                       times=times, rows=rows)
        made: dict[str, Any] = {name: resampled(name, getattr(self, name)) for name in self.signals}
        return dataclasses.replace(self, times=times, rows=rows, **made)

    def _samples(self, at: npt.NDArray[np.intp], which: str) -> Log:
        if len(at) < 2:
            raise LogError(Finding("log.samples", f"{len(at)} samples {which}; the log goes from "
                                   f"{self.times[0]:g} to {self.times[-1]:g} s", self.source,
                                   fix="take a longer part"))
        rows = (at + 1).astype(np.int64) if self.rows is None else self.rows[at]
        made: dict[str, Any] = {name: getattr(self, name)[at] for name in self.signals}
        return dataclasses.replace(self, times=self.times[at], rows=rows, **made)

    def _with(self, change: Callable[[str, Array], Array],
              joints: tuple[str, ...] | None = None) -> Log:
        made: dict[str, Any] = {name: change(name, getattr(self, name)) for name in self.signals}
        return dataclasses.replace(self, joints=self.joints if joints is None else joints, **made)
