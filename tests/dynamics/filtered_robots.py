#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Robots whose own links touch or overlap: stable on every engine after one command.

usage: filtered_robots.py ROOT TENON

Two arms with hands (orca-arm, as URDF and as MJCF), a humanoid (gb-robot-models) and the four tasks
of the Adroit hand (gymnasium-robotics), from the packages beside this Python. Each is converted,
`pairs --filter always,adjacent,default` filters what touches, and SECONDS are simulated on each
engine of the build. Exit 0: every run ends well; 1: one did not; 77: the packages are not here.
"""

import os
import pathlib
import sys
import sysconfig
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "engines_beside"))

from robots_per_engine import engines_of, first_error, run  # noqa: E402

PATIENCE = 600  # [s] for one command
SECONDS = 2
ROBOTS = {
    "orca_arm/orcabot.urdf": "purelib",
    "orca_arm/orcabot.xml": "purelib",
    "share/gb_robot_models/robots/gene01_0/model.urdf": "data",
    **{f"gymnasium_robotics/envs/assets/adroit_hand/adroit_{task}.xml": "purelib"
       for task in ("door", "hammer", "pen", "relocate")},
}


def ended(tenon, *words):
    """-> exit code, and the first error where it is not 0"""
    code, answer = run([tenon, *map(str, words), "--json"], PATIENCE)
    return code, f"{words[0]} ended with {code}: {first_error(answer)[:200]}"


def faults_of(tenon, engines, source, folder):
    """Converts, filters and simulates one robot; -> what went wrong."""
    fixed = ["--fix-base"] if source.suffix == ".urdf" else []
    asset = folder / "asset.usda"
    code, fault = ended(tenon, "convert", source, asset, *fixed)
    if code not in (0, 1):  # 1: done, with findings
        return [fault]
    code, fault = ended(tenon, "pairs", asset, "--filter", "always,adjacent,default")
    if code != 0:
        return [fault]
    faults = []
    for engine, _ in engines:
        code, fault = ended(tenon, "sim", asset, "--engine", engine, "--duration", SECONDS)
        print(f"  {engine} {code}", flush=True)
        if code != 0:
            faults.append(f"{engine}: {fault}")
    return faults


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    tenon = os.path.abspath(sys.argv[2])
    engines = engines_of(tenon)
    faults = []
    for name, place in ROBOTS.items():
        source = pathlib.Path(sysconfig.get_path(place)) / name
        if not source.exists():
            print(f"skipped: {source} is not here")
            sys.exit(77)
        print(name, flush=True)
        with tempfile.TemporaryDirectory() as folder:
            faults += [f"{name}: {fault}" for fault in
                       faults_of(tenon, engines, source, pathlib.Path(folder))]
    for fault in faults:
        print(fault)
    print(f"{len(ROBOTS)} robots whose links overlap on {len(engines)} engines after one command, "
          f"{len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
