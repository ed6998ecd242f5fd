#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Many hands in one process: the Python package beside mujoco.rollout and Gymnasium, in one run.

Usage: vector_environments.py [PAGE] [--rounds N] [--smoke]. PAGE gets the table. Needs the
environments of python/tests/install.sh; exit 77 without them. Each figure is of a process of its
own with one thread, in turns; the medians count. All step the model that tenon makes of the
example hand, for rollout and Gymnasium as MJCF without the shapes that touch nothing. Exit 1 where
`World.step()` on MuJoCo takes more processor time than rollout.
"""

import argparse
import datetime
import json
import os
import statistics
import sys
import tempfile

import python_package

COUNTS = (1, 16, 64, 256, 1024)
# Of all environments together, in each process.
STEPS = {"mujoco": 20_000, "rollout": 20_000, "envs": 20_000, "gymnasium": 20_000, "physx": 5_000,
         "jolt": 5_000}
SMOKE_STEPS = 40
LEAST = 1.0  # times the steps of mujoco.rollout
MEASURED = """
import json, resource, sys, time
{made}
step()
start = time.process_time()
begun = time.process_time()
for _ in range({calls}):
    step()
spent = time.process_time() - begun
print(json.dumps({{"start": start, "rate": {count} * {calls} * {each} / spent,
                   "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024}}))
"""
WORLD = """
import tenon_usd
world = tenon_usd.World({hand!r}, envs={count}, engine={engine!r}, physics="physics", threads=1)
step = world.step
"""
ROLLOUT = """
import mujoco
import numpy as np
from mujoco import rollout
model = mujoco.MjModel.from_xml_path({model!r})
data = mujoco.MjData(model)
kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
state = np.zeros(mujoco.mj_stateSize(model, kind))
mujoco.mj_getState(model, data, state, kind)
states = np.tile(state, ({count}, 1))
out = np.zeros(({count}, 1, state.size))
runner = rollout.Rollout(nthread=1)

def step():
    global states
    runner.rollout(model, [data], states, nstep=1, state=out)
    states = np.ascontiguousarray(out[:, 0])
"""
FRAMES = """
import numpy as np
{envs_of}
envs.reset(seed=0)
actions = np.zeros(envs.action_space.shape, dtype=envs.action_space.dtype)

def step():
    envs.step(actions)
"""
OWN_ENVS = """
from tenon_usd.gym import AssetVectorEnv
envs = AssetVectorEnv({hand!r}, {count}, frame_time={frame!r}, episode_time=1e9, threads=1,
                      engine="mujoco", physics="physics")
"""
# One MuJoCo for each environment, in one process.
GYMNASIUM = """
import os
os.environ["MUJOCO_GL"] = "disable"
model, skip, fps = {model!r}, {each}, {fps}
{gym_hand}
envs = SyncVectorEnv([Hand] * {count})
"""
MODEL = """
import mujoco
import tenon_usd
world = tenon_usd.World({hand!r}, engine="mujoco", physics="physics")
spec = mujoco.MjSpec.from_string(world.to_mjcf())
for geom in list(spec.geoms):
    if geom.contype == 0 and geom.conaffinity == 0:
        spec.delete(geom)
spec.compile()
with open({model!r}, "w", encoding="utf-8") as file:
    file.write(spec.to_xml())
print(world.time_step)
"""
NAMES = {"mujoco": "`World.step()`, MuJoCo", "rollout": "`mujoco.rollout`, `nstep=1`",
         "physx": "`World.step()`, PhysX", "jolt": "`World.step()`, Jolt",
         "envs": "`AssetVectorEnv`", "gymnasium": "Gymnasium's `MujocoEnv`, `SyncVectorEnv`"}
PAGE = """# Many environments beside others

`bench/vector_environments.py`, {date}, one thread of a shared x86-64 machine with Python {python}:
the example hand, {rounds} processes for each figure, in turns, medians. All others step the model
that tenon makes of it, without the shapes that touch nothing. Worlds and `mujoco.rollout` are
called for each single step; vector environments for frames of 0.02 s ({each} steps), with targets
in and positions and velocities of joints out.

- `steps`: of one environment, by second of processor time
- `ratio`: of these to those of what is beside it: `mujoco.rollout` for `World.step()` on MuJoCo,
  Gymnasium for `AssetVectorEnv`; above 1 the package makes more
- `memory`: maximum of what the process had resident, Python and NumPy included [MB]
- `start`: processor time until the first step is done, imports included [s]

| environments | what | steps | ratio | memory | start |
|---|---|---|---|---|---|
"""


def made_of(kind, values):
    """The code that makes `step` of one of NAMES."""
    if kind in ("mujoco", "physx", "jolt"):
        return WORLD.format(engine=kind, **values)
    if kind == "rollout":
        return ROLLOUT.format(**values)
    text = OWN_ENVS if kind == "envs" else GYMNASIUM
    return FRAMES.format(
        envs_of=text.format(**values, gym_hand=python_package.HAND_OF_GYMNASIUM))


def measured(kind, values, steps):
    each = values["each"] if kind in ("envs", "gymnasium") else 1
    calls = max(3, steps // values["count"] // each)  # 3: to 1,024 environments
    return json.loads(python_package.output(MEASURED.format(
        made=made_of(kind, values), calls=calls, count=values["count"], each=each)))


def row(kind, count, found, beside):
    ratio = f"{found['rate'] / beside['rate']:.2f}" if beside else ""
    return (f"| {count:,} | {NAMES[kind]} | {round(found['rate'], -2):,.0f} | {ratio} | "
            f"{found['memory']:.0f} | {found['start']:.2f} |")


def compare(counts, rounds, most, values):
    """-> for each count its rows and the ratio to rollout."""
    for count in counts:
        tried = {kind: [] for kind in NAMES}
        for _ in range(rounds):
            for kind in NAMES:
                steps = min(most, STEPS[kind])
                tried[kind].append(measured(kind, {**values, "count": count}, steps))
        found = {kind: {name: statistics.median(one[name] for one in each) for name in each[0]}
                 for kind, each in tried.items()}
        beside = {"mujoco": found["rollout"], "envs": found["gymnasium"]}
        yield ([row(kind, count, found[kind], beside.get(kind)) for kind in NAMES],
               found["mujoco"]["rate"] / found["rollout"]["rate"])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("page", nargs="?")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--envs", type=int, nargs="+", default=COUNTS)
    parser.add_argument("--smoke", action="store_true", help="once, small, without a page")
    options = parser.parse_args()
    if not os.path.exists(os.path.join(python_package.WHEEL, "beside/bin/python")):
        print("skipped: no package (python/tests/install.sh)")
        return 77
    counts, rounds, most = (((1, 4), 1, SMOKE_STEPS) if options.smoke
                            else (options.envs, options.rounds, max(STEPS.values())))
    lines, ratios = [], []
    with tempfile.TemporaryDirectory() as folder:
        model = os.path.join(folder, "hand.xml")
        time_step = float(python_package.output(
            MODEL.format(hand=python_package.HAND, model=model)).split()[-1])
        each = max(1, round(0.02 / time_step))
        values = {"hand": python_package.HAND, "model": model, "each": each,
                  "frame": each * time_step, "fps": round(1 / (each * time_step))}
        for found, ratio in compare(counts, rounds, most, values):
            print("\n".join(found), flush=True)
            lines += found
            ratios.append(ratio)
    if options.page and not options.smoke:
        head = PAGE.format(date=datetime.date.today(), rounds=rounds, each=each,
                           python=".".join(map(str, sys.version_info[:2])))
        with open(options.page, "w", encoding="utf-8") as file:
            file.write(head + "\n".join(lines) + "\n")
    print("steps of World.step() on MuJoCo to those of mujoco.rollout, at "
          f"{', '.join(map(str, counts))} "
          f"environments: {', '.join(f'{ratio:.2f}' for ratio in ratios)}")
    return 0 if options.smoke or min(ratios) >= LEAST else 1


if __name__ == "__main__":
    sys.exit(main())
