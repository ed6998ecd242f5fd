#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What `tenon tune` promises, on published robots: a small step of each joint alone is by the form.

usage: tuned_robots.py ROOT TENON PAGE [--write] [--few] [--robots COUNT] [--keep FOLDER]
                       [--seconds SECONDS]

The robots are the first COUNT (50) URDFs of tests/convert/ten_robots.py --all that convert and have
a drive, with a fixed base and drives for all joints. Each is given FREQUENCY and RATIO, and JOINTS
of its joints at most are stepped on every engine of the build, one after the other. A joint whose
overshoot and rise are not within 5 % of the form (an overshoot not within half a per cent of the
step, either) has to have a cause that the program proves by a run without it, whose overshoot and
rise are judged here again. --keep puts the result of each robot into FOLDER and takes those that
are there, and after --seconds no more robots are begun: so 50 robots are done in several calls, of
the same program. Exit 0: so it is for all, and PAGE has the counts; 1: not; 77: the
robots cannot be fetched.
"""

import argparse
import collections
import hashlib
import json
import multiprocessing.pool
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tests/convert"), str(ROOT / "tests/engines_beside")]
SELF, ARGUMENTS = sys.argv[0], sys.argv[1:]
sys.argv = [SELF, os.devnull, "form"]  # test_responses reads it

import ten_robots  # noqa: E402
from robots_per_engine import engines_of, names_of  # noqa: E402
from test_responses import LEAST, PART, overshoot, rise  # noqa: E402

FREQUENCY, RATIO = 5, 0.7  # [Hz]
STEP, PERIOD, AMPLITUDE = 0.001, 0.4, 1  # [s], [s], [% of the range]
GAINS = "300,20"
JOINTS = 4  # of one robot at most, spread over all that have a drive
PATIENCE = 600  # [s] for one robot
OMEGA = 2 * 3.141592653589793 * FREQUENCY

HEAD = """# Tuned robots

Published robots as URDF, the first {robots} of [ten_robots.py](../tests/convert/ten_robots.py)
that convert and have a drive, with `--fix-base --gains {gains}`. `tenon tune --frequency
{frequency} --damping-ratio {ratio}` gives all joints one response, and `--test step --amplitude
{amplitude} --dt {step}` steps each of them alone, by {amplitude} % of its range, while the other
drives hold; of robots with many, {joints} spread over all. `make judge ONLY=tuned_robots` holds
this page, `--write` of its script makes it.

- *by the form*: overshoot and rise are within 5 % of those of the second-order form, or the
  overshoot within half a per cent of the step.
- a cause: they are not, and in a run without it they are; with several, without all of these.
  `other-drives` give way, as they are no stiffer; `max-force` and `velocity-limit` are bounds that
  the description has; `gravity` lets drives sag.
- *own-damping*: the joint damps by itself more than the ratio asks for; a note of `tune` says so.
- *open*: whatever is taken away, it is not by the form.

"""


def is_by_form(step):
    """The overshoot and the rise time of an answer, by this file's own formulas."""
    over, up = overshoot(RATIO), rise(OMEGA, RATIO)
    return (step["riseTime"] is not None
            and abs(step["overshoot"] - over) <= max(PART * over, LEAST)
            and abs(step["riseTime"] - up) <= PART * up)


def run(words):
    """-> exit code, the answer"""
    try:
        done = subprocess.run([*map(str, words)], capture_output=True, text=True, check=False,
                              timeout=PATIENCE)
        return done.returncode, json.loads(done.stdout)
    except (subprocess.TimeoutExpired, json.JSONDecodeError):
        return None, {}


def verdict(result, damped):
    """-> "by the form", its causes, "open", or "unstable"; a fault of the program, or None.
    `damped`: joints whose own damping alone is more than the ratio asks for, as notes say."""
    if result["joint"] in damped:
        return "own-damping", None
    if result["verdict"] == "unstable":
        return "unstable", None
    step = result.get("step")
    if step is None or "byForm" not in step:
        return "not stepped", "; ".join(result["reasons"]) or "no reason"
    if step["byForm"] != is_by_form(step):
        return "by the form", f"byForm is {step['byForm']}: {step}"
    if step["byForm"]:
        return "by the form", None
    if not step["causes"]:
        return "open", None
    if not is_by_form(step["without"]):
        return "open", f"not by the form without {step['causes']}: {step['without']}"
    return " and ".join(sorted(step["causes"])), None


class Robot:
    def __init__(self, options, name, source, folder, engines):
        self.tenon, self.name, self.source = options.tenon, name, source
        self.engines = [engine for engine, _ in engines]
        key = hashlib.sha256(f"{name} {source}".encode()).hexdigest()[:16]
        self.asset = folder / f"{key}.usdc"
        self.kept = options.keep / f"{key}.json" if options.keep else None
        self.end = options.end
        self.counts = None  # {engine: Counter of verdicts}; it has no drives
        self.faults, self.joints, self.left = [], 0, False

    def run(self):
        """The result that is kept, or a new one while there is time."""
        if self.kept and self.kept.exists():
            told = json.loads(self.kept.read_text(encoding="utf-8"))
            counts, self.faults, self.joints = told["counts"], told["faults"], told["joints"]
            self.counts = counts and {engine: collections.Counter(found)
                                      for engine, found in counts.items()}
            return self
        if time.monotonic() > self.end:
            self.left = True
            return self
        self.tune()
        if self.kept:
            self.kept.write_text(json.dumps({"name": self.name, "counts": self.counts,
                                             "faults": self.faults, "joints": self.joints}),
                                 encoding="utf-8")
        return self

    def tune(self):
        code, _ = run([self.tenon, "convert", self.source, self.asset, "--fix-base", "--gains",
                       GAINS, "--json"])
        if code not in (0, 1):
            return
        wish = [self.tenon, "tune", self.asset, "--frequency", FREQUENCY, "--damping-ratio", RATIO,
                "--dt", STEP, "--json"]
        _, answer = run(wish)
        joints = [drive["joint"] for drive in answer.get("drives", []) if drive["to"]]
        if not joints:
            return
        count = min(JOINTS, len(joints))
        chosen = [joints[i * len(joints) // count] for i in range(count)]
        code, answer = run([*wish, "--test", "step", "--amplitude", AMPLITUDE, "--period", PERIOD,
                            "--engine", "all",
                            *(word for joint in chosen for word in ("--joints", joint))])
        if "engines" not in answer:
            said = (answer.get("diagnostics") or [{"message": f"exit code {code}"}])[-1]
            self.faults.append(f"{self.name}: {said['message'][:200]}")
            return
        if not any(engine["results"] for engine in answer["engines"]):
            return
        self.counts = {}
        damped = {drive["joint"] for drive in answer["drives"]
                  if drive["to"]["dampingRatio"] > 1.001 * RATIO
                  and any("own damping of" in note for note in drive["notes"])}
        for engine in answer["engines"]:
            self.judge(engine, damped)

    def judge(self, engine, damped):
        """Counts the verdicts of one engine, and keeps what is not explained."""
        found = self.counts[engine["engine"]] = collections.Counter()
        for result in engine["results"]:
            if result["verdict"] == "skipped":
                continue
            word, fault = verdict(result, damped)
            found[word] += 1
            joint = result["joint"].rsplit("/", 1)[1]
            if fault or word in ("open", "unstable"):
                self.faults.append(f"{self.name} {engine['engine']} {joint}: "
                                   f"{fault or word + ' ' + str(result.get('step'))}")
        self.joints = max(self.joints, sum(found.values()))


def page_of(robots, engines):
    lines = HEAD.format(robots=len(robots), gains=GAINS, frequency=FREQUENCY, ratio=RATIO,
                        amplitude=AMPLITUDE, step=STEP, joints=JOINTS)
    names = [name for name, _ in engines]
    total = {name: sum((robot.counts.get(name, collections.Counter()) for robot in robots),
                       collections.Counter()) for name in names}
    words = sorted({word for counts in total.values() for word in counts},
                   key=lambda word: (word != "by the form", word in ("open", "unstable"),
                                     -sum(total[name][word] for name in names), word))
    lines += "| joints | " + " | ".join(f"{name} {version}" for name, version in engines) + " |\n"
    lines += "|---|" + "---|" * len(names) + "\n"
    for word in words:
        lines += f"| {word} | " + " | ".join(str(total[name][word]) for name in names) + " |\n"
    lines += "\nBy the form of all joints:\n\n| robot | joints | " + " | ".join(names) + " |\n"
    lines += "|---|---|" + "---|" * len(names) + "\n"
    for robot in robots:
        cells = [str(robot.counts.get(name, {}).get("by the form", 0)) for name in names]
        lines += f"| {robot.name} | {robot.joints} | " + " | ".join(cells) + " |\n"
    return lines


def robots_of(options, packages, engines, work):
    """-> the first robots that have drives, and all that were tried"""
    rows = ten_robots.rows_of(argparse.Namespace(all=not options.few, only=None), packages)
    rows = [row for row in rows if str(row[1]).endswith(".urdf")]
    count = 3 if options.few else options.robots
    options.end = time.monotonic() + options.seconds
    left = [Robot(options, name, path, work, engines)
            for name, path in names_of(rows, packages)]
    tried, found = [], []
    with multiprocessing.pool.ThreadPool(options.jobs) as pool:
        while left and len(found) < count:
            some, left = left[:count - len(found)], left[count - len(found):]
            tried += pool.map(Robot.run, some, 1)
            found = [robot for robot in tried if robot.counts]
            if any(robot.left for robot in tried):
                break
    return found, tried


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--few", action="store_true")
    parser.add_argument("--robots", type=int, default=50)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args(ARGUMENTS)
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
    packages, why = ten_robots.make_packages(options.root)
    if packages is None:
        print(f"skipped: the robots cannot be fetched: {why}")
        return 77
    engines = engines_of(options.tenon)
    with tempfile.TemporaryDirectory() as work:
        robots, tried = robots_of(options, packages, engines, pathlib.Path(work))
    if any(robot.left for robot in tried):
        print(f"{len(robots)} robots so far; call it again, with the same --keep")
        return 1
    faults = [fault for robot in tried for fault in robot.faults]
    page = page_of(robots, engines)
    print(page[page.index("| joints"):])
    for fault in faults:
        print(fault)
    if options.write:
        options.page.write_text(page, encoding="utf-8")
    same = options.few or (options.page.exists()
                           and options.page.read_text(encoding="utf-8") == page)
    joints = sum(robot.joints for robot in robots)
    print(f"{len(robots)} robots, {joints} joints on {len(engines)} engines, {len(faults)} "
          "without a proven cause" + ("" if same else ": --write"))
    return 0 if same and not faults and robots else 1


if __name__ == "__main__":
    sys.exit(main())
