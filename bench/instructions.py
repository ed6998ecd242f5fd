#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Counts the instructions of small rows of work and holds them to bench/results/instructions.json.

usage: instructions.py PROGRAM [--record] [ROW...]
PROGRAM is built with the preset `release`. Exit 0: no row took 5 % more than recorded; 1: one did;
77: another compiler, C library or valgrind than the record's, which count otherwise.
Who makes a row slower on purpose records it anew, in the same commit, and says why there.
"""

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile

import command_rows
import machine

RECORD = os.path.join(command_rows.BENCH, "results/instructions.json")
GROWTH = 0.05
SKIPPED = 77
# One name, so that no path is longer at one run than at another.
WORK = os.path.join(tempfile.gettempdir(), "tenon_instructions_work")


def circumstances(program):
    """What the counts depend on beside the code."""
    build = os.path.dirname(os.path.dirname(os.path.abspath(program)))
    compiler = machine.cache_entry(build, "CMAKE_CXX_COMPILER")
    return {
        "compiler": machine.first_line([compiler, "--version"], build),
        "flags": machine.cache_entry(build, "CMAKE_CXX_FLAGS_RELEASE"),
        "unity": machine.cache_entry(build, "TENON_UNITY"),
        "libc": " ".join(platform.libc_ver()),
        "valgrind": machine.first_line(["valgrind", "--version"], build),
        "architecture": platform.machine(),
    }


def measure(program, rows):
    before = ["setarch", "-R"] if command_rows.has_setarch() else []
    command_rows.make_inputs(WORK, program)
    return {name: command_rows.count_instructions(name, program, WORK, before) for name in rows}


def record(here, counts):
    commit = machine.first_line(["git", "rev-parse", "HEAD"], command_rows.ROOT)
    with open(RECORD, "w", encoding="utf-8") as file:
        json.dump({**here, "recorded_on": commit, "rows": counts}, file, indent=1)
        file.write("\n")
    print(f"recorded {len(counts)} rows in {os.path.relpath(RECORD)}")


def compare(recorded, counts):
    """Prints a line for each row; -> the rows that grew too much."""
    grown = []
    for name, count in counts.items():
        if name not in recorded:
            print(f"{name:16} {count:14,}  not recorded")
            grown.append(name)
            continue
        change = count / recorded[name] - 1
        words = ""
        if change > GROWTH:
            words = "  GROWN: make it fast again, or record it anew with the reason"
            grown.append(name)
        elif change < -GROWTH:
            words = "  faster: record it anew, so that it stays so"
        print(f"{name:16} {count:14,}  {100 * change:+6.2f} %{words}")
    return grown


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("rows", nargs="*")
    parser.add_argument("--record", action="store_true")
    arguments = parser.parse_intermixed_args()
    program = os.path.abspath(arguments.program)
    if not os.path.exists(program):
        print(f"skipped: no {program}; `make test` builds it: cmake --build build/release")
        return SKIPPED
    try:
        here = circumstances(program)
    except OSError as error:
        print(f"skipped: {error}")
        return SKIPPED
    with open(RECORD, encoding="utf-8") as file:
        recorded = json.load(file)
    different = [key for key, value in here.items() if recorded.get(key) != value]
    if different and not arguments.record:
        for key in different:
            print(f"skipped: {key} is `{here[key]}`, the record's `{recorded.get(key)}`")
        return SKIPPED
    try:
        counts = measure(program, arguments.rows or command_rows.rows_here())
    except command_rows.Failure as failure:
        print(failure)
        return 1
    if arguments.record:
        record(here, counts)
        return 0
    return 1 if compare(recorded["rows"], counts) else 0


if __name__ == "__main__":
    sys.exit(main())
