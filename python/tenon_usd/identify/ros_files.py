# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Logs of ROS 2: bags (rosbags) and MCAP (mcap), with states of joints and what they were told.

States are sensor_msgs/JointState, and the feedback of control_msgs/JointTrajectoryControllerState;
commands are trajectory_msgs/JointTrajectory, the reference of that state, and JointState on a topic
with a word like "command". MCAP may have the same as JSON, or objects of numbers by column. Rows
are numbers of messages on their topic.
"""

from __future__ import annotations

import dataclasses
import json
import os
import pathlib
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

from ..errors import MissingError
from .channels import COMMAND_WORDS, Reading, words_of
from .log import Array, Finding, LogError
from .log_files import UNREADABLE, finished, package
from .raw_log import MAX_VALUES, RawLog, listed

STATE = "JointState"
TRAJECTORY = "JointTrajectory"
CONTROLLER = "JointTrajectoryControllerState"
TYPES = (STATE, TRAJECTORY, CONTROLLER)
#: Parts of a controller's state, old and new names, and whether they are commands.
PARTS = (("actual", False), ("feedback", False), ("desired", True), ("reference", True))
Times = np.ndarray[Any, np.dtype[np.int64]]


@dataclasses.dataclass
class _Series:
    """One signal of one joint, as messages bring it."""

    topic: str
    times: list[int] = dataclasses.field(default_factory=list)
    """Nanoseconds."""
    values: list[float] = dataclasses.field(default_factory=list)
    rows: list[int] = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class _Plan:
    """A trajectory that was sent: positions and velocities by joint at times from its start."""

    topic: str
    start: int
    offsets: Array
    values: dict[tuple[str, str], Array]


class _Messages:
    """Takes messages one by one; gives a table."""

    def __init__(self, source: str, how: Reading) -> None:
        self.source, self.how = source, how
        self.series: dict[tuple[str, str], _Series] = {}
        self.plans: list[_Plan] = []
        self.counts: dict[str, int] = {}
        self.total = 0

    def wants(self, topic: str) -> bool:
        return not self.how.topics or topic in self.how.topics

    def refuse(self, rule: str, message: str, fix: str, topic: str = "", row: int = 0) -> LogError:
        return LogError(Finding(rule, message, self.source, row, topic, fix))

    def take(self, topic: str, kind: str, stamp: int, message: Any) -> None:
        """One message; `stamp` is when it was recorded [ns]."""
        row = self.counts[topic] = self.counts.get(topic, 0) + 1
        stamp = _header_stamp(message) or stamp
        try:
            if kind == STATE:
                self._state(topic, stamp, row, message)
            elif kind == CONTROLLER:
                self._controller(topic, stamp, row, message)
            elif kind == TRAJECTORY:
                self._trajectory(topic, stamp, row, message)
            else:
                self._numbers(topic, stamp, row, message)
        except (TypeError, ValueError, AttributeError, KeyError, OverflowError) as error:
            if isinstance(error, LogError):
                raise
            raise self.refuse("log.message", f"is no {kind}: {error!r}", "leave the topic out: "
                              "--topic NAME for those to read", topic, row) from None

    def _add(self, topic: str, name: str, signal: str, stamp: int, row: int, value: float) -> None:
        series = self.series.setdefault((name, signal), _Series(topic))
        if series.topic != topic:
            raise self.refuse("log.twice", f"has {signal} of {name}, and so has {series.topic}",
                              f"choose with --topic {series.topic}", topic, row)
        series.times.append(stamp)
        series.values.append(value)
        series.rows.append(row)
        self.total += 1
        if self.total > MAX_VALUES:
            raise self.refuse("log.too-large", f"more than {MAX_VALUES} values",
                              "cut the log into parts", topic, row)

    def _all(self, topic: str, names: list[str], signal: str, stamp: int, row: int, values: Any
             ) -> None:
        values = _listed(values)
        if not values:
            return
        if len(values) != len(names):
            raise self.refuse("log.ragged", f"has {len(values)} values of {signal} for "
                              f"{len(names)} joints", "take the message out", topic, row)
        for name, value in zip(names, values, strict=True):
            self._add(topic, name, signal, stamp, row, float(value))

    def _state(self, topic: str, stamp: int, row: int, message: Any) -> None:
        prefix = "command_" if COMMAND_WORDS & set(words_of(topic)) else ""
        names = [str(each) for each in _of(message, "name")]
        for signal in ("position", "velocity", "effort"):
            self._all(topic, names, prefix + signal, stamp, row, _of(message, signal))

    def _controller(self, topic: str, stamp: int, row: int, message: Any) -> None:
        names = [str(each) for each in _of(message, "joint_names")]
        for part, is_command in PARTS:
            point = _of(message, part)
            if point is None:
                continue
            prefix = "command_" if is_command else ""
            for key, signal in (("positions", "position"), ("velocities", "velocity"),
                                ("effort", "effort")):
                self._all(topic, names, prefix + signal, stamp, row, _of(point, key))

    def _trajectory(self, topic: str, stamp: int, row: int, message: Any) -> None:
        names = [str(each) for each in _of(message, "joint_names")]
        points = _listed(_of(message, "points"))
        if not points:
            return
        offsets = np.array([_duration(_of(point, "time_from_start")) for point in points])
        if np.any(np.diff(offsets) <= 0):
            raise self.refuse("log.time-order", "its points are not in the order of time",
                              "times from start have to increase", topic, row)
        values: dict[tuple[str, str], Array] = {}
        for key, signal in (("positions", "command_position"), ("velocities", "command_velocity")):
            rows = [_listed(_of(point, key)) for point in points]
            if not any(rows):
                continue
            if any(len(each) != len(names) for each in rows):
                raise self.refuse("log.ragged", f"has points without {key} of all its joints",
                                  "take the message out", topic, row)
            table = np.array(rows, dtype=np.float64)
            self.total += table.size
            values.update({(name, signal): table[:, k] for k, name in enumerate(names)})
        self.plans.append(_Plan(topic, stamp, offsets, values))

    def _numbers(self, topic: str, stamp: int, row: int, message: Any) -> None:
        """An object of JSON: numbers by column, as tenon_usd.logs.write() has them."""
        for name, value in dict(message).items():
            if isinstance(value, (int, float)) and not isinstance(value, bool):
                self._add(topic, str(name), "", stamp, row, float(value))

    # ---- as a table

    def table(self, there: Iterable[str]) -> RawLog:
        states = {key: each for key, each in self.series.items()
                  if not key[1].startswith("command_")}
        if not states:
            raise self.refuse("log.no-joint", "has no states of joints", "they are messages of "
                              f"{listed(TYPES)}; topics are {listed(sorted(there), 20)}")
        lead = max(states.values(), key=lambda each: len(each.times))
        start, stamps = lead.times[0], np.array(lead.times, dtype=np.int64)
        times = np.asarray((stamps - start) * 1e-9, dtype=np.float64)
        columns = {}
        for key, series in self.series.items():
            name = f"{key[0]}.{key[1]}" if key[1] else key[0]
            columns[name] = self._at(series, stamps, key[1].startswith("command_"))
        for key in dict.fromkeys(key for plan in self.plans for key in plan.values):
            if key not in self.series:
                columns[f"{key[0]}.{key[1]}"] = self._planned(key, stamps)
        return finished(RawLog(self.source, times, columns, np.array(lead.rows, dtype=np.int64),
                                start * 1e-9, 0, lead.topic))

    def _at(self, series: _Series, stamps: Times, is_command: bool) -> Array:
        """A signal at the times of the one with the most samples: states between neighbours,
        commands held."""
        own, values = np.array(series.times, dtype=np.int64), np.array(series.values)
        if len(own) == len(stamps) and np.array_equal(own, stamps):
            return values
        late = np.flatnonzero(np.diff(own) <= 0)
        if late.size:
            raise self.refuse("log.time-order", "times go back or stand still",
                              "cut the bag where the recording began anew", series.topic,
                              series.rows[int(late[0]) + 1])
        if is_command:
            at = np.searchsorted(own, stamps, side="right") - 1
            return np.asarray(np.where(at < 0, np.nan, values[np.maximum(at, 0)]))
        return np.asarray(np.interp(stamps - stamps[0], own - stamps[0], values, left=np.nan,
                                    right=np.nan))

    def _planned(self, key: tuple[str, str], stamps: Times) -> Array:
        """What trajectories say at times: straight between their points, held after the last; a
        new one begins where the one before it is."""
        found = np.full(len(stamps), np.nan)
        plans = sorted((plan for plan in self.plans if key in plan.values),
                       key=lambda plan: plan.start)
        for number, plan in enumerate(plans):
            begin = int(np.searchsorted(stamps, plan.start))
            end = len(stamps)
            if number + 1 < len(plans):
                end = int(np.searchsorted(stamps, plans[number + 1].start))
            since = (stamps[begin:end] - plan.start) * 1e-9
            offsets, values = plan.offsets, plan.values[key]
            if offsets[0] > 0 and begin > 0 and np.isfinite(found[begin - 1]):
                offsets = np.concatenate(([0.0], offsets))
                values = np.concatenate(([found[begin - 1]], values))
            found[begin:end] = np.interp(since, offsets, values)
        return found


def _of(message: Any, name: str) -> Any:
    return message.get(name) if isinstance(message, dict) else getattr(message, name, None)


def _listed(values: Any) -> list[Any]:
    """A list of what may be None, a list or an array."""
    return [] if values is None else list(values)


def _seconds_parts(value: Any) -> tuple[int, int]:
    nanoseconds = _of(value, "nanosec")
    if nanoseconds is None:
        nanoseconds = _of(value, "nsec")
    return int(_of(value, "sec") or 0), int(nanoseconds or 0)


def _duration(value: Any) -> float:
    seconds, nanoseconds = _seconds_parts(value)
    return seconds + nanoseconds * 1e-9


def _header_stamp(message: Any) -> int:
    """Of the header [ns]; 0 where there is none."""
    header = _of(message, "header")
    stamp = None if header is None else _of(header, "stamp")
    if stamp is None:
        return 0
    seconds, nanoseconds = _seconds_parts(stamp)
    return seconds * 10**9 + nanoseconds


def _kind(name: str) -> str:
    """"sensor_msgs/msg/JointState" -> "JointState"; empty for types that are not read."""
    last = name.replace(".", "/").rpartition("/")[2]
    return last if last in TYPES else ""


# ---- files

def _store() -> Any:
    typesys = package("rosbags.typesys", "reading messages of ROS", "bags")
    return typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)


def read_mcap(path: str, how: Reading) -> RawLog:
    """An .mcap file. Raises as read_log() does."""
    readers = package("mcap.reader", "reading MCAP", "bags")
    messages = _Messages(path, how)
    topics: set[str] = set()
    with open(path, "rb") as file:
        for topic, kind, stamp, message in _damage_told(_mcap_messages(readers, file, topics),
                                                        path):
            if messages.wants(topic):
                messages.take(topic, kind, stamp, message)
    return messages.table(topics)


def _mcap_messages(readers: Any, file: Any, topics: set[str]
                   ) -> Iterator[tuple[str, str, int, Any]]:
    store: Any = None
    for schema, channel, message in readers.make_reader(file).iter_messages():
        name = schema.name if schema is not None else ""
        topics.add(f"{channel.topic} ({name or channel.message_encoding})")
        kind = _kind(name)
        if channel.message_encoding == "json":
            decoded = json.loads(message.data)
            flat = isinstance(decoded, dict) and any(
                isinstance(each, (int, float)) for each in decoded.values())
            if kind or flat:
                yield channel.topic, kind, int(message.log_time), decoded
        elif channel.message_encoding == "cdr" and kind:
            store = store or _store()
            decoded = store.deserialize_cdr(message.data, _full(name))
            yield channel.topic, kind, int(message.log_time), decoded


def _full(name: str) -> str:
    """"sensor_msgs/JointState" -> "sensor_msgs/msg/JointState"."""
    parts = name.split("/")
    return name if len(parts) != 2 else f"{parts[0]}/msg/{parts[1]}"


def read_bag(path: str, how: Reading) -> RawLog:
    """A folder of a bag of ROS 2. Raises as read_log() does."""
    bags = package("rosbags.highlevel", "reading bags of ROS 2", "bags")
    messages = _Messages(path, how)
    topics: set[str] = set()
    for topic, kind, stamp, message in _damage_told(_bag_messages(bags, path, topics, messages),
                                                    path):
        messages.take(topic, kind, stamp, message)
    return messages.table(topics)


def _bag_messages(bags: Any, path: str, topics: set[str], messages: _Messages
                  ) -> Iterator[tuple[str, str, int, Any]]:
    with bags.AnyReader([pathlib.Path(os.fspath(path))], default_typestore=_store()) as reader:
        topics.update(f"{each.topic} ({each.msgtype})" for each in reader.connections)
        wanted = [each for each in reader.connections
                  if _kind(each.msgtype) and messages.wants(each.topic)]
        if not wanted:
            return
        for connection, stamp, data in reader.messages(connections=wanted):
            decoded = reader.deserialize(data, connection.msgtype)
            yield connection.topic, _kind(connection.msgtype), int(stamp), decoded


def _damage_told(found: Iterator[tuple[str, str, int, Any]], path: str
                 ) -> Iterator[tuple[str, str, int, Any]]:
    """Libraries raise whatever they like for damaged bytes."""
    count = 0
    try:
        for each in found:
            count += 1
            yield each
    except (LogError, MissingError, *UNREADABLE):
        raise
    except Exception as error:
        raise _damaged(path, count, error) from None


def _damaged(path: str, count: int, error: Exception) -> LogError:
    return LogError(Finding("log.damaged", f"cannot be read after {count} messages of joints: "
                            f"{type(error).__name__} {error}", path, count + 1, "",
                            "recover it with the tools of its format (mcap recover, ros2 bag "
                            "reindex)"))
