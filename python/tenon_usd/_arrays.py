# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What World is given and gives, checked: numbers, names, arrays of its shapes."""

from __future__ import annotations

import math
import operator
import zipfile
from collections.abc import Iterable, Sequence
from typing import IO, Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from ._lists import no_such
from .errors import InvalidError, NotFoundError

Array = npt.NDArray[np.float64]
#: Bytes that an archive may unpack to, and such bytes more for each of its own.
UNPACKED = 1 << 30
UNPACKED_PER_BYTE = 40


def check_unpacked(archive: str | IO[bytes], size: int) -> None:
    """Raises ValueError where the arrays of an archive of `size` bytes are too large for it, and
    what zipfile raises."""
    with zipfile.ZipFile(archive) as entries:
        whole = sum(entry.file_size for entry in entries.infolist())
    if whole > (most := UNPACKED + UNPACKED_PER_BYTE * size):
        raise ValueError(f"it unpacks to {whole} bytes, more than {most}")


def locked(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """A write to the array that a property returns would be lost: it raises instead."""
    array.flags.writeable = False
    return array


#: The largest number that the library counts with.
_MOST = (1 << 64) - 1


def counted(what: str, number: SupportsIndex) -> int:
    """A number of 0 or more. Raises TypeError for no integer, ValueError for one out of range."""
    try:
        count = operator.index(number)
    except TypeError:
        raise TypeError(f"{what} is a whole number, not {number!r}") from None
    if not 0 <= count <= _MOST:
        raise ValueError(f"{what} must be 0 or more, not {count}" if count < 0 else
                         f"{what} must be at most {_MOST}, not {count}")
    return count


def seconds(what: str, number: float) -> float:
    """A finite time of 0 or more [s]. Raises TypeError for no number, InvalidError for another."""
    try:
        time = float(number)
    except (TypeError, ValueError):
        raise TypeError(f"{what} is a number of seconds, not {number!r}") from None
    if not 0 <= time < math.inf:
        raise InvalidError(f"{what} must be finite and 0 or more seconds, not {time:g}")
    return time


def named(what: str, text: str | None) -> str:
    """A str; empty for None. Raises TypeError for what is none."""
    if text is not None and not isinstance(text, str):
        raise TypeError(f"{what} is a str, not {text!r}")
    return text or ""


def place(what: str, number: SupportsIndex, size: int) -> int:
    """An index as sequences take it: -1 is the last one."""
    try:
        at = operator.index(number)
    except TypeError:
        raise TypeError(f"{what} is a number or a name, not {number!r}") from None
    if not -size <= at < size:
        raise IndexError(f"there is no {what} {at}; there are {size}")
    return at % size


def environments(
    envs: SupportsIndex | Sequence[int] | npt.NDArray[Any] | None, count: int
) -> list[int]:
    """The numbers of some of `count` environments, given by number or by a mask; None: all."""
    if envs is None:
        return list(range(count))
    chosen = np.atleast_1d(np.asarray(envs))
    if chosen.dtype == bool:
        if chosen.shape != (count,):
            raise ValueError(f"a mask of shape {chosen.shape} for {count} environments")
        chosen = np.flatnonzero(chosen)
    elif chosen.size and chosen.dtype.kind not in "iu":
        raise TypeError(f"environments are numbers of type int or a mask, not {envs!r}")
    return [place("environment", int(i), count) for i in chosen.reshape(-1)]


def texts(what: str, texts: Iterable[str]) -> list[str]:
    """A list of str. Raises TypeError for a str, which is a sequence of its letters."""
    if isinstance(texts, str):
        raise TypeError(f"{what} is a list of str, not the str {texts!r}; write [{texts!r}]")
    if not isinstance(texts, Iterable):
        raise TypeError(f"{what} is a list of str, not {texts!r}")
    return [_text_in(what, text) for text in texts]


def _text_in(what: str, text: str) -> str:
    if not isinstance(text, str):
        raise TypeError(f"{what} is a list of str; {text!r} in it is none")
    return text


def checked_poses(values: npt.ArrayLike, envs: int) -> Array:
    """Poses (envs, 7): x, y, z [m], then w, x, y, z. Raises InvalidError for what is none."""
    poses = spread("poses", values, (envs, 7))
    lengths = np.linalg.norm(poses[:, 3:], axis=1)
    if not np.isfinite(poses).all() or not (lengths > 0).all():
        raise InvalidError(
            "a pose is x, y, z [m], then w, x, y, z of a quaternion: all finite and the quaternion "
            "not zero"
        )
    return poses


def spread(what: str, values: npt.ArrayLike, shape: tuple[int, ...]) -> Array:
    """Numbers as an array of a shape that they broadcast to. Raises TypeError for what are no
    numbers, ValueError for another shape."""
    try:
        array = np.asarray(values)
    except ValueError:
        raise ValueError(f"{what} has rows of different lengths; expected numbers of the shape "
                         f"{shape}") from None
    if array.dtype.kind not in "biuf":
        kind = type(values).__name__ if array.dtype == object else f"numbers of {array.dtype}"
        raise TypeError(f"{what} is an array of the shape {shape} or what broadcasts to it, not "
                        f"{kind}")
    try:
        return np.ascontiguousarray(np.broadcast_to(array.astype(np.float64, copy=False), shape))
    except ValueError:
        raise ValueError(f"{what} has the shape {array.shape}; expected {shape} or what broadcasts "
                         "to it") from None


def finite(what: str, values: npt.ArrayLike, shape: tuple[int, ...]) -> Array:
    """The same of targets. Raises InvalidError for NaN and infinity."""
    array = spread(what, values, shape)
    if not np.isfinite(array).all():
        raise InvalidError(f"{what} must be finite numbers")
    return array


def index(what: str, paths: list[str], path: str) -> int:
    """The number of a path, or of the last element of one where no other has it. Raises
    NotFoundError with the one that was meant."""
    if not isinstance(path, str):
        raise TypeError(f"{what} is a path, not {path!r}")
    if path in paths:
        return paths.index(path)
    same = [i for i, each in enumerate(paths) if each.rpartition("/")[2] == path]
    if len(same) == 1:
        return same[0]
    if same:
        raise NotFoundError(f"{what}: {path!r} is the name of several: "
                            + ", ".join(paths[i] for i in same[:20]))
    raise NotFoundError(f"{what}: {no_such(path, paths)}")
