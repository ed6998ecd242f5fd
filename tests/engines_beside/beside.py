#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Small scenes of our own, stepped by tenon and by another engine, body by body.

usage: beside.py ENGINE PYTHON TENON PAGE [--only NAME...] [--show] [--write]

ENGINE: ovphysx or newton; PYTHON: one with that engine. A scene agrees where every body is at the
same place and turned the same way at the times and within the tolerances of its row, and `tenon
check --for` that engine is silent. Where a row names a difference, the two differ, the portability
rule that it names speaks alone, and without the property they agree. PAGE has a part with what came
of it, which --write makes anew. Exit 0: all is as the rows say and as the page has it; 1: not.
"""

import argparse
import json
import math
import multiprocessing.pool
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import page_part
import table
from row import NEWTON, OVPHYSX

HERE = pathlib.Path(__file__).resolve().parent
STEP = 0.001  # [s], of tenon, and of the engine where a row names no other
FRAMES = 20  # per second, of tenon's log; times of rows are multiples of 1 / FRAMES
NAMED = {OVPHYSX: ("ovphysx 0.7.0", "physx"), NEWTON: ("Newton 1.8.0", "newton")}
SILENT = 600  # [s] until an engine is given up


class Case:
    """A layer that is run: a row as it stands, or without what makes the difference."""

    def __init__(self, row, engine, folder, plain):
        self.row, self.plain = row, plain
        self.difference = row.differs.get(engine)
        self.name = row.name + (".without" if plain else "")
        self.path = pathlib.Path(folder) / f"{self.name}.usda"
        self.path.write_text(self.difference.without if plain else row.layer)
        self.tolerance = row.tolerance(engine)
        self.rules, self.own, self.other = [], {}, {}

    def expects_difference(self):
        return self.difference is not None and not self.plain

    def job(self):
        return json.dumps(
            {
                "file": str(self.path),
                "times": self.row.times,
                "moves": self.row.moves,
                "step": self.row.step,
            }
        )


def run_tenon(tenon, case, more=()):
    """-> {path: [position and orientation (x, y, z, w) at each time]} or {"error": words}"""
    words = [
        tenon,
        "sim",
        str(case.path),
        "--dt",
        str(STEP),
        "--fps",
        str(FRAMES),
        "--duration",
        str(max(case.row.times)),
        "-o",
        "-",
        "--format",
        "jsonl",
        *more,
    ]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    frames = [json.loads(line) for line in done.stdout.splitlines()]
    if done.returncode not in (0, 1) or not frames:
        return {"error": done.stderr.strip()[-300:]}
    found = {path: [] for path in frames[0]["bodies"]}
    for time in case.row.times:
        frame = frames[round(time * FRAMES)]
        assert abs(frame["time"] - time) < STEP / 2, (case.name, time, frame["time"])
        for path, state in frame["bodies"].items():
            turn = state["orientation"]
            found[path].append([*state["position"], *turn[1:], turn[0]])
    return found


def run_engine(engine, python, cases, log, folder=None):
    """The answers of the engine; its process is started anew where it dies."""
    waiting = list(cases)
    while waiting:
        process = subprocess.run(
            [python, "-B", str(HERE / f"run_{engine}.py")],
            input="".join(case.job() + "\n" for case in waiting),
            text=True,
            stdout=subprocess.PIPE,
            stderr=log,
            check=False,
            timeout=SILENT,
            cwd=folder or cases[0].path.parent,  # engines write logs where they are started
        )
        answers = [json.loads(line) for line in process.stdout.splitlines()]
        for case, answer in zip(waiting, answers):
            case.other = answer
        waiting = waiting[len(answers) :]
        if waiting:
            waiting.pop(0).other = {"error": f"the engine died, exit {process.returncode}"}


def rules_of(tenon, engine, cases):
    """The portability rules that speak on each case."""
    words = [
        tenon,
        "check",
        *(str(case.path) for case in cases),
        "--for",
        NAMED[engine][1],
        "--json",
    ]
    answer = json.loads(subprocess.run(words, capture_output=True, text=True, check=False).stdout)
    of = {case.path.name: case for case in cases}
    for finding in answer["diagnostics"]:
        if finding["rule"].startswith("portability."):
            of[pathlib.Path(finding["file"]).name].rules.append(finding["rule"])


def turn_between(a, b):
    """[degrees]"""
    size = math.dist(a, (0, 0, 0, 0)) * math.dist(b, (0, 0, 0, 0))
    return math.degrees(2 * math.acos(min(1, abs(sum(x * y for x, y in zip(a, b))) / size)))


def meters_per_unit(layer):
    return float(re.search(r"metersPerUnit = (\S+)", layer)[1])


class Apart:
    """How far two runs are apart: distance [m] and turn [degrees], each with body and time."""

    def __init__(self, case):
        self.error = next(
            (
                f"{who}: {run['error']}"
                for who, run in (("tenon", case.own), ("the engine", case.other))
                if "error" in run
            ),
            None,
        )
        self.metres, self.degrees, self.place, self.turn = 0, 0, None, None
        if self.error is None:
            self.measure(case)

    def measure(self, case):
        scale = meters_per_unit(case.row.layer)
        if not case.own or set(case.own) - set(case.other):
            self.error = f"other bodies: {sorted(case.own)} and {sorted(case.other)}"
            return
        for path in case.own:
            for time, a, b in zip(case.row.times, case.own[path], case.other[path]):
                if not all(map(math.isfinite, b)):
                    self.error = f"the engine: {path} is not finite at {time} s"
                    return
                distance, turn = math.dist(a[:3], b[:3]) * scale, turn_between(a[3:], b[3:])
                if distance >= self.metres:
                    self.metres, self.place = distance, (path, time, a[:3], b[:3])
                if turn >= self.degrees:
                    self.degrees, self.turn = turn, (path, time, a[3:], b[3:])

    def within(self, tolerance):
        return self.error is None and self.metres <= tolerance[0] and self.degrees <= tolerance[1]

    def __str__(self):
        return self.error or f"{1000 * self.metres:.3g} mm, {self.degrees:.2g} degrees apart"


def fault(case):
    """What is not as the row says; None where all is."""
    apart = Apart(case)
    if not case.expects_difference():
        if not apart.within(case.tolerance):
            return f"differs, and no rule is expected: {apart}; rules: {case.rules}"
        return f"agrees, but {case.rules} speak" if case.rules else None
    if apart.within(case.tolerance):
        return f"agrees ({apart}), but {case.difference.rule} is expected"
    if set(case.rules) != {case.difference.rule}:
        return f"{apart}; rules {case.rules}, expected {case.difference.rule} alone"
    return None


def all_cases(engine, folder, only):
    rows = [row for row in table.rows() if engine in row.engines and (not only or row.name in only)]
    cases = [Case(row, engine, folder, False) for row in rows]
    return cases, [Case(row, engine, folder, True) for row in rows if engine in row.differs]


def result(engine, cases, faults):
    differing = [case for case in cases if case.expects_difference()]
    words = f"{len(cases)} scenes beside {NAMED[engine][0]}: {len(cases) - len(differing)} equal"
    if differing:
        words += f", {len(differing)} differ, each named by a rule and equal without it"
    return f"{len(faults)} of {words}" if faults else words


def run_all(arguments, folder):
    """-> the cases, run and checked: rows as they stand, then those without what differs"""
    cases, plain = all_cases(arguments.engine, folder, arguments.only)
    both = cases + plain
    with multiprocessing.pool.ThreadPool(os.cpu_count()) as pool:
        owns = pool.map(lambda case: run_tenon(arguments.tenon, case), both)
    for case, own in zip(both, owns):
        case.own = own
    with open(pathlib.Path(folder) / "log.txt", "w", encoding="utf-8") as log:
        run_engine(arguments.engine, arguments.python, both, log)
    rules_of(arguments.tenon, arguments.engine, both)
    return cases, both


def held_page(page, engine, text, write):
    """What is wrong with the engine's part of the page; None where it is as it is to be."""
    part = re.compile(rf"(<!-- {engine}: made by .*? -->\n)(.*?)(<!-- end of {engine} -->)", re.S)
    old = page.read_text(encoding="utf-8")
    new = part.sub(lambda found: found[1] + text + found[3], old)
    if write:
        page.write_text(new, encoding="utf-8")
    if not part.search(old):
        return f"{page} has no part {engine}"
    return None if write or new == old else f"{page} is not what the run makes: --write"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("engine", choices=NAMED)
    parser.add_argument("python")
    parser.add_argument("tenon")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--only", nargs="*", help="these scenes; the page is left alone")
    parser.add_argument("--write", action="store_true", help="make the engine's part of the page")
    parser.add_argument("--show", action="store_true", help="tell every scene's distance")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cases, both = run_all(arguments, folder)
    faults = {case.name: words for case in both if (words := fault(case))}
    for case in both:
        if arguments.show or case.name in faults:
            print(
                f"{'FAULT' if case.name in faults else 'good '} {case.name:28} "
                f"{faults.get(case.name) or Apart(case)}"
            )
    if not arguments.only and not faults:
        text = page_part.text(NAMED[arguments.engine][0], [(case, Apart(case)) for case in cases])
        wrong = held_page(arguments.page, arguments.engine, text, arguments.write)
        if wrong:
            faults["the page"] = wrong
            print(wrong)
    print(result(arguments.engine, cases, faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
