#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Configurations for Isaac Lab and mjlab, loaded by the classes of these packages.

    ways_out_beside.py ROOT TENON

The robots are URDF files of packages in the Python that runs this (requirements-ways.txt), made
assets with gains. Isaac Lab and mjlab are as PyPI has them; torch, warp, Kit and all else that they
import are stand-ins, as only classes of configurations are used, and mujoco is itself. Each file
must load unedited; Isaac Lab validates its configuration, and its numbers are those of `tenon
physics`. mjlab finds the actuators of its model, which MuJoCo compiles, and gains, efforts,
armatures and ranges are those of the asset. Good when all robots of at least 50 do.
"""

import importlib.abc
import importlib.machinery
import importlib.util
import pathlib
import re
import runpy
import sys
import sysconfig
import tempfile
import types
from unittest import mock

import mujoco

sys.path[:0] = [str(pathlib.Path(__file__).parent)]

# pylint: disable=wrong-import-position
import ways_out
from ways_out import Places, expect, faults, near, tenon, wanted_motors

SITE = pathlib.Path(sysconfig.get_paths()["purelib"])
REAL = {"isaaclab", "mjlab", "mujoco", "numpy"}
LEAST = 50


class AnyClass(type):
    """A class whose members are classes of the same kind."""

    def __getattr__(cls, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return AnyClass(name, (), {})


class Absent(types.ModuleType):
    """A module that is not there: whatever is asked for exists, and does nothing."""

    def __getattr__(self, name):
        if name == "__version__":
            return "2.0"
        if name.startswith("__"):
            raise AttributeError(name)
        made = AnyClass(name, (), {
            "__init__": lambda self, *args, **names: None,
            "__class_getitem__": classmethod(lambda cls, item: cls),
        }) if name[0].isupper() else mock.MagicMock(name=name)
        setattr(self, name, made)
        return made


class StandIns(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Modules that nobody has."""

    def find_spec(self, name, path, target=None):
        if name.partition(".")[0] in REAL or name.startswith("_"):
            return None
        return importlib.machinery.ModuleSpec(name, self, is_package=True)

    def create_module(self, spec):
        return Absent(spec.name)

    def exec_module(self, module):
        module.__path__ = []


def configuration(file):
    [made] = [value for key, value in runpy.run_path(str(file)).items() if key.endswith("_CFG")]
    return made


def check_isaaclab(name, asset, work):
    file = work / "lab_cfg.py"
    code, answer = tenon("convert", asset, file, "--format", "isaaclab")
    if code:
        expect(f"{name}: Isaac Lab", False, answer["diagnostics"][-1])
        return
    made = configuration(file).replace(prim_path="/World/Robot")
    made.validate()
    found = {}
    for group in made.actuators.values():
        for joint in group.joint_names_expr:
            found[joint] = {"stiffness": group.stiffness, "damping": group.damping,
                            "effort": group.effort_limit_sim, "velocity": group.velocity_limit_sim,
                            "armature": group.armature, "friction": group.friction,
                            "passive": group.viscous_friction}
    for joint, row in wanted_motors(Places(asset)).items():
        for key, value in row.items():
            expect(f"{name}: Isaac Lab's {key} of {joint}",
                   near(found.get(joint, {}).get(key), value),
                   (found.get(joint, {}).get(key), value))


def check_mjlab(name, asset, work):
    """-> how many actuators."""
    file = work / "mjlab_cfg.py"
    code, answer = tenon("convert", asset, file, "--format", "mjlab")
    if code not in (0, 1):
        expect(f"{name}: mjlab", False, answer["diagnostics"][-1])
        return 0
    made = configuration(file)
    spec = made.spec_fn()
    names = [joint.name for joint in spec.joints]
    count = 0
    for row in made.articulation.actuators:
        hits = [one for one in names if any(re.fullmatch(p, one) for p in row.target_names_expr)]
        expect(f"{name}: joints of the model", len(hits) == len(row.target_names_expr), hits)
        actuator = row.build(None, list(range(len(hits))), hits)
        actuator.edit_spec(spec, hits)
        expect(f"{name}: all have actuators", len(actuator._target_names) == len(hits))
        count += len(hits)
    model = spec.compile()
    compare(name, model, wanted_motors(Places(asset)))
    return count


def compare(name, model, wanted):
    """Gains, efforts, armatures of a compiled model. Names of its joints may hold what names of
    prims cannot, and are compared without that."""
    plain = {re.sub(r"[^A-Za-z0-9_]", "_", model.joint(i).name): i for i in range(model.njnt)}
    of_joint = {model.actuator_trnid[i][0]: i for i in range(model.nu)}
    for joint, row in wanted.items():
        number = plain.get(joint)
        if number is None:
            expect(f"{name}: {joint} is in the model", False, sorted(plain)[:5])
            continue
        dof = model.jnt_dofadr[number]
        expect(f"{name}: armature of {joint}", near(model.dof_armature[dof], row["armature"]))
        expect(f"{name}: friction of {joint}", near(model.dof_frictionloss[dof], row["friction"]))
        actuator = of_joint.get(number)
        if row["stiffness"] or row["damping"]:
            expect(f"{name}: {joint} has an actuator", actuator is not None)
        if actuator is None or not row["stiffness"]:
            continue
        expect(f"{name}: stiffness of {joint}",
               near(-model.actuator_biasprm[actuator][1], row["stiffness"]))
        expect(f"{name}: damping of {joint}",
               near(-model.actuator_biasprm[actuator][2], row["damping"]))
        if row["effort"] is not None:
            expect(f"{name}: effort of {joint}",
                   near(model.actuator_forcerange[actuator][1], row["effort"]))


def main():
    sys.meta_path.append(StandIns())
    source = SITE / "isaaclab/source/isaaclab"  # where the package keeps its modules
    sys.path[:0] = [str(source)] if source.exists() else []
    done, actuators = 0, 0
    robots = [file for folder in ways_out.PACKAGES
              for file in sorted((SITE / folder).rglob("*.urdf"))]
    with tempfile.TemporaryDirectory() as folder:
        for number, robot in enumerate(robots):
            work = pathlib.Path(folder) / str(number)
            work.mkdir()
            asset = work / "asset.usda"
            code, _ = tenon("convert", robot, asset, "--gains", "20,2", "--armature", "0.01")
            if code not in (0, 1) or not Places(asset).scene["bodies"]:
                print(f"{robot.name}: no robot")
                continue
            before = len(faults)
            try:
                check_isaaclab(robot.name, asset, work)
                actuators += check_mjlab(robot.name, asset, work)
            except (TypeError, ValueError, AttributeError, KeyError) as error:
                expect(robot.name, False, f"{type(error).__name__}: {error}")
            done += len(faults) == before
            print(f"{robot.name}: {'as its asset' if len(faults) == before else 'WRONG'}",
                  flush=True)
    for fault in faults[:40]:
        print("FAULT", fault)
    print(f"{done} robots with {actuators} actuators are their assets in the classes of Isaac Lab "
          f"and mjlab; {len(faults)} faults")
    return 1 if faults or done < LEAST else 0


if __name__ == "__main__":
    sys.exit(main())
