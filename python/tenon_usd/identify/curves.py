# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Motions that excite joints, as offsets from where each joint is in the middle [rad or m].

multisine  sums of sines of all joints at once; `Sines` are what a search changes
chirp      joint after joint, a sine that gets faster
steps      joint after joint, jumps of the command
ramps      joint after joint, constant speeds both ways, each level faster than the one before
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from .log import Array

KINDS = ("multisine", "chirp", "steps", "ramps")
#: Sines of one joint.
SINES = 6
#: Speeds of `ramps`, as parts of what the joint may do.
LEVELS = (0.03, 0.08, 0.2, 0.5)
#: Of a cycle of `ramps`, in which the speed changes its sign.
TURNING = 0.08


@dataclasses.dataclass(frozen=True)
class Bounds:
    """Of N joints [rad or m, and per second], shape (N,) each."""

    room: Array
    """How far a joint may go from its middle."""
    speed: Array
    frequency: Array
    """Hz, up to which it follows."""
    step: Array
    """The largest jump of a command; infinite where nothing limits it."""
    settling: Array
    """Seconds in which a jump is over."""
    strength: Array
    """What its drive can accelerate beside its weight [rad/s^2 or m/s^2]."""


@dataclasses.dataclass(frozen=True)
class Sines:
    """Sums of sines of N joints, SINES each: cycles within the duration, sizes and phases [rad],
    shape (N, SINES) each."""

    cycles: Array
    sizes: Array
    phases: Array

    def changed(self, joint: int, other: Sines) -> Sines:
        """With one joint as another has it."""
        parts = []
        for mine, its in zip(dataclasses.astuple(self), dataclasses.astuple(other), strict=True):
            part = np.array(mine)
            part[joint] = its[joint]
            parts.append(part)
        return Sines(*parts)


def draw_sines(random: np.random.Generator, bounds: Bounds, duration: float) -> Sines:
    """Sines up to the frequency of each joint; slow ones are larger."""
    count = len(bounds.room)
    cycles, sizes = np.ones((count, SINES)), np.zeros((count, SINES))
    for j in range(count):
        most = max(2.0, math.floor(float(bounds.frequency[j]) * duration))
        wanted = np.exp(random.uniform(0.0, math.log(most + 0.5), SINES))
        own = np.unique(np.maximum(np.rint(wanted), 1.0))
        cycles[j, :len(own)] = own
        sizes[j, :len(own)] = own ** -random.uniform(0.3, 1.2)
    return Sines(cycles, sizes, random.uniform(0.0, 2 * math.pi, (count, SINES)))


def smooth(x: Array) -> Array:
    """From 0 to 1 with speeds and accelerations of 0 at both ends."""
    x = np.clip(x, 0.0, 1.0)
    return np.asarray(x * x * x * (10 - 15 * x + 6 * x * x))


def faded(times: Array, duration: float) -> Array:
    """Rises at the begin and falls at the end, within a second or a tenth of the time."""
    edge = min(1.0, 0.1 * duration)
    return smooth(times / edge) * smooth((duration - times) / edge)


def multisine(times: Array, duration: float, sines: Sines, bounds: Bounds) -> Array:
    """Shape (T, N); each joint as large as its room, speed and strength allow."""
    phase = 2 * math.pi * times[:, None, None] / duration * sines.cycles + sines.phases
    raw = np.sum(sines.sizes * np.sin(phase), axis=2) * faded(times, duration)[:, None]
    peak = np.max(np.abs(raw), axis=0)
    moves = np.gradient(raw, times, axis=0)
    speed = np.max(np.abs(moves), axis=0)
    turn = np.max(np.abs(np.gradient(moves, times, axis=0)), axis=0)
    scale = np.minimum(np.minimum(bounds.room / np.maximum(peak, 1e-12),
                                  bounds.speed / np.maximum(speed, 1e-12)),
                       bounds.strength / np.maximum(turn, 1e-12))
    return np.asarray(raw * scale)


def in_turn(kind: str, times: Array, duration: float, bounds: Bounds,
            random: np.random.Generator) -> Array:
    """Joint after joint, each in its part of the time; shape (T, N)."""
    count = len(bounds.room)
    part = duration / max(count, 1)
    made = np.zeros((len(times), count))
    for j in range(count):
        inside = (times >= j * part) & (times < (j + 1) * part)
        own = times[inside] - j * part
        if kind == "chirp":
            made[inside, j] = _chirp(own, part, bounds, j)
        elif kind == "steps":
            made[inside, j] = _steps(own, part, bounds, j, random)
        else:
            made[inside, j] = _ramps(own, part, bounds, j)
    return made


def _chirp(times: Array, duration: float, bounds: Bounds, j: int) -> Array:
    """A sine from three cycles in the time up to the joint's frequency, each octave as long; it
    gets smaller where speed or acceleration would be too large."""
    high = float(bounds.frequency[j])
    low = min(3.0 / duration, 0.5 * high)
    rate = math.log(high / low) / duration
    frequency = low * np.exp(rate * times)
    phase = 2 * math.pi * (frequency - low) / rate
    room = float(bounds.room[j])
    border = float(bounds.speed[j]) / (2 * math.pi * room) if room > 0 else math.inf
    strong = math.sqrt(float(bounds.strength[j]) / room) / (2 * math.pi) if room > 0 else math.inf
    size = room / np.sqrt(1 + (frequency / border) ** 2 + (frequency / max(strong, 1e-9)) ** 4)
    # What the change of the size adds to the speed is less than a tenth.
    return np.asarray(0.9 * size * np.sin(phase) * faded(times, duration))


def _steps(times: Array, duration: float, bounds: Bounds, j: int, random: np.random.Generator
           ) -> Array:
    hold = min(max(float(bounds.settling[j]), 0.3), max(duration / 6, 0.1))
    count = max(2, math.floor(duration / hold))
    room, step = float(bounds.room[j]), float(bounds.step[j])
    levels = [0.0]
    for _ in range(count - 2):
        wanted = room * random.uniform(0.3, 1.0) * (-1.0 if levels[-1] > 0 else 1.0)
        levels.append(levels[-1] + float(np.clip(wanted - levels[-1], -step, step)))
    at = np.minimum((times / hold).astype(int), count - 1)
    # Home at the end, in jumps that are none too large.
    while abs(levels[-1]) > step and len(levels) < 10_000:
        levels.append(levels[-1] - math.copysign(step, levels[-1]))
    levels.append(0.0)
    return np.asarray(np.array(levels)[np.minimum(at, len(levels) - 1)])


def _ramps(times: Array, duration: float, bounds: Bounds, j: int) -> Array:
    """Of each level: out, back, out to the other side and back, at a constant speed."""
    room, top = float(bounds.room[j]), float(bounds.speed[j])
    part = duration / len(LEVELS)
    made = np.zeros(len(times))
    for number, level in enumerate(LEVELS):
        inside = (times >= number * part) & (times < (number + 1) * part)
        own = (times[inside] - number * part) / part
        # A turn takes 50 times the speed, by the time of a cycle.
        speed = min(level * top, 0.7 * float(bounds.strength[j]) * part / 50)
        cycles = max(1, math.ceil(speed * part / 4 / max(room, 1e-12)))
        made[inside] = speed * part / cycles * _zigzag(own * cycles % 1.0)
    return made


def _zigzag(x: Array) -> Array:
    """Of one cycle, x from 0 to 1: slopes of 1, -1, 1 with turns that take a while; it begins and
    ends at 0 at rest."""
    grid = np.linspace(0.0, 1.0, 801)
    slope = np.where((grid < 0.25) | (grid >= 0.75), 1.0, -1.0)
    half = max(2, round(400 * TURNING))
    padded = np.concatenate((np.zeros(half), slope, np.zeros(half)))
    rounded = np.convolve(padded, np.hanning(2 * half + 1) / np.sum(np.hanning(2 * half + 1)),
                          mode="valid")
    rounded *= smooth(grid / TURNING) * smooth((1 - grid) / TURNING)
    place = np.concatenate(([0.0], np.cumsum((rounded[1:] + rounded[:-1]) / 2 * np.diff(grid))))
    return np.asarray(np.interp(x, grid, place - grid * place[-1]))
