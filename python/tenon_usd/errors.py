# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What is raised where something cannot be done."""

from __future__ import annotations

import errno
import os
import stat
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ._tenon import Diagnostic


class Error(Exception):
    """Why something could not be done, with its place and what to do about it.

    `diagnostics` is a list of findings: first the reason, then what else was found on the way.
    Pickles and copies keep them, so that another process may raise it.
    """

    diagnostics: list[Diagnostic]

    def __init__(self, message: str, diagnostics: Sequence[Diagnostic] = ()) -> None:
        super().__init__(message)
        self.diagnostics = list(diagnostics)

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""

    def __reduce__(self) -> tuple[Any, ...]:
        rest = {name: value for name, value in vars(self).items() if name != "diagnostics"}
        return type(self), (str(self), self.diagnostics), rest

    def _repr_html_(self) -> str:
        """A table of the findings for notebooks."""
        from ._lists import html_of_findings

        return html_of_findings(self.diagnostics, type(self).__name__)

    def _first(self, name: str) -> str:
        return str(getattr(self.diagnostics[0], name)) if self.diagnostics else ""

    @property
    def rule(self) -> str:
        """Stable dotted name of the finding; empty where it has none."""
        return self._first("rule")

    @property
    def file(self) -> str:
        """The file; empty where it is unknown."""
        return self._first("file")

    @property
    def line(self) -> int:
        """In the file, counted from 1; 0 where it is unknown."""
        return self.diagnostics[0].line if self.diagnostics else 0

    @property
    def prim(self) -> str:
        """Path of the prim; empty where it is unknown."""
        return self._first("prim")

    @property
    def fix(self) -> str:
        """What can be done about it; empty where nothing is known."""
        return self._first("fix")


#: What Python calls the reasons of files that rules name.
_ERRNO = {"file.not-found": errno.ENOENT, "file.exists": errno.EEXIST}


class FileError(Error, OSError):
    """A file cannot be read or written: `filename` is its name, `errno` the system's number where
    it is known, else None."""

    def __init__(self, message: str, diagnostics: Sequence[Diagnostic] = ()) -> None:
        super().__init__(message, diagnostics)
        _tell_file(self)


def _tell_file(error: Any) -> None:
    error.filename = error.file or None
    error.errno = _ERRNO.get(error.rule)
    error.strerror = os.strerror(error.errno) if error.errno else None


class ParseError(Error, ValueError):
    """Text breaks the grammar."""


class CorruptError(Error, ValueError):
    """Binary data contradict themselves or their size."""


class UnsupportedError(Error, NotImplementedError):
    """Valid, but not handled: a version, a type, something that an engine cannot do."""


class LimitError(Error):
    """A stated limit is exceeded (docs/limits.md)."""


class InvalidError(Error, ValueError):
    """An argument or a value that cannot be used."""


class NotFoundError(Error, LookupError):
    """A path, a layer, a prim or a variant that does not exist."""


class MissingFileError(NotFoundError, FileNotFoundError):
    """A file that does not exist: `filename` is its name, `errno` is errno.ENOENT."""

    def __init__(self, message: str, diagnostics: Sequence[Diagnostic] = ()) -> None:
        super().__init__(message, diagnostics)
        _tell_file(self)


class ExportWarning(UserWarning):
    """The exported model moves unlike the asset: World.diagnostics has all reasons."""


class UnstableError(Error, ArithmeticError):
    """A simulation left the finite numbers."""


class MissingError(Error, RuntimeError):
    """An engine or an optional part is not installed."""


def check_file(path: str | os.PathLike[str]) -> None:
    """Raises OSError for what would hold a reader or has no end: pipes, sockets, devices."""
    mode = os.stat(path).st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode)):
        raise OSError(errno.EINVAL, "not a regular file; save what it gives to one",
                      os.fspath(path))


CLASSES: dict[str, type[Error]] = {
    "io": FileError,
    "parse": ParseError,
    "corrupt": CorruptError,
    "unsupported": UnsupportedError,
    "limit": LimitError,
    "invalid": InvalidError,
    "notFound": NotFoundError,
    "fileNotFound": MissingFileError,
    "unstable": UnstableError,
    "missing": MissingError,
}
