#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds CONFORMANCE.md to what the tests measured.

usage: make_table.py MEASURED_DIR [--write]

MEASURED_DIR holds the records of suite.py. Every suite that left one must have the same rows and the
same known misses in CONFORMANCE.md; suites that skipped are not looked at. --write puts in what was
measured, keeps the rest, and lowers limits. Without OpenUSD or the published material nothing is measured: exit 77.
Before that, with nothing but this repository: every list of known misses has at most as many lines
as miss_limits.json allows, and each line a reason. The limits may only fall.
"""

import glob
import json
import os
import re
import sys

import suite

HERE = os.path.dirname(os.path.abspath(__file__))
REPO = os.path.dirname(os.path.dirname(HERE))
DOCUMENT = os.path.join(REPO, "CONFORMANCE.md")
LIMITS = os.path.join(HERE, "miss_limits.json")


def read_records(folder):
    """{suite: record}"""
    records = {}
    for path in sorted(glob.glob(os.path.join(folder, "*.json"))):
        with open(path, encoding="utf-8") as file:
            record = json.load(file)
        records[record["suite"]] = record
    return records


def section(text, name):
    """(before, rows, after) of the part between the marks of `name`."""
    found = re.search(rf"(.*<!-- {name}: .*? -->\n)(.*?)(<!-- end of {name} -->.*)", text, re.S)
    if found is None:
        sys.exit(f"CONFORMANCE.md has no part <!-- {name}: ... --> <!-- end of {name} -->")
    return found[1], found[2], found[3]


def figure_rows(record):
    return [f"| {row['label']} | {row['passed']} | {row['total']} | {record['suite']} |"
            for row in record["rows"]]


def miss_rows(record):
    return [f"| {name} | {reason} | {record['suite']} |"
            for name, reason in sorted(record["misses"].items())]


def suite_of(row):
    return row.rstrip(" |").rsplit("| ", 1)[-1]


def updated(rows, records, make_rows):
    """The rows of a table with those of the measured suites replaced, in their order."""
    lines = rows.splitlines()
    head, body = lines[:2], lines[2:]
    order = list(dict.fromkeys([suite_of(row) for row in body] + sorted(records)))
    result = head
    for name in order:
        result += (make_rows(records[name]) if name in records
                   else [row for row in body if suite_of(row) == name])
    return "\n".join(result) + "\n"


def with_measured(text, records):
    for name, make_rows in (("figures", figure_rows), ("misses", miss_rows)):
        before, rows, after = section(text, name)
        text = before + updated(rows, records, make_rows) + after
    return text


def read_limits():
    with open(LIMITS, encoding="utf-8") as file:
        return json.load(file)


def miss_lists():
    """{name of a list: its misses}"""
    paths = glob.glob(os.path.join(REPO, "tests", "**", "*misses*.txt"), recursive=True)
    paths += glob.glob(os.path.join(REPO, "tests", "**", "misses", "*.txt"), recursive=True)
    return {os.path.relpath(path, REPO): suite.read_misses(path) for path in set(paths)}


def lower_limits():
    lists, limits = miss_lists(), read_limits()
    lowered = {name: min(limit, len(lists.get(name, ()))) for name, limit in limits.items()}
    with open(LIMITS, "w", encoding="utf-8") as file:
        json.dump({name: limit for name, limit in lowered.items() if limit}, file, indent=1,
                  sort_keys=True)
        file.write("\n")


def limit_faults():
    faults, names, limits = [], miss_lists(), read_limits()
    for name, lines in sorted(names.items()):
        limit = limits.get(name, 0)
        if len(lines) > limit:
            faults.append(f"{name}: {len(lines)} known misses, at most {limit} are allowed")
        elif len(lines) < limit:
            faults.append(f"{name}: {len(lines)} known misses: lower its limit in {LIMITS}")
        faults += [f"{name}: no reason: {line}" for line, reason in lines.items() if not reason]
    faults += [f"{name}: no such list, but it has a limit" for name in sorted(set(limits) - set(names))]
    return faults


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if "--write" in sys.argv:
        lower_limits()
    faults = limit_faults()
    for fault in faults:
        print(fault)
    records = read_records(sys.argv[1])
    with open(DOCUMENT, encoding="utf-8") as file:
        text = file.read()
    measured = with_measured(text, records)
    if "--write" in sys.argv:
        with open(DOCUMENT, "w", encoding="utf-8") as file:
            file.write(measured)
    elif measured != text:
        for line in sorted(set(measured.splitlines()) - set(text.splitlines())):
            print(f"measured: {line}")
        for line in sorted(set(text.splitlines()) - set(measured.splitlines())):
            print(f"CONFORMANCE.md: {line}")
        print(f"make it anew: {' '.join(sys.argv[:2])} --write")
        faults.append("table")
    print(f"{len(records)} suites measured: {' '.join(records)}")
    sys.exit(1 if faults else 0 if records else suite.SKIPPED)


if __name__ == "__main__":
    main()
