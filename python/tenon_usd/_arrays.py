# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What World is given and gives, checked: numbers, names, arrays of its shapes."""

from __future__ import annotations

import operator
from collections.abc import Iterable
from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from ._lists import no_such
from .errors import InvalidError, NotFoundError

Array = npt.NDArray[np.float64]


def locked(array: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """A write to the array that a property returns would be lost: it raises instead."""
    array.flags.writeable = False
    return array


def counted(what: str, number: SupportsIndex) -> int:
    """A number of 0 or more. Raises TypeError for no integer, ValueError below 0."""
    number = operator.index(number)
    if number < 0:
        raise ValueError(f"{what} must be 0 or more, not {number}")
    return number


def place(what: str, number: SupportsIndex, size: int) -> int:
    """An index as sequences take it: -1 is the last one."""
    at = operator.index(number)
    if not -size <= at < size:
        raise IndexError(f"there is no {what} {at}; there are {size}")
    return at % size


def texts(what: str, texts: Iterable[str]) -> list[str]:
    """A list of str. Raises TypeError for a str, which is a sequence of its letters."""
    if isinstance(texts, str):
        raise TypeError(f"{what} is a list of str, not the str {texts!r}; write [{texts!r}]")
    return list(texts)


def checked_poses(values: npt.ArrayLike, envs: int) -> Array:
    """Poses (envs, 7): x, y, z [m], then w, x, y, z. Raises InvalidError for what is none."""
    poses = spread(values, (envs, 7))
    lengths = np.linalg.norm(poses[:, 3:], axis=1)
    if not np.isfinite(poses).all() or not (lengths > 0).all():
        raise InvalidError(
            "a pose is x, y, z [m], then w, x, y, z of a quaternion: all finite and the quaternion "
            "not zero"
        )
    return poses


def spread(values: npt.ArrayLike, shape: tuple[int, ...]) -> Array:
    """Numbers as an array of a shape that they broadcast to."""
    array = np.asarray(values, dtype=np.float64)
    return np.ascontiguousarray(np.broadcast_to(array, shape))


def finite(values: npt.ArrayLike, shape: tuple[int, ...]) -> Array:
    """The same of targets. Raises InvalidError for NaN and infinity."""
    array = spread(values, shape)
    if not np.isfinite(array).all():
        raise InvalidError("targets must be finite numbers")
    return array


def index(paths: list[str], path: str) -> int:
    """The number of a path. Raises NotFoundError with the one that was meant."""
    try:
        return paths.index(path)
    except ValueError:
        raise NotFoundError(no_such(path, paths)) from None
