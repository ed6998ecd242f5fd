#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A model's actuators and keyframes through USD and back: the same forces in the same states.

    actuators_round_trip.py ROOT TENON

MuJoCo's reader is that of tests/robot_requirements.txt; without it the test skips.
"""

import functools
import sys

import round_trip
from round_trip import ROOT, faults, mujoco, numpy, run

ROUNDING = 2e-7  # relative, of the floats that USD has
FIELDS = ("trntype", "gaintype", "biastype", "dyntype", "gear", "gainprm", "biasprm", "dynprm",
          "forcelimited", "forcerange", "actlimited", "actrange")
FOLDED = {"lean_servo"}  # a servo whose gear went into its gains on the way in
OF_CONTROLS = ("ctrllimited", "ctrlrange")
near = functools.partial(round_trip.near, rounding=ROUNDING)


def by_name(model, kind, count):
    """Numbers of things by name."""
    return {mujoco.mj_id2name(model, kind, i) or str(i): i for i in range(count)}


def compare_actuators(before, after):
    """All have their names and their numbers, be they drives of joints or not."""
    kind = mujoco.mjtObj.mjOBJ_ACTUATOR
    old, new = (by_name(model, kind, model.actuator_gear.shape[0]) for model in (before, after))
    if set(new) != set(old):
        faults.append(f"actuators: {sorted(new)}, before {sorted(old)}")
        return
    for name in set(old) - FOLDED:
        for field in FIELDS:
            near(f"{name}.{field}", getattr(after, f"actuator_{field}")[new[name]],
                 getattr(before, f"actuator_{field}")[old[name]])
        for field in OF_CONTROLS:
            found, wanted = (getattr(model, f"actuator_{field}")[model.actuator_ctrladr[i]]
                             for model, i in ((after, new[name]), (before, old[name])))
            near(f"{name}.{field}", found, wanted)


def state(model, key):
    """Centres of mass and their velocities by body, efforts by joint that is not free."""
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, key)
    mujoco.mj_forward(model, data)
    result = {}
    for name, body in by_name(model, mujoco.mjtObj.mjOBJ_BODY, model.nbody).items():
        velocity = numpy.zeros(6)
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, body, velocity, 0)
        result[f"body {name}"] = [*data.xipos[body], *velocity]
    for name, joint in by_name(model, mujoco.mjtObj.mjOBJ_JOINT, model.njnt).items():
        kind = model.jnt_type[joint]
        if kind != mujoco.mjtJoint.mjJNT_FREE:
            first = model.jnt_dofadr[joint]
            count = 3 if kind == mujoco.mjtJoint.mjJNT_BALL else 1
            result[f"joint {name}"] = data.qfrc_actuator[first:first + count]
    return result


def compare_keys(before, after):
    old, new = (by_name(model, mujoco.mjtObj.mjOBJ_KEY, model.nkey) for model in (before, after))
    if set(old) != set(new):
        faults.append(f"keyframes: {sorted(new)}, before {sorted(old)}")
        return
    for name, key in old.items():
        wanted, found = state(before, key), state(after, new[name])
        for part, numbers in wanted.items():
            if part in found:
                near(f"{name}: {part}", found[part], numbers)
            elif part.startswith("joint"):
                faults.append(f"{name}: {part} is gone")


def check_own(work):
    source = ROOT / "tests/convert/mjcf/actuators.xml"
    run("convert", source, f"{work}/package/")
    run("convert", source, work / "plain.usda")
    before = mujoco.MjModel.from_xml_path(str(source))
    for name, asset in (("a", "package/crane.usda"), ("b", "plain.usda")):
        back = work / f"{name}.xml"
        round_trip.without_source(work / asset.replace("crane.usda", "payloads/base.usda"))
        answer = run("convert", work / asset, back, "--physics", "mujoco")
        for finding in answer["diagnostics"]:
            if finding["rule"] in ("mjcf.left-out", "actuator.target-missing"):
                faults.append(f"{asset}: {finding}")
        after = mujoco.MjModel.from_xml_path(str(back))
        compare_actuators(before, after)
        compare_keys(before, after)


def check_left_out(work):
    """What cannot be said is listed with its prim."""
    text = (work / "plain.usda").read_text()
    broken = text.replace("mjc:qvel = [0.1, ", "mjc:qvel = [", 1)
    broken = broken.replace("rel mjc:target = </crane/Physics/rope>",
                            "rel mjc:target = </crane/Physics/nothing>", 1)
    (work / "broken.usda").write_text(broken)
    answer = run("convert", work / "broken.usda", work / "broken.xml")
    said = sorted((finding["prim"], finding["property"]) for finding in answer["diagnostics"]
                  if finding["rule"] == "mjcf.left-out")
    if said != [("/crane/Physics/up", "mjc:qvel"), ("/crane/Physics/winch", "mjc:target")]:
        faults.append(f"listed: {said}")


def check_published(work):
    source = ROOT / "build/robots/dm_control/suite/humanoid.xml"
    if not source.exists():
        print("no published model")
        return
    run("convert", source, work / "humanoid.usda")
    round_trip.without_source(work / "humanoid.usda")
    run("convert", work / "humanoid.usda", work / "humanoid.xml")
    before = mujoco.MjModel.from_xml_path(str(source))
    after = mujoco.MjModel.from_xml_path(str(work / "humanoid.xml"))
    compare_actuators(before, after)
    compare_keys(before, after)


if __name__ == "__main__":
    sys.exit(round_trip.main(check_own, check_left_out, check_published))
