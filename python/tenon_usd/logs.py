# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Logs of runs for other programs: MCAP, Rerun, Parquet, NumPy archives, CSV.

    tenon sim hand.usda -o run.npz --log contacts,energy
    python -m tenon_usd.logs run.npz run.mcap

read() takes what `tenon sim -o` writes (.npz, .csv, .jsonl) and what write() wrote (.parquet);
record() makes a log of a World. write() goes by the ending: .mcap and .rrd need the extras "mcap"
and "rerun", .parquet the extra "parquet".
"""

from __future__ import annotations

import csv
import io
import json
import os
import sys
import tempfile
import zipfile
import zlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ._arrays import check_unpacked
from .errors import check_file
from .log import (
    AXES,
    BODY,
    CONTACT_NUMBERS,
    CONTACT_VECTORS,
    SIM_UNITS,
    Array,
    Log,
    LogError,
    make_log,
)
from .recording import record

__all__ = ["Log", "LogError", "main", "read", "record", "write"]

ARRAYS = {"position": "position", "orientation": "orientation", "linearVelocity": "linear_velocity",
          "angularVelocity": "angular_velocity"}


# ---- reading

def _number(text: str) -> float:
    return float(text) if text else np.nan


def _read_table(lines: Iterable[str], texts: Sequence[str] = ()) -> dict[str, Any]:
    rows = csv.reader(lines)
    head = next(rows, None)
    if not head or head[0] != "time":
        raise LogError("the first column of a log is `time`")
    values: list[list[Any]] = [[] for _ in head]
    for row in rows:
        if len(row) != len(head):
            raise LogError(f"line {rows.line_num} has {len(row)} values, not {len(head)}")
        for name, column, text in zip(head, values, row, strict=True):
            column.append(text if name in texts else _number(text))
    return {name: np.array(column, dtype=str if name in texts else np.float64)
            for name, column in zip(head, values, strict=True)}


COLLIDERS = ("collider0", "collider1", "body0", "body1")


def _contacts_path(path: str) -> str:
    stem, ending = os.path.splitext(path)
    return f"{stem}.contacts{ending}"


def _read_csv(path: str) -> Log:
    with open(path, encoding="utf-8-sig", newline="") as file:
        columns = _read_table(file)
    contacts = None
    if os.path.exists(_contacts_path(path)):
        with open(_contacts_path(path), encoding="utf-8", newline="") as file:
            contacts = _read_table(file, COLLIDERS)
    return make_log(columns.pop("time"), columns, contacts)


def _parts(path: str, what: str, count: int) -> list[str]:
    """Names of the coordinates of a joint."""
    return [f"{path}.{what}"] if count == 1 else [f"{path}.{what}.{k}" for k in range(count)]


def _camel(name: str) -> str:
    first, *rest = name.split("_")
    return first + "".join(word.capitalize() for word in rest)


def _npz_parts(arrays: Mapping[str, Any], name: str, flat: Any) -> list[str]:
    """Names of the columns of one output, as tables have them where the archive tells."""
    values, count = arrays[name], flat.shape[1]
    if name + "_names" in arrays:
        return [f"{name}.{part}" for part in _texts(arrays[name + "_names"])]
    if values.ndim == 3 and values.shape[2] == 3:
        of_bodies = name.startswith(("linear_", "angular_"))
        owners = _texts(arrays["body_paths" if of_bodies else "joint_paths"])
        if len(owners) == values.shape[1]:
            return [f"{owner}.{_camel(name)}{axis}" for owner in owners for axis in AXES]
    if name + "_offsets" in arrays:
        sensors = name.startswith("sensor_")
        owners = _texts(arrays["sensor_paths" if sensors else "joint_paths"])
        offsets = arrays[name + "_offsets"].astype(int)
        key = _camel(name.removeprefix("sensor_").removeprefix("joint_"))
        if len(offsets) == len(owners) + 1 and offsets[-1] == count:
            return [part for i, owner in enumerate(owners)
                    for part in _parts(owner, key, offsets[i + 1] - offsets[i])]
    return [f"{name}.{k}" for k in range(count)]


def _npz_outputs(arrays: Mapping[str, Any], used: set[str], samples: int) -> dict[str, Any]:
    """What is beside states."""
    columns: dict[str, Any] = {}
    for name, values in arrays.items():
        if name in used or name.startswith("contact_") or values.ndim < 2 \
                or len(values) != samples or values.dtype.kind != "f":
            continue
        flat = values.reshape(samples, -1)
        parts = _npz_parts(arrays, name, flat)
        columns.update({part: flat[:, k] for k, part in enumerate(parts)})
    return columns


def _texts(array: Any) -> list[str]:
    return [each.decode() if isinstance(each, bytes) else str(each) for each in array]


def _npz_contacts(arrays: Mapping[str, Any]) -> dict[str, Any] | None:
    if "contact_offsets" not in arrays:
        return None
    counts = np.diff(arrays["contact_offsets"])
    paths = np.array(_texts(arrays["collider_paths"]))
    pairs = arrays["contact_colliders"].astype(int)
    found: dict[str, Any] = {"time": np.repeat(arrays["time"], counts)}
    for side in range(2):
        found[f"collider{side}"] = paths[pairs[:, side]] if len(pairs) else np.zeros(0, dtype=str)
    for key in (*CONTACT_VECTORS, *CONTACT_NUMBERS):
        values = arrays["contact_" + _snake(key)]
        if key in CONTACT_VECTORS:
            found.update({key + axis: values[:, k] for k, axis in enumerate(AXES)})
        else:
            found[key] = values
    return found


def _snake(name: str) -> str:
    return "".join("_" + c.lower() if c.isupper() else c for c in name)


def _own_npz(arrays: Mapping[str, Any]) -> Log:
    """An archive of write()."""
    columns = dict(zip(_texts(arrays["columns"]), arrays["values"].T, strict=True))
    contacts = {name.removeprefix("contact."): values for name, values in arrays.items()
                if name.startswith("contact.")}
    return make_log(arrays["time"], columns, contacts or None, json.loads(str(arrays["units"])))


def _read_npz(path: str) -> Log:
    check_unpacked(path, os.stat(path).st_size)
    with np.load(path, allow_pickle=False) as file:
        arrays = {name: file[name] for name in file.files}
    if {"time", "columns", "values", "units"} <= set(arrays):
        return _own_npz(arrays)
    if "time" not in arrays or "body_paths" not in arrays:
        raise LogError("the archive has no `time` and `body_paths`")
    columns: dict[str, Any] = {}
    for i, body in enumerate(_texts(arrays["body_paths"])):
        for what, axes in BODY.items():
            columns.update({f"{body}.{what}{axis}": arrays[ARRAYS[what]][:, i, k]
                            for k, axis in enumerate(axes)})
    offsets, joints = arrays["joint_offsets"].astype(int), _texts(arrays["joint_paths"])
    if len(offsets) != len(joints) + 1 or (np.diff(offsets, prepend=0) < 0).any() or \
            offsets[-1] > arrays["joint_position"].shape[1]:
        raise LogError("`joint_offsets` does not fit `joint_paths` and `joint_position`")
    for i, joint in enumerate(joints):
        for what in ("position", "velocity"):
            for k, name in enumerate(_parts(joint, what, offsets[i + 1] - offsets[i])):
                columns[name] = arrays[f"joint_{what}"][:, offsets[i] + k]
    used = {*ARRAYS.values(), "joint_position", "joint_velocity"}
    columns.update(_npz_outputs(arrays, used, len(arrays["time"])))
    return make_log(arrays["time"], columns, _npz_contacts(arrays))


#: Lists of a line of JSON whose parts are axes, wherever they stand.
VECTORS = ("linearVelocity", "angularVelocity", "orientation", "linearAcceleration",
           "angularAcceleration", "reactionForce", "reactionTorque", "force", "torque",
           "framePosition", "frameOrientation", "frameLinearVelocity", "frameAngularVelocity")


def _flat(value: Any, name: str, of_body: bool, found: dict[str, float]) -> None:
    """Numbers of a line of JSON by the names that tables have for them."""
    if isinstance(value, dict):
        for key, each in value.items():
            _flat(each, f"{name}.{key}" if name else key, of_body, found)
    elif isinstance(value, list):
        key = name.rpartition(".")[2]
        labels = [""] if len(value) == 1 else [f".{k}" for k in range(len(value))]
        if key in VECTORS or (of_body and key == "position"):
            labels = list(BODY["orientation"] if len(value) == 4 else AXES)
        for label, each in zip(labels, value, strict=True):
            found[name + label] = float(each)
    elif isinstance(value, (int, float)):
        found[name] = float(value)


def _jsonl_contacts(lines: Sequence[Mapping[str, Any]]) -> dict[str, Any] | None:
    if not any("contacts" in line for line in lines):
        return None
    rows: list[dict[str, Any]] = []
    for line in lines:
        for contact in line.get("contacts", []):
            row: dict[str, Any] = {"time": line["time"]}
            for side in range(2):
                row[f"collider{side}"] = contact["colliders"][side]
                row[f"body{side}"] = contact["bodies"][side] or ""
            for key in (*CONTACT_VECTORS, *CONTACT_NUMBERS):
                value = contact[key]
                row.update({key + axis: value[k] for k, axis in enumerate(AXES)}
                           if key in CONTACT_VECTORS else {key: value})
            rows.append(row)
    names = list(rows[0]) if rows else ["time", *COLLIDERS]
    return {name: np.array([row[name] for row in rows]) for name in names}


#: What damaged files raise, and those that only claim to hold much.
DAMAGED = (ValueError, KeyError, IndexError, TypeError, AttributeError, EOFError, MemoryError,
           NotImplementedError, OverflowError, csv.Error, zipfile.BadZipFile, zlib.error)
#: What values raise that are not of the types that logs have.
NOT_OURS = (ValueError, KeyError, TypeError, AttributeError, IndexError, OverflowError)


def _sample(line: Mapping[str, Any]) -> dict[str, float]:
    """The numbers of a line of JSON by the names of their columns, and "time"."""
    found = {"time": float(line["time"])}
    for key, value in line.items():
        if key in ("bodies", "joints", "sensors"):
            for path, each in value.items():
                _flat(each, path, key == "bodies", found)
        elif key not in ("time", "contacts"):
            _flat(value, key, False, found)
    return found


def _read_jsonl(path: str) -> Log:
    lines: list[dict[str, Any]] = []
    samples: list[dict[str, float]] = []
    number = 0
    with open(path, encoding="utf-8-sig") as file:
        try:
            for number, text in enumerate(file, 1):
                if text.strip():
                    lines.append(json.loads(text))
                    samples.append(_sample(lines[-1]))
        except json.JSONDecodeError as error:
            raise LogError(f"line {number}, column {error.colno}: {error.msg}") from error
        except UnicodeDecodeError as error:
            raise LogError(f"is no text in UTF-8: {error.reason}") from error
        except (*NOT_OURS, RecursionError) as error:
            raise LogError(f"line {number} is not one of a log: {error!r}") from error
    names = list(samples[0]) if samples else ["time"]
    if len(names) * len(samples) > 1_000_000 + 10 * sum(map(len, samples)):
        raise LogError(f"most lines lack most of the {len(names)} numbers of the first one")
    columns = {name: [sample.get(name, np.nan) for sample in samples] for name in names}
    try:
        contacts = _jsonl_contacts(lines)
    except NOT_OURS as error:
        raise LogError(f"a contact is not one of a log: {error!r}") from error
    return make_log(columns.pop("time"), columns, contacts)


def _read_parquet(path: str) -> Log:
    pa, pq = _extra("pyarrow", "parquet"), _extra("pyarrow.parquet", "parquet")
    table = pq.ParquetFile(path, pre_buffer=False).read(use_threads=False)
    columns = {name: table[name].to_numpy() for name in table.column_names}
    units = json.loads((table.schema.metadata or {}).get(b"tenon.units", b"{}"))
    contacts = None
    if os.path.exists(_contacts_path(path)):
        other = pq.ParquetFile(_contacts_path(path), pre_buffer=False).read(use_threads=False)
        contacts = {name: np.array(other[name].to_pylist()) if pa.types.is_string(
            other[name].type) else other[name].to_numpy() for name in other.column_names}
    if "time" not in columns:
        raise LogError("the table has no column `time`")
    return make_log(columns.pop("time"), columns, contacts, units or SIM_UNITS)


READERS: dict[str, Callable[[str], Log]] = {
    ".csv": _read_csv, ".npz": _read_npz, ".jsonl": _read_jsonl, ".parquet": _read_parquet}


def read(path: str | os.PathLike[str]) -> Log:
    """Reads a log of `tenon sim -o` (.npz, .csv, .jsonl), or a .parquet of write(). Raises
    LogError, OSError."""
    path = os.fspath(path)
    ending = os.path.splitext(path)[1]
    if ending not in READERS:
        raise LogError(f"{path}: logs that can be read end in {', '.join(READERS)}")
    check_file(path)
    try:
        return READERS[ending](path)
    except (LogError, *DAMAGED) as error:
        raise LogError(f"{path}: {error or type(error).__name__}") from error


# ---- writing

def _extra(module: str, extra: str) -> Any:
    import importlib
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise RuntimeError(f"this format needs {module.partition('.')[0]}: "
                           f"pip install 'tenon-usd[{extra}]'") from error


def _csv_bytes(time: Any, columns: Mapping[str, Any]) -> bytes:
    sink = io.StringIO(newline="")
    writer = csv.writer(sink, lineterminator="\n")
    writer.writerow(["time", *columns])
    for row in zip(time, *columns.values(), strict=True):
        writer.writerow([repr(float(v)) if isinstance(v, (float, np.floating)) else str(v)
                         for v in row])
    return sink.getvalue().encode()


def _csv(log: Log, path: str) -> dict[str, bytes]:
    files = {path: _csv_bytes(log.time, log.columns)}
    if log.contacts is not None:
        rest = {name: values for name, values in log.contacts.items() if name != "time"}
        files[_contacts_path(path)] = _csv_bytes(log.contacts["time"], rest)
    return files


def _npz(log: Log, path: str) -> dict[str, bytes]:
    """time, columns (their names) and values (samples, columns); contacts and units likewise."""
    arrays: dict[str, Any] = {"time": log.time, "columns": np.array(list(log.columns)),
                              "values": np.stack(list(log.columns.values()), axis=1)
                              if log.columns else np.zeros((len(log.time), 0))}
    for name, values in (log.contacts or {}).items():
        arrays[f"contact.{name}"] = values
    arrays["units"] = np.array(json.dumps(log.units))
    sink = io.BytesIO()
    np.savez_compressed(sink, **arrays)
    return {path: sink.getvalue()}


def _parquet(log: Log, path: str) -> dict[str, bytes]:
    pa, pq = _extra("pyarrow", "parquet"), _extra("pyarrow.parquet", "parquet")

    def table(columns: Mapping[str, Any]) -> bytes:
        made = pa.table({name: pa.array(values.tolist()) for name, values in columns.items()})
        made = made.replace_schema_metadata({"tenon.units": json.dumps(log.units)})
        sink = io.BytesIO()
        pq.write_table(made, sink, compression="zstd")
        return sink.getvalue()

    files = {path: table({"time": log.time, **log.columns})}
    if log.contacts is not None:
        files[_contacts_path(path)] = table(log.contacts)
    return files


def _stamp(seconds: float) -> int:
    return max(0, round(seconds * 1e9))


def _object(**properties: str) -> dict[str, Any]:
    return {"type": "object", "properties": {name: {"type": kind} for name, kind in
                                             properties.items()}}


def _transforms(log: Log, sample: int, scale: float, poses: Mapping[str, tuple[Array, Array]]
                ) -> dict[str, Any]:
    stamp = _stamp(log.time[sample])
    rows = []
    for path, (positions, quaternions) in poses.items():
        x, y, z = (positions[sample] * scale).tolist()
        qw, qx, qy, qz = quaternions[sample].tolist()
        rows.append({"timestamp": {"sec": stamp // 10**9, "nsec": stamp % 10**9},
                     "parent_frame_id": "world", "child_frame_id": path,
                     "translation": {"x": x, "y": y, "z": z},
                     "rotation": {"x": qx, "y": qy, "z": qz, "w": qw}})
    return {"transforms": rows}


def _contact_rows(log: Log, sample: int, scale: float) -> dict[str, Any]:
    assert log.contacts is not None
    lengths = ("point.x", "point.y", "point.z", "depth")
    return {"contacts": [
        {name: values[i].item() * (scale if name in lengths else 1)
         if values.dtype.kind == "f" else str(values[i]) for name, values in log.contacts.items()}
        for i in log.contacts_at(sample)]}


def _mcap(log: Log, path: str, scale: float) -> dict[str, bytes]:
    """Poses on "/tf" as foxglove.FrameTransforms [m], all other columns on "/values", contacts on
    "/contacts"; messages are JSON."""
    writers = _extra("mcap.writer", "mcap")
    sink = io.BytesIO()
    writer = writers.Writer(sink, compression=writers.CompressionType.ZSTD)
    writer.start(profile="", library="tenon")
    writer.add_metadata("tenon.units", {**log.units, "length of /tf and /contacts": "m"})

    def channel(topic: str, schema: str, shape: Mapping[str, Any]) -> int:
        known = writer.register_schema(schema, "jsonschema", json.dumps(shape).encode())
        return int(writer.register_channel(topic, "json", known))

    others = log.others()
    poses = {path: (log.body(path, "position"), log.body(path, "orientation"))
             for path in log.bodies}
    tf = channel("/tf", "foxglove.FrameTransforms", _object(transforms="array"))
    values = channel("/values", "tenon.Values", _object(**dict.fromkeys(others, "number")))
    contacts = None if log.contacts is None else channel("/contacts", "tenon.Contacts",
                                                         _object(contacts="array"))
    for sample in range(len(log.time)):
        messages: list[tuple[int, Any]] = [
            (tf, _transforms(log, sample, scale, poses)),
            (values, {name: column[sample].item() for name, column in others.items()
                      if np.isfinite(column[sample])})]
        if contacts is not None:
            messages.append((contacts, _contact_rows(log, sample, scale)))
        stamp = _stamp(log.time[sample])
        for where, message in messages:
            writer.add_message(where, stamp, json.dumps(message).encode(), stamp, sample)
    writer.finish()
    return {path: sink.getvalue()}


def _rrd(log: Log, path: str, scale: float) -> None:
    """Poses as transforms below "bodies" [m], other columns as scalars below "values", contacts as
    points "contacts" [m]."""
    rr = _extra("rerun", "rerun")
    recording = rr.RecordingStream("tenon", recording_id="tenon-log")
    recording.save(path)
    index = rr.TimeColumn("time", duration=log.time)
    for body in log.bodies:
        quaternions = log.body(body, "orientation")[:, [1, 2, 3, 0]]
        rr.send_columns(rr.new_entity_path(["bodies", body]), indexes=[index],
                        columns=rr.Transform3D.columns(
                            translation=log.body(body, "position") * scale,
                            quaternion=quaternions), recording=recording)
    for name, column in log.others().items():
        rr.send_columns(rr.new_entity_path(["values", name]), indexes=[index],
                        columns=rr.Scalars.columns(scalars=column), recording=recording)
    if log.contacts is not None:
        points = np.stack([log.contacts[f"point{axis}"] for axis in AXES], axis=1) * scale \
            if len(log.contacts["time"]) else np.zeros((0, 3))
        counts = [len(log.contacts_at(sample)) for sample in range(len(log.time))]
        rr.send_columns("contacts", indexes=[index], columns=rr.Points3D.columns(
            positions=points).partition(lengths=counts), recording=recording)
    recording.flush()
    recording.disconnect()


WRITERS = (".mcap", ".rrd", ".parquet", ".npz", ".csv")


def write(log: Log, path: str | os.PathLike[str], meters_per_unit: float = 1.0) -> None:
    """Writes a log by the ending of `path`: .mcap, .rrd, .parquet, .npz, .csv; whole or not at all.

    `meters_per_unit` turns lengths of the stage into metres for .mcap and .rrd, whose viewers
    expect them; other formats keep the log's units. Contacts of .csv and .parquet stand in a second
    file, "run.contacts.csv". Raises LogError, OSError, RuntimeError where an extra is missing.
    """
    from .sweep.chunks import write_whole
    path = os.path.abspath(path)
    ending = os.path.splitext(path)[1]
    scale = meters_per_unit if log.units.get("length") != "m" else 1.0
    if ending == ".rrd":
        handle, part = tempfile.mkstemp(prefix=".part-", suffix=".rrd", dir=os.path.dirname(path))
        os.close(handle)
        try:
            _rrd(log, part, scale)
            os.chmod(part, 0o644)
            os.replace(part, path)
        finally:
            if os.path.exists(part):
                os.unlink(part)
        return
    if ending == ".mcap":
        files = _mcap(log, path, scale)
    elif ending in WRITERS:
        files = {".csv": _csv, ".npz": _npz, ".parquet": _parquet}[ending](log, path)
    else:
        raise LogError(f"{path}: logs that can be written end in {', '.join(WRITERS)}")
    for name, contents in reversed(files.items()):
        write_whole(name, contents)


def main(words: list[str] | None = None) -> int:
    """`python -m tenon_usd.logs IN OUT [--meters-per-unit M]`; -> exit code."""
    import argparse
    parser = argparse.ArgumentParser("python -m tenon_usd.logs", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input")
    parser.add_argument("output")
    parser.add_argument("--meters-per-unit", type=float, default=1.0)
    given = parser.parse_args(words)
    both = (given.input, given.output)
    if all(map(os.path.exists, both)) and os.path.samefile(*both):
        print("error: the output is the input", file=sys.stderr)
        return 2
    try:
        write(read(given.input), given.output, given.meters_per_unit)
    except (LogError, OSError, RuntimeError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 4 if isinstance(error, RuntimeError) else 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
