#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the limits: each constant of tenon/base/limits is used and stands in docs/limits.md.

Exit 0: held; 1: each fault on a line of its own.
"""

import os
import re
import sys

import source_files

TABLE = re.compile(r"tenon/base/limits/(\w+_)?limits\.h")
PAGE = "docs/limits.md"
CONSTANT = re.compile(r"inline constexpr [\w:]+ (k\w+) = ([^;]+);")


def numeral(text):
    """1000 of `1000`, `10'000` or `1u << 20`."""
    text = re.sub(r"(?<=\d)u\b", "", text.replace("'", ""))
    left, _, right = text.partition("<<")
    return int(left) << int(right) if right else int(left)


def check(root, files):
    """-> faults of the project at `root`, whose files are `files`."""
    limits, faults = {}, []
    for table in filter(TABLE.fullmatch, files):
        with open(os.path.join(root, table), encoding="utf-8") as file:
            limits.update((name, (table, numeral(value)))
                          for name, value in CONSTANT.findall(file.read()))
    with open(os.path.join(root, PAGE), encoding="utf-8") as file:
        rows = dict(re.findall(r"^\| `(k\w+)` \| ([\d ]+) \|", file.read(), re.MULTILINE))
    used = set()
    for path in files:
        if path.startswith(("tenon/", "cli/", "worker/")) and not TABLE.fullmatch(path):
            if path.endswith(source_files.CODE):
                with open(os.path.join(root, path), encoding="utf-8") as file:
                    used.update(re.findall(r"limits::(k\w+)", file.read()))
    if not limits:
        faults.append("tenon/base/limits: no limits found")
    for name, (table, value) in limits.items():
        if name not in used:
            faults.append(f"{table}: {name} is not used")
        if name not in rows:
            faults.append(f"{PAGE}: no row for {name}")
        elif int(rows[name].replace(" ", "")) != value:
            faults.append(f"{PAGE}: {name} is {value}, not {rows[name]}")
    faults += [f"{PAGE}: {name} is no limit" for name in rows if name not in limits]
    return faults


def main():
    faults = check(source_files.ROOT, source_files.project_files())
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults of limits")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
