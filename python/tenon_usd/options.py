# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""How assets are opened and read: the arguments that all functions on assets share."""

from __future__ import annotations

import difflib
import math
import operator
import os
from collections.abc import Mapping, Sequence
from typing import Any, TypedDict

from ._tenon import OpenArguments

PathLike = str | os.PathLike[str]


class OpenOptions(TypedDict, total=False):
    """The arguments that open(), World() and the other functions on assets share."""

    physics: str
    """Variant of the variant sets "Physics": "mujoco", or "PRIM=VARIANT", several with commas."""
    overrides: Sequence[str]
    """"PATH.attribute=value" in text form, in the units of the stage: they win over the files."""
    session: PathLike
    """A session layer file."""
    payloads: bool
    """False: payloads are left out."""
    load: Sequence[str]
    """Prims whose payloads are loaded; all where it is empty."""
    mask: Sequence[str]
    """Prims that are composed, with what is above and below; all where it is empty."""
    muted: Sequence[str]
    """Layers that count as absent."""
    variant_fallbacks: Mapping[str, Sequence[str]]
    """Variants to select where none is, by variant set."""
    search_paths: Sequence[PathLike]
    """Folders that asset paths are looked up in."""
    sandbox: Sequence[PathLike]
    """Folders that files may be read from; all where it is empty."""
    allow_read: Sequence[PathLike]
    """Folders and files that may go into outputs beside those of the asset."""
    max_work: int
    """Units of work that composition may take (docs/limits.md), for scenes large by their arcs."""
    contents: Mapping[PathLike, str | bytes]
    """Texts or bytes in memory that stand for files, over the disk: layers that are not saved."""
    readings: Mapping[str, str]
    """Readings of the physics by name (docs/physics.md): {"nesting": "ignore"}."""


def arguments_of(given: Mapping[str, Any]) -> OpenArguments:
    """The arguments for the library. Raises TypeError for an unknown one."""
    arguments = OpenArguments()
    for name, value in given.items():
        if value is None:
            continue
        if name == "physics":
            _select_physics(arguments, value)
        elif name == "session":
            arguments.session = path_of(value)
        elif name in ("search_paths", "sandbox", "allow_read"):
            setattr(arguments, name, [path_of(path) for path in list_of(name, value)])
        elif name == "variant_fallbacks":
            arguments.variant_fallbacks = {k: list(v) for k, v in value.items()}
        elif name == "contents":
            for path, text in value.items():
                bytes_of = text.encode() if isinstance(text, str) else bytes(text)
                arguments.set_contents(path_of(path), bytes_of)
        elif name == "readings":
            arguments.readings = dict(value)
        elif name == "max_work":
            arguments.max_work = _work_of(value)
        elif name == "payloads":
            arguments.payloads = bool(value)
        elif name in OpenOptions.__annotations__:
            setattr(arguments, name, list_of(name, value))
        else:
            close = difflib.get_close_matches(name, OpenOptions.__annotations__, 1)
            raise TypeError(f"got an unexpected keyword argument {name!r}; "
                            + (f"did you mean {close[0]!r}? " if close else "") + "There are "
                            + ", ".join(OpenOptions.__annotations__))
    return arguments


def path_of(path: PathLike) -> str:
    """A path as str. Raises TypeError, in Python's words, for what is no path, ValueError for what
    no file is called."""
    name = os.fsdecode(path)
    os.fsencode(name)  # raises for half characters
    if "\0" in name:
        raise ValueError(f"no file is called {name!r}: there is a null character in it")
    return name


def list_of(name: str, value: Any) -> list[Any]:
    """A str is a sequence of its letters, which nobody means."""
    if isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name} is a list, not {value!r}; write [{value!r}]")
    return list(value)


def check_positive(**given: float | None) -> None:
    """Raises ValueError for a number that is not finite and above 0; None is none."""
    for name, value in given.items():
        if value is not None and not (0 < value and math.isfinite(value)):
            raise ValueError(f"{name} is {value!r}; expected a number above 0")


def _work_of(value: Any) -> int:
    work = operator.index(value)
    if work < 1:
        raise ValueError(f"max_work is {work}; expected 1 or more")
    return work


def _select_physics(arguments: OpenArguments, text: str) -> None:
    arguments.physics_below = True
    if not isinstance(text, str):
        raise TypeError(f"physics is a str, not {text!r}")
    for part in filter(None, text.split(",")):
        if "=" in part:
            arguments.physics_of = [*arguments.physics_of, part]
        else:
            arguments.physics = part
