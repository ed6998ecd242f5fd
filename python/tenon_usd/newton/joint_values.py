# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of joints: limits, drives and what resolvers find, as keyword arguments of the builder.

Limits, targets and gains are those of the description (rad, N m/rad). What resolvers give is in the
units that USD has for it, degrees where a joint turns; MuJoCo's are per radian.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from .importing import Importing, warn
from .prims import PrimView

DEGREE = math.pi / 180
#: Newton's stiffness of a limit that newton:limitStiffness = inf calls hard [N m/deg or N/m].
HARD_LIMIT = 1.0e8
#: Values of Newton's attribute mujoco:solreflimit_mode: how SolverMuJoCo is to make solref of the
#: gains of a limit: from them, from the authored mjc:solreflimit, or MuJoCo's default.
FROM_GAINS, AUTHORED, MUJOCO_DEFAULT = 0, 1, 2
ANGULAR = ("rotX", "rotY", "rotZ")
AXES = {
    "transX": (1.0, 0.0, 0.0), "transY": (0.0, 1.0, 0.0), "transZ": (0.0, 0.0, 1.0),
    "rotX": (1.0, 0.0, 0.0), "rotY": (0.0, 1.0, 0.0), "rotZ": (0.0, 0.0, 1.0),
}
SPRING_KEYS = ("mujoco:dof_passive_stiffness", "mujoco:dof_springref")


@dataclasses.dataclass
class DofValues:
    """One degree of freedom: keyword arguments of JointDofConfig, and what follows its making."""

    arguments: dict[str, Any]
    position: float | None = None
    velocity: float | None = None
    custom: dict[str, Any] = dataclasses.field(default_factory=dict)


def drive_of(joint: Any, dof: str) -> Any:
    """The drive of a degree of freedom that the joint itself authors, or None."""
    for drive in joint.drives:
        if drive.dof == dof and drive.source == joint.path:
            return drive
    return None


def has_drive(prim: PrimView, dof: str, alone: bool) -> bool:
    name = ("angular" if dof in ANGULAR else "linear") if alone else dof
    return prim.HasAPI(f"PhysicsDriveAPI:{name}")


@dataclasses.dataclass(frozen=True)
class _Drive:
    """A drive as PhysicsDriveAPI authors it, in the units of the description."""

    stiffness: float
    damping: float
    max_force: float
    target_position: float
    target_velocity: float
    type: bool


def _authored_drive(importing: Importing, prim: PrimView, dof: str, alone: bool) -> _Drive:
    """Of PhysicsDriveAPI, where the description has another drive in its place: an actuator of
    MuJoCo, which SolverMuJoCo reads by itself."""
    angular = dof in ANGULAR
    name = ("angular" if angular else "linear") if alone else dof
    m, kg = importing.scene.meters_per_unit, importing.scene.kilograms_per_unit
    unit = DEGREE if angular else m
    force = kg * m * m if angular else kg * m

    def value(attribute: str, default: float) -> float:
        found = prim.value(f"drive:{name}:physics:{attribute}")
        return default if found is None else float(found)

    return _Drive(
        value("stiffness", 0.0) * force / unit,
        value("damping", 0.0) * force / unit,
        value("maxForce", math.inf) * force,
        value("targetPosition", 0.0) * unit,
        value("targetVelocity", 0.0) * unit,
        prim.value(f"drive:{name}:physics:type") == "acceleration",
    )


def target_arguments(
    importing: Importing, joint: Any, prim: PrimView, dof: str, alone: bool
) -> dict[str, Any]:
    """Targets, gains, the mode of the actuator and the largest effort."""
    modes = importing.libraries.newton.JointTargetMode
    if not has_drive(prim, dof, alone):
        return {"actuator_mode": modes.NONE}
    drive = drive_of(joint, dof) or _authored_drive(importing, prim, dof, alone)
    scale = importing.gains_scale if dof in ANGULAR else 1.0
    stiffness, damping = drive.stiffness * scale, drive.damping * scale
    if drive.type:
        warn(
            joint.path,
            "an acceleration drive: Newton takes its gains for those of a force drive; author "
            'physics:type = "force" with gains of its own',
        )
    mode = modes.from_gains(
        stiffness, damping, importing.options.force_position_velocity_actuation, has_drive=True
    )
    return {
        "target_q": drive.target_position,
        "target_qd": drive.target_velocity,
        "target_ke": stiffness,
        "target_kd": damping,
        "effort_limit": drive.max_force,
        "actuator_mode": mode,
    }


def effort_arguments(
    importing: Importing, prim: PrimView, made: dict[str, Any]
) -> dict[str, Any]:
    """The tighter of the drive's effort and that of the joint itself."""
    own = importing.resolvers.value(prim, "JOINT", "effort_limit")
    if own is not None:
        made["effort_limit"] = min(float(own), made.get("effort_limit", math.inf))
    return made


def damping_of(importing: Importing, prim: PrimView) -> tuple[float, float]:
    """Passive damping of linear and of angular degrees of freedom [N s/m], [N m s/rad]."""
    resolvers = importing.resolvers
    for resolver in resolvers.all:
        for key, angular in (("damping", 1 / DEGREE), ("damping_per_rad", 1.0)):
            found = resolvers.asked(resolver, prim, "JOINT", key)
            if found is not None:
                resolvers.collect(prim)
                return float(found), float(found) * angular
    default = importing.builder.default_joint_cfg.damping
    return default, default


def limit_gains(
    importing: Importing, prim: PrimView, key: str, angular: bool
) -> tuple[float, float, int]:
    """Stiffness and damping of a limit, and how SolverMuJoCo is to read them. `key`: "limit_rotX",
    "limit_angular" and so on, of values for one degree of freedom."""
    resolvers, config = importing.resolvers, importing.builder.default_joint_cfg
    unit = DEGREE if angular else 1.0
    of_joint = [resolvers.value(prim, "JOINT", f"limit_{gain}") for gain in ("ke", "kd")]
    own = resolvers.of_schemas(prim, f"{key}_ke"), resolvers.of_schemas(prim, f"{key}_kd")
    gains = []
    for value, one, default in zip(of_joint, own, (config.limit_ke, config.limit_kd), strict=True):
        if value is None:
            gains.append(default if one is None else one / unit)
        elif value == -math.inf:
            gains.append(default)
        else:
            gains.append(value / unit)
    stiffness, damping = gains
    if math.isinf(stiffness):
        stiffness, damping = HARD_LIMIT / unit, 0.0
    elif math.isinf(damping):
        damping = 0.0
    plain = all(each is None for each in (*of_joint, *own))
    return stiffness, damping, _solref_mode(importing, prim, plain)


def _solref_mode(importing: Importing, prim: PrimView, plain: bool) -> int:
    if importing.resolvers.mujoco is None:
        return FROM_GAINS
    if prim.authored("mjc:solreflimit") is not None:
        return AUTHORED
    config = importing.builder.default_joint_cfg
    standard = importing.libraries.newton.ModelBuilder.JointDofConfig()
    untouched = config.limit_ke == standard.limit_ke and config.limit_kd == standard.limit_kd
    if prim.HasAPI("MjcJointAPI") and plain and untouched:
        return MUJOCO_DEFAULT
    return FROM_GAINS


def solref_values(importing: Importing, gains: list[tuple[float, float, int]]) -> dict[str, Any]:
    """What is kept for SolverMuJoCo about limits, one for each degree of freedom."""
    if importing.resolvers.mujoco is None:
        return {}
    known, made = importing.builder.custom_attributes, {}
    if "mujoco:solreflimit_mode" in known:
        made["mujoco:solreflimit_mode"] = [mode for _, _, mode in gains]
    if "mujoco:solreflimit_gain_baseline" in known:
        vector = importing.libraries.warp.vec2
        made["mujoco:solreflimit_gain_baseline"] = [vector(ke, kd) for ke, kd, _ in gains]
    return made


def spring_of(
    importing: Importing, prim: PrimView, angular: bool, custom: dict[str, Any]
) -> tuple[float, float | None, float]:
    """Stiffness and rest of the passive spring, and the coordinate that MuJoCo counts from."""
    resolvers, config = importing.resolvers, importing.builder.default_joint_cfg
    stiffness, spring = (custom.pop(key, None) for key in SPRING_KEYS)
    stiffness = resolvers.value(
        prim, "JOINT", "stiffness", config.stiffness if stiffness is None else stiffness
    )
    unit = mujoco_angle(importing) if angular else 1.0
    found = resolvers.value(prim, "JOINT", "springref")
    if found is not None:
        spring = float(found) * unit
    start = resolvers.value(prim, "JOINT", "ref")
    start = custom.get("mujoco:dof_ref", None if start is None else float(start) * unit)
    rest: float | None = config.rest_q
    if spring is not None or start is not None:
        rest = float(spring or 0.0) - float(start or 0.0)
    return float(stiffness), rest, float(start or 0.0)


def mujoco_angle(importing: Importing) -> float:
    """Radians in a unit of MuJoCo's angles, degrees where mjc:compiler:angle says nothing."""
    scene = importing.scene_prim
    said = scene.authored("mjc:compiler:angle") if scene is not None else None
    return DEGREE if said is None or said == "degree" else 1.0


def one_dof(importing: Importing, joint: Any, prim: PrimView) -> DofValues:
    """Of a revolute or prismatic joint."""
    resolvers, config = importing.resolvers, importing.builder.default_joint_cfg
    angular = joint.type == "revolute"
    dof = ("rot" if angular else "trans") + joint.axis
    custom = importing.custom_values(prim, "JOINT", "JOINT_DOF", "JOINT_COORD")
    stiffness, rest, start = spring_of(importing, prim, angular, custom)
    gains = limit_gains(importing, prim, "limit_angular" if angular else "limit_linear", angular)
    unit = DEGREE if angular else 1.0
    speed = resolvers.value(prim, "JOINT", "velocity_limit")
    speed = None if speed is None or math.isinf(speed) else float(speed) * unit
    made = {
        "limit_lower": joint.lower - start,
        "limit_upper": joint.upper - start,
        "limit_ke": gains[0],
        "limit_kd": gains[1],
        "stiffness": stiffness,
        "rest_q": rest,
        "armature": resolvers.value(prim, "JOINT", "armature", config.armature),
        "friction": resolvers.value(prim, "JOINT", "friction", config.friction),
        "damping": damping_of(importing, prim)[angular],
        "velocity_limit": config.velocity_limit if speed is None else speed,
    }
    made.update(target_arguments(importing, joint, prim, dof, alone=True))
    custom.update(
        {key: values[0] for key, values in solref_values(importing, [gains]).items()}
    )
    values = DofValues(effort_arguments(importing, prim, made), custom=custom)
    values.position, values.velocity = state_of(
        importing, prim, "angular" if angular else "linear", unit
    )
    return values


def state_of(
    importing: Importing, prim: PrimView, key: str, unit: float
) -> tuple[float | None, float | None]:
    """Start of a coordinate as a resolver finds it [rad or m, and per second]."""
    found = (importing.resolvers.value(prim, "JOINT", f"{key}_{what}") for what in
             ("position", "velocity"))
    position, velocity = (None if each is None else float(each) * unit for each in found)
    return position, velocity
