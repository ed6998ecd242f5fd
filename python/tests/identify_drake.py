# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon identify` beside logs of another simulator, with effects that no asset states.

    identify_drake.py ROOT TENON DRAKE PAGE [--write] [--only TEXT]

Commands of `tenon excite`, played in Drake (drake_log.py, run by the Python DRAKE) on robots of
build/robots whose friction, damping, armature, gains and delay are other ones: as the model has
them, with friction that is larger at rest (Stribeck), with ripple of the motors' torque, with
friction that grows with the load, and all of these. PAGE has the table between its marks; --write
makes it. Exit 0: held-out motion is at least GAIN times as close as by the asset; of the logs
without further effects friction, stiffness and delay are within BOUNDS, and WITHIN of all numbers
are within their 95 %; and PAGE has these rows; 1: not; 77: something is missing.
"""

import argparse
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/convert"))

import ten_robots  # noqa: E402

from tenon_usd.identify.selftest import DEFAULT_FAMILIES  # noqa: E402

ROBOTS = [("ur5", ten_robots.ROBOTS + "ur_description/urdf/ur5_robot.urdf", 800, 40, 6),
          ("so101", ten_robots.ROBOTS + "so_arm_description/urdf/so101.urdf", 10, 0.5, 0.1)]
#: Of friction at rest, of the first friction [N m], of the load.
EFFECTS = {"as the model": {}, "Stribeck": {"stribeck": 0.6},
           "Stribeck, identified": {"stribeck": 0.6}, "ripple": {"ripple": 0.1},
           "load": {"load": 0.03}, "all": {"stribeck": 0.6, "ripple": 0.1, "load": 0.03}}
#: What is identified of logs of that name, beside what usually is.
MORE = {"Stribeck, identified": ("stribeck", "stribeckSpeed")}
DELAY, PERIOD, DURATION = 0.006, 0.004, 8
#: Where nothing else acts: parts of the numbers, and of all numbers how many are within their 95 %.
BOUNDS = {"friction": 0.05, "stiffness": 0.05, "delay": 0.5}
WITHIN = 0.9
GAIN = 5
MARKS = re.compile(r"(<!-- drake: .*? -->\n)(.*?)(<!-- end of drake -->)", re.S)


def numbers_of(joints, stiffness, damping, friction, effects):
    """Other numbers than the asset's; joints further out have smaller ones."""
    drawn = random.Random(3)
    made = {}
    for at, joint in enumerate(joints):
        size = 1.0 if at < len(joints) / 2 else 0.25
        made[joint] = {"stiffness": stiffness, "driveDamping": damping, "friction": friction * size,
                       "damping": 0.6 * friction * size, "armature": 0.07 * friction * size}
        made[joint] = {name: value * drawn.uniform(0.65, 1.5)
                       for name, value in made[joint].items()}
        made[joint]["start"] = 0.0
    ripple = effects.get("ripple", 0.0) * friction
    return {"joints": made, "delay": DELAY, "stribeck": effects.get("stribeck", 0.0),
            "stribeckSpeed": 0.1, "ripple": ripple, "load": effects.get("load", 0.0)}


class Robot:
    def __init__(self, tenon, drake, packages, row, folder):
        self.name, urdf, self.stiffness, self.damping, self.friction = row
        self.tenon, self.drake, self.folder = tenon, drake, folder
        self.urdf = str(packages / urdf)
        self.asset, self.motion = folder / "robot.usda", folder / "motion.csv"
        self.call("convert", self.urdf, self.asset, "--gains", f"{self.stiffness},{self.damping}",
                  "--fix-base", "-q")
        self.call("excite", self.asset, "-o", self.motion, "--duration", str(DURATION), "--step",
                  str(PERIOD), "--no-collisions", "-q")
        head = self.motion.read_text(encoding="utf-8").split("\n")[0].split(",")
        self.joints = [name.rpartition("/")[2].partition(".")[0] for name in head[1::2]]

    def call(self, *words):
        done = subprocess.run([self.tenon, *map(str, words)], capture_output=True, text=True,
                              env={**os.environ, "TENON_PYTHON": sys.executable})
        if done.returncode not in (0, 1):
            raise SystemExit(f"{' '.join(map(str, words))}: {done.stderr}")
        return done

    def identified(self, effects, more=()):
        """The numbers of the log, and what `tenon identify --json` says."""
        numbers = numbers_of(self.joints, self.stiffness, self.damping, self.friction, effects)
        truth, log = self.folder / "numbers.json", self.folder / "log.csv"
        truth.write_text(json.dumps(numbers), encoding="utf-8")
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        subprocess.run([self.drake, "-B", str(ROOT / "python/tests/drake_log.py"), self.urdf,
                        str(self.motion), str(truth), str(log)], check=True, env=environment)
        rows = [f"--identify={family}" for family in (*DEFAULT_FAMILIES, *more)] if more else []
        done = self.call("identify", self.asset, log, "--commands", self.motion, "--hold", "--json",
                         *rows)
        return numbers, json.loads(done.stdout)


def off(numbers, found):
    """By family the worst part by which a number is off [delay: in samples], and how many of all
    truths are within their intervals."""
    worst, within, count = dict[str, float](), 0, 0
    for each in found["parameters"]:
        family = each["family"]
        for path in each["paths"][:1]:
            joint = numbers["joints"][path.rpartition("/")[2]]
            truth = {"delay": numbers["delay"], "stribeckSpeed": numbers["stribeckSpeed"],
                     "stribeck": numbers["stribeck"] * joint["friction"], **joint}[family]
        apart = abs(each["value"] - truth) / (PERIOD if family == "delay" else truth)
        worst[family] = max(worst.get(family, 0.0), apart)
        bounds = [each[name] if each[name] is not None else math.copysign(math.inf, sign)
                  for name, sign in (("low", -1), ("high", 1))]
        within += bounds[0] <= truth <= bounds[1]
        count += 1
    return worst, within, count


def left(found):
    """Root mean square of held-out positions before and after [rad]."""
    rows = [each for each in found["heldOut"] if each["channel"] == "position"]
    return [math.sqrt(sum(each[name] ** 2 for each in rows) / len(rows))
            for name in ("before", "after")]


HEAD = """
Commands of `tenon excite` every 4 ms, played for 9 s in Drake on an arm of 60 N m and on one of
hobby servos, whose numbers are others than those of the asset, with a delay of 6 ms, encoders of
16 bit and 1 % of noise on efforts; in all rows of an arm but the first with what no asset states:
friction that is 60 % larger at rest (Stribeck), ripple of the motors' torque of 10 % of the
friction, bearings that add 3 % of the effort to it (`make judge ONLY=identify_drake`; how far off
the worst number of each kind is):

"""
COLUMNS = ("robot", "the log has", "friction", "damping", "armature", "stiffness",
           "drive damping", "delay", "within 95 %", "held-out positions")
HEAD += f"| {' | '.join(COLUMNS)} |\n{'|---' * len(COLUMNS)}|\n"


def row_of(robot, name, numbers, found):
    worst, within, count = off(numbers, found)
    before, after = left(found)
    cells = [f"{100 * worst[family]:.2g} %" if family in worst else "not told"
             for family in ("friction", "damping", "armature", "stiffness", "driveDamping")]
    delay = f"{PERIOD * 1e3 * worst['delay']:.2g} ms" if "delay" in worst else "not told"
    return (f"| {robot} | {name} | {' | '.join(cells)} | {delay} | {within} of {count} | "
            f"{before:.2g} -> {after:.2g} rad |\n")


def faults_of(name, numbers, found):
    before, after = left(found)
    if after * GAIN > before:
        yield f"held-out motion is {before / after:.2g} times as close, of {GAIN}"
    worst, within, count = off(numbers, found)
    if EFFECTS[name]:
        return
    for family, most in BOUNDS.items():
        if worst.get(family, math.inf) > most:
            yield f"{family} is off by {worst.get(family, math.inf):.3g}, of {most}"
    if within < WITHIN * count:
        yield f"{within} of {count} numbers are within their 95 %"


def without_numbers(table):
    return re.sub(r"[0-9.e-]+", "", table)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon")
    parser.add_argument("drake")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    packages, why = ten_robots.make_packages(options.root.resolve())
    if packages is None:
        print(f"skipped: {why}")
        return 77
    rows, faults = "", []
    for row in ROBOTS:
        if options.only not in row[0]:
            continue
        with tempfile.TemporaryDirectory() as folder:
            robot = Robot(options.tenon, options.drake, packages, row, pathlib.Path(folder))
            for name, effects in EFFECTS.items():
                numbers, found = robot.identified(effects, MORE.get(name, ()))
                rows += row_of(robot.name, name, numbers, found)
                print(rows.rstrip("\n").rpartition("\n")[2], flush=True)
                faults += [f"{robot.name}, {name}: {fault}"
                           for fault in faults_of(name, numbers, found)]
    page = options.page.read_text(encoding="utf-8")
    known = MARKS.search(page)
    if known and options.write:
        options.page.write_text(page[:known.start(2)] + HEAD + rows + page[known.end(2):],
                                encoding="utf-8")
        known = MARKS.search(options.page.read_text(encoding="utf-8"))
    same = known is not None and without_numbers(known[2]) == without_numbers(HEAD + rows)
    print("\n".join(faults))
    count = rows.count("\n")
    print(f"{count} logs by Drake, {len(faults)} faults; "
          f"page {'has' if same else 'lacks'} these rows")
    return 0 if same and not faults else 1


if __name__ == "__main__":
    sys.exit(main())
