# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A layer over an asset with identified numbers, in the schemas of UsdPhysics, Newton, PhysX and
MuJoCo and their units. The asset's own files stay as they are; the layer is opened in its place.

What was written is read back under every variant of "Physics" before it is handed on.
"""

from __future__ import annotations

import contextlib
import dataclasses
import math
import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from .. import _tenon
from ..errors import Error, FileError
from ..functions import open as open_stage
from .log import Array
from .moments import axes_of, inertia_of_moments
from .parameters import Parameter

#: Floats of the schemas keep this part of a number.
READ_BACK = 2e-6
#: Counts in place of physics:diagonalInertia where it is authored: xx, yy, zz, xy, xz, yz.
_NEWTON = "newton:inertia"
_API_OF = {"physics:diagonalInertia": "PhysicsMassAPI", _NEWTON: "NewtonMassAPI"}
#: What is not a number of the asset, with the reason.
NOT_WRITTEN = {
    "delay": "no schema of drives has it; tenon_usd.actuators.Delay simulates it",
    "offset": "it belongs to the encoder; correct it where the robot is calibrated",
    "effortScale": "it belongs to the sensor of the log",
    "stribeck": "no schema has friction that is larger at rest",
    "stribeckSpeed": "no schema has friction that is larger at rest",
    "contactFriction": "shapes share materials; set physics:dynamicFriction of the material",
}


@dataclasses.dataclass(frozen=True)
class Opinion:
    """One attribute of the layer, in the units of the stage."""

    prim: str
    api: str
    name: str
    type: str
    value: float | tuple[float, ...]


@dataclasses.dataclass(frozen=True)
class Overlay:
    """`text` is the layer, `opinions` what it says; `left` the parameters that no schema has, with
    the reason; `variants` those under which the numbers were read back."""

    text: str
    opinions: tuple[Opinion, ...]
    left: tuple[tuple[Parameter, str], ...]
    variants: tuple[str, ...]


@dataclasses.dataclass(frozen=True)
class _Units:
    """What a unit of the stage is in SI."""

    length: float
    mass: float

    def torque(self, angular: bool) -> float:
        return self.mass * self.length ** (2 if angular else 1)

    def rate(self, angular: bool) -> float:
        """Of gains: a force for a length, or a torque for a radian."""
        return self.mass * (self.length ** 2 if angular else 1)


def _number(value: Any, otherwise: float) -> float:
    return float(value) if isinstance(value, (int, float)) else otherwise


def _joint_opinions(family: str, path: str, value: float, angular: bool, units: _Units
                    ) -> list[Opinion]:
    """Friction, damping and armature: Newton's, PhysX's and MuJoCo's attributes."""
    kind = "angular" if angular else "linear"
    axis, prefix = f"PhysxJointAxisAPI:{kind}", f"physxJointAxis:{kind}:"
    turn = math.pi / 180 if angular else 1.0
    if family == "friction":
        own = value / units.torque(angular)
        return [Opinion(path, "NewtonJointAPI", "newton:friction", "float", own),
                Opinion(path, axis, prefix + "staticFrictionEffort", "float", own),
                Opinion(path, axis, prefix + "dynamicFrictionEffort", "float", own),
                Opinion(path, "MjcJointAPI", "mjc:frictionloss", "double", own)]
    own = value / units.rate(angular)
    if family == "armature":
        return [Opinion(path, "NewtonJointAPI", "newton:armature", "float", own),
                Opinion(path, axis, prefix + "armature", "float", own),
                Opinion(path, "MjcJointAPI", "mjc:armature", "double", own)]
    return [Opinion(path, "NewtonJointAPI", "newton:damping", "float", own * turn),
            Opinion(path, axis, prefix + "viscousFrictionCoefficient", "float", own * turn),
            Opinion(path, "MjcJointAPI", "mjc:damping", "double", own)]


def _drive_opinions(family: str, path: str, value: float, dof: str, units: _Units, acceleration:
                    bool) -> list[Opinion]:
    """Gains and the largest effort of UsdPhysics' drive."""
    angular = dof.startswith("rot")
    name = {"stiffness": "stiffness", "driveDamping": "damping", "maxForce": "maxForce"}[family]
    if family == "maxForce":
        own = value / units.torque(angular)
    else:
        gain = 1.0 if acceleration else units.rate(angular)
        own = value / gain * (math.pi / 180 if angular else 1.0)
    instance = "angular" if angular else "linear"
    return [Opinion(path, f"PhysicsDriveAPI:{instance}", f"drive:{instance}:physics:{name}",
                    "float", own)]


def _actuator_opinions(stage: _tenon.Stage, source: str, path: str,
                       values: dict[tuple[str, str], float], angular: bool, units: _Units
                       ) -> list[Opinion]:
    """The same of an actuator of MuJoCo, which replaces the drive: force = gain ctrl + b0 + b1 l +
    b2 l', with l = gear q."""
    prim = stage[source]
    gear = float(np.asarray(prim.get("mjc:gear")).reshape(-1)[0])
    unit = gear * gear * units.rate(angular)
    gain = np.array(prim.get("mjc:gainPrm"), dtype=np.float64)
    bias = np.array(prim.get("mjc:biasPrm"), dtype=np.float64)
    made: list[Opinion] = []
    stiffness = values.get(("stiffness", path))
    damping = values.get(("driveDamping", path))
    if stiffness is not None and bias[1] != 0:
        ratio = stiffness / unit / -bias[1]
        gain[0] *= ratio
        bias[:2] *= ratio
    if damping is not None:
        bias[2] = -damping / unit
    if stiffness is not None or damping is not None:
        made += [Opinion(source, "", "mjc:gainPrm", "double[]", tuple(map(float, gain))),
                 Opinion(source, "", "mjc:biasPrm", "double[]", tuple(map(float, bias)))]
    most = values.get(("maxForce", path))
    if most is not None:
        own = most / abs(gear) / units.torque(angular)
        made += [Opinion(source, "", "mjc:forceRange:min", "double", -own),
                 Opinion(source, "", "mjc:forceRange:max", "double", own)]
    return made


def _mass_opinions(stage: _tenon.Stage, path: str, value: float, was: float, units: _Units
                   ) -> list[Opinion]:
    """Mass, and inertia with it, as engines change both."""
    made = [Opinion(path, "PhysicsMassAPI", "physics:mass", "float", value / units.mass)]
    prim = stage[path]
    for name, kind in (("physics:diagonalInertia", "float3"), (_NEWTON, "double[]")):
        inertia = np.asarray(prim.get(name) if name in prim.authored else [], dtype=np.float64)
        if inertia.any():
            made.append(Opinion(path, _API_OF[name], name, kind,
                                tuple(map(float, inertia * value / was))))
    return made


def _limit_opinions(path: str, value: float, angular: bool, units: _Units) -> list[Opinion]:
    kind = "angular" if angular else "linear"
    own = math.degrees(value) if angular else value / units.length
    return [Opinion(path, "NewtonJointAPI", "newton:velocityLimit", "float", own),
            Opinion(path, f"PhysxJointAxisAPI:{kind}",
                    f"physxJointAxis:{kind}:maxJointVelocity", "float", own)]


def _mimic_opinions(prim: Any, path: str, value: float, angular: tuple[bool, bool], units: _Units
                    ) -> list[Opinion]:
    """Of the law that the joint has: PhysX's, q + gearing leader + offset = 0, or Newton's, with
    MuJoCo's old name. `angular`: the follower, the leader."""
    own, lead = (math.pi / 180 if each else units.length for each in angular)
    ratio = value * lead / own
    made = []
    for name in prim.authored:
        if name == "newton:mimicCoef1":
            made.append(Opinion(path, "", name, "float", ratio))
        elif name == "mjc:coef1":
            made.append(Opinion(path, "", name, "double", ratio))
        elif name.startswith("physxMimicJoint:") and name.endswith(":gearing"):
            made.append(Opinion(path, "", name, "float", -ratio))
    return made or [Opinion(path, "NewtonMimicAPI", "newton:mimicCoef1", "float", ratio)]


def _of_bodies(scene: Any, wanted: dict[tuple[str, str], float]
               ) -> dict[tuple[str, str], Array]:
    """Centres of mass (3,) and inertias (3, 3) of bodies that have numbers of `wanted`, the others
    of them as in the scene: by path and what was identified, "centerOfMass", "secondMoment" or
    "mass", with which inertia changes."""
    made: dict[tuple[str, str], Array] = {}
    for body in scene.bodies:
        own, inertia = (np.array(each, dtype=np.float64)
                        for each in (body.center_of_mass, body.inertia))
        axes, moments = axes_of(inertia)
        for kind, numbers in (("centerOfMass", own), ("secondMoment", moments)):
            for at, axis in enumerate("XYZ"):
                if (kind + axis, body.path) in wanted:
                    numbers[at] = wanted[kind + axis, body.path]
                    made[body.path, kind] = numbers
        if (body.path, "secondMoment") in made:
            made[body.path, "secondMoment"] = inertia_of_moments(axes, moments)
        elif ("mass", body.path) in wanted:
            made[body.path, "mass"] = inertia * (wanted["mass", body.path] / body.mass)
    return made


def _body_opinions(stage: _tenon.Stage, of: tuple[str, str], value: Array, units: _Units
                   ) -> list[Opinion]:
    path, kind = of
    if kind == "mass":
        return []  # _mass_opinions()
    if kind == "centerOfMass":
        return [Opinion(path, "PhysicsMassAPI", "physics:centerOfMass", "point3f",
                        tuple(map(float, value / units.length)))]
    own = value / (units.mass * units.length ** 2)
    axes, moments = axes_of(own)
    made = [Opinion(path, "PhysicsMassAPI", "physics:diagonalInertia", "float3",
                    tuple(map(float, moments.sum() - moments))),
            Opinion(path, "PhysicsMassAPI", "physics:principalAxes", "quatf", _quaternion(axes))]
    if _NEWTON in stage[path].authored:
        six = tuple(float(own[at]) for at in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))
        made.append(Opinion(path, _API_OF[_NEWTON], _NEWTON, "double[]", six))
    return made


def _quaternion(axes: Array) -> tuple[float, ...]:
    """Of a rotation: w, x, y, z (Bar-Itzhack 2000)."""
    twist = [axes[2, 1] - axes[1, 2], axes[0, 2] - axes[2, 0], axes[1, 0] - axes[0, 1]]
    matrix = np.empty((4, 4))
    matrix[:3, :3] = axes + axes.T - np.trace(axes) * np.eye(3)
    matrix[3, :3] = matrix[:3, 3] = twist
    matrix[3, 3] = np.trace(axes)
    x, y, z, w = np.linalg.eigh(matrix)[1][:, 3]
    return tuple(float(each) * (-1 if w < 0 else 1) for each in (w, x, y, z))


def make_overlay(asset: str, output: str, parameters: Sequence[Parameter], values: Array
                 ) -> Overlay:
    """The layer for `output`, over `asset`. Raises errors of tenon_usd.errors: InvalidError where
    a variant of the asset would not take a number."""
    stage = open_stage(asset)
    units = _Units(_number(stage.metadata("metersPerUnit"), 0.01),
                   _number(stage.metadata("kilogramsPerUnit"), 1.0))
    wanted = {(each.family, path): share * float(value)
              for each, value in zip(parameters, values) for path, share in each.parts}
    left = [(each, NOT_WRITTEN[each.family]) for each in parameters if each.family in NOT_WRITTEN]
    opinions: dict[tuple[str, str], Opinion] = {}

    def add(made: list[Opinion]) -> None:
        opinions.update({(each.prim, each.name): each for each in made})

    variants = _variants(stage)
    scene = stage.physics()
    joints, bodies = ({each.path: each for each in scene.joints},
                      {each.path: each for each in scene.bodies})
    for (family, path), value in wanted.items():
        if family in ("friction", "damping", "armature"):
            add(_joint_opinions(family, path, value, joints[path].type != "prismatic", units))
        elif family in ("stiffness", "driveDamping", "maxForce"):
            drive = joints[path].drives[0]
            add(_drive_opinions(family, path, value, drive.dof, units, bool(drive.type)))
        elif family == "velocityLimit":
            add(_limit_opinions(path, value, joints[path].type != "prismatic", units))
        elif family == "mass":
            add(_mass_opinions(stage, path, value, bodies[path].mass, units))
    for of, numbers in _of_bodies(scene, wanted).items():
        add(_body_opinions(stage, of, numbers, units))
    for variant in variants or [""]:
        _add_mimics(_opened(asset, variant), wanted, units, add)
        _add_actuators(asset, variant, wanted, units, add)
    made = list(opinions.values())
    text = _text(stage, asset, output, made)
    _read_back(text, asset, output, variants, wanted)
    return Overlay(text, tuple(made), tuple(left), tuple(variants))


def _variants(stage: _tenon.Stage) -> list[str]:
    """Those of "Physics" that have any."""
    prim = stage.default_prim
    if prim is None:
        return []
    return [each for each in prim.variants.get("Physics", ("", []))[1] if each != "none"]


def _opened(asset: str, variant: str) -> _tenon.Stage:
    return open_stage(asset, physics=variant) if variant else open_stage(asset)


def _add_mimics(stage: _tenon.Stage, wanted: dict[tuple[str, str], float], units: _Units, add: Any
                ) -> None:
    for joint in stage.physics().joints:
        value = wanted.get(("mimicRatio", joint.path))
        for mimic in joint.mimics[:1] if value is not None else ():
            assert value is not None
            turns = (mimic.dof.startswith("rot"), mimic.leader_dof.startswith("rot"))
            add(_mimic_opinions(stage[joint.path], joint.path, value, turns, units))


def _add_actuators(asset: str, variant: str, wanted: dict[tuple[str, str], float], units: _Units,
                   add: Any) -> None:
    stage = _opened(asset, variant)
    for joint in stage.physics().joints:
        for drive in joint.drives[:1]:
            named = any(path == joint.path for _, path in wanted)
            if named and drive.source != joint.path and stage[drive.source].type_name in (
                    "MjcActuator",):
                add(_actuator_opinions(stage, drive.source, joint.path, wanted,
                                       drive.dof.startswith("rot"), units))


# ---- as text


def _text(stage: _tenon.Stage, asset: str, output: str, opinions: list[Opinion]) -> str:
    inside = os.path.relpath(os.path.abspath(asset), os.path.dirname(os.path.abspath(output)))
    inside = inside if inside.startswith(".") else "./" + inside
    lines = ["#usda 1.0", "("]
    prim = stage.default_prim
    if prim is not None:
        lines.append(f'    defaultPrim = "{prim.name}"')
    lines.append('    doc = "Numbers that were identified from a log (tenon identify)."')
    for name in ("kilogramsPerUnit", "metersPerUnit", "timeCodesPerSecond"):
        value = stage.metadata(name)
        if isinstance(value, (int, float)):
            lines.append(f"    {name} = {value!r}")
    lines.append(f"    subLayers = [@{inside}@]")
    axis = stage.metadata("upAxis")
    if isinstance(axis, str):
        lines.append(f'    upAxis = "{axis}"')
    lines += [")", ""]
    by_prim: dict[str, list[Opinion]] = {}
    for opinion in opinions:
        by_prim.setdefault(opinion.prim, []).append(opinion)
    tree: dict[str, Any] = {}
    for path in by_prim:
        at = tree
        for part in path.strip("/").split("/"):
            at = at.setdefault(part, {})
    _write_prims(tree, "", by_prim, lines, "")
    return "\n".join(lines) + "\n"


def _write_prims(tree: dict[str, Any], above: str, by_prim: dict[str, list[Opinion]],
                 lines: list[str], indent: str) -> None:
    for name in sorted(tree):  # depth is that of the asset, which tenon has bounded
        path = f"{above}/{name}"
        own = by_prim.get(path, [])
        apis = sorted({each.api for each in own if each.api})
        if apis:
            lines.append(f'{indent}over "{name}" (')
            told = ", ".join(f'"{api}"' for api in apis)
            lines += [f"{indent}    prepend apiSchemas = [{told}]", f"{indent})"]
        else:
            lines.append(f'{indent}over "{name}"')
        lines.append(f"{indent}{{")
        for each in sorted(own, key=lambda opinion: opinion.name):
            lines.append(f"{indent}    {_uniform(each)}{each.type} {each.name} = {_said(each)}")
        _write_prims(tree[name], path, by_prim, lines, indent + "    ")
        lines.append(f"{indent}}}")


def _uniform(opinion: Opinion) -> str:
    return "uniform " if opinion.name.startswith("mjc:") else ""


def _said(opinion: Opinion) -> str:
    value = opinion.value
    if isinstance(value, tuple):
        told = ", ".join(repr(each) for each in value)
        return f"[{told}]" if opinion.type.endswith("[]") else f"({told})"
    return repr(float(np.float32(value))) if opinion.type == "float" else repr(value)


# ---- read back


def _read_back(text: str, asset: str, output: str, variants: list[str],
               wanted: dict[tuple[str, str], float]) -> None:
    """Opens the layer as it would be in its place and compares. Raises InvalidError."""
    described = _of_bodies(open_stage(asset).physics(), wanted)
    folder = tempfile.mkdtemp(prefix="tenon-identify-")
    try:
        path = os.path.join(folder, "overlay.usda")
        inside = os.path.relpath(os.path.abspath(asset), os.path.dirname(os.path.abspath(output)))
        inside = inside if inside.startswith(".") else "./" + inside
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace(f"@{inside}@", f"@{os.path.abspath(asset)}@", 1))
        for variant in variants or [""]:
            scene = _opened(path, variant).physics()
            for (family, of), value in wanted.items():
                found = _found(scene, family, of)
                if found is not None and abs(found - value) > READ_BACK * max(abs(value), 1e-12):
                    raise Error(
                        f"{family} of {of} is {found:g} under the variant {variant or 'none'}, "
                        f"not the identified {value:g}: another layer of the asset is stronger")
            bodies = {body.path: body for body in scene.bodies}
            for (of, family), numbers in described.items():
                body = bodies[of]
                own = np.asarray(body.center_of_mass if family == "centerOfMass"
                                 else body.inertia)
                if np.abs(own - numbers).max() > READ_BACK * max(np.abs(numbers).max(), 1e-12):
                    what = "the centre of mass" if family == "centerOfMass" else "the inertia"
                    raise Error(f"{what} of {of} is {own.tolist()}, not the identified "
                                f"{numbers.tolist()}: another layer of the asset is stronger, or "
                                "the prim is scaled")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _found(scene: Any, family: str, path: str) -> float | None:
    if family in ("friction", "damping", "armature"):
        return next((float(getattr(joint, family)) for joint in scene.joints
                     if joint.path == path), None)
    if family in ("stiffness", "driveDamping", "maxForce"):
        name = {"driveDamping": "damping", "maxForce": "max_force"}.get(family, family)
        return next((float(getattr(joint.drives[0], name)) for joint in scene.joints
                     if joint.path == path and len(joint.drives)), None)
    if family == "velocityLimit":
        return next((float(joint.velocity_limit) for joint in scene.joints
                     if joint.path == path), None)
    if family == "mimicRatio":
        return next((float(joint.mimics[0].multiplier) for joint in scene.joints
                     if joint.path == path and len(joint.mimics)), None)
    if family == "mass":
        return next((float(body.mass) for body in scene.bodies if body.path == path), None)
    return None


@contextlib.contextmanager
def temporary_overlay(asset: str, parameters: Sequence[Parameter], values: Array) -> Iterator[str]:
    """The path of a layer over the asset, which goes at the end of the block. Raises as
    make_overlay()."""
    folder = tempfile.mkdtemp(prefix="tenon-identify-")
    try:
        path = os.path.join(folder, "overlay.usda")
        made = make_overlay(os.path.abspath(asset), path, parameters, values)
        with open(path, "w", encoding="utf-8") as file:
            file.write(made.text)
        yield path
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def write_overlay(overlay: Overlay, output: str, asset: str, replace: bool = False) -> None:
    """Writes the layer. Raises FileError where the file is there, unless `replace`, and where it is
    the asset itself."""
    if os.path.exists(output):
        if os.path.samefile(output, asset):
            raise FileError(f"{output} is the asset itself; name another file")
        if not replace:
            raise FileError(f"{output} is there; name another file, or give --force")
    _tenon.write_files(output, overlay.text.encode(), {})
