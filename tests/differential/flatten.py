# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares flattened stages with UsdStage.Flatten, and flattened layer stacks with
UsdUtils.FlattenLayerStack: where their texts are not the same, the flattened layers are opened with
OpenUSD and dumped by openusd_stage.py. Needs Python with OpenUSD's modules.

usage: flatten.py FLATTEN [--suite NAME]... [--layer-stack] [--keep FOLDER] [--show N]

FLATTEN is the program tests/tools/flatten_files.cpp.
Suites are those of dump_stage.py; without --suite this project's scenes and the three published
ones that hold most rules, noted for CONFORMANCE.md. Known misses of whole stages would be named
in flatten_misses.txt: one more or less
fails. Exit 77: OpenUSD is absent.
"""

import argparse
import json
import multiprocessing
import os
import re
import shutil
import subprocess
import sys
import tempfile

import dump_stage

HERE = os.path.dirname(os.path.abspath(__file__))
SKIPPED = 77
BATCH = 60  # cases
MISSES = os.path.join(HERE, "flatten_misses.txt")
SUITES = ("project", "openusd_usd", "mxpv_fixtures", "aousd_composition")
PROTOTYPE = re.compile(r"/Flattened_Prototype_\d+")
# What names the file or its place, or counts what was composed.
OWN_KEYS = ("root", "layerStack", "usedLayers", "compositionErrors", "rootChildren", "stack")


def flatten_with_openusd(source, target, layer_stack):
    from pxr import Usd, UsdUtils  # pylint: disable=import-outside-toplevel

    stage = Usd.Stage.Open(source)
    if layer_stack:
        flat = UsdUtils.FlattenLayerStack(stage)
    else:
        flat = stage.Flatten(addSourceFileComment=False)
    flat.Export(target, args={"format": "usda"})


def dump(module, path):
    """The dump of a layer as an object; None when OpenUSD rejects it."""
    out = path + ".json"
    if module.main([path, "-o", out]) != 0:
        return None
    with open(out, encoding="utf-8", errors="surrogateescape") as file:
        return json.load(file)


def expected_and_actual(module, case, actual, folder, layer_stack):
    """Run in a child: both flattened layers as dumps, written to a file; [] when the texts are the
    same."""
    sys.stderr = open(os.devnull, "w", encoding="utf-8")
    os.dup2(sys.stderr.fileno(), 2)
    expected = os.path.join(folder, "expected.usda")
    try:
        flatten_with_openusd(case.path, expected, layer_stack)
    except Exception:  # pylint: disable=broad-except
        sys.exit(3)
    pair = []
    if text_of(expected) != text_of(actual):
        pair = [dump(module, expected), dump(module, actual)]
    with open(os.path.join(folder, "pair.json"), "w", encoding="utf-8",
              errors="surrogateescape") as file:
        json.dump(pair, file)
    sys.exit(0)


def text_of(path):
    """But for the numbers of prototypes."""
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8", errors="surrogateescape") as file:
        return PROTOTYPE.sub("/Flattened_Prototype", file.read())


def plain(value):
    """Without what differs by nature: names of files and numbers of prototypes."""
    if isinstance(value, dict):
        return {plain(k): plain(v) for k, v in value.items()
                if k not in OWN_KEYS and not PROTOTYPE.match(k)}
    if isinstance(value, list):
        return [plain(item) for item in value]
    return PROTOTYPE.sub("/Flattened_Prototype", value) if isinstance(value, str) else value


def judge(module, arguments, case, actual):
    """What differs, as lines; None when OpenUSD cannot flatten the file. `actual` is the file that
    FLATTEN wrote."""
    with tempfile.TemporaryDirectory() as folder:
        process = multiprocessing.get_context("fork").Process(
            target=expected_and_actual,
            args=(module, case, actual, folder, arguments.layer_stack))
        process.start()
        process.join(dump_stage.SECONDS)
        if process.is_alive():
            process.kill()
        pair = os.path.join(folder, "pair.json")
        if not os.path.exists(pair):
            return None
        with open(pair, encoding="utf-8", errors="surrogateescape") as file:
            dumps = json.load(file)
        if arguments.keep:
            keep(arguments.keep, case, os.path.join(folder, "expected.usda"), actual)
    if not dumps:
        return []
    expected, found = dumps
    if expected is None:
        return None
    if found is None:
        return ["OpenUSD does not read what tenon wrote"]
    return sorted(dump_stage.differences(plain(expected), plain(found)))


def judge_all(module, arguments, cases):
    """{name of a case: what differs}; FLATTEN does many at once: with sanitizers it takes long to
    start."""
    kind, results = "layer-stack" if arguments.layer_stack else "stage", {}
    for start in range(0, len(cases), BATCH):
        batch = cases[start:start + BATCH]
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([arguments.flatten, kind, folder, *(case.path for case in batch)],
                                  stderr=subprocess.PIPE, check=False,
                                  timeout=BATCH * dump_stage.SECONDS)
            if done.returncode != 0:
                sys.exit(f"{arguments.flatten} ended with {done.returncode} after "
                         f"{len(os.listdir(folder))} of {[case.name for case in batch]}:\n"
                         + done.stderr.decode("utf-8", "replace")[-3000:])
            for number, case in enumerate(batch):
                actual = os.path.join(folder, f"{number}.usda")
                results[case.name] = judge(module, arguments, case, actual)
    return results


def keep(target, case, *paths):
    os.makedirs(target, exist_ok=True)
    for name, path in zip(("expected", "actual"), paths):
        kept = case.name.replace("/", "_").replace(" ", "_") + f".{name}.usda"
        if os.path.exists(path):
            shutil.copyfile(path, os.path.join(target, kept))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("flatten")
    parser.add_argument("--suite", action="append")
    parser.add_argument("--layer-stack", action="store_true")
    parser.add_argument("--keep")
    parser.add_argument("--show", type=int, default=0)
    arguments = parser.parse_args()
    try:
        import pxr  # noqa: F401  pylint: disable=unused-import,import-outside-toplevel
    except ImportError:
        print("skipped: no OpenUSD modules in this Python")
        return SKIPPED
    dump_stage.TOLERANT.add("timeSamples")  # those of clips may lie between authored ones
    what = (("flatten_layer_stack", "flattened layer stacks") if arguments.layer_stack
            else ("flatten", "flattened stages"))
    dump_stage.measured.forget(what[0])
    suites = arguments.suite or list(SUITES)
    module = dump_stage.oracle_module()
    with tempfile.TemporaryDirectory() as folder:
        cases = dump_stage.collect(suites, folder)
        results = judge_all(module, arguments, cases)
    reasons = {} if arguments.layer_stack else dump_stage.measured.read_misses(MISSES)
    known = {name for name in reasons if name.split()[0] in suites}
    record_as = None if arguments.suite else what
    return 0 if dump_stage.report(results, known, arguments.show, record_as, reasons) else 1


if __name__ == "__main__":
    sys.exit(main())
