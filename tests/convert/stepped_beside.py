#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Exported robots move like their assets, or the export says what it loses.

    stepped_beside.py ROOT TENON [COUNT]

COUNT published robots (4 without it), an even choice of the descriptions in build/robots
(tests/convert/ten_robots.py fetches them), are converted, half of them with gains, and moved for
2 s by weight and drives, without contacts: by `tenon sim` on MuJoCo; as MJCF that `tenon convert`
wrote, in MuJoCo of PyPI; and as URDF that it wrote, converted again. A body that ends up elsewhere
by more than 1e-6 (m, or parts of a turn) is a fault, unless a warning of the conversion names a
cause. Without limits of velocity, and with an integrator that the asset names, so that runs take no
drive otherwise than as an actuator, two of the causes are gone: then the robot moves alike, or as
far apart as numbers rounded to floats take it, which a run with as little more gravity tells.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
COUNT = int(sys.argv[3]) if len(sys.argv) > 3 else 4
ROBOTS = ROOT / "build/robots"
sys.path.insert(0, str(ROBOTS))

try:
    import mujoco
    import numpy as np
except ImportError as error:
    print(f"skipped: {error} (tests/convert/ten_robots.py fetches it)")
    sys.exit(77)

SECONDS, FRAMES = 2, 25  # frames of a second
CLOSE = 1e-6
ROUNDED = 2.0 ** -23  # of a float
# Beside limits of velocity and drives: what MuJoCo's compiler refuses.
OTHERWISE = "physics:diagonalInertia"
NAMING = ("mujoco.not-mapped", "urdf.left-out", "urdf.replaced")
FOLDERS = ("cmeel.prefix/share/example-robot-data/robots", "airo_models", "upkie_description")


class Fault(Exception):
    """What keeps a robot from being compared."""


def tenon(*words, fine=(0, 1)):
    done = subprocess.run([TENON, *map(str, words), "--json"], capture_output=True, text=True,
                          check=False)
    try:
        answer = json.loads(done.stdout)
    except json.JSONDecodeError:
        raise Fault(f"{words[0]}: {done.stderr[-300:]}") from None
    if done.returncode not in fine:
        raise Fault(f"{words[0]}: " + next((d["message"] for d in answer["diagnostics"]
                                            if d["severity"] == "error"), "failed"))
    return answer


def chosen():
    files = [path for folder in FOLDERS for path in sorted((ROBOTS / folder).rglob("*.urdf"))
             if "<link" in path.read_text(errors="replace")]
    return files[::max(1, len(files) // COUNT)][:COUNT]


def warnings_of(answer):
    return [d for d in answer["diagnostics"] if d["severity"] in ("warning", "error")]


class Motion:
    """Positions and orientations of bodies over the frames, by the name of the body."""

    def __init__(self, places, turns):
        self.places, self.turns = places, turns

    def apart(self, other):
        """-> the largest difference and the body that has it."""
        worst = (0.0, "")
        for name in self.places.keys() & other.places.keys():
            away = np.abs(self.places[name] - other.places[name]).max()
            # The same turn has two quaternions.
            a, b = self.turns[name], other.turns[name]
            turned = np.minimum(np.abs(a - b).max(axis=1), np.abs(a + b).max(axis=1)).max()
            worst = max(worst, (float(max(away, turned)), name))
        return worst


def by_tenon(asset, folder):
    """-> the motion and what the run said; bodies that share a name are skipped."""
    log = folder / "run.npz"
    answer = tenon("sim", asset, "--engine", "mujoco", "--duration", SECONDS, "--fps", FRAMES,
                   "-o", log)
    frames = np.load(log)
    names = [path.decode() if isinstance(path, bytes) else str(path)
             for path in frames["body_paths"]]
    short = [name.rsplit("/", 1)[-1] for name in names]
    alone = [i for i, name in enumerate(short) if short.count(name) == 1]
    return Motion({short[i]: frames["position"][:, i] for i in alone},
                  {short[i]: frames["orientation"][:, i] for i in alone}), answer


def by_mujoco(path, gravity=1.0):
    """The motion of a model in plain MuJoCo."""
    model = mujoco.MjModel.from_xml_path(str(path))
    model.opt.gravity *= gravity
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    names = {model.body(i).name: i for i in range(1, model.nbody)}
    places, turns = {name: [] for name in names}, {name: [] for name in names}
    steps = round(1 / FRAMES / model.opt.timestep)
    for frame in range(SECONDS * FRAMES + 1):
        if frame:
            mujoco.mj_step(model, data, steps)
        mujoco.mj_kinematics(model, data)
        for name, i in names.items():
            places[name].append(data.xpos[i].copy())
            turns[name].append(data.xquat[i].copy())
    return Motion({n: np.array(p) for n, p in places.items()},
                  {n: np.array(t) for n, t in turns.items()})


def without_shapes(source, copy):
    """The description of what moves alone: nothing touches, and no mesh is read."""
    text = source.read_text(encoding="utf-8", errors="replace")
    copy.write_text(re.sub(r"<(visual|collision)\b.*?</\1>", "", text, flags=re.DOTALL),
                    encoding="utf-8")
    return copy


SCENE = """
def PhysicsScene "SceneOfTest" (prepend apiSchemas = ["MjcSceneAPI"])
{
    uniform token mjc:option:integrator = "implicitfast"
}
"""


def without_choices(asset, copy):
    """A copy whose joints may be as fast as they become, and which names its integrator."""
    copy.write_text(re.sub(r"((?:velocityLimit|maxJointVelocity) = )\S+", r"\1inf",
                           asset.read_text()) + SCENE)
    left = [j["path"] for j in tenon("physics", copy)["joints"] if j["velocityLimit"]]
    if left:
        raise Fault(f"{left[0]} keeps its limit of velocity")
    return copy


class Robot:
    def __init__(self, source, gains, folder):
        self.source, self.folder = source, folder
        self.flags = ["--fix-base", *(["--gains", "50,5"] if gains else [])]
        self.name = source.relative_to(ROBOTS).as_posix().split("robots/")[-1] + (
            " with gains" if gains else "")
        self.asset = folder / "robot.usda"
        self.lines = []

    def run(self):
        """-> faults."""
        bare = without_shapes(self.source, self.folder / "source.urdf")
        tenon("convert", bare, self.asset, *self.flags)
        motion, _ = by_tenon(self.asset, self.folder)
        free = without_choices(self.asset, self.folder / "free.usda")
        free_motion, _ = by_tenon(free, self.folder)
        faults = []
        for kind, write in (("MJCF", self.as_mjcf), ("URDF", self.as_urdf)):
            faults += self.judge(kind, *write(self.asset), motion, "")
            faults += self.judge(kind, *write(free), free_motion, " without choices")
        return faults

    def as_mjcf(self, asset):
        path = self.folder / "robot.xml"
        path.unlink(missing_ok=True)
        answer = tenon("convert", asset, path)
        return by_mujoco(path), warnings_of(answer)

    def as_urdf(self, asset):
        path, back = self.folder / "robot.urdf", self.folder / "back.usda"
        path.unlink(missing_ok=True)
        back.unlink(missing_ok=True)
        answer = tenon("convert", asset, path)
        tenon("convert", path, back, *self.flags)
        if asset.name == "free.usda":
            back.write_text(back.read_text() + SCENE)  # no part of a robot's description
        return by_tenon(back, self.folder)[0], warnings_of(answer)

    def judge(self, kind, motion, named, own, which):
        apart, body = own.apart(motion)
        causes = [d for d in named if d["rule"] in NAMING]
        rules = sorted({f"[{d['rule']}] {d['message']}" for d in causes})
        self.lines.append(f"{kind}{which}: {apart:.2g} at {body}; {rules}")
        if len(own.places.keys() & motion.places.keys()) < len(own.places) / 2:
            return [f"{kind}{which}: less than half of the bodies have their names"]
        if which:
            causes = [d for d in causes if d["property"] == OTHERWISE]
        if apart <= CLOSE or causes:
            return []
        if kind == "MJCF":
            path = self.folder / "robot.xml"
            rounded, _ = by_mujoco(path).apart(by_mujoco(path, 1 + ROUNDED))
            self.lines.append(f"    rounding takes it {rounded:.2g} away")
            if apart <= 10 * rounded:
                return []
        return [f"{kind}{which}: {body} is {apart:.3g} apart, and no warning says why: {rules}"]


def main():
    faults, count = [], 0
    for number, source in enumerate(chosen()):
        for gains in (False, True) if COUNT > 4 else (bool(number % 2),):
            with tempfile.TemporaryDirectory() as folder:
                robot = Robot(source, gains, pathlib.Path(folder))
                try:
                    found = robot.run()
                except (Fault, ValueError) as error:
                    found = [f"not compared: {error}"]
            count += 1
            faults += [f"{robot.name}: {fault}" for fault in found]
            if os.environ.get("TENON_SHOW"):
                print(robot.name, *robot.lines, sep="\n    ", flush=True)
    for fault in faults:
        print(fault)
    print(f"{count} robots as MJCF and URDF, 2 s beside their assets: {len(faults)} differ")
    if count == 0:
        print("skipped: there are no published robots in build/robots")
        return 77
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
