# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Files of TOML that are read and checked key by key: plans of sweeps, tasks."""

from __future__ import annotations

import dataclasses
import difflib
import re
import sys
import tomllib
from collections.abc import Iterable, Mapping
from typing import Any

from .errors import check_file

#: Faults that are told about one file, and characters of each.
MAX_FAULTS = 20
MAX_MESSAGE = 400
#: Names of one dotted key: tomllib takes memory with the square of them.
MAX_KEY_PARTS = 64
LONG_INTEGER = "an integer is beyond 64 bits; write it as a float, such as 1e30"


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
        self.heads: dict[str, list[int]] = {}
        self.faults: list[Fault] = []
        self.row = ""
        self.line = 0

    def at(self, table: str, number: int) -> None:
        """What follows is about the row `number` (from 1) of the tables [[table]]."""
        self.row, self.line = f"{table} {number}", 0
        if table not in self.heads:
            head = re.compile(rf"\s*\[\[\s*{re.escape(table)}\s*\]\]")
            self.heads[table] = [at for at, line in enumerate(self.lines, 1) if head.match(line)]
        found = self.heads[table]
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
        """What is wrong here, or with a key here. Of many faults the first are told."""
        if len(self.faults) < MAX_FAULTS:
            line = self.line_of(key) if key else self.line
            shown = message if len(message) <= MAX_MESSAGE else message[:MAX_MESSAGE] + "..."
            self.faults.append(Fault(self.row, line, shown))
        elif len(self.faults) == MAX_FAULTS:
            self.faults.append(Fault("", 0, "further faults are not listed; correct these first"))

    def unknown(self, table: Mapping[str, Any], known: Iterable[str]) -> None:
        """Faults for keys that a table may not have, each with its line."""
        known = tuple(known)
        for key in table:
            if key not in known and len(self.faults) <= MAX_FAULTS:
                close = difflib.get_close_matches(key, known, 1)
                self.fault(f'there is no "{key}" here; '
                           + (f'did you mean "{close[0]}"? ' if close else "")
                           + f'there are {", ".join(known)}', key)

    def text(self, table: Mapping[str, Any], key: str, default: str | None = None) -> str | None:
        """A text that is not empty, without line breaks and other control characters."""
        value = table.get(key, default)
        if value is not None and not (isinstance(value, str) and value and value.isprintable()):
            self.fault(f"{key} is {value!r}; expected a text of one line", key)
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
            and abs(value) <= sys.float_info.max)


def rows_of(reader: Reader, table: Mapping[str, Any], key: str) -> list[Mapping[str, Any]]:
    """The tables [[key]]; none and a fault where it is something else."""
    rows = table.get(key, [])
    if not isinstance(rows, list) or not all(isinstance(row, dict) for row in rows):
        reader.fault(f"{key} is a list of tables: [[{key}]]", key)
        return []
    return rows


def read_toml(path: str, most: int, error: type[FileError]) -> tuple[str, dict[str, Any]]:
    """The text of a file of TOML with at most `most` bytes, and the table that it is. Raises
    `error` with the line; OSError."""
    check_file(path)
    with open(path, "rb") as file:
        contents = file.read(most + 1)
    if len(contents) > most:
        raise error(path, [Fault("", 0, f"larger than {most} bytes")])
    try:
        text = contents.decode("utf-8-sig")
        if _has_long_key(text):
            raise ValueError(f"a key has more than {MAX_KEY_PARTS} names with dots between")
        table = tomllib.loads(text)
        if _has_long_integer(table):
            raise ValueError(LONG_INTEGER)
    except UnicodeDecodeError as reason:
        line = contents.count(b"\n", 0, reason.start) + 1
        raise error(path, [Fault("", line, f"byte 0x{contents[reason.start]:02x} is no UTF-8; "
                                 "save the file as UTF-8")]) from reason
    except RecursionError as reason:
        raise error(path, [Fault("", 0, "lists or tables nested too deep")]) from reason
    except ValueError as reason:  # tomllib says so, too, of integers with thousands of digits
        place = re.search(r" \(at line (\d+), (column \d+)\)$", str(reason))
        message = (f"{str(reason)[:place.start()]} in {place[2]}" if place else
                   LONG_INTEGER if str(reason).startswith("Exceeds the limit") else str(reason))
        raise error(path, [Fault("", int(place[1]) if place else 0, message)]) from reason
    return text, table


def _has_long_key(text: str) -> bool:
    """Numbers of a list and names in quotes count by what is between commas and brackets."""
    return any(sum(1 for part in piece.split(".") if part.strip()) > MAX_KEY_PARTS
               for piece in re.split(r"[^\w.\s\"'-]|\n", text))


def _has_long_integer(value: Any) -> bool:
    if isinstance(value, (dict, list)):
        return any(map(_has_long_integer, value.values() if isinstance(value, dict) else value))
    return isinstance(value, int) and not -(1 << 63) <= value < 1 << 63
