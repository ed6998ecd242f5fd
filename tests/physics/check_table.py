#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds docs/physics-conformance.md, the table of the numbered rules of physics, to the tree.

usage: check_table.py [--write]

The table is made of tests/physics/conformance.txt and of the golden cases, which name the rules
that they show in "about". A fault: a number without a row, a file or a test that does not exist, a
row that is done without a test, a golden case that names an unknown number, another count of rows
that are not done than the file says, a table that is not up to date (--write makes it).
"""

import json
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DATA = "tests/physics/conformance.txt"
TABLE = "docs/physics-conformance.md"
GOLDEN = "tests/golden/physics"
NUMBERS = {"S": 124, "M": 21, "Q": 14, "E": 137}
STATUS = ("done", "partly", "not yet")
TITLES = {"S": "Rules of reading", "M": "Mass properties", "Q": "The seven published scenes",
          "E": "Scenes"}
HEAD = """# Physics: conformance

One row per numbered rule: S for reading, M for mass properties, Q for findings on the seven
published UsdPhysics examples, E for scenes that show one idea each. Written by
`tests/physics/check_table.py` from `tests/physics/conformance.txt`; the test `check.physics_table`
holds it to the tree. A test named `like_this` is a case of `tests/golden/physics`, one named
`Suite.Case` a unit test or a run, one named `check.like_this` a script that ctest runs.
"""


def numbers_in(text):
    """The numbers that `about` names, "S-105..S-107" included."""
    found = []
    pattern = r"\b([SMQE])-(\d+)(?:\.\.\1-(\d+))?"
    for letter, first, last in re.findall(pattern, text):
        found += [f"{letter}-{n}" for n in range(int(first), int(last or first) + 1)]
    return found


def golden_cases():
    """-> {number: [case, ...]}"""
    cases = {}
    folder = os.path.join(ROOT, GOLDEN)
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name, "expected.json"), encoding="utf-8") as file:
            for number in numbers_in(json.load(file)["about"]):
                cases.setdefault(number, []).append(name)
    return cases


def test_names():
    """Unit tests as Suite.Case, and scripts that ctest runs by their name."""
    names = set()
    for place in ("tenon", "cli", "tests"):
        for folder, _, files in os.walk(os.path.join(ROOT, place)):
            for name in files:
                if name.endswith("_test.cpp"):
                    with open(os.path.join(folder, name), encoding="utf-8") as file:
                        names |= set(".".join(pair) for pair in re.findall(
                            r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", file.read(), re.MULTILINE))
                elif name == "CMakeLists.txt":
                    with open(os.path.join(folder, name), encoding="utf-8") as file:
                        names |= set(re.findall(r"^ *tenon_check\(([\w.]+) ", file.read(),
                                                re.MULTILINE))
    return names


def read_rows(path):
    """-> ([row, ...], count of rows that are not done)"""
    rows, count = [], -1
    with open(path, encoding="utf-8") as file:
        for line in file:
            line = line.strip()
            if not line or line.startswith("#"):
                continue
            if line.startswith("not done:"):
                count = int(line.partition(":")[2])
                continue
            number, status, where, rule, *more = [part.strip() for part in line.split(" | ")]
            row = {"number": number, "status": status, "where": where, "rule": rule,
                   "missing": "", "tests": []}
            for part in more:
                key, _, value = part.partition(": ")
                row[key] = value.split() if key == "tests" else value
            rows.append(row)
    return rows, count


def place_of(row):
    return row["where"] if "/" in row["where"] or row["where"] == "cli" \
        else "tenon/physics/" + row["where"]


def faults_of(rows, count, cases, units):
    numbers = [row["number"] for row in rows]
    wanted = [f"{letter}-{n}" for letter, last in NUMBERS.items() for n in range(1, last + 1)]
    for number in wanted:
        if numbers.count(number) != 1:
            yield f"{number}: {numbers.count(number)} rows"
    for number in sorted((set(numbers) | set(cases)) - set(wanted)):
        yield f"{number}: no such number {cases.get(number, '')}"
    for row in rows:
        if row["status"] not in STATUS:
            yield f"{row['number']}: status `{row['status']}`"
        if not os.path.exists(os.path.join(ROOT, place_of(row))):
            yield f"{row['number']}: no file {place_of(row)}"
        for test in row["tests"]:
            if test not in units:
                yield f"{row['number']}: no test {test}"
        if row["status"] == "done" and not row["tests"] and row["number"] not in cases:
            yield f"{row['number']}: done without a test"
        if (row["status"] == "done") == bool(row["missing"]):
            yield f"{row['number']}: done says nothing missing, the others do"
    open_rows = sum(row["status"] != "done" for row in rows)
    if open_rows != count:
        yield f"{DATA}: {open_rows} rows are not done, the file says {count}"


def table(rows, cases):
    lines = [HEAD]
    counts = {status: sum(row["status"] == status for row in rows) for status in STATUS}
    lines.append(f"{len(rows)} rows: " + ", ".join(f"{n} {s}" for s, n in counts.items()) + ".")
    for letter, title in TITLES.items():
        lines += ["", f"## {title}", "", "| number | rule | file | tests | status |",
                  "|---|---|---|---|---|"]
        for row in rows:
            if row["number"].startswith(letter):
                tests = cases.get(row["number"], []) + row["tests"]
                status = row["status"] + (f": {row['missing']}" if row["missing"] else "")
                lines.append(f"| {row['number']} | {row['rule']} | `{place_of(row)}` | "
                             + ", ".join(f"`{test}`" for test in tests) + f" | {status} |")
    return "\n".join(line.rstrip() for line in lines) + "\n"


def main():
    rows, count = read_rows(os.path.join(ROOT, DATA))
    cases = golden_cases()
    faults = list(faults_of(rows, count, cases, test_names()))
    text = table(rows, cases)
    path = os.path.join(ROOT, TABLE)
    if "--write" in sys.argv[1:]:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    elif not os.path.exists(path) or open(path, encoding="utf-8").read() != text:
        faults.append(f"{TABLE} is not up to date: run tests/physics/check_table.py --write")
    for fault in faults:
        print(fault)
    print(f"{len(rows)} rows, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
