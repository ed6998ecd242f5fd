#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Forty published robots, URDF and MJCF, as an asset and back, beside MuJoCo's reading of them.

    forty_robots.py ROOT TENON

The files are an even choice of those in build/robots, which ten_robots.py makes. The judgement
robot_corpora (robot_corpora.py) does the same to many more, with validators and other converters.
Good when everything that the source's own reader takes is converted, every number is MuJoCo's, and
what goes back to MJCF and URDF says what it said.
"""

import collections
import os
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(ROOT / "build/robots"))

import robot_corpora  # pylint: disable=wrong-import-position
import round_trip  # pylint: disable=wrong-import-position,unused-import # skips without MuJoCo

# Files of each package.
CHOSEN = {"example-robot-data": 15, "airo-models": 5, "upkie-description": 2, "dm-control": 11,
          "gymnasium-robotics": 9}
NUMBERS = ("kinematics", "mass", "inertia", "limits", "effort", "DOF", "MJCF back", "URDF back")
SHOWN = robot_corpora.COLUMNS[:robot_corpora.COLUMNS.index("usd-core")]


def main():
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, count in CHOSEN.items():
            place = ROOT / "build/robots" / robot_corpora.PACKAGES[name]
            work = pathlib.Path(folder) / name
            work.mkdir()
            results[name] = robot_corpora.Corpus(sys.argv[2], place, work)
            results[name].run(robot_corpora.files_of(place, count), os.cpu_count())
    rows = collections.Counter()
    for name, corpus in results.items():
        rows += corpus.rows
        for note in corpus.notes:
            print(f"{name}: {note}")
    if rows["files"] == 0:
        print("skipped: there are no published robots in build/robots")
        return 77
    print("\n".join(robot_corpora.table(results, SHOWN)))
    wrong = {column: rows["converted"] - rows["unread " + column] - rows[column]
             for column in NUMBERS}
    print(f"{rows['files']} files: {rows['converted']} converted, {rows['no robot']} no robots, "
          f"{rows['refused']} refused; wrong: {wrong}")
    return 0 if rows["converted"] >= 30 and not rows["refused"] and not any(wrong.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
