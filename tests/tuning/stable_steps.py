#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Up to which omega dt a drive stays stable, by bisection of runs, is what tenon/tuning/gains.h
derives, to 20 % below and 2 % above: near the bound runs are stopped as unstable before they are.

    stable_steps.py TENON          some damping ratios
    stable_steps.py TENON all      prints a row for each engine, integrator and damping ratio
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

from scenes import WEIGHTLESS, drives, wheel
from author import joint, scene

TENON = str(pathlib.Path(sys.argv[1]).absolute())
STEP = 1e-3


def layer(integrator):
    words = {"physics_apis": ["MjcSceneAPI"]} if integrator else {}
    lines = [f'uniform token mjc:option:integrator = "{integrator}"'] if integrator else []
    return scene(wheel("A", (0, 0, 3), 0.5),
                 joint("revolute", "J", None, "/World/A", (0, 0, 3), axis="Y", parts=drives()),
                 gravity=[*WEIGHTLESS, *lines], **words)


def is_stable(path, engine, coarse, ratio):
    done = subprocess.run(
        [TENON, "tune", path, "--frequency", f"{coarse / STEP}rad/s", "--damping-ratio", f"{ratio}",
         "--test", "step", "--engine", engine, "--dt", f"{STEP}", "--period", "2", "--amplitude",
         "1", "--force", "--json"], capture_output=True, text=True, check=False)
    told = json.loads(done.stdout)
    if done.returncode == 3:
        return False
    step = told["engines"][0]["results"][0]["step"]
    return step["overshoot"] is not None and step["overshoot"] < 5


def bound(integrator, engine, ratio):
    """What gains.h says."""
    if engine != "mujoco" or not integrator:
        return math.inf
    root = math.sqrt(ratio * ratio + 1)
    if integrator == "euler":
        return min(2 * (root - ratio), 1 / ratio)
    if integrator != "rk4":
        return 2 * (root + ratio)
    coarse = 0.0
    while coarse < 4:
        coarse += 1e-3
        for side in (-1, 1):
            z = coarse * (-ratio + side * complex(ratio * ratio - 1, 0) ** 0.5)
            if abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24) > 1 + 1e-9:
                return coarse - 1e-3
    return 4


def measured(path, engine, ratio):
    """-> the largest stable omega dt, at most 100."""
    low, high = 0.05, 100.0
    if is_stable(path, engine, high, ratio):
        return math.inf
    while high / low > 1.02:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if is_stable(path, engine, middle, ratio) else (low, middle)
    return low


def main():
    every = sys.argv[2:] == ["all"]
    failed = count = 0
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "a.usda"
        doctor = subprocess.run([TENON, "doctor", "--json"], capture_output=True, text=True,
                                check=False)
        here = json.loads(doctor.stdout)["engines"]
        names = {row["name"] for row in here if row["available"]}
        for engine, integrator in (("mujoco", ""), ("physx", ""), ("jolt", ""),
                                   ("mujoco", "euler"), ("mujoco", "implicitfast"),
                                   ("mujoco", "rk4")):
            path.write_text(layer(integrator))
            if engine not in names:
                continue
            for ratio in (0.05, 0.3, 1, 3) if every else (0.3,):
                runs, form = measured(path, engine, ratio), bound(integrator, engine, ratio)
                well = runs == form or 0.8 * form <= runs <= 1.02 * form
                count += 1
                failed += not well
                if every or not well:
                    print(f"{engine:7} {integrator or 'own':13} ratio {ratio:<5} runs {runs:.3g}  "
                          f"form {form:.3g}{'' if well else '  NO'}", flush=True)
    print(f"{count} bounds, {failed} not by their form")
    return 1 if failed or not count else 0


if __name__ == "__main__":
    sys.exit(main())
