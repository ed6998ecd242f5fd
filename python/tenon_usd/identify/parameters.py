# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What can be identified: families of parameters, and rows that say which joints, within which
bounds and with which prior.

    rows = [row_from_text("friction:.*finger.*=0..2"), *rows_from_file("parameters.toml")]
    parameters = select(rows, world, log)
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from .._lists import no_such
from .._toml import FileError, Reader, is_number, read_toml, rows_of
from ..actuators import fitting
from ..errors import InvalidError, NotFoundError
from ..world import World
from .log import Log
from .moments import axes_of
from .stribeck import DECAY

MAX_FILE_BYTES = 1 << 20
MAX_PARAMETERS = 400
#: Limits of velocity from here on are none [rad/s or m/s].
NO_LIMIT = 1e6


@dataclasses.dataclass(frozen=True)
class Family:
    """One kind of parameter. `of` is what has it; `sets` the number of World.set_parameter() that
    it is, with a dot a field of the description, empty where the model of the log has it; `motion`
    the motion that tells it."""

    of: str
    unit: str
    sets: str
    low: float
    high: float
    motion: str


_GAINS = "steps and fast sines of the command, so that the joint is away from it"
#: What can be identified, by name.
FAMILIES = {
    "friction": Family("joint", "N m or N", "jointFriction", 0, math.inf,
                       "slow motion that turns back several times, and the effort in the log"),
    "damping": Family("joint", "N m s/rad or N s/m", "jointDamping", 0, math.inf,
                      "constant speeds, slow and fast ones"),
    "stribeck": Family("joint", "N m or N", "", 0, math.inf,
                       "slow motion that stops and turns back, and the effort in the log"),
    "stribeckSpeed": Family("joint", "rad/s or m/s", "", 1e-3, 100,
                            "motion at speeds below and above it, and the effort in the log"),
    "armature": Family("joint", "kg m^2 or kg", "jointArmature", 0, math.inf,
                       "fast accelerations, such as a chirp"),
    "stiffness": Family("drive", "N m/rad or N/m", "driveStiffness", 0, math.inf, _GAINS),
    "driveDamping": Family("drive", "N m s/rad or N s/m", "driveDamping", 0, math.inf, _GAINS),
    "maxForce": Family("drive", "N m or N", "driveMaxForce", 1e-9, math.inf,
                       "commands that the drive can only follow with all its effort"),
    "mass": Family("body", "kg", "bodyMass", 1e-6, math.inf,
                   "postures in which gravity pulls differently, and the effort in the log"),
    "contactFriction": Family("collider", "1", "colliderFriction", 0, 10,
                              "motion in which the shape slides"),
    "delay": Family("drive", "s", "", -0.05, 0.5, "steps and fast sines of the command"),
    "offset": Family("joint", "rad or m", "", -math.inf, math.inf,
                     "postures in which gravity pulls differently, and the effort in the log"),
    "effortScale": Family("joint", "1", "", 1e-3, 1e3,
                          "effort in the log, and a known mass that is lifted or accelerated"),
    "mimicRatio": Family("joint that follows", "1", "joints.mimics.multiplier", -math.inf,
                         math.inf, "positions of the joint that follows, in the log"),
    "velocityLimit": Family("joint with a limit of velocity", "rad/s or m/s",
                            "joints.velocityLimit", 1e-6, math.inf,
                            "commands that are faster than the joint may be"),
    **{f"centerOfMass{axis}": Family(
        "body", "m", "bodies.centerOfMass", -math.inf, math.inf,
        "postures in which gravity pulls differently, and the effort in the log")
       for axis in "XYZ"},
    **{f"secondMoment{axis}": Family(
        "body", "kg m^2", "bodies.inertia", 0, math.inf,
        "fast accelerations about several axes, and the effort in the log") for axis in "XYZ"},
}
#: Names for several families.
GROUPS = {
    "gains": ("stiffness", "driveDamping"),
    "centerOfMass": tuple(f"centerOfMass{axis}" for axis in "XYZ"),
    "inertia": tuple(f"secondMoment{axis}" for axis in "XYZ"),
}


@dataclasses.dataclass(frozen=True)
class Row:
    """What was asked for: `family` of everything that `pattern` means; None: as the family has it.
    `prior` and `deviation` are what is known of it; `tied`: one number for all of them."""

    family: str
    pattern: str = ".*"
    low: float | None = None
    high: float | None = None
    start: float | None = None
    prior: float | None = None
    deviation: float | None = None
    tied: bool | None = None
    line: int = 0
    file: str = dataclasses.field(default="", compare=False)

    @property
    def place(self) -> str:
        """"parameters.toml:3: " for messages; empty where it is of no file."""
        return f"{self.file}:{self.line}: " if self.file else ""


@dataclasses.dataclass(frozen=True)
class Parameter:
    """One number [SI, rad] to identify, of one object or shared by several."""

    family: str
    paths: tuple[str, ...]
    nominal: float
    """What the asset says."""
    start: float
    low: float
    high: float
    scale: float
    """What counts as a large change of it."""
    prior: float | None = None
    deviation: float | None = None
    weights: tuple[float, ...] = ()
    """Of a sum (summed()): how much the number of each path counts in it, the first one 1."""
    shares: tuple[float, ...] = ()
    """Of a sum: which part of it each path gets; empty: every path has the number itself."""

    @property
    def name(self) -> str:
        """"friction:/arm/elbow", of a sum "friction:/hand/index_1 + 1.1 index_2"."""
        if self.weights:
            return f"{self.family}:{self.paths[0]}" + "".join(
                f" + {weight:.4g} {path.rpartition('/')[2]}"
                for path, weight in zip(self.paths[1:], self.weights[1:]))
        more = f" (+{len(self.paths) - 1})" if len(self.paths) > 1 else ""
        return f"{self.family}:{self.paths[0]}{more}"

    @property
    def parts(self) -> list[tuple[str, float]]:
        """Each path, and what its number is of this one."""
        return list(zip(self.paths, self.shares or (1.0,) * len(self.paths)))

    @property
    def unit(self) -> str:
        return FAMILIES[self.family].unit

    @property
    def is_place(self) -> bool:
        """Whether it is a place in time or space, where a part of the number is no measure."""
        return self.family in ("delay", "offset") or self.family.startswith("centerOfMass")


class ParametersError(FileError):
    """Rows that cannot be used: a Fault for each thing that is wrong."""


def _families(name: str) -> tuple[str, ...]:
    """Raises NotFoundError, with the reason where there is one."""
    if name in GROUPS:
        return GROUPS[name]
    if name in FAMILIES:
        return (name,)
    raise NotFoundError(f"family: {no_such(name, [*FAMILIES, *GROUPS])}")


def _numbers(text: str, names: Sequence[str], whole: str) -> list[float]:
    parts = text.split(".." if ".." in text else ",")
    try:
        values = [float(part) for part in parts]
    except ValueError:
        values = []
    if len(values) != len(names) or not all(map(math.isfinite, values)):
        raise InvalidError(f"{whole!r}: expected {' and '.join(names)} as two numbers")
    return values


def rows_from_text(text: str) -> list[Row]:
    """"FAMILY", "FAMILY:REGEX", "FAMILY:REGEX=LOW..HIGH": rows, one for each family that it names.
    Raises NotFoundError and InvalidError."""
    head, equals, numbers = text.partition("=")
    name, _, pattern = head.partition(":")
    low = high = None
    if equals:
        low, high = _numbers(numbers, ("the least", "the largest"), text)
        if low > high:
            raise InvalidError(f"{text!r}: the first number is not above the second")
    return [Row(family, pattern or ".*", low, high) for family in _families(name)]


def prior_from_text(text: str) -> list[Row]:
    """"FAMILY:REGEX=VALUE,DEVIATION": what is known of them. Raises NotFoundError and
    InvalidError."""
    head, equals, numbers = text.partition("=")
    name, _, pattern = head.partition(":")
    if not equals:
        raise InvalidError(f"{text!r}: expected FAMILY:REGEX=VALUE,DEVIATION")
    value, deviation = _numbers(numbers, ("the value", "its standard deviation"), text)
    if deviation < 0:
        raise InvalidError(f"{text!r}: a deviation is not below 0")
    return [Row(family, pattern or ".*", prior=value, deviation=deviation)
            for family in _families(name)]


_KEYS = ("family", "joints", "low", "high", "start", "prior", "deviation", "tied")


def rows_from_file(path: str) -> list[Row]:
    """The tables [[parameter]] of a TOML file. Errors: ParametersError, with lines; OSError."""
    text, table = read_toml(path, MAX_FILE_BYTES, ParametersError)
    reader = Reader(text)
    reader.unknown(table, ("parameter",))
    rows: list[Row] = []
    for number, each in enumerate(rows_of(reader, table, "parameter"), 1):
        reader.at("parameter", number)
        rows += [dataclasses.replace(row, file=path) for row in _file_row(reader, dict(each))]
    if not rows and not reader.faults:
        reader.fault("there is no table [[parameter]]")
    if reader.faults:
        raise ParametersError(path, reader.faults)
    return rows


def _file_row(reader: Reader, table: dict[str, Any]) -> list[Row]:
    reader.unknown(table, _KEYS)
    name = reader.text(table, "family", "") or ""
    pattern = reader.text(table, "joints", ".*") or ".*"
    values: dict[str, float | None] = {}
    for key in ("low", "high", "start", "prior", "deviation"):
        values[key] = None
        if key in table:
            if is_number(table[key]):
                values[key] = float(table[key])
            else:
                reader.fault(f"{key} is {table[key]!r}; expected a number", key)
    tied = table.get("tied")
    if tied is not None and not isinstance(tied, bool):
        reader.fault(f"tied is {tied!r}; expected true or false", "tied")
        tied = None
    low, high, deviation = values["low"], values["high"], values["deviation"]
    if low is not None and high is not None and low > high:
        reader.fault(f"low is {low:g} and high {high:g}", "low")
    if (values["prior"] is None) != (deviation is None):
        reader.fault("a prior has both prior and deviation", "prior")
    elif deviation is not None and deviation < 0:
        reader.fault("a deviation is not below 0", "deviation")
    try:
        return [Row(family, pattern, low, high, values["start"], values["prior"], deviation, tied,
                    reader.line) for family in _families(name)]
    except NotFoundError as error:
        reader.fault(str(error), "family")
        return []


# ---- what the rows mean in an asset


@dataclasses.dataclass(frozen=True)
class Plant:
    """What an asset says about the objects that have parameters [SI, rad]."""

    joints: dict[str, Any]
    drives: dict[str, Any]
    bodies: dict[str, Any]
    colliders: dict[str, float]
    inertia: dict[str, float]
    """What a joint has to accelerate [kg m^2 or kg]."""
    followers: dict[str, tuple[str, float]] = dataclasses.field(default_factory=dict)
    """Joints that follow another by a linear mimic law: the one that leads the whole chain, and
    the turn of the follower by a turn of that one [its unit by that of the leader]."""


def plant_of(world: World, inertia: dict[str, float]) -> Plant:
    scene = world.scene
    joints = {joint.path: joint for joint in scene.joints if joint.path in world.joint_names}
    drives = {path: joint.drives[0] for path, joint in joints.items()
              if joint.drives and path in world.drive_names}
    colliders = {}
    for collider in scene.colliders:
        material = scene.unbound if collider.material is None else scene.materials[
            collider.material]
        colliders[str(collider.path)] = float(material.dynamic_friction)
    bodies = {body.path: body for body in scene.bodies if not body.kinematic and body.mass > 0}
    return Plant(joints, drives, bodies, colliders, inertia, _followers(scene, joints))


def _followers(scene: Any, joints: dict[str, Any]) -> dict[str, tuple[str, float]]:
    laws = {path: joint.mimics[0] for path, joint in joints.items()
            if len(joint.mimics) == 1 and not np.any(joint.mimics[0].higher)}
    made = {}
    for path in laws:
        leader, ratio = path, 1.0
        for _ in laws:  # a circle of leaders ends, too
            if leader in laws:
                ratio *= float(laws[leader].multiplier)
                leader = scene.joints[laws[leader].leader].path
        if leader in joints and leader not in laws and ratio:
            made[path] = (leader, ratio)
    return made


def _names(plant: Plant, log: Log, of: str) -> list[str]:
    if of == "body":
        return list(plant.bodies)
    if of == "collider":
        return list(plant.colliders)
    if of == "joint that follows":
        return [path for path, joint in plant.joints.items() if len(joint.mimics) == 1]
    if of == "joint with a limit of velocity":
        return [path for path in log.joints if path in plant.joints
                and plant.joints[path].velocity_limit < NO_LIMIT]
    return [name for name in log.joints if name in (plant.drives if of == "drive"
                                                    else plant.joints)]


def _nominal(plant: Plant, family: str, path: str) -> float:
    if family in ("friction", "damping", "armature"):
        return float(getattr(plant.joints[path], family))
    if family in ("stiffness", "driveDamping", "maxForce"):
        drive = plant.drives[path]
        return float({"stiffness": drive.stiffness, "driveDamping": drive.damping,
                      "maxForce": drive.max_force}[family])
    if family == "mass":
        return float(plant.bodies[path].mass)
    if family == "mimicRatio":
        return float(plant.joints[path].mimics[0].multiplier)
    if family == "velocityLimit":
        return float(plant.joints[path].velocity_limit)
    if family.startswith("centerOfMass"):
        return float(plant.bodies[path].center_of_mass["XYZ".index(family[-1])])
    if family.startswith("secondMoment"):
        moments = axes_of(np.asarray(plant.bodies[path].inertia))[1]
        return float(moments["XYZ".index(family[-1])])
    if family == "contactFriction":
        return plant.colliders[path]
    if family == "stribeckSpeed":
        return DECAY
    return 1.0 if family == "effortScale" else 0.0


def _scale(plant: Plant, log: Log, family: str, path: str, nominal: float) -> float:
    """A large change of the number: its own size, or what makes a tenth of the efforts."""
    if family == "delay":
        return max(log.step, 1e-3)
    if family == "offset":
        return 0.02
    if family.startswith(("centerOfMass", "secondMoment")):
        body = plant.bodies[path]
        spread = 0.5 * float(np.trace(np.asarray(body.inertia)))
        # A part of the body's size, or of the inertia of a body that large.
        return (0.3 * math.sqrt(spread / body.mass) if family.startswith("centerOfMass")
                else max(nominal, 0.1 * spread))
    if family not in ("friction", "stribeck", "damping", "armature", "stiffness", "driveDamping",
                      "maxForce"):
        return max(abs(nominal), 0.1)
    at = log.joints.index(path)
    inertia = plant.inertia.get(path, 0.0) or 1e-3
    speed = _size(log.velocity, at) or _size(_slope(log), at) or 1.0
    effort = _size(log.effort, at) or _size(log.command_effort, at)
    if not effort:
        turn = _size(_slope(log, 2), at) or 1.0
        effort = inertia * turn
    typical = {"friction": 0.1 * effort, "stribeck": 0.1 * effort, "damping": 0.1 * effort / speed,
               "armature": 0.1 * inertia, "stiffness": effort / max(_size(log.position, at), 1e-3),
               "driveDamping": 0.1 * effort / speed, "maxForce": effort}[family]
    return float(max(nominal if math.isfinite(nominal) else 0.0, typical, 1e-9))


def _slope(log: Log, times: int = 1) -> Any:
    values: Any = log.position
    for _ in range(times if values is not None and len(log) > 2 else 0):
        values = np.gradient(values, log.times, axis=0)
    return values


def _size(values: Any, column: int) -> float:
    """The deviation of a column; 0 where there is none."""
    if values is None:
        return 0.0
    own = values[:, column][np.isfinite(values[:, column])]
    return float(np.std(own)) if own.size else 0.0


def select(rows: Iterable[Row], plant: Plant, log: Log, sums: bool = True) -> list[Parameter]:
    """The parameters that rows mean, in their order; of one that several rows name the last says
    bounds and prior. `sums`: those of joints that move together are one (summed()). Raises
    NotFoundError for patterns that mean nothing, InvalidError."""
    found: dict[tuple[str, tuple[str, ...]], Parameter] = {}
    for row in rows:
        family = FAMILIES[row.family]
        names = _names(plant, log, family.of)
        try:
            paths = [names[i] for i in fitting(row.pattern, names)] if names else []
        except NotFoundError as error:
            raise NotFoundError(f"{row.place}{row.family}: {error}") from None
        if not paths:
            raise NotFoundError(f"{row.place}{row.family}: the asset has no {family.of} of the "
                                "log's joints that has it")
        tied = row.tied if row.tied is not None else row.family == "delay"
        for group in [tuple(paths)] if tied else [(path,) for path in paths]:
            key = (row.family, group)
            found[key] = _parameter(row, group, plant, log, found.get(key))
    if len(found) > MAX_PARAMETERS:
        raise InvalidError(f"{len(found)} parameters; at most {MAX_PARAMETERS} are identified "
                           "together: name fewer joints")
    made = list(found.values())
    return summed(made, plant) if sums else made


#: What of a joint that follows acts on its leader: by the ratio of the mimic law to this power.
POWERS = {"friction": 1, "damping": 2, "armature": 2}


def summed(parameters: Sequence[Parameter], plant: Plant) -> list[Parameter]:
    """The same with one parameter, their sum, in place of those that no motion tells apart:
    friction, damping and armature of a joint and of its followers. What a prior is about stays
    for itself, and so do joints whose ratio is not known yet."""
    groups: dict[tuple[str, str], list[tuple[float, Parameter]]] = {}
    open_ratios = {path for each in parameters if each.family == "mimicRatio"
                   for path in each.paths}
    for each in parameters:
        if each.family in POWERS and len(each.paths) == 1 and each.prior is None and (
                each.paths[0] not in open_ratios):
            leader, ratio = plant.followers.get(each.paths[0], (each.paths[0], 1.0))
            groups.setdefault((each.family, leader), []).append(
                (abs(ratio) ** POWERS[each.family], each))
    sums = {}
    for (_, leader), members in groups.items():
        if len(members) > 1:
            members.sort(key=lambda member: member[1].paths[0] != leader)
            sums.update({(each.family, each.paths): members for _, each in members})
    made: list[Parameter] = []
    for each in parameters:
        group = sums.get((each.family, each.paths))
        if group is None:
            made.append(each)
        elif each is next(other for other in parameters if any(other is m for _, m in group)):
            made.append(_sum(group))
    return made


def _sum(members: Sequence[tuple[float, Parameter]]) -> Parameter:
    """Each part keeps its share of what the asset has; all are the same where that is 0."""
    first = members[0][0]
    weights = [weight / first for weight, _ in members]
    own = [each for _, each in members]

    def total(name: str) -> float:
        return float(sum(w * getattr(each, name) for w, each in zip(weights, own)))

    nominal = total("nominal")
    shares = [each.nominal / nominal if nominal > 0 else 1 / sum(weights) for each in own]
    return Parameter(own[0].family, tuple(each.paths[0] for each in own), nominal, total("start"),
                     total("low"), total("high"), max(nominal, own[0].scale),
                     weights=tuple(weights), shares=tuple(shares))


def _parameter(row: Row, paths: tuple[str, ...], plant: Plant, log: Log,
               known: Parameter | None) -> Parameter:
    family = FAMILIES[row.family]
    nominal = float(np.mean([_nominal(plant, row.family, path) for path in paths]))
    scale = float(np.mean([_scale(plant, log, row.family, path, nominal) for path in paths]))
    low = row.low if row.low is not None else known.low if known else family.low
    high = row.high if row.high is not None else known.high if known else family.high
    prior = row.prior if row.prior is not None else known.prior if known else None
    deviation = row.deviation if row.prior is not None else known.deviation if known else None
    start = row.start if row.start is not None else nominal
    if not math.isfinite(start):
        start = scale
    if low < family.low or high > family.high:
        raise InvalidError(f"{row.place}{row.family} of {paths[0]}: bounds are within "
                           f"{family.low:g} and {family.high:g} {family.unit}")
    start = min(max(start, low), high)
    return Parameter(row.family, paths, nominal, start, low, high, scale, prior, deviation)
