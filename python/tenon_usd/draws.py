# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Distributions that environments draw from at the start of each episode (tenon_usd.gym).

    vary = {"bodyMass@/World/can": LogUniform(0.5, 2), "gravity": Normal(1, 0.02)}
    envs = GraspEnv("grasp.usda", num_envs=64, vary=vary)

Names are those of World's `vary`: factors of masses, frictions, gains and gravity, offsets of
positions [rad or m]. A text "bodyMass@/World/can=0.5..2" is Uniform(0.5, 2).
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Protocol

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


class Distribution(Protocol):
    """What numbers are drawn from."""

    def sample(self, random: np.random.Generator, shape: tuple[int, ...]) -> Array:
        """Numbers in the unit of what varies, of this shape; of nothing but the generator."""


@dataclasses.dataclass(frozen=True)
class Uniform:
    """As likely everywhere from `low` to `high`, in the unit of what varies."""

    low: float
    high: float

    def __post_init__(self) -> None:
        _check_range(self.low, self.high)

    def sample(self, random: np.random.Generator, shape: tuple[int, ...]) -> Array:
        """Numbers in the unit of what varies, of this shape."""
        return random.uniform(self.low, self.high, shape)


@dataclasses.dataclass(frozen=True)
class LogUniform:
    """Its logarithm is uniform from that of `low` to that of `high`, both above 0."""

    low: float
    high: float

    def __post_init__(self) -> None:
        _check_range(self.low, self.high)
        if self.low <= 0:
            raise ValueError(f"a logarithm is of numbers above 0, not of {self.low}")

    def sample(self, random: np.random.Generator, shape: tuple[int, ...]) -> Array:
        """Numbers in the unit of what varies, of this shape."""
        return np.exp(random.uniform(math.log(self.low), math.log(self.high), shape))


@dataclasses.dataclass(frozen=True)
class Normal:
    """A normal distribution by mean and standard deviation, in the unit of what varies; what lies
    beyond `low` or `high` is moved there."""

    mean: float
    deviation: float
    low: float = -math.inf
    high: float = math.inf

    def __post_init__(self) -> None:
        if not math.isfinite(self.mean) or not 0 <= self.deviation < math.inf:
            raise ValueError(f"{self} has no finite mean and deviation of 0 or more")
        if not self.low <= self.high:
            raise ValueError(f"{self} has no range from low to high")

    def sample(self, random: np.random.Generator, shape: tuple[int, ...]) -> Array:
        """Numbers in the unit of what varies, of this shape."""
        return np.clip(random.normal(self.mean, self.deviation, shape), self.low, self.high)


@dataclasses.dataclass(frozen=True)
class Choice:
    """One of some values, each as likely, in the unit of what varies."""

    values: Sequence[float]

    def __post_init__(self) -> None:
        if not len(self.values) or not np.isfinite(np.asarray(self.values, dtype=float)).all():
            raise ValueError(f"{self} has no finite numbers to choose from")

    def sample(self, random: np.random.Generator, shape: tuple[int, ...]) -> Array:
        """Numbers in the unit of what varies, of this shape."""
        return random.choice(np.asarray(self.values, dtype=np.float64), shape)


def _check_range(low: float, high: float) -> None:
    if not (math.isfinite(low) and math.isfinite(high) and low <= high):
        raise ValueError(f"{low} to {high} is no finite range")


#: What World's `vary` takes here: texts, or distributions by name.
Vary = Iterable[str] | Mapping[str, Distribution]


def check(what: str, one: Distribution) -> None:
    """Raises TypeError for what is no distribution."""
    if not hasattr(one, "sample"):
        raise TypeError(f"{what} is drawn from a distribution such as Uniform(0.8, 1.2), not from "
                        f"{one!r}")


def distributions(vary: Vary) -> dict[str, Distribution]:
    """By name, of texts "NAME=LOW..HIGH" too. Raises ValueError for other texts."""
    if isinstance(vary, Mapping):
        for name, one in vary.items():
            check(name, one)
        return dict(vary)
    if isinstance(vary, str):
        raise TypeError(f"vary is a list of str, not the str {vary!r}; write [{vary!r}]")
    found: dict[str, Distribution] = {}
    for text in vary:
        name, equals, numbers = text.rpartition("=")
        low, dots, high = numbers.partition("..")
        try:
            found[name] = Uniform(float(low), float(high if dots else low))
        except ValueError as reason:
            raise ValueError(f"{text!r} is not NAME=LOW..HIGH: {reason}") from None
        if not equals:
            raise ValueError(f"{text!r} is not NAME=LOW..HIGH")
    return found


def is_of_model(name: str) -> bool:
    """A field of the scene ("joints.upper"): it is part of the model and is drawn once."""
    return "." in name.partition("@")[0]


def texts(drawn: Mapping[str, Distribution]) -> list[str]:
    """What World is given, which draws fields of the scene itself. Raises ValueError where those
    are not uniform."""
    made = []
    for name, one in drawn.items():
        if not is_of_model(name):
            offset = name.partition("@")[0].endswith("Position")
            made.append(f"{name}={0 if offset else 1}")
        elif isinstance(one, Uniform):
            made.append(f"{name}={one.low!r}..{one.high!r}")
        else:
            raise ValueError(f"{name} is part of the model and drawn once: a Uniform, not {one}")
    return made


__all__ = ["Choice", "Distribution", "LogUniform", "Normal", "Uniform", "Vary"]
