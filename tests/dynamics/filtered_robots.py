#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Robots whose own links touch or overlap: stable on every engine after one command.

usage: filtered_robots.py ROOT TENON

Two arms with hands (orca-arm, as URDF and as MJCF), a humanoid (gb-robot-models) and the four tasks
of the Adroit hand (gymnasium-robotics), from the packages beside this Python. Each is converted,
`pairs --filter always,adjacent,default` filters what touches, and SECONDS are simulated on each
engine. Exit 0: every run ends well; 1: one did not; 77: the packages are not here.
"""

import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile

ENGINES = ("mujoco", "physx", "jolt")
SECONDS = 2
ROBOTS = {
    "orca_arm/orcabot.urdf": "purelib",
    "orca_arm/orcabot.xml": "purelib",
    "share/gb_robot_models/robots/gene01_0/model.urdf": "data",
    **{f"gymnasium_robotics/envs/assets/adroit_hand/adroit_{task}.xml": "purelib"
       for task in ("door", "hammer", "pen", "relocate")},
}


def run(words):
    """-> exit code, what was printed as an error"""
    done = subprocess.run([*map(str, words)], capture_output=True, text=True, check=False,
                          timeout=600)
    return done.returncode, done.stderr


def first_error(printed):
    return next((line for line in printed.splitlines() if "error" in line), "")[:200]


def faults_of(tenon, source, folder):
    """Converts, filters and simulates one robot; -> what went wrong."""
    fixed = ["--fix-base"] if source.suffix == ".urdf" else []
    asset = folder / "asset.usda"
    code, printed = run([tenon, "convert", source, asset, *fixed])
    if code not in (0, 1):  # 1: done, with findings
        return [f"convert ended with {code}: {first_error(printed)}"]
    code, printed = run([tenon, "pairs", asset, "--filter", "always,adjacent,default", "--quiet"])
    if code != 0:
        return [f"pairs ended with {code}: {first_error(printed)}"]
    faults = []
    for engine in ENGINES:
        code, printed = run([tenon, "sim", asset, "--engine", engine, "--duration", SECONDS])
        print(f"  {engine} {code}", flush=True)
        if code != 0:
            faults.append(f"{engine} ended with {code}: {first_error(printed)}")
    return faults


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    tenon = os.path.abspath(sys.argv[2])
    faults = []
    for name, place in ROBOTS.items():
        source = pathlib.Path(sysconfig.get_path(place)) / name
        if not source.exists():
            print(f"skipped: {source} is not here")
            sys.exit(77)
        print(name, flush=True)
        with tempfile.TemporaryDirectory() as folder:
            faults += [f"{name}: {fault}" for fault in
                       faults_of(tenon, source, pathlib.Path(folder))]
    for fault in faults:
        print(fault)
    print(f"{len(ROBOTS)} robots whose links overlap on {len(ENGINES)} engines after one command, "
          f"{len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
