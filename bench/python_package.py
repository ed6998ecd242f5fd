#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The Python package beside pxr, mujoco and the program, in one run: processor time, medians.

Usage: python_package.py [--rounds N] [--smoke]. Needs the environments of python/tests/install.sh;
exit 77 without them. A ratio below 1: the package takes less, of rates above 1: it makes more.
"""

import argparse
import glob
import json
import os
import statistics
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
WHEEL = os.path.join(ROOT, "build/wheel")
HAND = os.path.join(ROOT, "examples/inspire_hand/inspire_hand.usda")
GRASP = os.path.join(ROOT, "examples/inspire_hand/grasp.usda")

TIMED = """
import time
began = time.process_time()
{work}
print(time.process_time() - began)
"""
IMPORT = {"tenon": "import tenon_usd", "pxr": "from pxr import Usd, UsdPhysics"}
NUMPY = "\nimport numpy"  # which the package imports with the first array
OPEN = {"tenon": "stage = tenon_usd.open({path!r})", "pxr": "stage = Usd.Stage.Open({path!r})"}
PHYSICS = {
    "tenon": "scene = stage.physics()\nmass = sum(body.mass for body in scene.bodies)",
    "pxr": "found = UsdPhysics.LoadUsdPhysicsFromRange(stage, ['/'])",
}
# Every authored value of every prim.
VALUES = {
    "tenon": "n = sum(1 for prim in stage.prims for name in prim.authored\n"
             "        if prim[name] is not None)",
    "pxr": "n = sum(1 for prim in stage.Traverse() for name in prim.GetAuthoredPropertyNames()\n"
           "        if not prim.GetAttribute(name) or prim.GetAttribute(name).Get() is not None)",
}
# One value of every prim, each read back before the next is set.
EDIT = {
    "tenon": "prims = list(stage['/World'].children)\nfor prim in prims:\n"
             "    prim['size'] = 7.0\n    assert prim['size'] == 7.0",
    "pxr": "prims = stage.GetPrimAtPath('/World').GetChildren()\nfor prim in prims:\n"
           "    prim.GetAttribute('size').Set(7.0)\n"
           "    assert prim.GetAttribute('size').Get() == 7.0",
}
STEPS = """
import os, time
import tenon_usd
world = tenon_usd.World({path!r}, envs={envs}, physics="physics", threads=1)
began = time.process_time()
{loop}
print({envs} * {steps} / (time.process_time() - began))
"""
ROLLOUT = """
import time
import numpy as np
import mujoco
from mujoco import rollout
import tenon_usd
model = mujoco.MjModel.from_xml_string(
    tenon_usd.World({path!r}, physics="physics").to_mjcf())
data = mujoco.MjData(model)
kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
state = np.zeros(mujoco.mj_stateSize(model, kind))
mujoco.mj_getState(model, data, state, kind)
states = np.tile(state, ({envs}, 1))
began = time.process_time()
rollout.rollout(model, data, states, np.zeros(({envs}, {steps}, model.nu)))
print({envs} * {steps} / (time.process_time() - began))
"""
# Frames of vector environments: targets of the drives in, positions and velocities of joints out.
FRAMES = """
import time
import numpy as np
{envs_of}
envs.reset(seed=0)
actions = np.zeros(envs.action_space.shape, dtype=envs.action_space.dtype)
envs.step(actions)
began = time.process_time()
for _ in range({frames}):
    envs.step(actions)
print({envs} * {frames} / (time.process_time() - began))
"""
OWN_ENVS = """
from tenon_usd.gym import AssetVectorEnv
envs = AssetVectorEnv({path!r}, {envs}, frame_time=0.02, episode_time=1e9, threads=1,
                      physics="physics")
"""
# A robot of MJCF `model` for Gymnasium: `skip` steps a call, `fps` pictures a second.
HAND_OF_GYMNASIUM = """
from gymnasium import spaces
from gymnasium.envs.mujoco import MujocoEnv
from gymnasium.vector import SyncVectorEnv


class Hand(MujocoEnv):
    metadata = {"render_modes": ["human", "rgb_array", "depth_array", "rgbd_tuple"],
                "render_fps": fps}

    def __init__(self):
        super().__init__(model, skip, None)
        self.observation_space = spaces.Box(-np.inf, np.inf, self.observe().shape, np.float64)

    def observe(self):
        return np.concatenate([self.data.qpos, self.data.qvel])

    def step(self, action):
        self.do_simulation(action, self.frame_skip)
        return self.observe(), 0.0, False, False, {}

    def reset_model(self):
        self.set_state(self.init_qpos, self.init_qvel)
        return self.observe()

"""
# The same model, as Gymnasium has it: one MuJoCo for each environment, in one process.
GYMNASIUM_ENVS = """
import os, tempfile
os.environ["MUJOCO_GL"] = "disable"
import tenon_usd
folder = tempfile.TemporaryDirectory()
world = tenon_usd.World({path!r}, physics="physics")
world.to_mjcf(os.path.join(folder.name, "hand.xml"))
skip = max(1, round(0.02 / world.time_step))
fps = round(1 / (skip * world.time_step))
model = os.path.join(folder.name, "hand.xml")
{hand}
envs = SyncVectorEnv([Hand] * {envs})
"""


def many_prims(folder, count):
    path = os.path.join(folder, "many.usda")
    with open(path, "w", encoding="utf-8") as file:
        file.write('#usda 1.0\ndef Xform "World"\n{\n')
        for i in range(count):
            file.write(f'    def Cube "c{i}"\n    {{\n        double size = {i}\n'
                       f'        double3 xformOp:translate = ({i}, 0, 0)\n    }}\n')
        file.write("}\n")
    return path


def output(code):
    """What a program prints in the environment with the package and what is beside it."""
    packages = glob.glob(os.path.join(WHEEL, "clean/lib/python*/site-packages"))[0]
    done = subprocess.run([os.path.join(WHEEL, "beside/bin/python"), "-c", code], check=False,
                          capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": packages, "PXR_WORK_THREAD_LIMIT": "1"})
    if done.returncode:
        sys.exit(f"bench: {done.stderr}")
    return done.stdout


def run(code):
    return float(output(code).split()[-1])


def beside(name, ours, theirs, rounds, unit="ms", scale=1e3):
    """One row: both, in turns."""
    pairs = [(run(ours), run(theirs)) for _ in range(rounds)]
    own, other = (statistics.median(side) * scale for side in zip(*pairs))
    print(f"{name:52} {own:10.1f} {other:10.1f} {unit:12} {own / other:7.3f}", flush=True)


def reading_rows(path, rounds, what):
    def both(before, timed):
        return [before[lib].format(path=path) + TIMED.format(work=timed[lib].format(path=path))
                for lib in ("tenon", "pxr")]

    opened = {lib: IMPORT[lib] + "\n" + OPEN[lib] for lib in IMPORT}
    beside(f"open, {what}", *both(IMPORT, OPEN), rounds)
    beside(f"read its physics, {what}", *both(opened, PHYSICS), rounds)
    ready = {lib: code + NUMPY for lib, code in opened.items()}
    beside(f"every authored value, {what}", *both(ready, VALUES), rounds)
    everything = {lib: "\n".join((IMPORT[lib], OPEN[lib], PHYSICS[lib])) for lib in IMPORT}
    beside(f"import, open and read the physics, {what}",
           *[TIMED.format(work=everything[lib].format(path=path)) for lib in ("tenon", "pxr")],
           rounds)


def editing_row(path, rounds, edits):
    ours, theirs = ["\n".join((IMPORT[lib] + NUMPY, OPEN[lib].format(path=path),
                               TIMED.format(work=EDIT[lib]))) for lib in ("tenon", "pxr")]
    beside(f"{edits} values set one by one", ours, theirs, rounds)


def program_rate(envs, steps, time_step):
    done = subprocess.run(
        [os.path.join(WHEEL, "clean/bin/tenon"), "bench", HAND, "--physics", "physics", "--envs",
         str(envs), "--duration", repr(steps * time_step), "-j", "1", "--json"],
        capture_output=True, text=True, check=True)
    return json.loads(done.stdout)["stepsPerCpuSecond"]


def stepping_rows(envs, steps, rounds):
    step = STEPS.format(path=HAND, envs=envs, steps=steps, loop=f"world.step({steps})")
    single = STEPS.format(path=HAND, envs=envs, steps=steps,
                          loop=f"for _ in range({steps}): world.step()")
    read = STEPS.format(
        path=HAND, envs=envs, steps=steps,
        loop=f"for _ in range({steps}):\n    world.step()\n    world.joints()\n"
             "    world.body_poses")
    plain = ROLLOUT.format(path=HAND, envs=envs, steps=steps)
    time_step = run(f"import tenon_usd\nprint(tenon_usd.World({HAND!r}).time_step)")
    rates = {name: [] for name in ("all", "one", "read", "program", "rollout")}
    for _ in range(rounds):
        rates["all"].append(run(step))
        rates["program"].append(program_rate(envs, steps, time_step))
        rates["one"].append(run(single))
        rates["read"].append(run(read))
        rates["rollout"].append(run(plain))
    rate = {name: statistics.median(values) for name, values in rates.items()}
    for name, own, other in (
            (f"{envs} environments, all steps in one call : program", "all", "program"),
            ("  one call for each step : program", "one", "program"),
            ("  joints and poses read at each step : program", "read", "program"),
            ("  all steps in one call : mujoco.rollout", "all", "rollout")):
        print(f"{name:52} {rate[own] / 1e3:10.1f} {rate[other] / 1e3:10.1f} {'k steps/cpu s':12} "
              f"{rate[own] / rate[other]:7.3f}", flush=True)


def learning_row(envs, frames, rounds):
    rates = []
    for _ in range(rounds):
        made = [code.format(path=HAND, envs=envs, hand=HAND_OF_GYMNASIUM)
                for code in (OWN_ENVS, GYMNASIUM_ENVS)]
        rates.append([run(FRAMES.format(envs_of=text, envs=envs, frames=frames)) for text in made])
    own, other = (statistics.median(side) for side in zip(*rates))
    name = f"{envs} environments, frames of 0.02 s : Gymnasium's MuJoCo"
    print(f"{name:52} {own / 1e3:10.1f} {other / 1e3:10.1f} {'k frames/cpu s':12} "
          f"{own / other:7.3f}", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--smoke", action="store_true", help="once, small")
    options = parser.parse_args()
    if not os.path.exists(os.path.join(WHEEL, "beside/bin/python")):
        print("skipped: no package (python/tests/install.sh)")
        return 77
    rounds, prims, steps = (1, 100, 20) if options.smoke else (options.rounds, 20000, 1000)
    edits = 100 if options.smoke else 6400
    print(f"{'':52} {'package':>10} {'other':>10} {'':12} {'ratio':>7}")
    beside("import", TIMED.format(work=IMPORT["tenon"]), TIMED.format(work=IMPORT["pxr"]), rounds)
    reading_rows(HAND, rounds, "the hand")
    with tempfile.TemporaryDirectory() as folder:
        reading_rows(many_prims(folder, prims), rounds, f"{prims} prims")
        editing_row(many_prims(folder, edits), rounds, edits)
    stepping_rows(64, steps, rounds)
    learning_row(64, max(1, steps // 10), rounds)
    return 0


if __name__ == "__main__":
    sys.exit(main())
