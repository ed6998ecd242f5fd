#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The same bytes at every run: every verb that answers about a file, on 29 files, on one processor
and on two, with and without random addresses (setarch -R).

    determinism.py ROOT TENON [--runs N] [--files N] [--verbs A,B] [--jobs N]

Each command is run N times in each of these four ways. Exit code, standard output, standard error
and the files that are written are compared with those of its first run. A row that fails on every
file is a fault, too: it compares one message. The whole takes 21 minutes of processor time.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from program import ROOT, TENON, verbs

# How each verb is run on FILE and its last prim, PRIM; what it writes is called out.*. A text: why
# it is not.
RUNS = {
    "add": [["add", "FILE", "PRIM/zz=xform", "--dry-run"]],
    "bake": [["bake", "FILE", "-o", "out.usda", "--duration", "0.05"],
             ["bake", "FILE", "-o", "out.glb", "--duration", "0.05"]],
    "bench": "prints times",
    "benchmark": [["benchmark", "FILE", "--json", "--tests", "ground_drop"]],
    "cat": [["cat", "FILE"], ["cat", "FILE", "-o", "out.usdc"],
            ["cat", "FILE", "--flatten", "-o", "out.usda"], ["cat", "FILE", "-o", "out.usdz"]],
    "check": [["check", "FILE", "--json"], ["check", "FILE", "-v"],
              ["check", "FILE", "--sarif", "out.sarif"]],
    "compare": [["compare", "FILE", "--duration", "0.05", "-o", "out.json"],
                ["compare", "FILE", "--duration", "0.05", "-o", "out.html"]],
    "completion": "is not about a file",
    "convert": [["convert", "FILE", "out.xml"], ["convert", "FILE", "out.urdf"],
                ["convert", "FILE", "out.sdf"], ["convert", "FILE", "out.srdf"],
                ["convert", "FILE", "out.py", "--format", "mjlab"]],
    "diff": [["diff", "FILE", "other.usda"], ["diff", "FILE", "other.usda", "--json"]],
    "doctor": "is about the machine",
    "drives": [["drives", "FILE", "--json"]],
    "dump": [["dump", "FILE"]],
    "dump-index": [["dump-index", "FILE"]],
    "explain": [["explain", "FILE", "PRIM", "--json"]],
    "help": "is not about a file",
    "inertia": [["inertia", "FILE", "--json"]],
    "info": [["info", "FILE", "--json"]],
    "manual": "is not about a file",
    "new": [["new", "out.usda"], ["new", "out.usdc"]],
    "colliders": [["colliders", "FILE", "--json"]],
    "pairs": [["pairs", "FILE", "--json"]],
    "pose": [["pose", "FILE", "--json"]],
    "physics": [["physics", "FILE"], ["physics", "FILE", "--json", "--geometry", "inline"],
                ["physics", "FILE", "--mass"]],
    "record": "pictures of a browser, which is another program",
    "remove": [["remove", "FILE", "PRIM", "--dry-run"]],
    "rename": [["rename", "FILE", "PRIM", "zz", "--dry-run"]],
    "report": [["report", "FILE", "--duration", "0.05", "-o", "out.html"]],
    "set": [["set", "FILE", "PRIM.zz=1", "--type", "int", "--dry-run"]],
    "sim": [["sim", "FILE", "--duration", "0.05", "--engine", engine, "-o", "out.csv",
             "--state-out", "out.state"] for engine in ("mujoco", "physx", "jolt")],
    "strip": [["strip", "FILE", "-o", "out.usda"]],
    "structure": [["structure", "FILE", "-o", "out.folder"]],
    "sweep": "is Python: python/tests", "excite": "is Python: python/tests/test_excite.py",
    "identify": "is Python: python/tests/test_identify.py",
    "test-runner": [["test-runner", "layer", "FILE"]],
    "tree": [["tree", "FILE", "--json"]],
    "tune": [["tune", "FILE", "-o", "out.json"], ["tune", "FILE", "-o", "out.html"]],
    "undo": "writes what the disk had: output.undo",
    "variant": [["variant", "FILE", "--json"]],
    "version": "is not about a file",
    "view": "serves pages until it is ended: live.*",
    "where": [["where", "FILE", "PRIM", "--json"]],
    "zip": [["zip", "FILE", "-o", "out.usdz"]],
}
FOLDERS = ("examples/scenes", "tests/physics/vendor_settings", "tests/check/scenes",
           "tests/physics/scenes")


def files(count):
    """The hand, and as many more of each folder as fit, always the same."""
    found = [ROOT / "examples/inspire_hand/inspire_hand.usda"]
    lists = [sorted((ROOT / folder).glob("*.usda")) for folder in FOLDERS]
    spread = [[paths[i * len(paths) // count] for i in range(min(count, len(paths)))]
              for paths in lists]
    for i in range(count):
        found += [paths[i] for paths in spread if i < len(paths)]
    return list(dict.fromkeys(found))[:count]


def last_prim(file):
    """The path of the last prim of an asset; "/" where it has none."""
    done = subprocess.run([TENON, "tree", file, "--json"], capture_output=True, text=True,
                          check=False)
    prims = json.loads(done.stdout).get("prims") or [{"path": "/"}]
    return prims[-1]["path"]


def filled(words, file, prim):
    return [str(file) if word == "FILE" else word.replace("PRIM", prim) for word in words]


def ways():
    """-> (name, words before the program) of each way to start it."""
    own = sorted(os.sched_getaffinity(0))
    for addresses in ([], ["setarch", "-R"]):
        for count in (1, 2):
            cores = ",".join(map(str, own[:count]))
            name = " ".join([f"{count} processors", *addresses])
            yield name, ["taskset", "-c", cores, *addresses]


def result(words, before, folder):
    for old in folder.glob("out.*"):
        shutil.rmtree(old) if old.is_dir() else old.unlink()
    done = subprocess.run([*before, TENON, *words], cwd=folder, capture_output=True, check=False,
                          env={**os.environ, "XDG_STATE_HOME": str(folder / "state")}, timeout=300)
    made = {str(path.relative_to(folder)): path.read_bytes()
            for out in sorted(folder.glob("out.*"))
            for path in ([out] if out.is_file() else sorted(out.rglob("*"))) if path.is_file()}
    return done.returncode, done.stdout, done.stderr, made


def differs(first, other):
    for name, one, two in zip(("exit code", "standard output", "standard error", "files"), first,
                              other):
        if one != two:
            return name


def told_of(words, runs):
    """-> (exit code, what is not as at the first run and of which way to start it)."""
    first, told = None, {}
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        shutil.copy(ROOT / "examples/scenes/joint.usda", folder / "other.usda")
        for name, before in list(ways()) * runs:
            found = result(words, before, folder)
            first = first or found
            what = differs(first, found)
            if what:
                told[f"{what} ({name})"] = None
    return first[0], list(told)


def rows(chosen):
    for verb in verbs():
        own = RUNS[verb] if verb in (chosen or RUNS) else ""
        yield from [] if isinstance(own, str) else own


def compared(files, rows, options):
    """Runs all rows on all files. -> commands, those with other bytes, rows that fail always."""
    commands = [(row, filled(row, file, prim)) for file in files
                for prim in [last_prim(file)] for row in rows]
    faults, failing = 0, {" ".join(row) for row in rows}
    with ThreadPoolExecutor(options.jobs) as pool:
        found = pool.map(lambda each: told_of(each[1], options.runs), commands)
        for (row, words), (code, told) in zip(commands, found):
            faults += bool(told)
            if code in (0, 1):
                failing.discard(" ".join(row))
            for fault in told:
                print(f"{' '.join(words)}: other {fault}", flush=True)
    return len(commands), faults, sorted(failing)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root")
    parser.add_argument("tenon")
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--files", type=int, default=29)
    parser.add_argument("--verbs", default="")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    chosen = [verb for verb in options.verbs.split(",") if verb]
    unknown = [verb for verb in verbs() if verb not in RUNS]
    if unknown:
        print("no row in RUNS: " + ", ".join(unknown))
        return 1
    commands, faults, failing = compared(files(options.files), list(rows(chosen)), options)
    for row in failing:
        print(f"fails on every file: {row}")
    runs = len(list(ways())) * options.runs
    print(f"{commands} commands on {options.files} files, {runs} runs of each, {faults} with other "
          f"bytes, {len(failing)} rows that always fail")
    return 1 if faults or failing or not commands else 0


if __name__ == "__main__":
    sys.exit(main())
