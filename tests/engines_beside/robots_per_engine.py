#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Published robots on every engine of a build: 2 s from where their files start them.

usage: robots_per_engine.py ROOT TENON PAGE [--write] [--few]

The robots are those of tests/convert/ten_robots.py --all that convert, and the example hand; --few
takes the first rows alone and leaves the page as it is. Engines are those that `tenon doctor` calls
available. PAGE is what --write makes of it: finite, unstable, or refused, with the words of the
program. Exit 0: PAGE has what the runs gave, and every run ended in one of these ways; 1: not; 77:
the robots cannot be fetched.
"""

import argparse
import collections
import json
import multiprocessing.pool
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/convert"))

import ten_robots  # noqa: E402

SECONDS = 2
PATIENCE = 300  # [s] for one run
FEW = 3

HEAD = """# Robots per engine

Published robots, those of [ten_robots.py](../tests/convert/ten_robots.py), converted to USD and
run for {seconds} s from where their files start them, on every engine of the build. `make judge
ONLY=robots_per_engine` holds this page, `--write` of its script makes it.

Finite: no state left the finite numbers, and no energy came from nowhere. Unstable: the engine says
at which time, or its energy grew without a source. Refused: no model was made.

"""


def run(words, patience=PATIENCE):
    """-> exit code, the answer"""
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=patience)
    except subprocess.TimeoutExpired:
        return None, {}
    try:
        return done.returncode, json.loads(done.stdout)
    except json.JSONDecodeError:
        return done.returncode, {"diagnostics": [{"severity": "error", "message": done.stderr}]}


def engines_of(tenon):
    return [
        (each["name"], each["version"])
        for each in run([tenon, "doctor", "--json"])[1]["engines"]
        if each["available"]
    ]


def first_error(answer):
    for finding in answer.get("diagnostics", []):
        if finding["severity"] == "error":
            return finding["message"]
    return ""


def outcome(tenon, engine, asset):
    """-> "finite", or what went wrong, in few words"""
    code, answer = run(
        [tenon, "sim", asset, "--engine", engine, "--duration", str(SECONDS), "--json"]
    )
    words = first_error(answer)
    if code is None:
        return f"no end within {PATIENCE} s"
    if code in (0, 1) and not words:
        return "finite"
    if code == 3:
        time = re.search(r"at ([0-9.e-]+) s", words)
        return f"unstable at {float(time[1]):.2g} s" if time else f"unstable: {short(words)}"
    return f"refused: {short(words)}"


def short(words):
    """The first sentence, without paths of this machine."""
    return re.sub(r"/\S*/", "", words.split("; ")[0].split("\n")[0]).replace("|", "/")[:120]


class Robot:
    def __init__(self, tenon, name, source, folder, engines):
        self.tenon, self.name, self.source, self.engines = tenon, name, source, engines
        self.asset = folder / f"{abs(hash((name, str(source))))}.usdc"
        self.outcomes = None  # it does not convert

    def run(self):
        asset = self.source
        if self.source.suffix != ".usda":
            code, _ = run([self.tenon, "convert", self.source, self.asset, "--json"])
            if code not in (0, 1):
                return self
            asset = self.asset
        self.outcomes = [outcome(self.tenon, name, asset) for name, _ in self.engines]
        return self


def page_of(robots, engines):
    converted = [robot for robot in robots if robot.outcomes is not None]
    lines = HEAD.format(seconds=SECONDS)
    lines += "| engine | finite | unstable | refused |\n|---|---|---|---|\n"
    for i, (name, version) in enumerate(engines):
        count = collections.Counter(robot.outcomes[i].split()[0] for robot in converted)
        finite = count.pop("finite", 0)
        unstable = count.pop("unstable", 0)
        lines += f"| {name} {version} | {finite} | {unstable} | {sum(count.values())} |\n"
    lines += "\n| robot | " + " | ".join(name for name, _ in engines) + " |\n"
    lines += "|---|" + "---|" * len(engines) + "\n"
    for robot in converted:
        lines += f"| {robot.name} | " + " | ".join(robot.outcomes) + " |\n"
    left = len(robots) - len(converted)
    return lines + f"\n{left} more descriptions do not convert and are skipped.\n"


def names_of(rows, folder):
    """What rows are called: kinds for the first ones, paths below the folder for the others."""
    for name, path, _ in rows:
        path = pathlib.Path(path)
        relative = path.relative_to(folder) if path.is_relative_to(folder) else path
        yield (name if " " in name or "." not in name else str(relative)[-60:]), folder / relative


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--few", action="store_true")
    options = parser.parse_args()
    packages, why = ten_robots.make_packages(options.root)
    if packages is None:
        print(f"skipped: the robots cannot be fetched: {why}")
        return 77
    rows = ten_robots.rows_of(argparse.Namespace(all=not options.few, only=None), packages)
    rows = rows[:FEW] if options.few else rows
    engines = engines_of(options.tenon)
    with tempfile.TemporaryDirectory() as work:
        robots = [
            Robot(options.tenon, name, path, pathlib.Path(work), engines)
            for name, path in names_of(rows, packages)
        ]
        hand = options.root / "examples/inspire_hand/inspire_hand.usda"
        robots.append(Robot(options.tenon, "the example hand", hand, pathlib.Path(work), engines))
        with multiprocessing.pool.ThreadPool(os.cpu_count()) as pool:
            robots = pool.map(Robot.run, robots, 1)
    page = page_of(robots, engines)
    print(page[page.index("| engine") :] if options.few else page[page.index("| engine") :][:400])
    if options.few:
        return 0 if all(robot.outcomes for robot in robots) else 1
    if options.write:
        options.page.write_text(page, encoding="utf-8")
    same = options.page.exists() and options.page.read_text(encoding="utf-8") == page
    print(f"{len(robots)} robots on {len(engines)} engines" + ("" if same else ": --write"))
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
