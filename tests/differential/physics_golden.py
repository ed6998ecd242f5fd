# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares `tenon physics` with OpenUSD's physics parser on every case of tests/golden/physics,
read with OpenUSD's readings where readers disagree. What still differs stands, each with its
reason, in physics_golden_misses.txt: one more or one less makes this fail.

usage: physics_golden.py --tenon PROGRAM
"""

import argparse
import os
import sys
from collections import Counter

import physics_random  # exits with 77 without OpenUSD

HERE = os.path.dirname(os.path.abspath(__file__))
CASES = os.path.join(os.path.dirname(HERE), "golden", "physics")
MISSES = os.path.join(HERE, "physics_golden_misses.txt")


def read_misses():
    """Lines `case kind path | reason`; a leading ~ marks what comes and goes."""
    misses = {}
    with open(MISSES, encoding="utf-8") as file:
        for line in file:
            key, _, reason = line.strip().partition(" | ")
            if key and not key.startswith("#"):
                if not reason:
                    sys.exit(f"{MISSES}: no reason for `{key}`")
                misses[key] = reason
    return misses


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--tenon", required=True)
    program = parser.parse_args().tenon
    found = {}
    names = sorted(os.listdir(CASES))
    for name in names:
        with open(os.path.join(CASES, name, "input.usda"), encoding="utf-8") as file:
            text = file.read()
        for key, detail in physics_random.differences(program, text, Counter()).items():
            found[f"{name} {key}"] = detail
    misses = read_misses()
    new = sorted(set(found) - {key.lstrip("~") for key in misses})
    gone = sorted(key for key in set(misses) - set(found) if not key.startswith("~"))
    for key in new:
        print(f"{key}\n    {found[key]}")
    for key in gone:
        print(f"listed as a miss but equal: {key}")
    print(f"{len(names)} cases, {len(found)} differences, {len(new)} new, {len(gone)} in vain")
    return 1 if new or gone else 0


if __name__ == "__main__":
    sys.exit(main())
