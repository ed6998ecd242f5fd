# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""How good a log is for identification: its clock, and of each joint what it did and how well that
was measured.

    quality = assess(log, asset_joints(scene))
    print(quality.text())
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from .delays import Delay, estimate_delays
from .joints import AssetJoint
from .log import Array, Finding, Log
from .raw_log import GAP, lined

#: Deviation of the time between samples, of the usual time, above which a clock is told of.
JITTER = 0.2
#: Of the samples at a limit of effort or speed, above which that is told.
SATURATED = 0.05
#: A motion of fewer steps of the encoder, or times its noise, is none.
STILL_STEPS, STILL_NOISE = 3.0, 8.0
#: Motions of less than this part of the range, or of this angle [rad] or length [m], are small.
SMALL_SHARE, SMALL_RAD, SMALL_M = 0.02, 0.02, 0.002
#: Samples within one period of the fastest motion, below which the log is too slow.
SAMPLES_PER_PERIOD = 8.0
#: Condition of the regressor of inertia, friction and offset, above which they are hardly told
#: apart.
CONDITION = 100.0
#: Of the limit, at which an effort or a speed counts as saturated.
AT_LIMIT = 0.98


@dataclasses.dataclass(frozen=True)
class JointQuality:
    """Of one joint [rad or m, and per second]; NaN where the log does not tell."""

    joint: str
    moved: float
    """From the least position to the largest."""
    range_share: float
    """`moved`, of the range of the asset's joint; NaN without limits."""
    quantisation: float
    """Step of the encoder; 0 where positions are not in steps."""
    noise: float
    """Deviation of positions beside what is smooth."""
    top_speed: float
    rms_speed: float
    rms_acceleration: float
    reversals: int
    """How often it turns around."""
    bandwidth: float
    """Hz, below which 95 % of the power of its velocity is."""
    saturated: float
    """Share of samples at the limit of effort (measured, else commanded), else of speed; NaN where
    the asset has no such limit."""
    condition: float
    """Of the regressor with columns of acceleration, velocity, direction of motion and 1; infinite
    where the joint is still. The smaller, the better told apart."""
    delay: float
    """Of the state behind its command [s]."""
    is_still: bool
    """It never moves."""


@dataclasses.dataclass(frozen=True)
class Quality:
    """Of a log."""

    source: str
    samples: int
    duration: float
    """s."""
    rate: float
    """Hz, of the usual time between samples."""
    jitter: float
    """Deviation of the time between samples [s], without gaps."""
    longest_step: float
    """The longest time between samples [s]."""
    gaps: int
    """Times between samples that are more than 5 times the usual one."""
    repeated: int
    """Samples that are those before them in every state, as of a sensor read too often."""
    signals: tuple[str, ...]
    joints: tuple[JointQuality, ...]
    findings: tuple[Finding, ...]
    """What to know before numbers are taken from the log."""

    @property
    def is_good(self) -> bool:
        """Nothing was found."""
        return not self.findings

    def to_json(self) -> dict[str, Any]:
        """As JSON takes it; what is unknown or infinite is null."""
        value = dataclasses.asdict(self)
        value["findings"] = [{"rule": each.rule, "severity": each.severity,
                              "joint": each.channel, "message": each.message, "row": each.line,
                              "fix": each.fix} for each in self.findings]
        return _plain(value)  # type: ignore[no-any-return]

    def text(self) -> str:
        """A table for people, lines without a newline at the end."""
        lines = [f"{self.samples} samples in {self.duration:.4g} s, {self.rate:.4g} Hz, jitter "
                 f"{1e3 * self.jitter:.3g} ms, {_counted(self.gaps, 'gap')}: "
                 + ", ".join(self.signals)]
        rows: list[tuple[str, ...]] = [HEAD]
        for each in self.joints:
            rows.append((each.joint.rpartition("/")[2], *(_number(value) for value in (
                each.moved, 100 * each.range_share, each.quantisation, each.noise, each.top_speed,
                each.bandwidth)), str(each.reversals), _number(100 * each.saturated),
                _number(each.condition), _number(1e3 * each.delay)))
        return "\n".join([*lines, *lined(rows),
                          *(f"{each.severity}: {each}" for each in self.findings)])


HEAD = ("joint", "moved", "range %", "encoder", "noise", "speed", "Hz", "turns", "at limit %",
        "condition", "delay ms")


def _number(value: float) -> str:
    return f"{value:.3g}" if math.isfinite(value) else "-"


def _counted(count: int, word: str) -> str:
    return f"{count or 'no'} {word}{'' if count == 1 else 's'}"


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(each) for each in value]
    if isinstance(value, (float, np.floating)):
        return float(value) if math.isfinite(value) else None
    if isinstance(value, np.integer):
        return int(value)
    return bool(value) if isinstance(value, np.bool_) else value


# ---- measures

def assess(log: Log, joints: Sequence[AssetJoint] = ()) -> Quality:
    """The quality of a log; limits are those of the asset's joints where they are given."""
    by_name = {joint.name: joint for joint in joints}
    delays = estimate_delays(log)
    rows = tuple(_of_joint(log, at, by_name.get(name), delays[at])
                 for at, name in enumerate(log.joints))
    steps = np.diff(log.times)
    usual = float(np.median(steps)) if len(steps) else 0.0
    regular = steps[steps <= GAP * usual]
    made = Quality(log.source, len(log), log.duration, 1 / usual if usual > 0 else 0.0,
                   float(np.std(regular)) if len(regular) else 0.0,
                   float(np.max(steps)) if len(steps) else 0.0, int(np.sum(steps > GAP * usual)),
                   _repeated(log), log.signals, rows, ())
    return dataclasses.replace(made, findings=tuple(_findings(log, made, by_name)))


def _repeated(log: Log) -> int:
    states = [getattr(log, name) for name in ("position", "velocity", "effort")
              if getattr(log, name) is not None]
    if not states or len(log) < 2:
        return 0
    whole = np.concatenate(states, axis=1)
    same = np.all((whole[1:] == whole[:-1]) | np.isnan(whole[1:]), axis=1)
    moving = np.any(np.abs(np.diff(np.nan_to_num(whole), axis=0)) > 0)
    return int(np.sum(same)) if moving else 0


def _of_joint(log: Log, at: int, joint: AssetJoint | None, delay: Delay) -> JointQuality:
    nothing = math.nan
    if log.position is None or not np.all(np.isfinite(log.position[:, at])) or len(log) < 5:
        return JointQuality(log.joints[at], nothing, nothing, nothing, nothing, nothing, nothing,
                            nothing, 0, nothing, nothing, nothing, delay.seconds, False)
    position = log.position[:, at]
    moved, step = float(np.ptp(position)), quantisation_of(position)
    noise = noise_of(position)
    velocity = _velocity(log, at)
    acceleration = np.gradient(_smoothed(velocity), log.times)
    still = moved <= max(STILL_STEPS * step, 1e-9) or (
        moved <= STILL_NOISE * noise and _is_flat(position))
    span = joint.span if joint is not None else math.inf
    return JointQuality(
        log.joints[at], moved, moved / span if math.isfinite(span) and span > 0 else nothing, step,
        noise, float(np.max(np.abs(velocity))), _rms(velocity), _rms(acceleration),
        0 if still else _reversals(velocity), nothing if still else _bandwidth(log.times, velocity),
        _saturated(log, at, joint, velocity),
        math.inf if still else _condition(velocity, acceleration), delay.seconds, still)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values * values)))


def quantisation_of(values: Array) -> float:
    """The step that all values are multiples of, from each other; 0 where there is none."""
    steps = np.unique(np.abs(np.diff(values)))
    scale = float(np.max(np.abs(values))) if len(values) else 0.0
    steps = steps[steps > 1e-12 * max(scale, 1e-300)]
    if len(steps) == 0:
        return 0.0
    # Rounded decimals: what is one step is a little more or less.
    least = float(steps[0])
    first = steps[steps < 1.5 * least]
    step = float(np.mean(first))
    counts = np.rint(steps / step)
    near = counts < 1000
    if np.sum(near) < 4:
        return 0.0
    off = np.abs(steps[near] - counts[near] * step)
    return step if np.all(off < 0.2 * step) else 0.0


def noise_of(values: Array) -> float:
    """The deviation of what is not smooth: fourth differences, most of which are noise."""
    if len(values) < 8:
        return 0.0
    rough = np.diff(values, 4)
    # 1, 4, 6, 4, 1: of independent noise the variance is 70 times as large. A joint is smooth most
    # of the time, so that the median counts.
    return float(np.median(np.abs(rough)) / 0.6745 / math.sqrt(70.0))


def _is_flat(values: Array) -> bool:
    """No frequency stands out: it is noise."""
    power = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(len(values)))) ** 2
    return float(power.max()) < 0.1 * float(power.sum())


def _velocity(log: Log, at: int) -> Array:
    if log.velocity is not None and np.all(np.isfinite(log.velocity[:, at])):
        return np.asarray(log.velocity[:, at])
    assert log.position is not None
    return _smoothed(np.gradient(log.position[:, at], log.times))


def _smoothed(values: Array) -> Array:
    """Means over five samples."""
    if len(values) < 5:
        return values
    padded = np.concatenate((values[:2][::-1], values, values[-2:][::-1]))
    return np.convolve(padded, np.full(5, 0.2), mode="valid")


def _reversals(velocity: Array) -> int:
    """Turns between speeds of 5 % of the largest."""
    least = 0.05 * float(np.max(np.abs(velocity)))
    signs = np.sign(velocity[np.abs(velocity) > least])
    return int(np.sum(signs[1:] != signs[:-1]))


def _bandwidth(times: Array, velocity: Array) -> float:
    step = float(np.median(np.diff(times)))
    even = np.interp(np.arange(times[0], times[-1], step), times, velocity)
    power = np.abs(np.fft.rfft((even - even.mean()) * np.hanning(len(even)))) ** 2
    whole = np.cumsum(power)
    if whole[-1] <= 0:
        return 0.0
    at = int(np.searchsorted(whole, 0.95 * whole[-1]))
    return float(np.fft.rfftfreq(len(even), step)[at])


def _saturated(log: Log, at: int, joint: AssetJoint | None, velocity: Array) -> float:
    if joint is None:
        return math.nan
    for name in ("effort", "command_effort"):
        values = getattr(log, name)
        if values is not None and np.all(np.isfinite(values[:, at])) \
                and math.isfinite(joint.effort_limit):
            return float(np.mean(np.abs(values[:, at]) >= AT_LIMIT * joint.effort_limit))
    if math.isfinite(joint.velocity_limit):
        return float(np.mean(np.abs(velocity) >= AT_LIMIT * joint.velocity_limit))
    return math.nan


def _condition(velocity: Array, acceleration: Array) -> float:
    """Of columns of unit length, so that units do not count."""
    least = 0.02 * float(np.max(np.abs(velocity)))
    columns = np.stack([acceleration, velocity, np.where(np.abs(velocity) > least,
                                                         np.sign(velocity), 0.0),
                        np.ones(len(velocity))], axis=1)
    lengths = np.linalg.norm(columns, axis=0)
    if np.any(lengths == 0):
        return math.inf
    values = np.linalg.svd(columns / lengths, compute_uv=False)
    return float(values[0] / values[-1]) if values[-1] > 0 else math.inf


# ---- what they say

def _findings(log: Log, quality: Quality, joints: dict[str, AssetJoint]) -> list[Finding]:
    found: list[Finding] = []

    def tell(rule: str, message: str, fix: str, joint: str = "", row: int = 0) -> None:
        found.append(Finding(rule, message, log.source, row, joint.rpartition("/")[2], fix,
                             "warning", prim=joint))

    usual = 1 / quality.rate if quality.rate else 0.0
    if quality.gaps:
        at = int(np.argmax(np.diff(log.times))) + 1
        tell("quality.gap", f"{_counted(quality.gaps, 'gap')}, the longest of "
             f"{quality.longest_step:.3g} s", "take a window without it", row=log.row(at))
    if quality.jitter > JITTER * usual:
        tell("quality.jitter", f"the time between samples varies by {1e3 * quality.jitter:.3g} ms, "
             f"usually it is {1e3 * usual:.3g} ms", "log the time of measuring, not of writing")
    if quality.repeated > 0.2 * quality.samples:
        tell("quality.repeated", f"{quality.repeated} samples are the same as those before them",
             "log at the rate of the sensors")
    if log.effort is None and log.command_position is None and log.command_effort is None \
            and log.command_velocity is None:
        tell("quality.no-input", "neither efforts nor commands are logged: motion without what "
             "causes it tells no number", "log them, or give the commands with --commands FILE")
    for each in quality.joints:
        _joint_findings(each, joints.get(each.joint), quality.rate, tell)
    return found


def _joint_findings(each: JointQuality, joint: AssetJoint | None, rate: float, tell: Any) -> None:
    if math.isnan(each.moved):
        tell("quality.no-position", "no position of it is logged", "log it", each.joint)
        return
    if each.is_still:
        tell("quality.still", "never moves: nothing can be told of it",
             "excite it, or leave it out", each.joint)
        return
    unit = joint.unit if joint is not None else "rad or m"
    small = SMALL_M if joint is not None and not joint.rotates else SMALL_RAD
    if each.range_share < SMALL_SHARE or (math.isnan(each.range_share) and each.moved < small):
        tell("quality.small", f"moves by {each.moved:.3g} {unit} alone", "excite it more",
             each.joint)
    if each.quantisation > 0.01 * each.moved:
        tell("quality.coarse", f"steps of its encoder, {each.quantisation:.3g} {unit}, are "
             f"{100 * each.quantisation / each.moved:.2g} % of its motion", "move it further",
             each.joint)
    if each.noise > 0.01 * each.moved:
        tell("quality.noise", f"noise of {each.noise:.3g} {unit} is "
             f"{100 * each.noise / each.moved:.2g} % of its motion", "move it further", each.joint)
    if each.saturated > SATURATED:
        tell("quality.saturated", f"{100 * each.saturated:.0f} % of its samples are at the limit",
             "excite it less, or identify the limit as well", each.joint)
    if each.bandwidth * SAMPLES_PER_PERIOD > rate:
        tell("quality.rate", f"moves at up to {each.bandwidth:.3g} Hz, while the log has "
             f"{rate:.3g} Hz", "log faster, or move it slower", each.joint)
    if each.reversals < 4:
        tell("quality.one-way", f"turns around {each.reversals} times alone, which friction takes",
             "excite it with motion both ways", each.joint)
    elif each.condition > CONDITION:
        tell("quality.alike", "acceleration, velocity and direction of motion are nearly the same "
             f"signal (condition {each.condition:.3g})", "excite it with several frequencies and "
             "speeds", each.joint)
