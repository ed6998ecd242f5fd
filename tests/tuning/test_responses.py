#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What `tenon tune` promises: after it a small step overshoots and rises as a second-order system
of that frequency and damping ratio does, on every engine, for every kind of joint.

    test_responses.py TENON           a few frequencies, by their closed forms
    test_responses.py TENON all       all of them
    test_responses.py TENON table     prints the table

Overshoot and rise time (10 to 90 %) are held to 5 % of the form, an overshoot also to half a per
cent of the step where 5 % of it is less. Engines take forces at the beginning or end of a step, an
error of first order in omega dt; where 1/1000 s is too coarse for that, the row counts at 1/4000 s
and says so.
"""

import itertools
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from scenes import SCENES

TENON = str(pathlib.Path(sys.argv[1]).absolute())
MODE = sys.argv[2] if len(sys.argv) > 2 else "few"
FREQUENCIES = (2, 5, 10) if MODE != "few" else (5,)
RATIOS = (0.3, 0.7, 1, 2)
STEPS = (1e-3, 2.5e-4)
PART = 0.05
LEAST = 0.005  # of the step


def response(omega, zeta, time):
    """From rest at 0 to 1."""
    if abs(zeta - 1) < 1e-9:
        return 1 - math.exp(-omega * time) * (1 + omega * time)
    if zeta < 1:
        damped = omega * math.sqrt(1 - zeta * zeta)
        return 1 - math.exp(-zeta * omega * time) * (
            math.cos(damped * time) + zeta * omega / damped * math.sin(damped * time))
    root = math.sqrt(zeta * zeta - 1)
    slow, fast = omega * (zeta - root), omega * (zeta + root)
    return 1 - (fast * math.exp(-slow * time) - slow * math.exp(-fast * time)) / (fast - slow)


def overshoot(zeta):
    return math.exp(-math.pi * zeta / math.sqrt(1 - zeta * zeta)) if zeta < 1 else 0.0


def rise(omega, zeta):
    def when(part):
        low, high = 0.0, 0.0
        while response(omega, zeta, high) < part:
            low, high = high, high + 0.02 / omega
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if response(omega, zeta, middle) < part else (low, middle)
        return high

    return when(0.9) - when(0.1)


def tune(path, joint, frequency, ratio, step):
    done = subprocess.run(
        [TENON, "tune", path, "--joints", joint, "--frequency", f"{frequency}", "--damping-ratio",
         f"{ratio}", "--test", "step", "--engine", "all", "--dt", f"{step}", "--period",
         f"{40 / (2 * math.pi * frequency)}", "--json"],
        capture_output=True, text=True, check=False)
    assert done.returncode == 0, (done.returncode, done.stdout[-2000:], done.stderr)
    return json.loads(done.stdout)


def judge(name, frequency, ratio, path, joint, inertia):
    """-> rows: engine, step, overshoot, rise, both by the form, well"""
    omega = 2 * math.pi * frequency
    forms = overshoot(ratio), rise(omega, ratio)
    rows = []
    done = set()
    for step in STEPS:
        told = tune(path, joint, frequency, ratio, step)
        drive = next(d for d in told["drives"] if d["joint"].endswith("/" + joint))
        assert abs(drive["inertia"] / inertia - 1) < 1e-5, (name, drive["inertia"], inertia)
        assert abs(drive["to"]["frequency"] / omega - 1) < 1e-6, (name, drive["to"])
        assert abs(drive["to"]["dampingRatio"] / ratio - 1) < 1e-6, (name, drive["to"])
        for engine in told["engines"]:
            if engine["engine"] in done:
                continue
            found = engine["results"][0]["step"]
            well = (abs(found["overshoot"] - forms[0]) <= max(PART * forms[0], LEAST)
                    and abs(found["riseTime"] - forms[1]) <= PART * forms[1])
            if well:
                done.add(engine["engine"])
            if well or step == STEPS[-1]:
                rows.append((engine["engine"], step, found["overshoot"], found["riseTime"], *forms,
                             well))
    return rows


def main():
    failed = count = finer = 0
    if MODE == "table":
        print("| joint | Hz | ratio | engine | step | overshoot (form) | rise (form) | |")
        print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for (name, (text, joint, inertia)), frequency, ratio in itertools.product(
                SCENES.items(), FREQUENCIES, RATIOS):
            path = pathlib.Path(folder) / (name.replace(" ", "_") + ".usda")
            path.write_text(text)
            for engine, step, over, up, over_form, up_form, well in judge(
                    name, frequency, ratio, path, joint, inertia):
                count += 1
                failed += not well
                finer += step < STEPS[0]
                row = (f"| {name} | {frequency} | {ratio} | {engine} | 1/{1 / step:.0f} s | "
                       f"{100 * over:.2f} % ({100 * over_form:.2f} %) | {1e3 * up:.2f} ms "
                       f"({1e3 * up_form:.2f} ms) | {'' if well else 'NO'} |")
                if MODE == "table" or not well:
                    print(row)
    print(f"{count} responses, {failed} not by their form, {finer} at the finer step")
    return 1 if failed or not count else 0


if __name__ == "__main__":
    sys.exit(main())
