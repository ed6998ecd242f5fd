# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Reads logs of robots: CSV, NumPy archives, Parquet, data sets of LeRobot, and by ros_files.py
MCAP and bags of ROS 2.

    log, notes = read_log("run.csv", tenon_usd.physics("arm.usda"))

Files are taken for hostile: what is damaged is a LogError with file, row and column.
"""

from __future__ import annotations

import array
import csv
import dataclasses
import importlib
import json
import os
import re
import zipfile
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import MissingError, check_file
from .channels import Reading, joined
from .joints import AssetJoint, asset_joints
from .log import Finding, Log, LogError
from .raw_log import (MAX_BYTES, MAX_COLUMNS, MAX_VALUES, RawLog, check_times, listed, table_of,
                      time_column)

if TYPE_CHECKING:
    from .._tenon import PhysicsScene

FORMATS = ("a .csv, .tsv, .npz, .jsonl, .parquet or .mcap file, a folder of a ROS 2 bag "
           "(metadata.yaml) or of a LeRobot data set (meta/info.json)")
MAX_EPISODES = 100_000
#: Bytes that an archive may unpack to, and such bytes more for each of its own.
UNPACKED = 64 << 20
UNPACKED_PER_BYTE = 40
#: What is about a file and not about its bytes.
UNREADABLE = (FileNotFoundError, PermissionError, IsADirectoryError)


def read_log(path: str | os.PathLike[str], asset: PhysicsScene | Sequence[AssetJoint],
             how: Reading | None = None) -> tuple[Log, list[Finding]]:
    """A log of the joints of an asset in SI units, and what is to be told about it.

    `asset` is the scene of tenon_usd.physics(), or the joints of asset_joints(). The format follows
    from the name. Raises LogError (which has file, row, channel and fix), OSError, and MissingError
    for a package that is not installed.
    """
    how = how or Reading()
    if isinstance(asset, Sequence):
        joints, metres = tuple(asset), 1.0
    else:
        joints, metres = asset_joints(asset), asset.meters_per_unit
    notes: list[Finding] = []
    name = os.fspath(path)
    raw = _checked(read_table(name, how), how, notes)
    commands = None
    if how.commands:
        commands = _checked(read_table(os.fspath(how.commands), how),
                            dataclasses.replace(how, allow_gaps=True), [])
        commands.in_stage_units = True
    return joined(raw, commands, joints, metres, how, notes), notes


def read_table(path: str, how: Reading | None = None) -> RawLog:
    """The columns of a file as they are, with their times. Raises as read_log() does."""
    how = how or Reading()
    if os.path.isdir(path):
        if os.path.exists(os.path.join(path, "meta", "info.json")):
            return _read_lerobot(path, how)
        if os.path.exists(os.path.join(path, "metadata.yaml")):
            from .ros_files import read_bag
            return read_bag(path, how)
        raise _refusal("log.format", "is a folder of neither a bag nor a data set", path)
    _check_size(path)
    ending = os.path.splitext(path)[1].lower()
    if ending in (".csv", ".tsv", ".txt"):
        return _read_csv(path, how)
    if ending == ".npz":
        return _read_npz(path, how)
    if ending == ".jsonl":
        return _own_log(path, how)
    if ending == ".parquet":
        return _read_parquet(path, how)
    if ending == ".mcap":
        from .ros_files import read_mcap
        return read_mcap(path, how)
    if ending in (".db3", ".bag"):
        raise _refusal("log.format", "is a part of a bag", path,
                       "give the folder with metadata.yaml; bags of ROS 1: rosbags-convert")
    raise _refusal("log.format", f"ends in `{ending}`", path)


def _refusal(rule: str, message: str, path: str, fix: str = "", row: int = 0,
             channel: str = "") -> LogError:
    return LogError(Finding(rule, message, path, row, channel, fix or f"give {FORMATS}"))


def _check_size(path: str) -> None:
    check_file(path)
    size = os.stat(path).st_size
    if size > MAX_BYTES:
        raise _refusal("log.too-large", f"has {size} bytes; at most {MAX_BYTES}", path,
                       "cut the log into parts")


def _checked(raw: RawLog, how: Reading, notes: list[Finding]) -> RawLog:
    check_times(raw, how.allow_gaps, notes)
    return raw


def package(module: str, what: str, extra: str) -> Any:
    """An optional package. Raises MissingError, which says how to get it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        name = module.partition(".")[0]
        raise MissingError(f"{what} needs the Python package {name} ({error}): "
                           f"pip install 'tenon-usd[{extra}]'") from None


# ---- tables with separators

def _read_csv(path: str, how: Reading) -> RawLog:
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            return _table_of_lines(file, path, how)
    except UnicodeDecodeError as error:
        raise _refusal("log.text", f"is no text in UTF-8: {error.reason} at byte {error.start}",
                       path, "save it as UTF-8") from None
    except csv.Error as error:
        raise _refusal("log.text", f"is no table: {error}", path,
                       "look for a quote that is not closed") from None


def _separator(head: str) -> str:
    return max(",;\t", key=head.count)


def _table_of_lines(file: Any, path: str, how: Reading) -> RawLog:
    head, line = "", 0
    for line, text in enumerate(file, 1):
        if text.strip() and not text.startswith("#"):
            head = text
            break
    if not head:
        raise _refusal("log.empty", "has no row with names of columns", path,
                       "the first row has to name the columns, one of them `time`")
    separator = _separator(head)
    names = [name.strip() for name in next(csv.reader([head], delimiter=separator))]
    _check_names(names, path, line)
    rows, numbers, table = csv.reader(file, delimiter=separator), array.array("q"), array.array("d")
    for row in rows:
        at = line + rows.line_num
        if not row or (len(row) == 1 and not row[0].strip()):
            continue
        if len(row) != len(names):
            raise _refusal("log.ragged", f"has {len(row)} values, while {len(names)} columns are "
                           "named", path, "the row is cut short or has a separator too many; "
                           "delete it", at)
        numbers.append(at)
        table.extend(_numbers(row, names, path, at))
        if len(table) > MAX_VALUES:
            raise _refusal("log.too-large", f"more than {MAX_VALUES} values", path,
                           "cut the log into parts", at)
    values = np.array(table, dtype=np.float64).reshape(len(numbers), len(names))
    name, _ = time_column(names, how.time, path, line)
    at_time = names.index(name)
    times: Any = values[:, at_time]
    if len(numbers) and abs(float(values[0, at_time])) > 1e15:
        times = _whole_times(path, line, separator, at_time, len(numbers))
    columns = {each: values[:, k] for k, each in enumerate(names)} | {name: times}
    return finished(table_of(names, columns, path, how.time, line, numbers))


def _whole_times(path: str, head: int, separator: str, at: int, count: int) -> Any:
    """Nanoseconds of a clock, of which doubles would lose the last digits."""
    with open(path, encoding="utf-8-sig", newline="") as file:
        for _ in range(head):
            next(file)
        texts = [row[at] for row in csv.reader(file, delimiter=separator)
                 if len(row) > 1 or (row and row[0].strip())]
    try:
        return np.array([int(text) for text in texts[:count]], dtype=np.int64)
    except (ValueError, OverflowError):
        return np.array([float(text or "nan") for text in texts[:count]])


def _check_names(names: list[str], path: str, line: int) -> None:
    if len(names) > MAX_COLUMNS:
        raise _refusal("log.too-large", f"{len(names)} columns; at most {MAX_COLUMNS}", path,
                       "leave out what is not of joints", line)
    seen: set[str] = set()
    for number, name in enumerate(names, 1):
        if not name:
            raise _refusal("log.columns", f"column {number} has no name", path,
                           "name it, or take it out", line)
        if name in seen:
            raise _refusal("log.columns", "is the name of two columns", path, "rename one of them",
                           line, name)
        seen.add(name)


def _numbers(row: list[str], names: list[str], path: str, line: int) -> list[float]:
    """Empty cells are NaN; anything else has to be a number."""
    try:
        return [float(text) if text else np.nan for text in row]
    except ValueError:
        for name, text in zip(names, row, strict=True):
            try:
                float(text or "nan")
            except ValueError:
                raise _refusal("log.number", f"{text[:40]!r} is no number", path,
                               "correct the cell, or leave it empty", line, name) from None
        raise


def finished(raw: RawLog) -> RawLog:
    """Paths of prims as names are what `tenon sim` writes."""
    states = re.compile(r"^/.*\.(position|velocity|driveEffort|orientation)(\.[\w]+)?$")
    raw.in_stage_units = any(states.match(name) for name in raw.columns)
    return raw


# ---- archives of NumPy

#: Names of arrays with a column for each joint, by the signal that they are.
ARRAYS = {"position": "position", "positions": "position", "q": "position", "qpos": "position",
          "velocity": "velocity", "velocities": "velocity", "qd": "velocity", "dq": "velocity",
          "qvel": "velocity", "effort": "effort", "efforts": "effort", "torque": "effort",
          "tau": "effort", "joint_position": "position", "joint_velocity": "velocity",
          "joint_effort": "effort", "command_position": "command_position",
          "command_velocity": "command_velocity", "command_effort": "command_effort"}
JOINT_NAMES = ("joints", "joint_names", "names")


def _read_npz(path: str, how: Reading) -> RawLog:
    arrays = _arrays(path)
    if "time" in arrays and "joint_paths" in arrays and "joint_offsets" in arrays:
        return _own_log(path, how)
    if {"time", "columns", "values"} <= set(arrays):
        return _own_table(arrays, path, how)
    names = [str(each) for key in JOINT_NAMES if key in arrays for each in arrays[key].ravel()]
    columns: dict[str, Any] = {}
    for key, values in arrays.items():
        _check_signal(key, values, path)
        if values.ndim == 1 and values.dtype.kind in "fiub":
            columns[key] = values
        elif values.ndim == 2 and values.dtype.kind in "fiub":
            if key not in ARRAYS:
                raise _refusal("log.unknown-channel", "is an array of an unknown signal", path,
                               f"arrays are named {listed(ARRAYS, 20)}", 0, key)
            if values.shape[1] != len(names):
                raise _refusal("log.ragged", f"has {values.shape[1]} columns, while `joints` names "
                               f"{len(names)}", path, "one name for each column", 0, key)
            parts = {f"{name}.{ARRAYS[key]}": values[:, k] for k, name in enumerate(names)}
            if len(parts) < len(names) or parts.keys() & columns.keys():
                raise _refusal("log.columns", "gives a joint a signal that it has already", path,
                               "leave one of the arrays, or of the joints, out", 0, key)
            columns.update(parts)
    return finished(table_of(list(columns), columns, path, how.time))


def _check_signal(key: str, values: Any, path: str) -> None:
    """An array with the name of a signal is one."""
    if key in ARRAYS and (values.ndim not in (1, 2) or values.dtype.kind not in "fiub"):
        raise _refusal("log.number", f"is an array of {values.dtype} of the shape {values.shape}",
                       path, "numbers, rows x joints", 0, key)


def _arrays(path: str) -> dict[str, Any]:
    """The arrays of an archive, without pickled objects; their sizes are known before."""
    try:
        with zipfile.ZipFile(path) as archive:
            whole = sum(entry.file_size for entry in archive.infolist())
        most = min(8 * MAX_VALUES, UNPACKED + UNPACKED_PER_BYTE * os.stat(path).st_size)
        if whole > most:
            raise _refusal("log.too-large", f"unpacks to {whole} bytes; at most {most}",
                           path, "cut the log into parts, or write it with numpy.savez")
        with np.load(path, allow_pickle=False) as file:
            # What is beside the arrays has another ending, and comes as bytes.
            return {name: values for name in file.files
                    if not isinstance(values := file[name], bytes)}
    except (LogError, *UNREADABLE):
        raise
    except Exception as error:  # what zipfile, zlib and NumPy raise for damaged bytes
        raise _refusal("log.damaged", f"is no whole archive of NumPy: {error}", path,
                       "write it again with numpy.savez, without objects") from None


def _own_log(path: str, how: Reading) -> RawLog:
    """What `tenon sim -o run.npz` and run.jsonl write."""
    from .. import logs

    try:
        read = logs.read(path)
    except (ValueError, KeyError, IndexError, TypeError, AttributeError) as error:
        why = str(error).removeprefix(f"{path}: ")
        raise _refusal("log.damaged", f"is no log of a run: {why}", path,
                       "write it again with `tenon sim -o`") from None
    columns: dict[str, Any] = {"time": read.time, **read.columns}
    return finished(table_of(list(columns), columns, path, how.time))


def _own_table(arrays: Mapping[str, Any], path: str, how: Reading) -> RawLog:
    """What tenon_usd.logs.write() and `tenon excite` write: rows x columns."""
    names, values = [str(each) for each in arrays["columns"].ravel()], arrays["values"]
    if values.ndim != 2 or values.shape[1] != len(names) or values.dtype.kind not in "fiu":
        raise _refusal("log.ragged", f"has the shape {values.shape} for {len(names)} columns", path,
                       "rows x columns", 0, "values")
    _check_names(names, path, 0)
    columns: dict[str, Any] = {"time": arrays["time"]}
    columns.update({name: values[:, k] for k, name in enumerate(names)})
    return finished(table_of(list(columns), columns, path, how.time))


# ---- Parquet

def _read_parquet(path: str, how: Reading, names: Mapping[str, Sequence[str]] | None = None,
                  episode: int | None = None) -> RawLog:
    parquet = package("pyarrow.parquet", "reading Parquet", "parquet")
    try:
        file = parquet.ParquetFile(path, pre_buffer=False)
        if file.metadata.num_rows * max(file.metadata.num_columns, 1) > MAX_VALUES:
            raise _refusal("log.too-large", f"more than {MAX_VALUES} values", path,
                           "cut the log into parts")
        table = file.read(use_threads=False)
        columns, count = _arrow_columns(table, path, names or {})
    except (LogError, *UNREADABLE):
        raise
    except Exception as error:  # what Arrow raises for damaged bytes
        raise _refusal("log.damaged", f"is no whole Parquet file: {error}", path) from None
    rows = np.arange(1, count + 1)
    columns, rows = _one_episode(columns, rows, path, episode)
    return finished(table_of(list(columns), columns, path, how.time, 0, rows))


def _arrow_columns(table: Any, path: str, names: Mapping[str, Sequence[str]]
                   ) -> tuple[dict[str, Any], int]:
    """Numbers of a table; lists become a column for each of their parts."""
    arrow = package("pyarrow", "reading Parquet", "parquet")
    columns: dict[str, Any] = {}
    for field in table.schema:
        column = table[field.name]
        kind = field.type
        if arrow.types.is_timestamp(kind):
            column = column.cast(arrow.timestamp("ns")).cast(arrow.int64())
            columns[field.name] = column.to_numpy()
        elif arrow.types.is_integer(kind) or arrow.types.is_floating(kind) \
                or arrow.types.is_boolean(kind):
            columns[field.name] = column.to_numpy()
        elif arrow.types.is_list(kind) or arrow.types.is_fixed_size_list(kind) \
                or arrow.types.is_large_list(kind):
            columns.update(_parts(field.name, column.to_pylist(), path, names))
    return columns, table.num_rows


def _parts(name: str, lists: list[Any], path: str, names: Mapping[str, Sequence[str]]
           ) -> dict[str, Any]:
    width = len(lists[0] or ()) if lists else 0
    for row, values in enumerate(lists, 1):
        if values is None or len(values) != width:
            raise _refusal("log.ragged", f"has {0 if values is None else len(values)} values, "
                           f"while row 1 has {width}", path, "take the row out", row, name)
    if not width or not all(isinstance(value, (int, float)) for value in lists[0]):
        return {}
    try:
        values = np.array(lists, dtype=np.float64)
    except (TypeError, ValueError):
        raise _refusal("log.number", "has values that are no numbers", path,
                       "take such rows out", 0, name) from None
    parts = names.get(name) or [str(k) for k in range(width)]
    if len(parts) != width:
        raise _refusal("log.ragged", f"has {width} values, while meta/info.json names "
                       f"{len(parts)}", path, "correct meta/info.json", 0, name)
    return {f"{name}.{part}": values[:, k] for k, part in enumerate(parts)}


def _one_episode(columns: dict[str, Any], rows: Any, path: str, episode: int | None
                 ) -> tuple[dict[str, Any], Any]:
    """The rows of one episode; of LeRobot the counters are no channels."""
    numbers = columns.get("episode_index")
    if numbers is None:
        return columns, rows
    there = np.unique(numbers)
    if episode is None and len(there) > 1:
        raise _refusal("log.episodes", f"has {len(there)} episodes", path,
                       f"choose one with --episode, {there[0]:g} to {there[-1]:g}")
    chosen = numbers == (there[0] if episode is None and len(there) else episode)
    if not np.any(chosen):
        raise _refusal("log.episodes", f"has no episode {episode}", path,
                       f"there are {listed([f'{each:g}' for each in there])}")
    counters = ("episode_index", "frame_index", "index", "task_index", "next.reward", "next.done",
                "next.success")
    return ({name: values[chosen] for name, values in columns.items() if name not in counters},
            rows[chosen])


# ---- LeRobot

def _read_lerobot(path: str, how: Reading) -> RawLog:
    about = os.path.join(path, "meta", "info.json")
    _check_size(about)
    try:
        with open(about, encoding="utf-8") as file:
            info = json.load(file)
        features = {name: _feature_names(each) for name, each in info["features"].items()
                    if isinstance(each, dict)}
        pattern, size = str(info.get("data_path", "")), int(info.get("chunks_size", 1000))
        count = int(info["total_episodes"])
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise _refusal("log.damaged", f"is no description of a data set: {error!r}", about,
                       "take the whole folder of the data set") from None
    if how.episode is None and count != 1:
        raise _refusal("log.episodes", f"has {count} episodes", path,
                       f"choose one with --episode, 0 to {count - 1}")
    episode = how.episode or 0
    if not 0 <= episode < min(count, MAX_EPISODES):
        raise _refusal("log.episodes", f"has no episode {episode}", path,
                       f"there are 0 to {count - 1}")
    names = {name: parts for name, parts in features.items() if parts}
    for file_name in _lerobot_files(path, pattern, episode, max(size, 1)):
        raw = _try_episode(file_name, how, names, episode)
        if raw is not None:
            return raw
    raise _refusal("log.episodes", f"no file below data/ has episode {episode}", path,
                   "download the data of the data set, too")


def _feature_names(feature: Mapping[str, Any]) -> list[str]:
    names = feature.get("names")
    if isinstance(names, Mapping):  # {"motors": [...]}, or a list for each axis
        names = next(iter(names.values()), None)
    return [str(each) for each in names] if isinstance(names, list) else []


def _lerobot_files(path: str, pattern: str, episode: int, size: int) -> list[str]:
    """Where an episode may be: its own file (version 2), or one of those with many (version 3)."""
    if "{episode_index" in pattern:
        numbers = {"episode_chunk": episode // size, "episode_index": episode}
        own = re.sub(r"\{(episode_chunk|episode_index)(?::0?(\d)d)?\}",
                     lambda part: str(numbers[part[1]]).zfill(int(part[2] or 0)), pattern)
        # The pattern is of the file; what it leads to is not outside of the folder.
        whole = os.path.normpath(os.path.join(path, own))
        if own and whole.startswith(os.path.normpath(path) + os.sep) and os.path.exists(whole):
            return [whole]
    found = []
    for folder, folders, files in os.walk(os.path.join(path, "data")):
        folders.sort()
        found += [os.path.join(folder, name) for name in sorted(files)
                  if name.endswith(".parquet")]
    return found[:MAX_EPISODES]


def _try_episode(file_name: str, how: Reading, names: Mapping[str, Sequence[str]],
                 episode: int) -> RawLog | None:
    _check_size(file_name)
    try:
        return _read_parquet(file_name, how, names, episode)
    except LogError as error:
        if error.rule == "log.episodes":
            return None
        raise
