# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Files of TOML that are read and checked key by key: plans of sweeps, tasks."""

from __future__ import annotations

import dataclasses
import difflib
import math
import re
from collections.abc import Iterable, Mapping
from typing import Any


@dataclasses.dataclass(frozen=True)
class Fault:
    """One thing that is wrong with a file. `row` names the row of the file ("vary 2"), `line` is
    where that row begins, or where its key stands, 0 where there is no line."""

    row: str
    line: int
    message: str

    def __str__(self) -> str:
        place = f":{self.line}" if self.line else ""
        return f"{place}: {self.row}: {self.message}" if self.row else f"{place}: {self.message}"


class FileError(ValueError):
    """A file that cannot be used: `path`, and a Fault for each thing that is wrong."""

    def __init__(self, path: str, faults: Iterable[Fault]) -> None:
        self.path, self.faults = path, tuple(faults)
        super().__init__("\n".join(f"{path}{fault}" for fault in self.faults))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.path, self.faults)


class Reader:
    """Collects the faults of one file while it is read. Not for bare keys in quotes."""

    def __init__(self, text: str) -> None:
        self.lines = text.split("\n")
        self.faults: list[Fault] = []
        self.row = ""
        self.line = 0

    def at(self, table: str, number: int) -> None:
        """What follows is about the row `number` (from 1) of the tables [[table]]."""
        self.row, self.line = f"{table} {number}", 0
        head = re.compile(rf"\s*\[\[\s*{re.escape(table)}\s*\]\]")
        found = [at for at, line in enumerate(self.lines, 1) if head.match(line)]
        if number <= len(found):
            self.line = found[number - 1]

    def at_top(self, key: str = "") -> None:
        """What follows is about the file, or about one key at its top."""
        self.row, self.line = "", 0
        if key:
            self.line = self.line_of(key)

    def line_of(self, key: str) -> int:
        """Where a key of this row stands; where the row begins, if that is not to be found."""
        for at in range(self.line, len(self.lines)):
            line = self.lines[at].partition("#")[0]
            if self.row and at > self.line and line.lstrip().startswith("["):
                break
            if re.search(rf"(^|[\s,{{]){re.escape(key)}\s*=", line) or re.match(
                    rf"\s*\[\[?\s*{re.escape(key)}\s*\]", line):
                return at + 1
        return self.line

    def fault(self, message: str, key: str = "") -> None:
        """What is wrong here, or with a key here."""
        line = self.line_of(key) if key else self.line
        self.faults.append(Fault(self.row, line, message))

    def unknown(self, table: Mapping[str, Any], known: Iterable[str]) -> None:
        """Faults for keys that a table may not have, each with its line."""
        known = tuple(known)
        for key in table:
            if key not in known:
                close = difflib.get_close_matches(key, known, 1)
                self.fault(f'there is no "{key}" here; '
                           + (f'did you mean "{close[0]}"? ' if close else "")
                           + f'there are {", ".join(known)}', key)

    def text(self, table: Mapping[str, Any], key: str, default: str | None = None) -> str | None:
        """A text that is not empty."""
        value = table.get(key, default)
        if value is not None and (not isinstance(value, str) or not value):
            self.fault(f"{key} is {value!r}; expected a text", key)
            return default
        return value

    def number(self, table: Mapping[str, Any], key: str, default: float, low: float,
               high: float) -> float:
        """A finite number of a range."""
        value = table.get(key, default)
        if not is_number(value) or not low <= value <= high:
            self.fault(f"{key} is {value!r}; expected a number from {low:g} to {high:g}", key)
            return default
        return float(value)

    def whole(self, table: Mapping[str, Any], key: str, default: int, low: int, high: int) -> int:
        """A whole number of a range."""
        value = table.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            self.fault(f"{key} is {value!r}; expected a whole number from {low} to {high}", key)
            return default
        return value


def is_number(value: Any) -> bool:
    """Whether it is a finite number, and neither true nor false."""
    return (not isinstance(value, bool) and isinstance(value, (int, float))
            and math.isfinite(value))


def rows_of(reader: Reader, table: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    """The tables [[key]]; none and a fault where it is something else."""
    rows = table.get(key, [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        reader.fault(f"{key} is a list of tables: [[{key}]]", key)
        return []
    return rows
