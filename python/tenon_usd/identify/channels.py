# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Which joint and which signal of an asset a column of a log is, by its name, and in which unit.

A name is that of a joint, whole or its last part, with words before or behind it: "j1",
"shoulder.pos", "cmd_shoulder_velocity [deg/s]", "/arm/shoulder.driveEffort",
"observation.state.shoulder.pos". What has other words is unknown, and refused.
"""

from __future__ import annotations

import dataclasses
import difflib
import functools
import math
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from .._patterns import compile_pattern
from .checks import check_log
from .joints import AssetJoint, find_joint
from .log import COMMANDS, SIGNALS, Array, Finding, Log, LogError
from .raw_log import RawLog, listed

#: What words of a name say.
KINDS = {
    "position": "position", "positions": "position", "pos": "position", "q": "position",
    "qpos": "position", "angle": "position", "angles": "position",
    "velocity": "velocity", "velocities": "velocity", "vel": "velocity", "speed": "velocity",
    "qd": "velocity", "dq": "velocity", "qvel": "velocity",
    "effort": "effort", "efforts": "effort", "torque": "effort", "tau": "effort",
    "force": "effort"}
COMMAND_WORDS = {"command", "commands", "commanded", "cmd", "target", "targets", "desired", "des",
                 "action", "goal", "reference", "ref", "setpoint"}
STATE_WORDS = {"state", "states", "joint", "joints", "measured", "meas", "actual", "feedback",
               "present", "observation", "obs", "motor", "drive", "sensor", "per"}
UNIT_WORDS = {"deg": "deg", "degree": "deg", "degrees": "deg", "rad": "rad", "radian": "rad",
              "radians": "rad", "mm": "mm", "cm": "cm", "m": "m", "s": "", "nm": "", "n": ""}
#: What `tenon sim` logs of joints beside states, which no identification takes.
UNUSED = {"acceleration", "reactionForce", "reactionTorque"}
#: Units of positions, in rad or m.
UNITS = {"rad": 1.0, "deg": math.pi / 180, "m": 1.0, "cm": 0.01, "mm": 0.001}
ANGLES = ("rad", "deg")


@dataclasses.dataclass(frozen=True)
class Reading:
    """How logs are read; options that are not given follow from the names of columns."""

    mapping: Mapping[str, str] = dataclasses.field(default_factory=dict)
    """Columns, or names of joints in columns, to joints of the asset; ".command_position" and so on
    behind the joint says the signal, too."""
    units: Sequence[str] = ()
    """Of positions, and per second of velocities: "deg" or "rad", and "m", "cm" or "mm". Without
    them radians and metres, or what names of columns say; of logs of `tenon sim` those they have.
    """
    signs: Mapping[str, float] = dataclasses.field(default_factory=dict)
    """1 or -1 of all signals of a joint, or of "JOINT.position" and the like alone."""
    ignore: Sequence[str] = ()
    """Regular expressions for whole names of columns that are not read."""
    allow_gaps: bool = False
    """Gaps are interpolated over, and rows without a state are skipped."""
    check: bool = True
    """Units and signs are checked against the asset."""
    commands: str | os.PathLike[str] = ""
    """A command table, as `tenon sim --commands` and `tenon excite` have it, of the same clock."""
    time: str = ""
    """The column with the times; empty: found by its name."""
    topics: Sequence[str] = ()
    """The topics of bags and MCAP that are read; empty: all of known types."""
    episode: int | None = None
    """Of a data set of LeRobot, counted from 0."""


@dataclasses.dataclass(frozen=True)
class _Channel:
    column: str
    joint: AssetJoint
    signal: str
    unit: str


def words_of(text: str) -> list[str]:
    """"velocityTarget_deg" -> velocity, target, deg."""
    return [word.lower() for word in re.findall(r"[A-Za-z][a-z]*|\d+", re.sub(
        r"([A-Z]+)(?=[A-Z][a-z]|\b|_)", lambda m: m[1].capitalize(), text))]


def _signal_of(words: Iterable[str], is_command: bool) -> tuple[str, str] | None:
    """The signal and unit that words tell; None where one of them is unknown."""
    kind, unit = "position", ""
    for word in words:
        if word in KINDS:
            kind = KINDS[word]
        elif word in COMMAND_WORDS:
            is_command = True
        elif word in UNIT_WORDS:
            unit = UNIT_WORDS[word] or unit
        elif word not in STATE_WORDS:
            return None
    return (f"command_{kind}" if is_command else kind), unit


class _Names:
    """Finds joints in names of columns."""

    def __init__(self, joints: Sequence[AssetJoint], how: Reading, source: str) -> None:
        self.joints, self.how, self.source = tuple(joints), how, source
        self.paths = {joint.path for joint in joints}
        #: Names of a joint in columns, longest first.
        self.known: list[tuple[str, AssetJoint]] = []
        self.whole: dict[str, tuple[AssetJoint, str]] = {}
        for joint in joints:
            self.known += [(joint.name, joint)]
            if sum(each.short == joint.short for each in joints) == 1:
                self.known += [(joint.short, joint)]
        for name, target in how.mapping.items():
            joint, signal = self.target(target)
            if signal:
                self.whole[name] = (joint, signal)
            else:
                self.known.append((name, joint))
        self.known.sort(key=lambda each: -len(each[0]))

    def target(self, text: str) -> tuple[AssetJoint, str]:
        """"shoulder.command_position" -> the joint and the signal; without one it is empty."""
        stem, _, end = text.rpartition(".")
        name, signal = (stem, end) if stem and end in SIGNALS else (text, "")
        joint = find_joint(name, self.joints)
        if joint is None:
            near = difflib.get_close_matches(name, [each.short for each in self.joints], 1)
            fix = f"did you mean {near[0]}?" if near else "joints are " + listed(
                each.short for each in self.joints)
            raise LogError(Finding("log.joint", f"the asset has no joint `{name}`", self.source,
                                   fix=fix))
        return joint, signal

    def channel(self, column: str, is_command: bool) -> _Channel | None:
        """What a column is; None for one that is not known."""
        if column in self.whole:
            joint, signal = self.whole[column]
            return _Channel(column, joint, signal, "")
        for fold in (False, True):
            for name, joint in self.known:
                rest = _without(column, name, fold)
                if rest is None:
                    continue
                found = self._told(column, joint, rest, is_command)
                if found is not None:
                    return found
        return None

    def _told(self, column: str, joint: AssetJoint, rest: str, is_command: bool
              ) -> _Channel | None:
        words = words_of(rest)
        numbers = [word for word in words if word.isdecimal()]
        dofs = [match[0] for match in re.finditer(r"\b(rot|trans)[XYZ]\b", rest)]
        if numbers or dofs:  # one of several degrees of freedom, as `tenon sim` writes them
            own = [each for each in self.joints if each.path == joint.path]
            if dofs:
                own = [each for each in own if each.dof == dofs[0]]
            elif len(numbers) == 1 and int(numbers[0]) < len(own):
                own = [own[int(numbers[0])]]
            else:
                return None
            if len(own) != 1:
                return None
            joint = own[0]
            words = words_of(re.sub(r"\b(rot|trans)[XYZ]\b|\b\d+\b", "", rest))
        signal = _signal_of(words, is_command)
        return None if signal is None else _Channel(column, joint, *signal)


@functools.lru_cache(maxsize=100_000)
def _pattern(name: str, fold: bool) -> re.Pattern[str]:
    return re.compile(rf"(?<![A-Za-z0-9]){re.escape(name)}(?![A-Za-z0-9])",
                      re.IGNORECASE if fold else 0)


def _without(column: str, name: str, fold: bool) -> str | None:
    """What of a column is left without a name that is in it as a whole; None: it is not."""
    found = _pattern(name, fold).search(column)
    if found is None:
        return None
    before = column[:found.start()]
    # "/arm/" of "/arm/shoulder.position" is a part of the path, not a word.
    before = "" if before.startswith("/") and before.endswith("/") else before
    return before + " " + column[found.end():]


# ---- a log out of tables

def joined(raw: RawLog, commands: RawLog | None, joints: Sequence[AssetJoint], metres: float,
           how: Reading, notes: list[Finding]) -> Log:
    """The log of a table, and of another one with commands of the same clock; `metres` is a unit of
    the stage. Raises LogError."""
    names = _Names(joints, how, raw.source)
    found = _signals(raw, names, metres, False, notes)
    if commands is not None:
        given = _signals(commands, names, metres, True, notes)
        found.update(_held(raw, commands, {key: value for key, value in given.items()
                                           if key not in found}))
    if not any(key[1] == "position" for key in found):
        raise raw.refuse("log.no-joint", "no column is the position of a joint of the asset",
                         f"--map COLUMN=JOINT.position; columns are {listed(raw.columns)}; joints "
                         f"are {listed(each.short for each in joints)}")
    log = _log_of(raw, found, joints)
    if log.position is None or not np.isfinite(log.position).any():
        raise raw.refuse("log.not-finite", "no position of a joint has a value",
                         "log positions, or name their column with --map COLUMN=JOINT.position")
    log = _signed(log, names, how)
    log = _whole(log, raw, how, notes)
    if how.check:
        notes += check_log(log, joints, "deg" in how.units)
    return log


Found = dict[tuple[str, str], tuple[Array, str]]


def _signals(raw: RawLog, names: _Names, metres: float, is_command: bool, notes: list[Finding]
             ) -> Found:
    """Values in SI units by joint and signal, each with its column."""
    found: Found = {}
    unused: list[str] = []
    ignored = [_expression(each, raw.columns) for each in names.how.ignore]
    _check_mapping(raw, names)
    for column, values in raw.columns.items():
        if any(each.fullmatch(column) for each in ignored) or (
                not is_command and _is_of_a_run(column, raw, names)):
            unused.append(column)
            continue
        channel = names.channel(column, is_command)
        if channel is None:
            raise _unknown(raw, column, names)
        key = (channel.joint.name, channel.signal)
        if key in found:
            raise raw.refuse("log.twice", f"is {channel.signal} of {channel.joint.name}, and so is "
                             f"`{found[key][1]}`", f"--ignore '{re.escape(column)}'", None, column)
        found[key] = (values * _factor(channel, raw, names.how, metres), column)
    if unused and not raw.in_stage_units:
        notes.append(Finding("log.ignored", f"{len(unused)} columns are not read: {listed(unused)}",
                             raw.source, raw.head, severity="info"))
    return found


def _expression(text: str, columns: Iterable[str]) -> re.Pattern[str]:
    try:
        return compile_pattern(text, columns)
    except re.error as error:
        raise LogError(Finding("log.ignore", f"`{text}` is no regular expression: {error}",
                               fix="--ignore '.*current.*', for whole names")) from None


def _check_mapping(raw: RawLog, names: _Names) -> None:
    for name in names.how.mapping:
        if not any(_without(column, name, False) is not None for column in raw.columns):
            if raw.in_stage_units:
                continue
            raise raw.refuse("log.unknown-channel", f"--map names `{name}`, which is in no column",
                             f"columns are {listed(raw.columns)}")


def _is_of_a_run(column: str, raw: RawLog, names: _Names) -> bool:
    """What `tenon sim` logs beside the states of joints: bodies, sensors, energies."""
    if not raw.in_stage_units:
        return False
    if not column.startswith("/"):
        return column.split(".")[0] in ("energy", "work")
    folder, _, last = column.rpartition("/")
    own, *words = last.split(".")
    return f"{folder}/{own}" not in names.paths or any(
        word in UNUSED or word.startswith("sensor") for word in words)


def _unknown(raw: RawLog, column: str, names: _Names) -> LogError:
    joint = next((joint for name, joint in names.known if _without(column, name, True) is not None),
                 None)
    if joint is None:
        near = difflib.get_close_matches(re.split(r"[./]", column)[0],
                                         [each.short for each in names.joints], 1)
        message = "names no joint of the asset" + (f"; did you mean {near[0]}?" if near else "")
        fix = (f"--map '{column}'=JOINT.position, or --ignore '{column}'; joints are "
               f"{listed(each.short for each in names.joints)}")
    else:
        message = f"names {joint.short}, and a signal that is not known"
        fix = (f"--map '{column}'={joint.short}.position (or .velocity, .effort, "
               f".command_position), or --ignore '{column}'")
    error = Finding("log.unknown-channel", message, raw.source, raw.head, column, fix)
    return LogError(error)


def _factor(channel: _Channel, raw: RawLog, how: Reading, metres: float) -> float:
    """From the unit of a column to rad, m and per second."""
    if channel.signal.endswith("effort"):
        return 1.0
    turns = channel.joint.rotates
    named = [unit for unit in (channel.unit,) if unit in UNITS and (unit in ANGLES) == turns]
    given = [unit for unit in how.units if (unit in ANGLES) == turns]
    if raw.in_stage_units and not named and not given:
        return UNITS["deg"] if turns else metres
    return UNITS[(given or named or ["rad" if turns else "m"])[0]]


def _held(raw: RawLog, commands: RawLog, given: Found) -> Found:
    """Commands of another table at the times of the log: each holds until the next."""
    times = commands.times + (commands.origin - raw.origin)
    at = np.searchsorted(times, raw.times + 1e-9, side="right") - 1
    if at[-1] < 0:
        raise commands.refuse("log.clock", f"begins {times[0] - raw.times[-1]:.6g} s after the log "
                              "ends", "commands take the clock of the log", 0, commands.time_name)
    held: Found = {}
    for key, (values, column) in given.items():
        filled = _forward(values)[np.maximum(at, 0)]
        held[key] = (np.where(at < 0, np.nan, filled), column)
    return held


def _forward(values: Array) -> Array:
    """Each empty cell takes what was before it."""
    at = np.where(np.isnan(values), 0, np.arange(len(values)))
    filled: Array = values[np.maximum.accumulate(at)]
    return filled


def _log_of(raw: RawLog, found: Found, joints: Sequence[AssetJoint]) -> Log:
    there = [joint.name for joint in joints if any(key[0] == joint.name for key in found)]
    signals: dict[str, Any] = {}
    for signal in SIGNALS:
        if any(key[1] == signal for key in found):
            nothing = np.full(len(raw.times), np.nan)
            columns = [found.get((name, signal), (nothing, ""))[0] for name in there]
            signals[signal] = np.stack([_forward(each) if signal in COMMANDS else each
                                        for each in columns], axis=1)
    return Log(raw.times, tuple(there), source=raw.source, rows=raw.rows, **signals)


def _signed(log: Log, names: _Names, how: Reading) -> Log:
    changed: dict[str, Any] = {}
    for text, sign in how.signs.items():
        joint, signal = names.target(text)
        if abs(sign) != 1:
            raise LogError(Finding("log.sign", f"the sign of {text} is {sign:g}", log.source,
                                   fix="1 or -1"))
        if joint.name not in log.joints:
            raise LogError(Finding("log.joint", f"the log has nothing of {joint.name}, whose sign "
                                   "is given", log.source, fix=f"it has {listed(log.joints)}"))
        at = log.joints.index(joint.name)
        for name in log.signals if not signal else [signal]:
            if name in log.signals:
                values = changed.setdefault(name, np.array(getattr(log, name)))
                values[:, at] *= sign
    return dataclasses.replace(log, **changed)


def _whole(log: Log, raw: RawLog, how: Reading, notes: list[Finding]) -> Log:
    """Without rows that have no number where the column has some; raises for the first of them."""
    missing = np.zeros(len(log), dtype=bool)
    early = np.zeros(len(log), dtype=bool)
    for signal in log.signals:
        values = getattr(log, signal)
        bad = ~np.isfinite(values)
        bad[:, np.all(np.isnan(values), axis=0)] = False  # the joint has no such channel
        if signal in COMMANDS:
            early |= np.any(bad & np.isnan(values), axis=1)
            bad &= ~np.isnan(values)
        missing |= np.any(bad, axis=1)
        if np.any(bad) and not how.allow_gaps:
            row, joint = (int(each[0]) for each in np.nonzero(bad))
            word = "has no value" if np.isnan(values[row, joint]) else "is infinite"
            raise raw.refuse("log.not-finite", f"{word} ({signal} of {log.joints[joint]})",
                             "--allow-gaps skips such rows", row,
                             _column_of(raw, log.joints[joint], signal))
    if not np.any(missing | early):
        return log
    for which, rule, message in ((missing, "log.not-finite", "rows without a state are skipped"),
                                 (early & ~missing, "log.no-command",
                                  "rows before the first command are skipped")):
        if np.any(which):
            row = int(np.flatnonzero(which)[0])
            notes.append(Finding(rule, f"{int(np.sum(which))} {message}", raw.source,
                                 int(raw.rows[row]), severity="warning"))
    keep = np.flatnonzero(~(missing | early))
    if len(keep) < 2:
        raise raw.refuse("log.samples", f"{len(keep)} of {len(log)} rows have all their values",
                         "log every signal in every row")
    made: dict[str, Any] = {name: getattr(log, name)[keep] for name in log.signals}
    return dataclasses.replace(log, times=log.times[keep], rows=raw.rows[keep], **made)


def _column_of(raw: RawLog, joint: str, signal: str) -> str:
    """A column for a message: the first that has the joint's name."""
    short = joint.rpartition("/")[2]
    words = [column for column in raw.columns if short in column]
    kind = signal.rpartition("_")[2][:3]
    return next((each for each in words if kind in each), words[0] if words else short)
