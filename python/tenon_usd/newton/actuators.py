# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Prims of type NewtonActuator as models of tenon_usd.actuators, for the engines here.

    from tenon_usd.actuators import Actuators
    from tenon_usd.newton.actuators import read_actuators

    world = tenon_usd.World("arm.usda")
    motors = Actuators(world, read_actuators("arm.usda", world.time_step))

What Newton's schemas say is in joint space, in radians and in the stage's units of length and mass.
"""

from __future__ import annotations

import math
import warnings
from typing import Any

from ..actuators import PD, PID, Actuator, DCMotor, Delay, Saturation, Stage
from ..errors import InvalidError, UnsupportedError
from .options import ImportedWarning, stage_of
from .prims import Prims, PrimView

JOINTS = ("PhysicsRevoluteJoint", "PhysicsPrismaticJoint")
CONTROLS = ("NewtonPDControlAPI", "NewtonPIDControlAPI", "NewtonNeuralControlAPI")
#: What no model here simulates, and what it is.
REFUSED = {
    "NewtonNeuralControlAPI": "a neural network that computes efforts",
    "NewtonPositionBasedClampingAPI": "a table of the largest effort by position",
}


def read_actuators(source: Any, time_step: float, *, physics: str = "") -> list[Actuator]:
    """The actuators of a stage: `source` and `physics` as add_usd() has them; delays, which Newton
    counts in time steps, are of steps of `time_step` [s].

    Commands are positions, or velocities where kp and ki are 0; other targets of Newton are 0.
    Raises InvalidError where a prim is not as its schema wants it, UnsupportedError for neural
    control and clamping by position.
    """
    stage = stage_of(source, physics)
    prims = Prims(stage, "/", ())
    found = [prim for prim in prims if prim.type_name == "NewtonActuator"]
    scene = stage.physics() if found else None
    return [_read(prims, prim, time_step, scene) for prim in found]


def _read(prims: Prims, prim: PrimView, time_step: float, scene: Any) -> Actuator:
    for api, what in REFUSED.items():
        if api in prim.apis:
            raise UnsupportedError(
                f"{prim.path}: {api}, {what}, is not simulated here; apply another API, deactivate "
                "the prim, or give its joint an Actuator of tenon_usd.actuators")
    joint = _target(prims, prim)
    try:
        stages, command = _stages(_Numbers(prim, prims[joint], scene), time_step)
    except InvalidError as reason:
        raise InvalidError(f"{prim.path}: {reason}") from None
    wide = math.inf if command == "velocity" else None
    return Actuator(joint, *stages, command=command, low=None if wide is None else -wide, high=wide)


def _target(prims: Prims, prim: PrimView) -> str:
    targets = prim.targets("newton:targets")
    if not targets:
        raise InvalidError(f"{prim.path}: newton:targets names no joint; author it, or deactivate "
                           "the prim")
    joint = prims.get(str(targets[0]))
    if joint is None or joint.type_name not in JOINTS:
        what = "no prim" if joint is None else f"a {joint.type_name or 'prim without a type'}"
        raise InvalidError(f"{prim.path}: newton:targets names {targets[0]}, which is {what}; "
                           f"it takes a {JOINTS[0]} or {JOINTS[1]}")
    if len(targets) > 1:
        warnings.warn(f"{prim.path}: newton:targets names {len(targets)} joints; {targets[0]} "
                      "alone is driven, as in Newton", ImportedWarning, stacklevel=4)
    return str(targets[0])


class _Numbers:
    """Attributes of an actuator in metres, kilograms and radians."""

    def __init__(self, prim: PrimView, joint: PrimView, scene: Any) -> None:
        self.apis, self._prim = prim.apis, prim
        length = scene.meters_per_unit
        self._along = length if joint.type_name == JOINTS[1] else 1.0
        self._effort = scene.kilograms_per_unit * length * length / self._along

    def plain(self, name: str) -> float:
        return float(self._prim.value("newton:" + name))

    def effort(self, name: str) -> float:
        return float(self.plain(name) * self._effort)

    def gain(self, name: str) -> float:
        return float(self.plain(name) * self._effort / self._along)

    def along(self, name: str) -> float:
        return self.plain(name) * self._along


def _stages(of: _Numbers, time_step: float) -> tuple[list[Stage], str]:
    """In Newton's order: delay, control law, limits; and what is commanded."""
    stages: list[Stage] = []
    if "NewtonActuatorDelayAPI" in of.apis:
        stages.append(Delay(of.plain("delaySteps") * time_step))
    law = _law(of)
    stages.append(law)
    if "NewtonMaxEffortClampingAPI" in of.apis:
        stages += _bounded(of.effort("maxEffort"))
    if "NewtonDCMotorClampingAPI" in of.apis:
        stages += _motor(of.effort("saturationEffort"), of.along("velocityLimit"),
                         of.effort("maxMotorEffort"))
    holds = law.stiffness != 0 or (isinstance(law, PID) and law.integral != 0)
    return stages, "position" if holds else "velocity"


def _law(of: _Numbers) -> PD | PID:
    laws = [api for api in CONTROLS if api in of.apis]
    if len(laws) != 1:
        told = "has no control law" if not laws else f"has several control laws, {', '.join(laws)}"
        raise InvalidError(f"it {told}; apply one of {CONTROLS[0]} and {CONTROLS[1]}")
    stiffness, damping, bias = of.gain("kp"), of.gain("kd"), of.effort("constEffort")
    if laws[0] == "NewtonPIDControlAPI":
        return PID(stiffness, damping, of.gain("ki"), of.along("integralMax"), bias)
    return PID(stiffness, damping, 0.0, bias=bias) if bias else PD(stiffness, damping)


def _bounded(effort: float) -> list[Stage]:
    return [Saturation(effort)] if effort != math.inf else []


def _motor(stall: float, free: float, most: float) -> list[Stage]:
    if free != math.inf:
        return [DCMotor(stall, free, most)]
    return _bounded(min(stall, most))


__all__ = ["read_actuators"]
