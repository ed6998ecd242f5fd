#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Layers of this project, and of the published material where it is, written as text and as a
binary layer and read again.

usage: run_round_trip.py ROUND_TRIP TENON [--all]

ROUND_TRIP is the program tests/tools/round_trip.cpp.
ourselves  text -> binary -> text and back: same fields, same text
OpenUSD    reads what was written, text and binary, as it reads the original: same text
stages     of the composition suite and random ones, all text layers replaced by binary ones: same
           dump, by both
Without --all one in SAMPLE of the layers, and of those the smaller ones: what takes a minute with
sanitizers. Exit 77: OpenUSD's modules are absent.
"""

import os
import shutil
import subprocess
import sys
import tempfile

import suite

sys.path.insert(0, os.path.join(suite.REPO, "tests", "differential"))
import dump_stage  # noqa: E402  pylint: disable=wrong-import-position
import random_scenes  # noqa: E402  pylint: disable=wrong-import-position

os.environ["PXR_USDC_EMIT_DEPRECATION_WARNINGS"] = "0"  # read when OpenUSD is loaded
try:
    from pxr import Sdf
except ImportError:
    suite.skip("no OpenUSD modules in this Python")

SAMPLE = 12  # of layers
SAMPLE_OF_STAGES = 5
LARGEST = {False: 300_000, True: 50_000_000}  # bytes, in a sample and with --all
BATCH = 40
OWN_STEP = 5  # one in so many of the layers of this project
OWN_SEEDS = range(600_000, 600_008)  # of random scenes


def layer_files(everything):
    found = []
    for folder, _, names in os.walk(suite.CONFORMANCE):
        for name in names:
            path = os.path.join(folder, name)
            if (name.endswith((".usda", ".usd", ".usdc")) and not os.path.islink(path)
                    and os.path.getsize(path) <= LARGEST[everything]):
                found.append(path)
    return sorted(found) if everything else sorted(found)[::SAMPLE]


def text_by_openusd(path):
    try:
        layer = Sdf.Layer.OpenAsAnonymous(path)
        return None if layer is None else layer.ExportToString()
    except Exception:  # pylint: disable=broad-except
        return None


def first_difference(expected, actual):
    if actual is None:
        return "OpenUSD does not read it"
    for number, pair in enumerate(zip(expected.split("\n"), actual.split("\n")), 1):
        if pair[0] != pair[1]:
            return f"line {number}: expected {pair[0][:120]!r}, actual {pair[1][:120]!r}"
    return None if expected == actual else "one text ends early"


def check(program, batch, folder, results):
    run = subprocess.run([program, folder, *batch], capture_output=True, text=True, check=False)
    verdicts = run.stdout.splitlines()
    if run.returncode != 0 or len(verdicts) != len(batch):
        sys.exit(f"{program} broke after {len(verdicts)} of {batch}:\n{run.stderr[-3000:]}")
    for number, (path, verdict) in enumerate(zip(batch, verdicts)):
        name = (suite.own_name(path) if path.startswith(suite.REPO + os.sep)
                else os.path.relpath(path, suite.CONFORMANCE))
        if verdict == "rejected":
            continue
        results.add("round trips: text, binary and back", name,
                    None if verdict == "equal" else verdict)
        expected = text_by_openusd(path)
        if expected is None:
            continue  # rejected by OpenUSD alone: a case for the tests of readers
        for suffix, label in ((".usda", "text"), (".usdc", "binary")):
            actual = text_by_openusd(os.path.join(folder, str(number)) + suffix)
            results.add(f"round trips: OpenUSD reads the {label} layers alike", name,
                        first_difference(expected, actual))


def rewrite(program, folder, made):
    """Replaces every layer below `folder` by the binary one that ROUND_TRIP makes of it."""
    layers = [os.path.join(inside, name) for inside, _, names in os.walk(folder)
              for name in names if name.endswith((".usd", ".usda"))]
    subprocess.run([program, made, *layers], capture_output=True, check=True)
    for number, path in enumerate(layers):
        binary = os.path.join(made, f"{number}.usdc")
        if os.path.exists(binary):
            os.remove(path)
            shutil.copyfile(binary, path)


def check_stages(program, tenon, everything, results):
    found = suite.cases("aousd_composition")
    for name, path in found if everything else found[::SAMPLE_OF_STAGES]:
        original = os.path.join(path, "usda", "root.usd")
        if os.path.exists(original):
            check_stage(program, tenon, name, original, results)


def check_own_stages(program, tenon, results):
    """Random scenes, whose layers have names that fit both forms."""
    for seed in OWN_SEEDS:
        with tempfile.TemporaryDirectory() as folder:
            inside = os.path.join(folder, "scene")
            os.mkdir(inside)
            scene = random_scenes.make_scene(seed)
            for name, text in random_scenes.texts(scene).items():
                with open(os.path.join(inside, name.replace(".usda", ".usd")), "w",
                          encoding="utf-8") as file:
                    file.write(text.replace(".usda", ".usd"))
            root = os.path.join(inside, "l0.usd")
            check_stage(program, tenon, f"own scene {seed}", root, results)


def check_stage(program, tenon, name, original, results):
    module = dump_stage.oracle_module()
    root = os.path.basename(original)
    with tempfile.TemporaryDirectory() as folder:
        copy, made = os.path.join(folder, "usda"), os.path.join(folder, "made")
        shutil.copytree(os.path.dirname(original), copy)
        for inside, _, _ in os.walk(copy):
            os.chmod(inside, 0o755)
        os.mkdir(made)
        rewrite(program, copy, made)
        cases = [dump_stage.Case(name, original),
                 dump_stage.Case(name + " rewritten", os.path.join(copy, root))]
        for side, dump in (
                ("tenon", lambda case: dump_stage.actual_dump(tenon, case)),
                ("OpenUSD", lambda case: dump_stage.expected_dump(module, case, made))):
            same = dump(cases[0]) == dump(cases[1])
            results.add(f"round trips: stages of binary layers dump alike, by {side}", name,
                        None if same else f"{side} dumps the rewritten stage otherwise")


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--all"]
    if len(arguments) != 2:
        sys.exit(__doc__)
    everything = "--all" in sys.argv
    files = layer_files(everything)
    results = suite.Results("round_trip_all" if everything else "round_trip")
    for start in range(0, len(files), BATCH):
        with tempfile.TemporaryDirectory() as folder:
            check(arguments[0], files[start:start + BATCH], folder, results)
    check_stages(*arguments, everything, results)
    own = suite.Results("own_round_trip")
    files = suite.own_layers(1 if everything else OWN_STEP)
    for start in range(0, len(files), BATCH):
        with tempfile.TemporaryDirectory() as folder:
            check(arguments[0], files[start:start + BATCH], folder, own)
    check_own_stages(*arguments, own)
    sys.exit(results.finish(is_whole=suite.HAS_PUBLISHED) | own.finish(is_whole=False))


if __name__ == "__main__":
    main()
