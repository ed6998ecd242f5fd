# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What the commands of this package share: how they begin, and how they end with an error."""

from __future__ import annotations

import argparse
import difflib
import json
import os
import sys
from collections.abc import Sequence
from typing import Any


def arguments_of(parser: argparse.ArgumentParser,
                 words: list[str] | None) -> argparse.Namespace | int:
    """The arguments, or the exit code where there is nothing to run: help was printed, a word is
    wrong, or standard output is closed."""
    try:
        arguments = parser.parse_args(words)
    except SystemExit as end:
        return int(end.code or 0)
    if sys.stdout is None:
        print("error: standard output is closed", file=sys.stderr)
        return 2
    return arguments


class ProgressLine:
    """One line of standard error that is written over; nothing where no terminal shows it."""

    def __init__(self, quiet: bool) -> None:
        self.on = not quiet and sys.stderr.isatty()

    def show(self, text: str) -> None:
        if self.on:
            print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        self.show("")


def text_of(error: Exception) -> str:
    """Of errors of the system the file first, as everywhere, and what may have been meant."""
    if type(error).__module__ != "builtins" or not isinstance(error, OSError) \
            or not isinstance(error.filename, str):
        return str(error)
    folder, name = os.path.split(error.filename)
    near: list[str] = []
    if isinstance(error, FileNotFoundError) and os.path.isdir(folder or "."):
        near = difflib.get_close_matches(name, os.listdir(folder or "."), 1)
    return f"{error.filename}: {error.strerror}" + (
        f"; did you mean {os.path.join(folder, near[0])}?" if near else "")


def fail(error: Exception, code: int, schema: str | None, lines: Sequence[str] | None = None,
         **fields: Any) -> int:
    """Prints an error, with a schema also as JSON with `fields`; -> the code. `lines` are those of
    its text."""
    try:
        if schema is not None:
            print(json.dumps({"tool": "tenon", "schema": schema, "ok": False,
                              "error": text_of(error), **fields}), flush=True)
        else:
            sys.stdout.flush()
    except OSError:  # Python flushes once more at its end
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    for line in text_of(error).split("\n") if lines is None else lines:
        # Control characters come from files, and would be orders to a terminal.
        shown = "".join(c if c.isprintable() else f"\\x{ord(c):02x}" for c in line)
        print(f"error: {shown}", file=sys.stderr)
    return code
