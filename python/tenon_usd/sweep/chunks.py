# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The folder of results: one file for each chunk of cases, written beside its place and moved there
when it is whole, so that a run that was killed loses only what it was working on; and one merged
file, whose bytes depend on the results alone.

    FOLDER/plan.json              the plan, its digest, the format
    FOLDER/chunks/00042.parquet   the rows of one chunk
    FOLDER/result.parquet         all rows, when all chunks are there
    FOLDER/report.html            what --report writes (report.py)
"""

from __future__ import annotations

import contextlib
import csv
import importlib
import io
import json
import os
import re
import tempfile
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from .._arrays import check_unpacked
from ..errors import check_file
from .cases import ExtraMissing
from .plan import Plan

FORMATS = ("parquet", "npz", "csv")
#: Columns that every row has, before those of the plan and behind them.
FRONT = ("case",)
BACK = ("status", "time", "rule", "error")
GROUP = 65536  # rows of one group of a merged Parquet file

Row = dict[str, Any]


class FolderError(RuntimeError):
    """A folder of results that cannot be used: the message says why and what to do."""


def columns_of(plan: Plan) -> list[tuple[str, type]]:
    """Names and types (int, float, str) of all columns, in their order."""
    columns: list[tuple[str, type]] = [("case", int)]
    for row in plan.vary:
        numbers = row.draw != "grid" or all(isinstance(value, float) for value in row.values)
        columns.append((row.name, float if numbers else str))
    columns += [(metric.name, float) for metric in plan.metrics]
    return [*columns, ("status", str), ("time", float), ("rule", str), ("error", str)]


def default_format() -> str:
    """Parquet where pyarrow is installed, else CSV."""
    try:
        _parquet()
    except ExtraMissing:
        return "csv"
    return "parquet"


def write_whole(path: str, contents: bytes) -> None:
    """Puts a file in its place when all of it is on the disk. Errors: OSError; the old one is
    left."""
    folder = os.path.dirname(path)
    handle, part = tempfile.mkstemp(prefix=".part-", dir=folder)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(contents)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(part, 0o644)
        os.replace(part, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(part)
        raise
    folder_handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(folder_handle)
    finally:
        os.close(folder_handle)


def _arrays(columns: Sequence[tuple[str, type]], rows: Sequence[Row]) -> dict[str, Any]:
    kinds = {int: np.int64, float: np.float64, str: None}
    return {name: np.array([row[name] for row in rows], dtype=kinds[kind])
            if kind is not str else [str(row[name]) for row in rows] for name, kind in columns}


def _parquet() -> Any:
    try:
        return importlib.import_module("pyarrow"), importlib.import_module("pyarrow.parquet")
    except ImportError as error:
        raise ExtraMissing("pyarrow", "parquet", "the format parquet") from error


def _encode_parquet(columns: Sequence[tuple[str, type]], rows: Sequence[Row], digest: str) -> bytes:
    pa, pq = _parquet()
    kinds = {int: pa.int64(), float: pa.float64(), str: pa.string()}
    schema = pa.schema([(name, kinds[kind]) for name, kind in columns],
                       metadata={"tenon.sweep": digest})
    table = pa.table(_arrays(columns, rows), schema=schema)
    sink = io.BytesIO()
    pq.write_table(table, sink, row_group_size=GROUP, compression="zstd")
    return sink.getvalue()


def _decode_parquet(contents: bytes) -> tuple[list[Row], str]:
    pa, pq = _parquet()
    # On this thread alone: others may still hold the buffer when Python ends.
    table = pq.ParquetFile(pa.BufferReader(contents), pre_buffer=False).read(use_threads=False)
    digest = (table.schema.metadata or {}).get(b"tenon.sweep", b"").decode()
    return table.to_pylist(), digest


def _encode_npz(columns: Sequence[tuple[str, type]], rows: Sequence[Row], digest: str) -> bytes:
    arrays = _arrays(columns, rows)
    named: dict[str, Any] = {
        f"column{at:04}": np.array(arrays[name], dtype="U" if kind is str else None)
        for at, (name, kind) in enumerate(columns)}
    sink = io.BytesIO()
    # Columns go by number: numpy cannot store a name that has a slash.
    np.savez_compressed(sink, tenon_sweep=np.array(digest),
                        columns=np.array([name for name, _ in columns]), **named)
    return sink.getvalue()


def _decode_npz(contents: bytes) -> tuple[list[Row], str]:
    check_unpacked(io.BytesIO(contents), len(contents))
    with np.load(io.BytesIO(contents), allow_pickle=False) as file:
        names = [str(name) for name in file["columns"]]
        arrays = [file[f"column{at:04}"].tolist() for at in range(len(names))]
        digest = str(file["tenon_sweep"])
    return [dict(zip(names, values, strict=True)) for values in zip(*arrays, strict=True)], digest


def _encode_csv(columns: Sequence[tuple[str, type]], rows: Sequence[Row], digest: str) -> bytes:
    sink = io.StringIO(newline="")
    writer = csv.writer(sink, lineterminator="\n")
    names = [name for name, _ in columns]
    writer.writerow(names)
    for row in rows:
        writer.writerow([repr(row[name]) if kind is float else row[name] for name, kind in columns])
    # A last line that no row has: a file that was cut, or is another plan's, is seen.
    return sink.getvalue().encode() + f"#end {len(rows)} {digest}\n".encode()


def _decode_csv(contents: bytes, kinds: dict[str, type]) -> tuple[list[Row], str]:
    text = contents.decode()
    body, mark, tail = text.rpartition("#end ")
    count, digest = tail.split()
    reader = csv.DictReader(io.StringIO(body, newline=""))
    rows = [{name: kinds.get(name, str)(value) for name, value in row.items()} for row in reader]
    if not mark or len(rows) != int(count):
        raise ValueError("the file was cut")
    return rows, digest


class Results:
    """The folder of results of one plan. Several processes may write to it at the same time: each
    file is the same whoever writes it."""

    def __init__(self, folder: str, plan: Plan, digest: str, form: str | None = None) -> None:
        """Makes or continues the folder. Errors: FolderError where it holds results of another plan
        or is no folder; OSError."""
        self.folder, self.plan, self.digest = folder, plan, digest
        self.columns = columns_of(plan)
        self.chunks = os.path.join(folder, "chunks")
        try:
            os.makedirs(self.chunks, exist_ok=True)
        except (FileExistsError, NotADirectoryError) as error:
            raise FolderError(f"{folder} is no folder; name another") from error
        self.format = self._claim(form)

    def _claim(self, form: str | None) -> str:
        """Writes plan.json, or reads the one that is there; -> the format of the folder."""
        path = os.path.join(self.folder, "plan.json")
        if not os.path.exists(path):
            chosen = form or default_format()
            if chosen == "parquet":
                _parquet()
            note = {"tenon.sweep": 1, "digest": self.digest, "format": chosen,
                    "cases": self.plan.case_count, "chunk": self.plan.chunk,
                    "plan": json.loads(self.plan.canonical())}
            part = f"{path}.{os.getpid()}"
            with open(part, "w", encoding="utf-8") as file:
                json.dump(note, file, indent=1, sort_keys=True)
                file.write("\n")
                file.flush()
                os.fsync(file.fileno())
            # Of several that begin at the same time one is first.
            with contextlib.suppress(FileExistsError):
                os.link(part, path)
            os.unlink(part)
        try:
            check_file(path)
            with open(path, encoding="utf-8") as file:
                note = json.load(file)
            known, found = note["digest"], note["format"]
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise FolderError(f"{path} is not of a sweep; name another folder with -o") from error
        if known != self.digest:
            raise FolderError(f"{self.folder} holds results of another plan, asset or version "
                              f"({str(known)[:12]}, not {self.digest[:12]}); name another folder "
                              "with -o")
        if found not in FORMATS or (form and form != found):
            raise FolderError(f"{self.folder} holds results as {found}; name another folder with "
                              "-o, or leave --format out")
        return str(found)

    def _encode(self, rows: Sequence[Row]) -> bytes:
        encode = {"parquet": _encode_parquet, "npz": _encode_npz, "csv": _encode_csv}[self.format]
        return encode(self.columns, rows, self.digest)

    def _decode(self, contents: bytes) -> tuple[list[Row], str]:
        if self.format == "csv":
            return _decode_csv(contents, dict(self.columns))
        return {"parquet": _decode_parquet, "npz": _decode_npz}[self.format](contents)

    def chunk_path(self, number: int) -> str:
        return os.path.join(self.chunks, f"{number:05}.{self.format}")

    @property
    def result_path(self) -> str:
        return os.path.join(self.folder, f"result.{self.format}")

    def write_chunk(self, number: int, rows: Sequence[Row]) -> None:
        """Errors: OSError; FolderError where the rows are not those of the chunk."""
        if [row["case"] for row in rows] != list(self.plan.chunk_cases(number)):
            raise FolderError(f"the rows are not those of chunk {number}")
        write_whole(self.chunk_path(number), self._encode(rows))

    def read_chunk(self, number: int) -> list[Row] | None:
        """The rows of a chunk; None where it is missing, damaged or of another plan."""
        return self._rows_of(self.chunk_path(number), self.plan.chunk_cases(number))

    def _rows_of(self, path: str, cases: range) -> list[Row] | None:
        try:
            check_file(path)
            with open(path, "rb") as file:
                rows, digest = self._decode(file.read())
        except ExtraMissing:
            raise
        except Exception:  # whatever a reader says of a damaged file
            return None
        names = [name for name, _ in self.columns]
        good = (digest == self.digest
                and [row.get("case") for row in rows] == list(cases)
                and all(list(row) == names for row in rows))
        return rows if good else None

    def read_result(self) -> list[Row] | None:
        """The rows of the merged file; None where it is missing, damaged or of another plan."""
        return self._rows_of(self.result_path, range(self.plan.case_count))

    def missing(self, numbers: Iterator[int] | range) -> list[int]:
        """Those chunks that are not there. Files that were begun and never finished go."""
        self._tidy()
        return [number for number in numbers if self.read_chunk(number) is None]

    def _tidy(self) -> None:
        """Removes what killed runs left: parts that nobody has touched for an hour."""
        import time
        for name in os.listdir(self.chunks):
            path = os.path.join(self.chunks, name)
            with contextlib.suppress(OSError):
                if re.match(r"\.part-", name) and time.time() - os.stat(path).st_mtime > 3600:
                    os.unlink(path)

    def rows(self) -> list[Row] | None:
        """All rows in order; None where a chunk is missing."""
        whole: list[Row] = []
        for number in range(self.plan.chunk_count):
            rows = self.read_chunk(number)
            if rows is None:
                return None
            whole += rows
        return whole

    def merge(self) -> str | None:
        """Writes the merged file when all chunks are there; -> its path, else None. Errors:
        OSError."""
        rows = self.rows()
        if rows is None:
            return None
        write_whole(self.result_path, self._encode(rows))
        return self.result_path
