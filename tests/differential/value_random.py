# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares values of random scenes with OpenUSD: `tenon dump` of each against the same dump made
with OpenUSD's modules. Needs Python with these.

usage: value_random.py TENON [--seeds FIRST COUNT] [--keep FOLDER] [--show N]

Seeds that are even make layered scenes with every value type and metadata, odd ones value clips
(value_scenes.py). Exit 77: OpenUSD is absent.
"""

import argparse
import os
import random
import sys
import tempfile

import dump_stage
import value_scenes

SKIPPED = 77
SEEDS = (0, 300)  # first, count


def make_case(seed, folder):
    folder = os.path.join(folder, str(seed))
    os.makedirs(folder, exist_ok=True)
    kind = value_scenes.ClipScene if seed % 2 else value_scenes.Scene
    path = kind(random.Random(seed), folder).make()
    return dump_stage.Case(f"seed {seed}", path)


def run(arguments, folder):
    """(scenes compared, seeds that differ, seeds that OpenUSD rejects)"""
    module = dump_stage.oracle_module()
    dump_stage.TOLERANT.add("timeSamples")  # those of clips may lie between authored ones
    first, count = arguments.seeds
    missed, rejected = [], []
    for seed in range(first, first + count):
        case = make_case(seed, folder)
        lines = dump_stage.judge(module, arguments.tenon, case, folder)
        if lines:
            missed.append(seed)
            print(f"MISS seed {seed}")
            for line in lines[: max(arguments.show, 3)]:
                print(f"   {line}")
        elif lines is None or dump_stage.expected_dump(module, case, folder) is None:
            rejected.append(seed)
    return count, missed, rejected


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tenon")
    parser.add_argument("--seeds", nargs=2, type=int, default=SEEDS)
    parser.add_argument("--keep")
    parser.add_argument("--show", type=int, default=0)
    arguments = parser.parse_args()
    dump_stage.measured.forget("value_scenes")
    try:
        import pxr  # noqa: F401  pylint: disable=unused-import,import-outside-toplevel
    except ImportError:
        print("skipped: no OpenUSD modules in this Python")
        return SKIPPED
    with tempfile.TemporaryDirectory() as temporary:
        count, missed, rejected = run(arguments, arguments.keep or temporary)
    print(f"{count - len(missed)} of {count} random scenes equal, {len(rejected)} of them rejected")
    if tuple(arguments.seeds) == SEEDS:
        row = ("random scenes: values, against OpenUSD", count - len(missed), count)
        dump_stage.measured.record("value_scenes", [row])
    # A generator whose scenes nobody opens compares nothing.
    return 1 if missed or len(rejected) * 4 > count else 0


if __name__ == "__main__":
    sys.exit(main())
