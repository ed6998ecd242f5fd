#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Published robots that their drives are to hold for 5 s, on every engine of a build.

usage: robots_hold.py ROOT TENON PAGE MISSES [--write] [--few]

The robots are the URDFs of tests/convert/ten_robots.py --all, converted with a fixed base and gains
for all joints, and run from where they start, which is where their drives are to hold them; --few
takes the first rows alone and leaves the page as it is. A joint holds where it ends within 1 degree
or 1 mm of its start, which makes engines agree to twice that; one that does not has to be named by
a finding of the run. A joint that ends elsewhere without a finding is silent: MISSES names the runs
that have one, and may only shrink. Exit 0: PAGE has what the runs gave, and silent are those of
MISSES; 1: not; 77: the robots cannot be fetched.
"""

import argparse
import multiprocessing.pool
import os
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/convert"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import ten_robots  # noqa: E402
from robots_per_engine import engines_of, first_error, names_of, run  # noqa: E402

SECONDS = 5
GAINS = "300,20"
DEGREES, METRES = 1.0, 0.001

HEAD = """# Robots that hold still

Published robots as URDF, those of [ten_robots.py](../tests/convert/ten_robots.py), converted with
`--fix-base --gains {gains}` and run for {seconds} s from where they start, on every engine of the
build. Their drives are to hold them there. `make judge ONLY=robots_hold` holds this page, `--write`
of its script makes it.

- *holds*: every joint ends within 1 degree or 1 mm of its start.
- *told*: each joint that does not is named by a finding of the run, or the run ends with an error.
- *silent*: a joint ends elsewhere, and no finding names it.

"""


class Outcome:
    """What became of one robot on one engine."""

    def __init__(self, verdict, words=""):
        self.verdict, self.words = verdict, words

    def text(self):
        return self.verdict + (f": {self.words}" if self.words else "")


def named_by(answer):
    """Joint -> rule of a finding that says why it does not stay where it starts."""
    found = {}
    for finding in answer.get("diagnostics", []):
        if not finding["rule"].startswith(("sim.", "joint.outside-limit")):
            continue
        for prim in [finding.get("prim"), *(r.get("path") for r in finding.get("related", []))]:
            if prim:
                found.setdefault(prim, finding["rule"])
    return found


def distances(answer):
    """Joint -> how far its coordinates end from zero, where a URDF starts."""
    return {
        path: max(map(abs, state["position"]))
        for path, state in answer.get("joints", {}).items()
        if state["position"]
    }


def joints(found):
    return "1 joint" if len(found) == 1 else f"{len(found)} joints"


def outcome(tenon, engine, asset, slides):
    """`slides`: the joints whose coordinates are metres."""
    words = [tenon, "sim", asset, "--engine", engine, "--json", "--duration"]
    code, answer = run([*words, str(SECONDS)])
    if code != 0:
        return Outcome("told", first_error(answer).split(";")[0][:100] or f"exit code {code}")
    named, moved = named_by(answer), {}
    for path, away in distances(answer).items():
        if away > (METRES if path in slides else DEGREES):
            moved[path] = away
    silent = {path: away for path, away in moved.items() if path not in named}
    if silent:
        worst = max(silent, key=silent.get)
        name = worst.rsplit("/", 1)[1]
        return Outcome("silent", f"{joints(silent)}, {name} {silent[worst]:.3g}")
    if moved:
        rules = sorted({named[path] for path in moved})
        return Outcome("told", f"{joints(moved)}, " + ", ".join(rules))
    return Outcome("holds")


class Robot:
    def __init__(self, tenon, name, source, folder, engines):
        self.tenon, self.name, self.source, self.engines = tenon, name, source, engines
        self.asset = folder / f"{abs(hash((name, str(source))))}.usdc"
        self.outcomes = None  # it does not convert

    def run(self):
        words = ["--fix-base", "--gains", GAINS, "--json"]
        code, _ = run([self.tenon, "convert", self.source, self.asset, *words])
        if code not in (0, 1):
            return self
        _, scene = run([self.tenon, "physics", self.asset, "--json"])
        slides = {joint["path"] for joint in scene["joints"] if joint["type"] == "prismatic"}
        self.outcomes = [
            outcome(self.tenon, name, self.asset, slides) for name, _ in self.engines
        ]
        return self


def page_of(robots, engines):
    converted = [robot for robot in robots if robot.outcomes is not None]
    lines = HEAD.format(seconds=SECONDS, gains=GAINS)
    lines += "| engine | holds | told | silent |\n|---|---|---|---|\n"
    for i, (name, version) in enumerate(engines):
        verdicts = [robot.outcomes[i].verdict for robot in converted]
        counts = " | ".join(str(verdicts.count(each)) for each in ("holds", "told", "silent"))
        lines += f"| {name} {version} | {counts} |\n"
    lines += "\n| robot | " + " | ".join(name for name, _ in engines) + " |\n"
    lines += "|---|" + "---|" * len(engines) + "\n"
    for robot in converted:
        cells = [each.text().replace("|", "/") for each in robot.outcomes]
        lines += f"| {robot.name} | " + " | ".join(cells) + " |\n"
    left = len(robots) - len(converted)
    return lines + f"\n{left} more descriptions do not convert and are skipped.\n"


def silent_runs(robots, engines):
    return sorted(
        f"{robot.name} {name}"
        for robot in robots
        for (name, _), each in zip(engines, robot.outcomes or [])
        if each.verdict == "silent"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("misses", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--few", action="store_true")
    options = parser.parse_args()
    packages, why = ten_robots.make_packages(options.root)
    if packages is None:
        print(f"skipped: the robots cannot be fetched: {why}")
        return 77
    rows = ten_robots.rows_of(argparse.Namespace(all=not options.few, only=None), packages)
    rows = [row for row in rows if str(row[1]).endswith(".urdf")][: 3 if options.few else None]
    engines = engines_of(options.tenon)
    with tempfile.TemporaryDirectory() as work:
        robots = [
            Robot(options.tenon, name, path, pathlib.Path(work), engines)
            for name, path in names_of(rows, packages)
        ]
        with multiprocessing.pool.ThreadPool(os.cpu_count()) as pool:
            robots = pool.map(Robot.run, robots, 1)
    page, silent = page_of(robots, engines), silent_runs(robots, engines)
    print(page[page.index("| engine") :])
    if options.few:
        return 0 if all(robot.outcomes for robot in robots) else 1
    if options.write:
        options.page.write_text(page, encoding="utf-8")
    same = options.page.exists() and options.page.read_text(encoding="utf-8") == page
    lines = options.misses.read_text(encoding="utf-8").splitlines()
    known = sorted(line for line in lines if line and not line.startswith("#"))
    for run_name in sorted(set(silent) ^ set(known)):
        print(run_name, "is silent" if run_name in silent else "is no longer silent: take it out")
    print(f"{len(robots)} robots on {len(engines)} engines" + ("" if same else ": --write"))
    return 0 if same and silent == known else 1


if __name__ == "__main__":
    sys.exit(main())
