# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares `tenon dump` with the same dump made by OpenUSD: composed stages, prim by prim.
Needs Python with OpenUSD's modules.

usage: dump_stage.py TENON [--suite NAME]... [--keep FOLDER] [--show N]

Suites: own, examples, project (scenes of this project's other tests, and random ones of several
layers); where the folder named by TENON_SHARED_DIR (default: ../shared) is, also hand (every
Physics variant), scenes, and those of its conformance/cases.txt. Without --suite all of these but
some of the last run. Known misses are named in dump_misses.txt: one more or one less fails.
With --keep, expected dumps are kept in FOLDER and used again; --show prints N differences a case.
"""

import argparse
import json
import math
import multiprocessing
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
REPO = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "conformance"))
import suite as measured  # noqa: E402  pylint: disable=wrong-import-position

SHARED = measured.SHARED
MISSES = os.path.join(HERE, "dump_misses.txt")
PROJECT_STEP = 11  # one in so many of the project's layers
# Planted for a limit on purpose below OpenUSD's (docs/limits.md), so the dumps cannot agree.
PLANTED_FOR_LIMITS = ("compose.index-capacity-exceeded.usda",)
# Of random scenes, others than stage_random.py draws; OpenUSD passes its own checks on these.
PROJECT_SEEDS = range(500_006, 500_015)
STAGE_SUITES = ("openusd_usd", "mxpv_fixtures", "tinyusdz", "physics_parse", "openusd_other")
STAGE_SUITES += ("aousd_composition", "aousd_value_resolution", "aousd_binary")
OWN_OPTIONS = ("--stacks", "--builtins", "--xforms")
SESSION = '#usda 1.0\nover "%s" (variants = { string Physics = "%s" })\n{\n}\n'
SECONDS = 60
TOLERANCE = 1e-6
HALF_TOLERANCE = 2e-3
# Keys of a dump whose numbers are computed.
TOLERANT = {"interpolated", "splineSamples", "localToWorld"}


class Case:
    def __init__(self, name, path, options=("--stacks",), session=None):
        self.name, self.path, self.options, self.session = name, path, list(options), session


def session_file(folder, prim, variant):
    path = os.path.join(folder, f"session_{prim}_{variant}.usda")
    with open(path, "w", encoding="utf-8") as file:
        file.write(SESSION % (prim, variant))
    return path


def variant_cases(suite, path, prim, variants, folder):
    yield Case(f"{suite} {os.path.basename(path)}", path, OWN_OPTIONS)
    yield Case(f"{suite} {os.path.basename(path)}:unloaded", path, ["--stacks", "--no-payloads"])
    for variant in variants:
        name = f"{suite} {os.path.basename(path)}:{variant}"
        yield Case(name, path, OWN_OPTIONS, session_file(folder, prim, variant))


def own_cases(suite, folder):
    variants = ("none", "physics", "physx", "mujoco")
    if suite == "hand":
        path = os.path.join(SHARED, "assets", "inspire_hand_isaac", "inspire_hand.usda")
        return list(variant_cases(suite, path, "Lhand", variants, folder))
    if suite == "examples":
        root = os.path.join(REPO, "examples", "inspire_hand")
        path = os.path.join(root, "inspire_hand.usda")
        cases = list(variant_cases(suite, path, "inspire_hand", variants, folder))
        grasp = os.path.join(root, "grasp.usda")
        return cases + [Case("examples grasp.usda", grasp, OWN_OPTIONS)]
    scenes = (os.path.join(HERE, "scenes") if suite == "own" else os.path.join(SHARED, "scenes"))
    names = sorted(name for name in os.listdir(scenes) if name.endswith(".usda"))
    return [Case(f"{suite} {name}", os.path.join(scenes, name), OWN_OPTIONS) for name in names]


def project_cases(folder):
    """Layers of this project's tests, and random scenes of several layers, made in `folder`."""
    import random_scenes  # pylint: disable=import-outside-toplevel

    for path in measured.own_layers(PROJECT_STEP):
        if os.path.basename(path) in PLANTED_FOR_LIMITS:
            print(f"skipped {os.path.relpath(path, REPO)}: planted for a limit below OpenUSD's")
            continue
        yield Case("project " + os.path.relpath(path, REPO), path, OWN_OPTIONS)
    for seed in PROJECT_SEEDS:
        inside = os.path.join(folder, f"scene_{seed}")
        os.makedirs(inside, exist_ok=True)
        for name, text in random_scenes.texts(random_scenes.make_scene(seed)).items():
            with open(os.path.join(inside, name), "w", encoding="utf-8") as file:
                file.write(text)
        yield Case(f"project scene {seed}", os.path.join(inside, "l0.usda"))


def published_cases(suites):
    if not measured.HAS_PUBLISHED:
        return
    with open(os.path.join(SHARED, "conformance", "cases.txt"), encoding="utf-8") as file:
        rows = [line.rstrip("\n").split("\t") for line in file if not line.startswith("#")]
    for suite, name, path in (row for row in rows if len(row) == 3):
        if suite in suites:
            path = root_layer(os.path.join(SHARED, "conformance", path))
            if os.path.isfile(path) and path.endswith((".usd", ".usda", ".usdc", ".usdz")):
                yield Case(f"{suite} {name}", path)


def root_layer(path):
    """The layer to open where a case is a folder."""
    for name in ("root.usd", "entry.usd", "usda/root.usd"):
        if os.path.isdir(path) and os.path.isfile(os.path.join(path, name)):
            return os.path.join(path, name)
    return path


def oracle_module():
    """Needs OpenUSD's modules."""
    import openusd_stage  # pylint: disable=import-outside-toplevel

    return openusd_stage


def run_oracle(module, case, out):
    """In a process of its own, because OpenUSD keeps layers and may crash."""

    def child():
        sys.stderr = open(os.devnull, "w", encoding="utf-8")
        os.dup2(sys.stderr.fileno(), 2)
        arguments = [case.path, "-o", out] + case.options
        if case.session:
            arguments += ["--session", case.session]
        sys.exit(module.main(arguments))

    process = multiprocessing.get_context("fork").Process(target=child)
    process.start()
    process.join(SECONDS)
    if process.is_alive():
        process.kill()
    return process.exitcode


def expected_dump(module, case, folder):
    """The dump as text; None when OpenUSD rejects the file; raises LookupError when it fails."""
    out = os.path.join(folder, case.name.replace("/", "_").replace(" ", "_") + ".json")
    if not os.path.exists(out):
        code = run_oracle(module, case, out)
        if code != 0:
            with open(out, "w", encoding="utf-8") as file:
                file.write("rejected" if code == 3 else "failed")
    with open(out, "rb") as file:
        text = file.read().decode("utf-8", "surrogateescape")
    if text == "failed":
        raise LookupError
    return None if text == "rejected" else text


def actual_dump(tenon, case):
    """Exit status and text."""
    command = [tenon, "dump", case.path] + case.options
    if case.session:
        command += ["--session", case.session]
    try:
        run = subprocess.run(command, capture_output=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return -1, ""
    # 1: the dump is there, and something that the layers name is not.
    answered = run.returncode == 1 and run.stdout
    return 0 if answered else run.returncode, run.stdout.decode("utf-8", "surrogateescape")


def close(a, b, tolerance):
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(close(x, y, tolerance) for x, y in zip(a, b))
    if isinstance(a, float) and isinstance(b, float):
        return math.isclose(a, b, rel_tol=tolerance, abs_tol=tolerance)
    return a == b


def differences(expected, actual, where=""):
    """Places where two dumps differ; interpolated values and transforms within a tolerance."""
    if isinstance(expected, dict) and isinstance(actual, dict):
        if list(expected) != list(actual) and sorted(expected) == sorted(actual):
            yield f"{where}: order of keys: expected {list(expected)}, actual {list(actual)}"
        kind = str(expected.get("type", "")).removesuffix("[]")
        half = "half" in kind or kind.endswith("h")
        for key in expected.keys() | actual.keys():
            if key not in actual:
                yield f"{where}/{key}: missing"
            elif key not in expected:
                yield f"{where}/{key}: not expected: {json.dumps(actual[key])[:160]}"
            elif key in TOLERANT:
                if not close(expected[key], actual[key], HALF_TOLERANCE if half else TOLERANCE):
                    yield f"{where}/{key}: {expected[key]} != {actual[key]}"
            else:
                yield from differences(expected[key], actual[key], f"{where}/{key}")
    elif expected != actual or type(expected) is not type(actual):
        yield f"{where}: expected {json.dumps(expected)[:160]}, actual {json.dumps(actual)[:160]}"


def judge(module, tenon, case, folder):
    """What differs, as lines; empty when nothing does."""
    try:
        expected = expected_dump(module, case, folder)
    except LookupError:
        return None
    code, actual = actual_dump(tenon, case)
    if code < 0 or code > 2:
        return [f"tenon ended with {code}"]
    if expected is None or code != 0:
        accepted = {True: "accepts", False: "rejects"}
        if (expected is not None) == (code == 0):
            return []
        return [f"OpenUSD {accepted[expected is not None]}, tenon {accepted[code == 0]} it"]
    if expected == actual:
        return []
    return sorted(differences(json.loads(expected), json.loads(actual)))


def collect(suites, folder):
    cases = []
    for suite in ("own", "examples") + (("hand", "scenes") if measured.HAS_PUBLISHED else ()):
        if suite in suites:
            cases += own_cases(suite, folder)
    if "project" in suites:
        cases += project_cases(folder)
    return cases + list(published_cases(suites))


def known_misses(suites):
    return {name for name in measured.read_misses(MISSES) if name.split()[0] in suites}


def report(results, known, show, record_as=None, reasons=None):
    """Prints misses and counts; true when they are the known ones. `record_as`: the name of the
    record and what its rows count, when they are to be noted for CONFORMANCE.md; `reasons`: of the
    known misses."""
    missed = {name for name, lines in results.items() if lines}
    for name in sorted(missed - known if not show else missed):
        print(f"MISS {name}")
        for line in results[name][: max(show, 3)]:
            print(f"   {line}")
    for name in sorted(known & set(results) - missed):
        print(f"FIXED {name}: remove it from dump_misses.txt")
    figures = []
    for suite in sorted({name.split()[0] for name in results}):
        ran = [n for n, lines in results.items() if n.split()[0] == suite and lines is not None]
        equal = len([name for name in ran if name not in missed])
        figures.append((suite, equal, len(ran)))
        print(f"{suite}: {equal} of {len(ran)} equal")
    if record_as and measured.HAS_PUBLISHED:
        record, label = record_as
        rows = [(f"{label}: {suite}", equal, total) for suite, equal, total in figures
                if suite != "project"]
        measured.record(record, rows, {name: reasons[name] for name in missed & known})
    return not (missed - known) and not (known & set(results) - missed)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tenon")
    parser.add_argument("--suite", action="append")
    parser.add_argument("--keep")
    parser.add_argument("--show", type=int, default=0)
    arguments = parser.parse_args()
    try:
        import pxr  # noqa: F401  pylint: disable=unused-import,import-outside-toplevel
    except ImportError:
        print("skipped: no OpenUSD modules in this Python")
        return 77
    measured.forget("dump")
    suites = arguments.suite or ["own", "project", "hand", "scenes", "examples",
                                  *STAGE_SUITES]
    module = oracle_module()
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or temporary
        os.makedirs(folder, exist_ok=True)
        cases = collect(suites, folder)
        results = {c.name: judge(module, arguments.tenon, c, folder) for c in cases}
    record_as = None if arguments.suite else ("dump", "stage dumps")
    known, reasons = known_misses(suites), measured.read_misses(MISSES)
    return 0 if report(results, known, arguments.show, record_as, reasons) else 1


if __name__ == "__main__":
    sys.exit(main())
