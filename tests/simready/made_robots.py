#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Published robots, converted with --profile simready, by NVIDIA's simready-validate and by tenon.

    made_robots.py ROOT TENON PYTHON [--robots N] [--only WORDS] [--no-pictures]

PYTHON is that of an environment with the package (requirements-simready.txt). Each robot of
build/robots gets the kind of robot that KINDS says. Codes that fail are those of features that are
other choices (OTHER_CHOICES), or lines of made_misses.txt: `FILE CODE | reason`, for what the
source forces. Exit 1: other codes fail, the two judges differ, or a line is not needed any more.
"""

import argparse
import collections
import pathlib
import subprocess
import sys
import tempfile

import beside_simready
from other_choices import OTHER_CHOICES

HERE = pathlib.Path(__file__).resolve().parent
# The first row with a word that the path has.
KINDS = (("Manipulator", tuple(f"suite/{name}" for name in (  # held in the world by their joints
    "ball_in_cup", "cheetah", "finger", "hopper", "manipulator", "reacher", "stacker", "swimmer",
    "walker"))),
         ("Quadruped", ("a1", "anymal", "b1", "go1", "go2", "hyq", "laikago", "solo", "quadruped",
                        "suite/dog")),
         ("Humanoid", ("alex", "g1_", "human", "icub", "romeo", "talos", "bolt")),
         ("Mobile Manipulators", ("tiago", "pr2", "centauro", "mobi", "baxter")),
         ("Wheeled", ("upkie", "cart")),
         ("Aerial", ("iris", "hextilt", "borinot", "quadrotor", "suite/fish")),
         ("End Effector", ("hand", "robotiq", "schunk", "allegro", "finger", "gripper")))


def kind_of(path):
    name = path.as_posix().split("build/robots/")[-1].lower()
    return next((kind for kind, words in KINDS if any(word in name for word in words)),
                "Manipulator")


def base_of(path):
    """What walks has a free root: in MJCF its own joint, in URDF as it is told."""
    held = kind_of(path) in ("Manipulator", "End Effector")
    return [] if held or path.suffix != ".urdf" else ["--float-base"]


def misses():
    """{(file, code): reason}"""
    rows = {}
    for line in (HERE / "made_misses.txt").read_text("utf-8").splitlines():
        if line and not line.startswith("#"):
            what, reason = line.split(" | ")
            name, code = what.rsplit(" ", 1)
            rows[name, code] = reason
    return rows


def robots_of(root, most, only):
    found = sorted((root / "build/robots").rglob("*.urdf")) + sorted(
        (root / "build/robots/dm_control/suite").glob("*.xml"))
    found = [path for path in found if not only or any(word in str(path) for word in only)]
    step = max(1, len(found) // most) if most else 1
    return found[::step][:most or None]


def converted(tenon, robots, folder, pictures):
    """{asset: robot}"""
    made = {}
    for number, robot in enumerate(robots):
        home = folder / str(number)
        home.mkdir()
        more = [] if pictures else ["--no-thumbnail"]
        # The folder above is called as the asset: its name is known when it is made.
        done = subprocess.run(
            [tenon, "convert", "-q", str(robot), f"{home}/usd/", "--profile", "simready",
             "--robot-type", kind_of(robot), "--metadata", "author=the tenon authors",
             "--metadata", "asset_license=BSD-3-Clause", *base_of(robot), *more],
            capture_output=True, text=True, check=False)
        assets = list((home / "usd").glob("*.usda"))
        if not assets:
            print(f"{robot.name}: not converted: {done.stderr[-300:]}")
            continue
        named = folder / f"{number}_" / assets[0].stem
        named.parent.mkdir()
        home.rename(named)
        made[str(named / "usd" / assets[0].name)] = robot
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon")
    parser.add_argument("python")
    parser.add_argument("--robots", type=int, default=0)
    parser.add_argument("--only", nargs="*", default=[])
    parser.add_argument("--no-pictures", action="store_true")
    options = parser.parse_args()
    faults = []
    known = misses()
    seen = set()
    failing = collections.Counter()
    with tempfile.TemporaryDirectory(prefix="tenon-simready-") as name:
        robots = robots_of(options.root.resolve(), options.robots, options.only)
        made = converted(options.tenon, robots, pathlib.Path(name), not options.no_pictures)
        own, _ = beside_simready.tenon_verdicts(options.tenon, "robot", list(made))
        theirs = beside_simready.nvidia_verdicts(options.python, "robot", list(made))
        for asset, robot in made.items():
            for code, verdict in theirs[asset]["codes"].items():
                short = code.split(".", 3)[3]
                mine = own[asset].get(code)
                if verdict == "died" or mine in (None, "open") or short in OTHER_CHOICES:
                    continue
                if options.no_pictures and short in ("SR.002", "RC.004"):
                    continue
                place = robot.name
                if mine != verdict:
                    faults.append(f"{place} {short}: tenon {mine}, theirs {verdict}")
                if verdict == "fail":
                    failing[short] += 1
                    seen.add((place, short))
                    if (place, short) not in known:
                        faults.append(f"{place} {short}: "
                                      f"{theirs[asset]['messages'].get(code, '')[:200]}")
    whole = not options.robots and not options.only
    if whole and len(made) < 60:
        faults.append(f"only {len(made)} robots: make them with tests/convert/ten_robots.py")
    faults += [f"{place} {code}: passes; take its line out of made_misses.txt"
               for place, code in sorted(set(known) - seen) if whole]
    print("\n".join(faults))
    clean = len(made) - len({place for place, _ in seen})
    print(f"{len(made)} robots, {clean} pass all, failing codes by robots: {dict(failing)}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
