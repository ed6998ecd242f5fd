#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares values at times with those that the published value resolution suite asserts.

usage: run_values.py VALUE_AT

VALUE_AT is the program tests/tools/value_at.cpp. The scenes are conformance/aousd/value_resolution
of the folder named by TENON_SHARED_DIR (default: ../shared), each through its binary layers. Two
assertions of the suite hold only for its sample code, which extrapolates a clip's times where
OpenUSD holds them; here they are expected as OpenUSD has them. A scene that is absent is passed
over. The scenes of own_scenes.py are asked for, too, of OpenUSD as well where its modules are.
"""

import math
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import own_scenes  # noqa: E402  pylint: disable=wrong-import-position
import suite  # noqa: E402  pylint: disable=wrong-import-position

ASSETS = os.path.join(suite.CONFORMANCE, "aousd", "value_resolution", "tests", "assets")
JUST_BEFORE_16 = "15.999999995559108"  # the suite's safe step below 16

# (scene, attribute, options, {time: value}); a pair of numbers is an open interval.
EXPECTED = (
    ("default", "/Root.root", (), {"default": 2.0}),
    ("timesamples", "/Root.root", (),
     {"1": 5.0, "40": 15.0, "15": (5.0, 10.0), "60": 15.0, "0.5": 5.0, "default": None}),
    ("timesamples", "/Root.root", ("--held",), {"15": 5.0, "30": 10.0}),
    # The suite asserts 25 at 50 and 0 at -1.
    ("clip_timings", "/Model.size", (),
     {"0": 10.0, "15": 17.5, "30": 15.0, "40": 20.0, "50": 20.0, "-1": 10.0}),
    ("clip_basic", "/Model.size", (), {"0": 0.0, "5": 5.0}),
    ("clip_advanced", "/Model.local", (),
     {"0": 0.0, "5": 5.0, "10": 10.0, "15": 15.0, "20": 20.0, "25": 20.0}),
    ("clip_advanced", "/Model.ref", (),
     {"0": 0.0, "5": -5.0, "10": -10.0, "20": -20.0, "25": -25.0, "30": -25.0}),
    ("clip_sets", "/DefaultOrderTest.attr", (), {"0": 10.0, "1": 20.0, "2": 30.0}),
    ("clip_multi", "/Model_1.size", (),
     {"5": -5.0, "10": -10.0, JUST_BEFORE_16: -15.0, "16": -23.0, "19": -23.0, "22": -26.0,
      "25": -29.0}),
)


def actual_values(program, scene, attribute, options, times):
    path = os.path.join(ASSETS, scene, "entry.usd")
    command = [program, path, *options, attribute, *times]
    run = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    return [line.split("\t") for line in run.stdout.splitlines()]


def matches(expected, text):
    if expected is None or text == "":
        return expected is None and text == ""
    if isinstance(expected, tuple):
        return expected[0] < float(text) < expected[1]
    return math.isclose(float(text), expected, rel_tol=1e-6, abs_tol=1e-6)


def judge(program):
    """(number of values, misses as lines)"""
    count, misses = 0, []
    for scene, attribute, options, expected in EXPECTED:
        if not os.path.isdir(os.path.join(ASSETS, scene)):
            continue
        actual = actual_values(program, scene, attribute, options, list(expected))
        for (time, value), (source, text) in zip(expected.items(), actual, strict=True):
            count += 1
            from_clips = scene.startswith("clip") and attribute != "/Model.local"
            if not matches(value, text) or (from_clips and source != "clips"):
                misses.append(f"{scene} {attribute} at {time}: expected {value}, "
                              f"actual {text or None} ({source})")
    return count, misses


def values_by_openusd(path, attribute, times):
    """None without OpenUSD's modules."""
    try:
        from pxr import Usd  # pylint: disable=import-outside-toplevel
    except ImportError:
        return None
    stage = Usd.Stage.Open(path)  # kept: an attribute does not keep its stage
    found = stage.GetAttributeAtPath(attribute)
    return [found.Get(Usd.TimeCode.Default() if time == "default" else float(time))
            for time in times]


def judge_own(program):
    """Scenes of this project; -> misses as lines"""
    count, misses = 0, []
    with tempfile.TemporaryDirectory() as folder:
        for scene, files in own_scenes.SCENES.items():
            os.mkdir(os.path.join(folder, scene))
            for name, text in files.items():
                with open(os.path.join(folder, scene, name), "w", encoding="utf-8") as file:
                    file.write(text)
        for scene, attribute, expected in own_scenes.EXPECTED:
            path = os.path.join(folder, scene, "entry.usda")
            run = subprocess.run([program, path, attribute, *expected], capture_output=True,
                                 text=True, check=True, timeout=60)
            actual = [line.split("\t")[1] for line in run.stdout.splitlines()]
            theirs = values_by_openusd(path, attribute, list(expected))
            for number, (time, value) in enumerate(expected.items()):
                count += 1
                if not matches(value, actual[number]):
                    misses.append(f"own {scene} {attribute} at {time}: expected {value}, "
                                  f"actual {actual[number] or None}")
                if theirs is not None and theirs[number] != value:
                    misses.append(f"own {scene} {attribute} at {time}: expected {value}, "
                                  f"OpenUSD says {theirs[number]}")
    print(f"values of this project's scenes: {count - len(misses)} of {count}")
    return misses


def main():
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    suite.forget("values")
    own_misses = judge_own(sys.argv[1])
    count, misses = judge(sys.argv[1])
    for miss in own_misses + misses:
        print(f"MISS {miss}")
    asserted = sum(len(expected) for _, _, _, expected in EXPECTED)
    print(f"{asserted - count} of {asserted} asserted values are of scenes that are absent")
    print(f"value resolution: {count - len(misses)} of {count} values")
    if count:
        row = ("AOUSD value resolution: asserted values", count - len(misses), count)
        suite.record("values", [row])
    return 1 if misses or own_misses else 0


if __name__ == "__main__":
    sys.exit(main())
