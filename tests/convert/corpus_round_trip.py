#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Published MJCF models through USD and back, compared as MuJoCo compiles them, field by field.

    corpus_round_trip.py ROOT TENON [--all] [--table] [FOLDER...]

The models are those of the packages in build/robots (tests/convert/ten_robots.py makes it), an even
choice of 40 of them unless --all asks for every one, and all below further folders. --table prints
a line for each file: equal, different with the names of the fields, or refused with the reason.
Good when 90 % of the models that MuJoCo itself compiles are equal. No file of others is kept.
"""

import concurrent.futures
import os
import pathlib
import subprocess
import sys
import tempfile

import round_trip
from round_trip import ROOT, TENON, mujoco

CHOSEN = 40
LEAST_EQUAL = 0.9
SECONDS = 300  # for one file


def models_below(folder):
    """Files that begin a model; parts that others include have another root element or none."""
    found = []
    for path in sorted(pathlib.Path(folder).rglob("*.xml")):
        if "<mujoco" in path.read_text(encoding="utf-8", errors="replace")[:20000]:
            found.append(path)
    return found


def compiled(path):
    try:
        return mujoco.MjModel.from_xml_path(str(path))
    except ValueError as error:
        return " ".join(str(error).split())[:150]


def converted(source, target):
    """The reason why there is no `target`; None: there is."""
    try:
        scene = ["--scene"] if target.suffix == ".usda" else []
        process = subprocess.run([TENON, "convert", source, target, "--force", "-q", *scene],
                                 capture_output=True, text=True, check=False, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return f"takes more than {SECONDS} s"
    if target.exists():
        return None
    lines = process.stderr.strip().splitlines()
    return lines[-1][:150] if lines else f"exit code {process.returncode}"


def judge(source):
    """(what became of a model, more about it)"""
    before = compiled(source)
    if isinstance(before, str):
        return "no model", before
    with tempfile.TemporaryDirectory() as folder:
        asset, back = pathlib.Path(folder) / "asset.usda", pathlib.Path(folder) / "back.xml"
        reason = converted(source, asset) or converted(asset, back)
        if reason:
            return "refused", reason
        after = compiled(back)
        if isinstance(after, str):
            return "not loaded", after
        differences = round_trip.model_differences(before, after)
    return ("different", ", ".join(differences)) if differences else ("equal", "")


def main():
    words = sys.argv[3:]
    models = models_below(ROOT / "build/robots")
    if not models:
        print("skipped: there are no published models in build/robots")
        return 77
    if "--all" not in words and len(models) > CHOSEN:
        models = [models[i * len(models) // CHOSEN] for i in range(CHOSEN)]
    for folder in words:
        models += [] if folder.startswith("--") else models_below(folder)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(judge, models))
    counts = {}
    for path, (result, more) in zip(models, results):
        counts[result] = counts.get(result, 0) + 1
        if "--table" in words or result not in ("equal", "no model"):
            print(f"{result}: {path}: {more}")
    total = len(models) - counts.get("no model", 0)
    equal = counts.get("equal", 0)
    said = ", ".join(f"{count} {result}" for result, count in sorted(counts.items()))
    print(f"MJCF through USD and back: {equal} of {total} models compile to the same; {said}")
    return 0 if total > 0 and equal >= LEAST_EQUAL * total else 1


if __name__ == "__main__":
    sys.exit(main())
