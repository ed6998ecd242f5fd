# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Trajectories that excite the joints of a robot, for identification: within the limits of
position, speed and effort, without bodies that touch, and with as much information as a search
finds.

    motion = excite(tenon_usd.physics("arm.usda"), duration=20.0)
    trajectory_files.write(motion, "arm.csv")
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .._patterns import compile_pattern
from .curves import KINDS, SINES, Bounds, Sines, draw_sines, in_turn, multisine, smooth
from .information import DROWNED, USUAL_SPEED, Judge, information
from .joints import AssetJoint, asset_joints
from .log import Array, Finding, FindingError
from .moving import Mover

if TYPE_CHECKING:
    from .._tenon import PhysicsScene

#: Taken where the asset has no limit of position [rad, m].
USUAL_ROOM = (math.pi / 2, 0.1)
#: Hz, above which nothing is excited; and of what a drive follows, the part that is asked for.
TOP_FREQUENCY, OF_BANDWIDTH = 5.0, 0.5
#: Motions of less than this part of the range are told.
SMALL = 0.02
#: Seconds of one joint, below which chirps, steps and ramps tell little.
SHORT = 5.0
#: Postures at which efforts and contacts are looked at.
EFFORT_POSTURES, CONTACT_POSTURES, REGRESSOR_POSTURES = 160, 400, 40
#: How often a motion is made smaller before it is given up.
ROUNDS = 30
MAX_SAMPLES, MAX_JOINTS, MAX_SEARCH = 1_000_000, 200, 10_000


class ExciteError(FindingError):
    """A motion that cannot be made: `channel` is the joint."""


@dataclasses.dataclass(frozen=True)
class How:
    """What is asked for."""

    kind: str = "multisine"
    """One of curves.KINDS."""
    joints: str = ""
    """Regular expression for paths or names, which is found anywhere in them; empty: all with a
    drive."""
    duration: float = 20.0
    """s, without the ways from the start to the middle and back."""
    step: float = 0.01
    """s, between rows."""
    seed: int = 0
    margin: float = 0.05
    """Of the range, that is kept to each limit of position."""
    speed: float = 0.8
    """Part of the speed that the asset allows."""
    effort: float = 0.8
    """Part of the effort that the drive has."""
    search: int = 60
    """Multisines that are tried."""
    collisions: bool = True
    """Postures in which bodies touch are skipped."""


@dataclasses.dataclass(frozen=True)
class Excitation:
    """A motion of N joints in T rows [SI, rad]."""

    times: Array
    """Seconds from 0 on, shape (T,)."""
    joints: tuple[AssetJoint, ...]
    position: Array
    """Of commands, shape (T, N), as velocity and acceleration."""
    velocity: Array
    acceleration: Array
    effort: Array
    """Largest expected effort of each joint [N m or N], shape (N,)."""
    shrunk: Array
    """Size of the motion, of what limits of position and speed allow, shape (N,)."""
    condition: float
    """Of the regressor of armature, viscous and Coulomb friction, columns of unit length."""
    log_det: float
    """Logarithm of the determinant of the information on these and the masses of the links."""
    unknowns: int
    """Combinations of these numbers that the motion tells apart from noise of 0.1 %."""
    how: How
    meters_per_unit: float
    notes: tuple[Finding, ...]

    @property
    def crest(self) -> Array:
        """Largest offset from the mean, of the root mean square one, shape (N,)."""
        offset = self.position - self.position.mean(axis=0)
        rms = np.sqrt(np.mean(offset * offset, axis=0))
        return np.asarray(np.max(np.abs(offset), axis=0) / np.maximum(rms, 1e-300))

    def to_json(self) -> dict[str, Any]:
        """What it is, without its rows."""
        crest = self.crest
        rows = [{"joint": joint.name, "unit": joint.unit,
                 "lower": float(self.position[:, k].min()),
                 "upper": float(self.position[:, k].max()),
                 "topSpeed": float(np.abs(self.velocity[:, k]).max()),
                 "effort": float(self.effort[k]), "effortLimit": _or_none(joint.effort_limit),
                 "speedLimit": _or_none(joint.velocity_limit), "size": float(self.shrunk[k]),
                 "crest": float(crest[k])} for k, joint in enumerate(self.joints)]
        return {"kind": self.how.kind, "duration": float(self.times[-1]), "rows": len(self.times),
                "step": self.how.step, "seed": self.how.seed,
                "condition": _or_none(self.condition), "logDet": _or_none(self.log_det),
                "unknowns": self.unknowns, "joints": rows,
                "findings": [{"rule": each.rule, "severity": each.severity, "joint": each.prim,
                              "message": each.message, "fix": each.fix} for each in self.notes]}


def _or_none(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


# ---- which joints

def chosen_joints(joints: Sequence[AssetJoint], pattern: str, notes: list[Finding]
                  ) -> tuple[AssetJoint, ...]:
    """Those that move by themselves, have a drive and fit the pattern. Raises ExciteError."""
    try:
        expression = compile_pattern(pattern, [joint.name for joint in joints], anywhere=True)
    except re.error as error:
        raise ExciteError(Finding("excite.joints", f"`{pattern}` is no regular expression: {error}",
                                  fix="--joints 'shoulder|elbow'")) from None
    found = [joint for joint in joints if expression.search(joint.name)]
    if not found:
        names = ", ".join(joint.short for joint in joints[:12])
        raise ExciteError(Finding("excite.joints", f"no joint of the asset fits `{pattern}`",
                                  fix=f"its joints are {names}" if names else "it has none"))
    reasons = {joint.name: _why_not(joint) for joint in found}
    free = tuple(joint for joint in found if not reasons[joint.name])
    for reason in dict.fromkeys(each for each in reasons.values() if each):
        names = ", ".join(joint.short for joint in found if reasons[joint.name] == reason)
        notes.append(Finding("excite.left-out", f"{names}: {reason}", severity="info"))
    if not free:
        raise ExciteError(Finding("excite.joints", "no joint can be excited: "
                                  + "; ".join(each.message for each in notes),
                                  fix="give joints drives with gains (the verb `drives`)"))
    if len(free) > MAX_JOINTS:
        raise ExciteError(Finding("excite.joints", f"{len(free)} joints; at most {MAX_JOINTS}",
                                  fix="--joints REGEX chooses some"))
    return free


def _why_not(joint: AssetJoint) -> str:
    if joint.leader:
        return f"follows {joint.leader.rpartition('/')[2]}"
    if joint.lower >= joint.upper:
        return "is locked by its limits"
    if not joint.has_drive or (joint.stiffness <= 0 and joint.damping <= 0):
        return "has no drive with gains, which would move it"
    return ""


# ---- the motion

class _Maker:
    """Makes one motion."""

    def __init__(self, scene: PhysicsScene, how: How) -> None:
        self.how = how
        self.notes: list[Finding] = []
        self.joints = chosen_joints(asset_joints(scene), how.joints, self.notes)
        self.mover = Mover(scene, self.joints)
        self.scene = scene
        self.random = np.random.default_rng(how.seed)
        self.start = self.mover.start
        self.middle = self._bearable(self._middles())
        self.slow = 1.0  # how much longer the way there takes than what speeds ask for
        for joint, start in zip(self.joints, self.start, strict=True):
            if not joint.lower - 1e-6 <= start <= joint.upper + 1e-6:
                self._tell("excite.start", f"starts at {start:.4g} {joint.unit}, beyond its limits",
                           "correct the start of the asset (convert with --start valid)", joint)
        if any(coordinate.joint is None for coordinate in self.mover.base.coordinates):
            self._tell("excite.floating", "a body floats: efforts are those of a base that is held",
                       "hold the robot on a stand")

    def _tell(self, rule: str, message: str, fix: str = "", joint: AssetJoint | None = None,
              severity: str = "warning") -> None:
        self.notes.append(Finding(rule, message, "", 0, joint.short if joint else "", fix, severity,
                                  prim=joint.name if joint else ""))

    def _refuse(self, rule: str, message: str, fix: str, joint: AssetJoint | None = None
                ) -> ExciteError:
        return ExciteError(Finding(rule, message, "", 0, joint.short if joint else "", fix,
                                   prim=joint.name if joint else ""))

    # ---- limits

    def _middles(self) -> Array:
        """Between the limits; where one is missing, the start."""
        return np.array([(joint.lower + joint.upper) / 2 if math.isfinite(joint.span)
                         else min(max(start, joint.lower + 0.01), joint.upper - 0.01)
                         for joint, start in zip(self.joints, self.start, strict=True)])

    def _bearable(self, middle: Array) -> Array:
        """Nearer to the start, where drives cannot hold the weight there."""
        for _ in range(6):
            if not any(abs(weight) > 0.9 * self.how.effort * joint.effort_limit for joint, weight
                       in zip(self.joints, self.mover.weight(middle), strict=True)):
                break
            middle = self.start + 0.6 * (middle - self.start)
        return middle

    def bounds(self, middle: Array) -> Bounds:
        """What each joint may do around the middle."""
        inertia = self.mover.inertia(middle)
        weight = np.abs(self.mover.weight(middle))
        rows = [self._bounds_of(joint, float(middle[k]), float(inertia[k]), float(weight[k]))
                for k, joint in enumerate(self.joints)]
        return Bounds(*(np.array(column) for column in zip(*rows, strict=True)))

    def _bounds_of(self, joint: AssetJoint, middle: float, inertia: float, weight: float
                   ) -> tuple[float, ...]:
        kind = 0 if joint.rotates else 1
        kept = self.how.margin * joint.span if math.isfinite(joint.span) else 0.0
        room = min(joint.upper - kept - middle, middle - joint.lower - kept)
        room = max(min(room, USUAL_ROOM[kind]) if not math.isfinite(joint.span) else room, 0.0)
        limit = joint.velocity_limit
        speed = self.how.speed * (limit if math.isfinite(limit) else USUAL_SPEED[kind])
        left = max(self.how.effort * joint.effort_limit - weight - joint.friction, 0.0)
        if joint.passive_damping > 0:
            speed = min(speed, 0.7 * left / joint.passive_damping)
        stiffness, damping = _gains(joint, inertia)
        natural, ratio = _second_order(stiffness, damping, inertia)
        follows = min(natural, stiffness / damping if damping > 0 and stiffness > 0 else natural)
        top = min(TOP_FREQUENCY, 0.1 / self.how.step, OF_BANDWIDTH * follows / (2 * math.pi))
        peak, over = _of_step(natural, ratio)
        step = speed / peak
        if math.isfinite(joint.effort_limit) and stiffness > 0:
            step = min(step, max(self.how.effort * joint.effort_limit - weight, 0.0) / stiffness)
        if self.how.kind == "steps":
            room /= 1 + 2 * over  # a jump goes from one side to the other
        settling = 6 / max(min(ratio, 1.0) * natural, 1e-9) if ratio <= 1 else \
            6 * damping / max(stiffness, 1e-9)
        return (room, speed, max(top, 2 / self.how.duration), step, min(settling, 5.0),
                left / max(inertia, 1e-9))

    def tell_limits(self, bounds: Bounds) -> None:
        """What was taken for what the asset does not say."""
        for joint in self.joints:
            if not math.isfinite(joint.velocity_limit):
                self._tell("excite.no-limit", "has no limit of speed; "
                           f"{USUAL_SPEED[0 if joint.rotates else 1]:g} {joint.unit}/s is taken",
                           "give it the one of the data sheet (the verb `drives`)", joint, "info")
            if not math.isfinite(joint.effort_limit):
                self._tell("excite.no-limit", "its drive has no limit of effort: none is kept",
                           "give it the one of the data sheet (the verb `drives`)", joint, "info")
        part = self.how.duration / len(self.joints)
        if self.how.kind != "multisine" and part < SHORT:
            self._tell("excite.short", f"{len(self.joints)} joints in turn have {part:.3g} s each",
                       f"--duration {math.ceil(SHORT * len(self.joints)):d}, or fewer joints",
                       severity="info")
        for k, joint in enumerate(self.joints):
            if bounds.strength[k] <= 0:
                weight = self.mover.weight(self.middle)[k]
                raise self._refuse("excite.weight", f"holds {weight:.3g} and has friction of "
                                   f"{joint.friction:.3g}, while its drive exerts "
                                   f"{joint.effort_limit:.3g}, of which --effort takes the part "
                                   f"{self.how.effort:g}", "correct the limit of its drive (the "
                                   "verb `drives`), or choose other joints by --joints", joint)
            if bounds.room[k] <= 0:
                raise self._refuse("excite.no-room", "has no room between its limits and the "
                                   "margin", "a smaller --margin, or leave it out with --joints",
                                   joint)

    # ---- kinds

    def curve(self, times: Array, bounds: Bounds, middle: Array) -> Array:
        """Offsets from the middle, shape (T, N)."""
        how = self.how
        if how.kind != "multisine":
            return in_turn(how.kind, times, how.duration, bounds, self.random)
        return multisine(times, how.duration, self._best_sines(times, bounds, middle), bounds)

    def _best_sines(self, times: Array, bounds: Bounds, middle: Array) -> Sines:
        """By a search: drawn ones first, then the best with one joint drawn again."""
        how, random = self.how, self.random
        first = max(1, how.search // 3)
        drawn = [draw_sines(random, bounds, how.duration) for _ in range(first)]
        at = np.linspace(0, len(times) - 1, min(REGRESSOR_POSTURES, len(times))).astype(int)
        judge = Judge(self.mover, middle)
        scores = [judge.score(judge.rows(*self._at(times, sines, bounds, middle, at)))
                  for sines in drawn]
        best, score = drawn[int(np.argmax(scores))], max(scores)
        for _ in range(how.search - first):
            other = draw_sines(random, bounds, how.duration)
            joint = int(random.integers(len(self.joints)))
            tried = best.changed(joint, other)
            if random.uniform() < 0.5:  # its phases alone
                phases = np.array(best.phases)
                phases[joint] = other.phases[joint]
                tried = dataclasses.replace(best, phases=phases)
            found = judge.score(judge.rows(*self._at(times, tried, bounds, middle, at)))
            if found > score:
                best, score = tried, found
        return best

    def _at(self, times: Array, sines: Sines, bounds: Bounds, middle: Array, at: Any
            ) -> tuple[Array, Array, Array]:
        position = middle + multisine(times, self.how.duration, sines, bounds)
        velocity = np.gradient(position, times, axis=0)
        return position[at], velocity[at], np.gradient(velocity, times, axis=0)[at]

    # ---- there and back

    def whole(self, offsets: Array, middle: Array, bounds: Bounds) -> tuple[Array, Array]:
        """The rows with the way from the start to the middle and back: times and positions."""
        way = np.abs(middle - self.start)
        lead = max(0.5, float(np.max(1.9 * way / np.maximum(bounds.speed, 1e-12)))) * self.slow
        count = math.ceil(lead / self.how.step)
        there = smooth(np.arange(count) / count)[:, None]
        rise = self.start + there * (middle - self.start)
        end = offsets[-1] + middle
        # A last row of steps may be away from the middle by rounding alone.
        fall = end + smooth(np.arange(1, count + 1) / count)[:, None] * (self.start - end)
        position = np.concatenate((rise, middle + offsets, fall))
        return np.asarray(np.arange(len(position)) * self.how.step, dtype=np.float64), position

    # ---- what shrinks it

    def within(self, offsets: Array, bounds: Bounds) -> tuple[Array, Array, Array, Array]:
        """Times, positions, sizes of the joints and largest efforts of a motion that keeps efforts
        and touches nothing; it is made smaller until it does."""
        size, blend, why = np.ones(len(self.joints)), 1.0, ""
        pairs = self._at_start() if self.how.collisions else set()
        limit = np.array([self.how.effort * joint.effort_limit for joint in self.joints])
        for _ in range(ROUNDS):
            middle = self.start + blend * (self.middle - self.start)
            whole, position = self.whole(self._inside(offsets * size, middle), middle, bounds)
            effort, at, worst = self._efforts(whole, position, limit)
            if np.any(effort > limit):
                k = int(np.argmax(effort / limit))
                lead = (len(whole) - len(offsets)) // 2
                if not lead <= at < len(whole) - lead and self.slow < 10:
                    self.slow *= 1.5
                    continue
                why = (f"{self.joints[k].short} would exert {effort[k]:.3g} of "
                       f"{limit[k]:.3g} {'N m' if self.joints[k].rotates else 'N'}")
                shares = self._shares(k, *worst)
                by = np.clip(0.97 * limit[k] / effort[k], 0.5, 0.95)
                size = np.where(shares > 0.3 * shares.max(), size * by, size)
                if abs(self.mover.weight(middle)[k]) > 0.9 * limit[k]:
                    blend *= 0.7  # smaller helps little where it holds as much while it stands
                if blend < 0.1 or float(size.min()) < 1e-3:
                    break
                continue
            hit = self._touching(position, pairs) if self.how.collisions else None
            if hit is None:
                self._tell_size(size, blend, why)
                return whole, position, size, effort
            why = f"{hit[0]} and {hit[1]} would touch by {1e3 * hit[2]:.3g} mm"
            size, blend = size * 0.85, blend * 0.85
        raise self._refuse("excite.no-motion", f"no motion is found that keeps all limits: {why}",
                           "another --joints, or correct limits and pairs of the asset (the verbs "
                           "`drives` and `pairs`)")

    def _shares(self, k: int, position: Array, velocity: Array, acceleration: Array) -> Array:
        """How much of the effort of one joint each of the motions takes [N m or N], shape (N,)."""
        whole = self.mover.effort(position, velocity, acceleration)[k]
        shares = np.zeros(len(self.joints))
        for j in range(len(self.joints)):
            still = np.arange(len(self.joints)) != j
            resting = np.where(still, position, self.middle)
            shares[j] = abs(whole - self.mover.effort(resting, velocity * still,
                                                      acceleration * still)[k])
        return shares

    def _inside(self, offsets: Array, middle: Array) -> Array:
        """Nearer to the start, there may be less room on one side: the whole is made smaller."""
        scale = np.ones(offsets.shape[1])
        for k, joint in enumerate(self.joints):
            kept = self.how.margin * joint.span if math.isfinite(joint.span) else 0.0
            for edge, most in ((joint.upper - kept - middle[k], float(offsets[:, k].max())),
                               (middle[k] - joint.lower - kept, -float(offsets[:, k].min()))):
                if most > max(edge, 0.0):
                    scale[k] = min(scale[k], max(edge, 0.0) / most)
        return offsets * scale

    def _efforts(self, times: Array, position: Array, limit: Array
                 ) -> tuple[Array, int, tuple[Array, Array, Array]]:
        """Largest ones on the way, shape (N,), and row and state of motion of the one that is most
        beyond its limit."""
        at = np.linspace(0, len(times) - 1, min(EFFORT_POSTURES, len(times))).astype(int)
        if self.how.kind == "steps":
            # What a jump takes is in its size; here the weight counts.
            velocity = acceleration = np.zeros_like(position)
        else:
            velocity = np.gradient(position, times, axis=0)
            acceleration = np.gradient(velocity, times, axis=0)
        rows = np.abs(np.stack([self.mover.effort(position[i], velocity[i], acceleration[i])
                                for i in at]))
        worst = int(at[int(np.argmax(np.max(rows / limit, axis=1)))])
        return (np.asarray(np.max(rows, axis=0)), worst,
                (position[worst], velocity[worst], acceleration[worst]))

    def _at_start(self) -> set[tuple[int, int]]:
        """Pairs that overlap where the asset starts: no motion can help it."""
        there = {(a, b) for _, a, b, _ in self.mover.touching(self.start[None])}
        if there:
            a, b = sorted(there)[0]
            self._tell("excite.overlap", f"{self._collider(a)} and {self._collider(b)} overlap at "
                       "the start" + (f", and {len(there) - 1} other pairs" if len(there) > 1
                                      else "") + ": such pairs are not kept apart",
                       "filter them (the verb `pairs`)")
        return there

    def _touching(self, position: Array, known: set[tuple[int, int]]
                  ) -> tuple[str, str, float] | None:
        count = min(CONTACT_POSTURES, len(position))
        at = np.linspace(0, len(position) - 1, count).astype(int)
        found = [(depth, a, b) for _, a, b, depth in self.mover.touching(position[at])
                 if (a, b) not in known]
        if not found:
            return None
        depth, a, b = max(found)
        return self._collider(a), self._collider(b), depth

    def _collider(self, index: int) -> str:
        collider = self.scene.colliders[index]
        path = self.scene.bodies[collider.body].path if collider.body is not None \
            else collider.path
        return str(path).rpartition("/")[2]

    def _tell_size(self, size: Array, blend: float, why: str) -> None:
        if why:
            self._tell("excite.shrunk", f"made smaller, to {100 * float(size.min()):.0f} % at "
                       f"least and {100 * blend:.0f} % of the way to the middle of the ranges: "
                       f"else {why}", severity="info")


def _gains(joint: AssetJoint, inertia: float) -> tuple[float, float]:
    factor = inertia if joint.is_acceleration else 1.0
    return joint.stiffness * factor, joint.damping * factor


def _second_order(stiffness: float, damping: float, inertia: float) -> tuple[float, float]:
    """Natural frequency [rad/s] and damping ratio; of a drive of speeds 1/time constant and 1."""
    inertia = max(inertia, 1e-9)
    if stiffness <= 0:
        return damping / inertia, 1.0
    natural = math.sqrt(stiffness / inertia)
    return natural, damping / (2 * inertia * natural)


def _of_step(natural: float, ratio: float) -> tuple[float, float]:
    """Of a unit step of a second-order system the top speed [1/s] and the overshoot."""
    if ratio >= 1:
        return natural * math.exp(-1.0) / ratio, 0.0
    root = math.sqrt(1 - ratio * ratio)
    return (natural * math.exp(-ratio / root * math.acos(ratio)),
            math.exp(-math.pi * ratio / root))


def excite(scene: PhysicsScene, how: How | None = None,
           progress: Callable[[str], None] | None = None, **changes: Any) -> Excitation:
    """A motion of a scene's joints; `changes` are fields of How. A seed gives the same numbers.

    Raises ExciteError where no motion keeps the limits, InvalidError of the algebra, MissingError
    without MuJoCo, whose shapes `collisions` look at.
    """
    how = checked(dataclasses.replace(how or How(), **changes))
    maker = _Maker(scene, how)
    bounds = maker.bounds(maker.middle)
    maker.tell_limits(bounds)
    times: Array = np.asarray(np.arange(round(how.duration / how.step) + 1) * how.step)
    if progress:
        progress("search")
    offsets = maker.curve(times, bounds, maker.middle)
    if progress:
        progress("limits")
    whole, position, size, effort = maker.within(offsets, bounds)
    velocity = np.gradient(position, whole, axis=0)
    if how.kind == "steps":
        velocity = np.zeros_like(position)
    acceleration = np.gradient(velocity, whole, axis=0)
    condition, log_det, unknowns = _told(maker.mover, position, velocity, acceleration)
    _tell_small(maker, position)
    return Excitation(whole, maker.joints, position, velocity, acceleration, effort, size,
                      condition, log_det, unknowns, how, scene.meters_per_unit,
                      tuple(maker.notes))


def checked(how: How) -> How:
    """Raises ExciteError for numbers that make no sense."""
    def refuse(what: str, fix: str) -> ExciteError:
        return ExciteError(Finding("excite.options", what, fix=fix))

    if how.kind not in KINDS:
        raise refuse(f"`{how.kind}` is no kind of motion", "one of " + ", ".join(KINDS))
    if not (math.isfinite(how.step) and 1e-4 <= how.step <= 1):
        raise refuse(f"the step is {how.step:g} s", "from 0.0001 to 1 s")
    if not (math.isfinite(how.duration) and 1 <= how.duration <= 36_000):
        raise refuse(f"the duration is {how.duration:g} s", "from 1 to 36000 s")
    if how.duration / how.step > MAX_SAMPLES:
        raise refuse(f"{how.duration / how.step:.0f} rows; at most {MAX_SAMPLES}",
                     "a longer step or a shorter duration")
    for name, low, high in (("margin", 0.0, 0.45), ("speed", 0.01, 1.0), ("effort", 0.01, 1.0)):
        value = float(getattr(how, name))
        if not (math.isfinite(value) and low <= value <= high):
            raise refuse(f"{name} is {value:g}", f"a part from {low:g} to {high:g}")
    if not 1 <= how.search <= MAX_SEARCH or how.seed < 0:
        raise refuse(f"search {how.search}, seed {how.seed}",
                     f"search from 1 to {MAX_SEARCH}, and a seed from 0 on")
    return how


def _told(mover: Mover, position: Array, velocity: Array, acceleration: Array
          ) -> tuple[float, float, int]:
    """Condition, log det and how many unknowns a motion tells apart."""
    if not np.any(velocity):
        return math.inf, 0.0, 0
    at = np.linspace(0, len(position) - 1, min(2 * REGRESSOR_POSTURES, len(position))).astype(int)
    judge = Judge(mover, position.mean(axis=0))
    rows = judge.rows(position[at], velocity[at], acceleration[at])
    values = judge.singular(rows)
    own = rows[:, :3 * len(mover.joints)]
    lengths = np.linalg.norm(own, axis=0)
    condition = math.inf
    if np.all(lengths > 0):
        known = np.linalg.svd(own / lengths, compute_uv=False)
        condition = float(known[0] / known[-1]) if known[-1] > 0 else math.inf
    return condition, information(values), int(np.sum(values > DROWNED))


def _tell_small(maker: _Maker, position: Array) -> None:
    """Joints that hardly move."""
    for k, joint in enumerate(maker.joints):
        moved = float(np.ptp(position[:, k]))
        usual = 2 * USUAL_ROOM[0 if joint.rotates else 1]
        span = joint.span if math.isfinite(joint.span) else usual
        if moved < SMALL * span:
            maker._tell("excite.small", f"moves by {moved:.3g} {joint.unit} alone, "
                        f"{100 * moved / span:.2g} % of its range", "look at its limits of speed "
                        "and effort", joint)


__all__ = ["KINDS", "SINES", "ExciteError", "Excitation", "How", "excite"]
