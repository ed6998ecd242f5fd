# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""How late joints follow their commands, by cross-correlation, finer than a sample."""

from __future__ import annotations

import dataclasses

import numpy as np
import numpy.typing as npt

from .log import Array, Log

#: Correlations below this tell no delay.
CLEAR = 0.5
#: Samples of the common clock in the least step of the log.
MAX_SAMPLES = 1 << 20


@dataclasses.dataclass(frozen=True)
class Delay:
    """Of one joint: from a command to the state that follows it."""

    joint: str
    seconds: float
    """NaN where the log does not tell: no command, no motion, or no likeness of the two."""
    correlation: float
    """Of the two at that delay, 0 to 1."""
    signal: str
    """"position", "velocity" or "effort"; empty where there is no pair of channels."""

    @property
    def is_known(self) -> bool:
        """The log tells it."""
        return bool(np.isfinite(self.seconds))


def estimate_delays(log: Log, longest: float = 0.5) -> tuple[Delay, ...]:
    """The delay of each joint, up to `longest` [s], in the order of log.joints.

    It is where the motion of the state is most like that of the command, with the signals taken for
    band-limited, so that it is finer than a sample. What a drive takes to follow (about
    damping / stiffness, and half a step where commands hold for a step) is part of it.
    """
    return tuple(_of_joint(log, at, longest) for at in range(len(log.joints)))


def _of_joint(log: Log, at: int, longest: float) -> Delay:
    best = Delay(log.joints[at], np.nan, 0.0, "")
    for signal in ("position", "velocity", "effort"):
        state, command = getattr(log, signal), getattr(log, f"command_{signal}")
        if state is None or command is None:
            continue
        if not (np.all(np.isfinite(state[:, at])) and np.all(np.isfinite(command[:, at]))):
            continue
        seconds, likeness = delay_between(log.times, command[:, at], state[:, at], longest)
        if best.signal == "" or likeness > best.correlation + 0.1:
            best = Delay(log.joints[at], seconds if likeness >= CLEAR else np.nan, likeness, signal)
    return best


def delay_between(times: Array, command: Array, state: Array, longest: float = 0.5
                  ) -> tuple[float, float]:
    """By how much `state` is later than `command` [s], and the correlation at that delay.

    All have the shape (T,). NaN and 0 where one of the two does not move.
    """
    step = float(np.median(np.diff(times))) if len(times) > 2 else 0.0
    if step <= 0:
        return np.nan, 0.0
    step = max(step, float(times[-1] - times[0]) / MAX_SAMPLES)
    grid = np.arange(times[0], times[-1], step)
    # What moves counts, not where it stands: differences, faded in and out.
    fade = np.hanning(max(len(grid) - 1, 1))
    told = np.diff(np.interp(grid, times, command)) * fade
    did = np.diff(np.interp(grid, times, state)) * fade
    most = max(1, min(int(longest / step), len(told) // 2))
    if len(told) < 8 or np.ptp(command) == 0 or np.ptp(state) == 0:
        return np.nan, 0.0
    size = 1 << int(np.ceil(np.log2(len(told) + most + 1)))
    product = np.fft.rfft(did, size) * np.conj(np.fft.rfft(told, size))
    whole = np.fft.irfft(product, size)[:most + 1]
    power = float(np.sqrt((told @ told) * (did @ did)))
    if power <= 0:
        return np.nan, 0.0
    peak = int(np.argmax(whole))
    lag = _finer(product, size, float(peak))
    return lag * step, float(np.clip(whole[peak] / power, 0.0, 1.0))


def _finer(product: npt.NDArray[np.complex128], size: int, lag: float) -> float:
    """The largest value of the correlation near a lag [samples], between samples, too."""
    omega = 2 * np.pi * np.arange(len(product)) / size
    weight = np.full(len(product), 2.0)
    weight[0] = weight[-1] = 1.0

    def at(where: float) -> float:
        return float(np.sum(weight * (product * np.exp(1j * omega * where)).real))

    low, high = max(lag - 1.0, 0.0), lag + 1.0
    ratio = (np.sqrt(5) - 1) / 2
    a, b = high - ratio * (high - low), low + ratio * (high - low)
    first, second = at(a), at(b)
    for _ in range(30):
        if first > second:
            high, b, second = b, a, first
            a = high - ratio * (high - low)
            first = at(a)
        else:
            low, a, first = a, b, second
            b = low + ratio * (high - low)
            second = at(b)
    return float((low + high) / 2)
