#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Verdicts of tenon beside those of NVIDIA's simready-validate, code by code.

    beside_simready.py ROOT TENON PYTHON [--robots N] [--examples N]

PYTHON is that of an environment with the package (requirements-simready.txt). The corpus: the
planted defects, conversions of robots of build/robots as one file and as a folder, and the
example files that the package ships. Known differences are named below with their reasons. Exit 0:
no other ones.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import planted

PROFILES = {"robot": ("Robot-Body", "3.0.0"), "prop": ("Robotics-Prop", "4.0.0")}
# code: why tenon's verdict is another one.
KNOWN = {
    "VM.TEX.004": ("", "the validator has the check and does not call it"),
    "NEWTON.BA.001": (".bad/", "Newton's schema brings UsdPhysics' root with it where it is "
                               "known, and as RC.005"),
    "RC.005": ("RV.007.bad", "an asset that selects Enabled: the validator takes Disabled for it"),
    "MUJOCO.DJ.001": ("RV.007.bad", "the same"),
    "MUJOCO.COL.001": ("RV.007.bad", "the same"),
    "NEWTON.COL.001": ("RV.004.bad", "the same"),
}


def tenon_verdicts(tenon, kind, assets):
    """{asset: {code: verdict}}, seconds"""
    start = time.monotonic()
    done = subprocess.run([tenon, "check", "--json", "--no-settings", "--only", "simready",
                           "--profile", f"simready-{kind}", *assets], capture_output=True,
                          text=True, check=False)
    rows = json.loads(done.stdout)["assets"]
    return {row["asset"]: {one["code"]: one["verdict"] for one in row["codes"] or []}
            for row in rows}, time.monotonic() - start


def nvidia_verdicts(python, kind, assets):
    script = pathlib.Path(__file__).with_name("nvidia_verdicts.py")
    done = subprocess.run([python, "-B", str(script), *PROFILES[kind]], input="\n".join(assets),
                          capture_output=True, text=True, check=False)
    rows = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    if len(rows) != len(assets):
        sys.exit(f"simready-validate judged {len(rows)} of {len(assets)}: {done.stderr[-500:]}")
    return {row["path"]: row for row in rows}


def planted_assets(folder):
    found = {"robot": [], "prop": []}
    for code, kind, good, files in planted.assets():
        home = folder / f"{code}.{'good' if good else 'bad'}"
        for name, text in files.items():
            path = home / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text if isinstance(text, bytes) else text.encode())
        found[kind].append(str(home / planted.main_file(files)))
    return found


def conversions(root, tenon, folder, most):
    """Robots of packages, every second one as a folder, every fourth as the tutorial has it."""
    robots = sorted((root / "build/robots").rglob("*.urdf")) + sorted(
        (root / "build/robots/dm_control/suite").glob("*.xml"))
    step = max(1, len(robots) // most) if most else len(robots)
    made = []
    for number, robot in enumerate(robots[::step][:most]):
        home = folder / f"{number}_{robot.stem}"
        output = home if number % 2 else home.with_suffix(".usda")
        more = ["--names", "tutorial"] if number % 4 == 3 else []
        subprocess.run([tenon, "convert", "-q", str(robot), str(output), *more],
                       capture_output=True, check=False)
        made += [str(path) for path in (home.glob("*.usda") if number % 2 else [output])
                 if path.exists()]
    return made


def examples(python, most):
    """Files that are no part of the package's own tests, but texts of its pages."""
    where = subprocess.run([python, "-c", "import simready.foundation.tier_core as t; "
                            "print(t.__path__[0])"], capture_output=True, text=True, check=True)
    folder = pathlib.Path(where.stdout.strip()) / "requirements/resources/examples"
    found = sorted(str(path) for path in folder.rglob("*.usd"))
    return found[:most]


def compare(tenon, python, kind, assets, tally):
    own, seconds = tenon_verdicts(tenon, kind, assets)
    theirs = nvidia_verdicts(python, kind, assets)
    tally["seconds"] += seconds
    for path in assets:
        row = theirs[path]
        tally["theirs"] += row["seconds"]
        if not row["codes"] or not own.get(path):
            tally["unopened"] += 1
            continue
        tally["assets"] += 1
        for code, verdict in row["codes"].items():
            mine = own[path].get(code)
            short = code.split(".", 3)[3]
            if verdict == "died" or mine in (None, "open"):
                tally["not compared"][short] += 1
            elif mine == verdict:
                tally["same"][short] += 1
            elif short in KNOWN and KNOWN[short][0] in path:
                tally["known"][short] += 1
            else:
                tally["other"].append((short, path, mine, verdict,
                                       row["messages"].get(code, "")[:150]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon")
    parser.add_argument("python")
    parser.add_argument("--robots", type=int, default=24)
    parser.add_argument("--examples", type=int, default=1000)
    options = parser.parse_args()
    tally = {"assets": 0, "unopened": 0, "seconds": 0.0, "theirs": 0.0, "other": [],
             "same": collections.Counter(), "known": collections.Counter(),
             "not compared": collections.Counter()}
    with tempfile.TemporaryDirectory(prefix="tenon-simready-") as name:
        folder = pathlib.Path(name)
        kinds = planted_assets(folder)
        kinds["robot"] += conversions(options.root, options.tenon, folder / "robots",
                                      options.robots)
        kinds["prop"] += examples(options.python, options.examples)
        for kind, assets in kinds.items():
            compare(options.tenon, options.python, kind, assets, tally)
    for short, path, mine, verdict, message in tally["other"]:
        print(f"{short}: tenon {mine}, theirs {verdict}: {path}: {message}")
    for code, (_, reason) in KNOWN.items():
        print(f"{code}: {tally['known'][code]} verdicts differ: {reason}")
    for code, count in sorted(tally["not compared"].items()):
        print(f"{code}: {count} not compared")
    same = sum(tally["same"].values())
    print(f"{tally['assets']} assets, {same} verdicts of {len(tally['same'])} codes the same, "
          f"{sum(tally['known'].values())} known and {len(tally['other'])} other differences; "
          f"{tally['theirs'] / max(tally['seconds'], 1e-9):.0f} times faster")
    return 1 if tally["other"] else 0


if __name__ == "__main__":
    sys.exit(main())
