# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Whether the numbers of a log can be those of an asset: units by the limits and by what velocities
say of positions, signs by what commands say of them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .joints import AssetJoint
from .log import Array, Finding, Log, LogError

DEGREES = 180 / math.pi
#: Of the range of a joint, by which a log may go beyond it; and in rad or m.
BEYOND, BEYOND_SI = 0.05, 0.02
#: Samples beyond, of all, that make a log one of another joint.
SHARE = 0.05
#: Motions of less than this part of the range, or of this angle [rad] or length [m], tell no sign.
MOVES, MOVES_RAD, MOVES_M = 0.02, 0.02, 0.002
#: Correlations below this tell nothing.
CLEAR = 0.7
#: Numbers of another unit are this many times larger than any position within the limits.
FAR = 2.5
#: A ratio within this factor of 1 is taken for 1.
NEAR = 1.6


def check_log(log: Log, joints: Sequence[AssetJoint], in_degrees: bool = False) -> list[Finding]:
    """What is odd about the numbers. Raises LogError where they cannot be those of the asset as
    they are: another unit, another sign, another joint. `in_degrees`: --units said so."""
    by_name = {joint.name: joint for joint in joints}
    pairs = [(at, by_name[name]) for at, name in enumerate(log.joints) if name in by_name]
    _check_degrees(log, pairs)
    for at, joint in pairs:
        if _moves(log, at, joint):
            _check_velocity(log, at, joint)
            _check_command(log, at, joint)
        _check_range(log, at, joint)
    return [finding for at, joint in pairs if in_degrees for finding in _tiny(log, at, joint)]


def _refuse(log: Log, joint: AssetJoint, rule: str, message: str, fix: str, sample: int = -1
            ) -> LogError:
    row = log.row(sample) if sample >= 0 else 0
    return LogError(Finding(rule, message, log.source, row, joint.short, fix, prim=joint.path))


def _room(joint: AssetJoint) -> float:
    """By how much a position may be beyond a limit [rad or m]."""
    span = joint.span if math.isfinite(joint.span) else 0.0
    return max(BEYOND * span, BEYOND_SI)


def _outside(values: Array, joint: AssetJoint) -> Array:
    """By how much each value is beyond the limits [rad or m]; 0 within them."""
    beyond: Array = np.maximum(np.maximum(joint.lower - values, values - joint.upper), 0.0)
    return beyond


def _reach(joint: AssetJoint) -> float:
    """The largest position within the limits, without its sign [rad or m]."""
    ends = [abs(end) for end in (joint.lower, joint.upper) if math.isfinite(end)]
    return max(ends, default=math.inf)


def _share(values: Array, joint: AssetJoint) -> float:
    return float(np.mean(_outside(values, joint) > _room(joint)))


def _check_degrees(log: Log, pairs: Sequence[tuple[int, AssetJoint]]) -> None:
    """Positions far beyond the limits that fit as degrees, or in millimetres."""
    if log.position is None:
        return
    for turns, factor, unit in ((True, DEGREES, "deg"), (False, 1000.0, "mm")):
        there = [(at, joint) for at, joint in pairs if joint.rotates == turns
                 and np.isfinite(log.position[0, at])]
        wrong = [(at, joint) for at, joint in there
                 if _share(log.position[:, at], joint) > SHARE
                 and float(np.max(np.abs(log.position[:, at]))) > FAR * _reach(joint)]
        if not wrong or any(_share(log.position[:, at] / factor, joint) > SHARE
                            for at, joint in there):
            continue
        at, joint = wrong[0]
        far = int(np.argmax(_outside(log.position[:, at], joint)))
        raise _refuse(log, joint, "log.units", f"goes to {log.position[far, at]:.4g} {joint.unit}, "
                      f"while the joint ends at {joint.lower:.4g} and {joint.upper:.4g}; as "
                      f"{unit} all joints fit", f"--units {unit}", far)


def _ratio(values: Array, reference: Array) -> tuple[float, float]:
    """The factor from a reference to values by least squares, and their correlation."""
    values, reference = values - values.mean(), reference - reference.mean()
    power, other = float(reference @ reference), float(values @ values)
    if power <= 0 or other <= 0:
        return 1.0, 0.0
    product = float(values @ reference)
    return product / power, product / math.sqrt(power * other)


def _moves(log: Log, at: int, joint: AssetJoint) -> bool:
    """By more than what shaking and noise may be."""
    span = joint.span if math.isfinite(joint.span) else 0.0
    least = max(MOVES * span, MOVES_RAD if joint.rotates else MOVES_M)
    return log.position is not None and float(np.ptp(log.position[:, at])) > least


def _check_velocity(log: Log, at: int, joint: AssetJoint) -> None:
    """Velocities against how positions change."""
    if log.position is None or log.velocity is None or len(log) < 10:
        return
    position, velocity = log.position[:, at], log.velocity[:, at]
    if not (np.all(np.isfinite(position)) and np.all(np.isfinite(velocity))):
        return
    # Over several samples, so that steps of encoders do not count.
    width = max(1, min(10, len(log) // 20))
    slopes = (position[width:] - position[:-width]) / (log.times[width:] - log.times[:-width])
    total = np.concatenate(([0.0], np.cumsum((velocity[1:] + velocity[:-1]) / 2
                                             * np.diff(log.times))))
    means = (total[width:] - total[:-width]) / (log.times[width:] - log.times[:-width])
    factor, clear = _ratio(means, slopes)
    if abs(clear) < CLEAR:
        return
    if factor < 0:
        raise _refuse(log, joint, "log.sign", "its velocity is opposite to how its position "
                      f"changes (correlation {clear:.2f})", f"--sign {joint.short}.velocity=-1, or "
                      f"{joint.short}.position=-1: compare with the asset")
    _check_factor(log, joint, factor, "its velocity", "what its position changes")


def _check_command(log: Log, at: int, joint: AssetJoint) -> None:
    """Positions against commands."""
    if log.position is None or log.command_position is None or len(log) < 10:
        return
    position, command = log.position[:, at], log.command_position[:, at]
    if not (np.all(np.isfinite(position)) and np.all(np.isfinite(command))):
        return
    factor, clear = _ratio(position, command)
    if clear < -CLEAR:
        raise _refuse(log, joint, "log.sign", "moves against its command (correlation "
                      f"{clear:.2f})", f"--sign {joint.short}.position=-1 (and .velocity), or "
                      f"--sign {joint.short}.command_position=-1: compare with the asset")
    if clear > CLEAR:
        _check_factor(log, joint, factor, "its position", "its command")


def _check_factor(log: Log, joint: AssetJoint, factor: float, what: str, other: str) -> None:
    known = ((DEGREES, "in degrees where the other is in radians"),
             (1 / DEGREES, "in radians where the other is in degrees")) if joint.rotates else \
        ((1000.0, "in millimetres where the other is in metres"),
         (0.001, "in metres where the other is in millimetres"))
    for ratio, told in known:
        if 1 / NEAR < factor / ratio < NEAR:
            raise _refuse(log, joint, "log.units", f"{what} is {factor:.3g} times {other}: {told}",
                          "name the unit in the columns (`..._deg`), or convert one of the two")


def _check_range(log: Log, at: int, joint: AssetJoint) -> None:
    """Positions within the limits."""
    if log.position is None or not np.all(np.isfinite(log.position[:, at])):
        return
    values = log.position[:, at]
    share = _share(values, joint)
    if share <= SHARE:
        return
    far = int(np.argmax(_outside(values, joint)))
    fix = "it is another joint, or of another robot; compare --map"
    if _share(-values, joint) <= SHARE:
        fix = f"with the other sign it fits: --sign {joint.short}=-1"
    raise _refuse(log, joint, "log.range", f"goes to {values[far]:.4g} {joint.unit} (and "
                  f"{100 * share:.0f} % of the samples are beyond), while the joint ends at "
                  f"{joint.lower:.4g} and {joint.upper:.4g}",
                  f"{fix}; --no-check reads it all the same", far)


def _tiny(log: Log, at: int, joint: AssetJoint) -> list[Finding]:
    """Radians that were taken for degrees move by very little."""
    if log.position is None or not joint.rotates or not math.isfinite(joint.span):
        return []
    values = log.position[:, at]
    moved = float(np.ptp(values))
    if not 0 < moved < joint.span / 40 or _share(values * DEGREES, joint) > 0:
        return []
    return [Finding("log.units", f"moves by {moved:.3g} rad alone, {100 * moved / joint.span:.1f} "
                    "% of its range", log.source, 0, joint.short,
                    "are the numbers radians already? then leave --units deg out", "warning",
                    prim=joint.path)]
