#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The same bytes at every run: every verb that answers about a file, on 29 files, on one processor
and on two, with and without random addresses (setarch -R).

    determinism.py ROOT TENON [--runs N] [--files N] [--verbs A,B]

Exit code, standard output, standard error and the files that are written are compared. The first
run of a command is what the others are compared with.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

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
    """-> (name, words before the program, processors) of each way to start it."""
    own = sorted(os.sched_getaffinity(0))
    plain = [[]] + ([["setarch", "-R"]] if shutil.which("setarch") else [])
    for words in plain:
        for count in sorted({1, min(2, len(own))}):
            yield f"{count} processors{' '.join(['', *words])}", words, own[:count]


def result(words, before, processors, folder):
    for old in folder.glob("out.*"):
        shutil.rmtree(old) if old.is_dir() else old.unlink()
    done = subprocess.run([*before, TENON, *words], cwd=folder, capture_output=True, check=False,
                          preexec_fn=lambda: os.sched_setaffinity(0, processors), timeout=300)
    made = {str(path.relative_to(folder)): path.read_bytes()
            for out in sorted(folder.glob("out.*"))
            for path in ([out] if out.is_file() else sorted(out.rglob("*"))) if path.is_file()}
    return done.returncode, done.stdout, done.stderr, made


def differs(first, other):
    for name, one, two in zip(("exit code", "standard output", "standard error", "files"), first,
                              other):
        if one != two:
            return name


def faults_of(words, runs, folder):
    """What is not as at the first run, and of which way to start it."""
    first, told = None, {}
    starts = list(ways())
    for i in range(runs):
        name, before, processors = starts[i % len(starts)]
        found = result(words, before, processors, folder)
        first = first or found
        what = differs(first, found)
        if what:
            told.setdefault(f"{what} ({name})")
    return list(told)


def rows(chosen):
    for verb in verbs():
        own = RUNS[verb] if verb in (chosen or RUNS) else ""
        yield from [] if isinstance(own, str) else own


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root")
    parser.add_argument("tenon")
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--files", type=int, default=29)
    parser.add_argument("--verbs", default="")
    options = parser.parse_args()
    chosen = [verb for verb in options.verbs.split(",") if verb]
    unknown = [verb for verb in verbs() if verb not in RUNS]
    if unknown:
        print("no row in RUNS: " + ", ".join(unknown))
        return 1
    runs = faults = commands = 0
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        os.environ["XDG_STATE_HOME"] = str(folder / "state")
        shutil.copy(ROOT / "examples/scenes/joint.usda", folder / "other.usda")
        for file in files(options.files):
            prim = last_prim(file)
            for words in rows(chosen):
                words = filled(words, file, prim)
                told = faults_of(words, options.runs, folder)
                commands, runs = commands + 1, runs + options.runs
                faults += bool(told)
                for fault in told:
                    print(f"{' '.join(words)}: other {fault}", flush=True)
    print(f"{commands} commands on {options.files} files, {runs} runs, {faults} with other bytes")
    return 1 if faults or not commands else 0


if __name__ == "__main__":
    sys.exit(main())
