#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Says how many tests of a run skipped, which, and why.

usage: skipped_tests.py TESTS_LOG LAST_LOG [--strict]

TESTS_LOG is what ctest printed, LAST_LOG its Testing/Temporary/LastTest.log with what each test
printed. A Python test all of whose cases skipped counts as skipped, too. --strict: exit 1 where a
test skipped that tools/allowed_skips.txt does not list.
"""

import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ALLOWED = os.path.join(HERE, "allowed_skips.txt")
DID_NOT_RUN = re.compile(r"^\s*\d+ - (\S.*) \(Skipped\)\s*$", re.MULTILINE)
BLOCK = re.compile(r"^\d+/\d+ Testing: (\S[^\n]*)\n(.*?)^<end of output>$",
                   re.MULTILINE | re.DOTALL)
# What tests print: scripts, GoogleTest, unittest.
REASONS = (re.compile(r"^skipped: (.*)$", re.MULTILINE),
           re.compile(r"^.*: Skipped\n(.+)$", re.MULTILINE),
           re.compile(r"skipped '(.*)'", re.MULTILINE))
ALL_CASES = re.compile(r"^Ran (\d+) tests? in .*\n\nOK \(skipped=(\d+)\)", re.MULTILINE)


def allowed_skips(text):
    """{name: reason}"""
    rows = [line.partition("|") for line in text.splitlines()
            if line.strip() and not line.startswith("#")]
    return {name.strip(): reason.strip() for name, _, reason in rows}


def reason_in(output):
    for pattern in REASONS:
        found = pattern.search(output)
        if found:
            return found.group(1).strip()
    cases = ALL_CASES.search(output)
    return f"all {cases.group(1)} cases skipped" if cases else "no reason given"


def skipped_tests(tests_log, last_log):
    """{name: reason}, sorted by name."""
    outputs = dict(BLOCK.findall(last_log))
    names = set(DID_NOT_RUN.findall(tests_log))
    for name, output in outputs.items():
        cases = ALL_CASES.search(output)
        if cases and cases.group(1) == cases.group(2):
            names.add(name)
    return {name: reason_in(outputs.get(name, "")) for name in sorted(names)}


def report(found, allowed):
    """-> lines, and the names that are not allowed."""
    others = [name for name in found if name not in allowed]
    count = f"{len(found)} test{'' if len(found) == 1 else 's'} skipped"
    lines = [count + (f", {len(others)} not in tools/allowed_skips.txt" if others else "")]
    lines += [f"  {name}: {reason}" for name, reason in found.items()]
    return lines, others


def read(path):
    if not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


def main():
    paths = [argument for argument in sys.argv[1:] if argument != "--strict"]
    if len(paths) != 2:
        sys.exit(__doc__)
    found = skipped_tests(*map(read, paths))
    lines, others = report(found, allowed_skips(read(ALLOWED)))
    print("\n".join(lines))
    return 1 if others and "--strict" in sys.argv else 0


if __name__ == "__main__":
    sys.exit(main())
