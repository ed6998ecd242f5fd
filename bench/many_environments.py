#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Many hands at a time beside mujoco.rollout: steps a second of processor time, as a ratio.

    many_environments.py TENON ASSET [--rounds 5] [--envs 64 1024] [--steps 10]

Both run the model that tenon makes of the asset (its own MJCF for rollout), the same number of
environments and threads, the same steps a call, in turns; the medians count. rollout writes the
states of all steps into arrays that are made before, tenon keeps them in its worlds.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "build/robots"))

import mujoco  # noqa: E402: of tests/robot_requirements.txt, which make test puts there
import mujoco.rollout  # noqa: E402
import numpy  # noqa: E402


def tenon_rate(tenon, asset, count, steps, duration):
    told = json.loads(subprocess.run(
        [tenon, "bench", asset, "--engine", "mujoco", "--envs", str(count), "--steps", str(steps),
         "--duration", str(duration), "--json"], capture_output=True, text=True, check=True).stdout)
    return told["stepsPerCpuSecond"], told["stepsPerSecond"]


def rollout_rate(model, count, steps, duration):
    threads = len(os.sched_getaffinity(0))
    datas = [mujoco.MjData(model) for _ in range(threads)]
    size = mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    first = numpy.zeros(size)
    mujoco.mj_getState(model, datas[0], first, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    states = numpy.tile(first, (count, 1))
    out = numpy.zeros((count, steps, size))
    calls = round(duration / model.opt.timestep / steps)
    with mujoco.rollout.Rollout(nthread=threads) as runner:
        wall, cpu = time.perf_counter(), time.process_time()
        for _ in range(calls):
            runner.rollout(model, datas, states, nstep=steps, state=out)
            states = numpy.ascontiguousarray(out[:, -1])
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    total = calls * steps * count
    return total / cpu, total / wall


def without_looks(xml):
    """The model as tenon steps it: shapes that touch nothing are no part of it. With them MuJoCo
    walks trees of boxes between bodies, which culls more."""
    spec = mujoco.MjSpec.from_file(str(xml))
    for geom in list(spec.geoms):
        if geom.contype == 0 and geom.conaffinity == 0:
            spec.delete(geom)
    return spec.compile()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tenon")
    parser.add_argument("asset")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--envs", type=int, nargs="+", default=[64, 1024])
    parser.add_argument("--steps", type=int, default=10)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        xml = pathlib.Path(folder) / "model.xml"
        subprocess.run([arguments.tenon, "convert", arguments.asset, xml], check=False,
                       capture_output=True)
        model = without_looks(xml)
        for count in arguments.envs:
            duration = max(0.04, round(6 / count, 2))
            ratios = []
            for _ in range(arguments.rounds):
                ours = tenon_rate(arguments.tenon, arguments.asset, count, arguments.steps,
                                  duration)
                theirs = rollout_rate(model, count, arguments.steps, duration)
                ratios.append([mine / other for mine, other in zip(ours, theirs)])
            cpu, wall = (statistics.median(column) for column in zip(*ratios))
            print(f"{count} environments, {arguments.steps} steps a call: "
                  f"{cpu:.3f} times mujoco.rollout by processor time, {wall:.3f} by the clock")


if __name__ == "__main__":
    main()
