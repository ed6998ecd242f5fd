#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What became of the 5,000 random scenes that composition is compared on, as data.

usage: scene_outcomes.py DUMP               holds random_scenes.json to its list of misses, judges
                                            those again and notes the row of CONFORMANCE.md
       scene_outcomes.py --merge SHARD...   makes random_scenes.json of the shards

Judging all scenes takes longer than a test may. It is done by hand, in as many processes as there
are processors, each with a shard of its own:
    compose_random.py DUMP --seed 1 --scenes 1250 --show 0 --outcomes /tmp/shard1.json
A scene is `equal`, `differs`, `slow` (OpenUSD takes more than the seconds that compose_random.py
gives it) or `died` (OpenUSD crashes on it). The two last ones say nothing about equality and are
counted apart. Every scene that differs is listed in random_scenes_misses.txt with its reason.
DUMP is the program tests/tools/composition_dump.cpp. Exit 77: no OpenUSD.
"""

import argparse
import json
import os
import sys
import tempfile
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "conformance"))
import suite  # noqa: E402  pylint: disable=wrong-import-position

FILE = os.path.join(HERE, "random_scenes.json")
MISSES = os.path.join(HERE, "random_scenes_misses.txt")
SCENES = 5000
KINDS = ("equal", "differs", "slow", "died")


def ranges(seeds):
    """[[first, last]...] of numbers."""
    result = []
    for seed in sorted(seeds):
        if result and result[-1][1] == seed - 1:
            result[-1][1] = seed
        else:
            result.append([seed, seed])
    return result


def write(path, outcomes):
    """`outcomes`: {seed: kind}. Kept are the ranges of seeds judged and those not equal."""
    table = {"judged": ranges(outcomes)}
    for kind in KINDS[1:]:
        table[kind] = sorted(seed for seed, found in outcomes.items() if found == kind)
    text = textwrap.fill(json.dumps(table), 99, break_long_words=False)
    with open(path + ".new", "w", encoding="utf-8") as file:
        file.write(text + "\n")
    os.replace(path + ".new", path)


def read(path):
    with open(path, encoding="utf-8") as file:
        table = json.load(file)
    outcomes = {seed: "equal" for first, last in table["judged"]
                for seed in range(first, last + 1)}
    for kind in KINDS[1:]:
        outcomes.update(dict.fromkeys(table[kind], kind))
    return outcomes


def merge(shards):
    outcomes = {}
    for shard in shards:
        outcomes.update(read(shard))
    write(FILE, outcomes)


def hold_to_misses(outcomes, path):
    """Prints what differs and is not listed, and what is listed and equal; -> (listed, is good)."""
    known = suite.read_misses(path) if path else {}
    differing = {f"scene {seed}" for seed, kind in outcomes.items() if kind == "differs"}
    fixed = {f"scene {seed}" for seed, kind in outcomes.items() if kind == "equal"} & set(known)
    for name in sorted(differing - set(known)):
        print(f"MISS {name}")
    for name in sorted(fixed):
        print(f"FIXED {name}: remove it from {os.path.basename(path)}")
    return len(differing & set(known)), not fixed and differing <= set(known)


def still_differs(dump, seed):
    """Whether a scene differs with this build; one that OpenUSD does not finish counts as such."""
    import compose_random  # pylint: disable=import-outside-toplevel  # needs OpenUSD
    import random_scenes  # pylint: disable=import-outside-toplevel
    with tempfile.TemporaryDirectory() as folder:
        judge = compose_random.Judge(argparse.Namespace(dump=dump), folder)
        return judge.judge(random_scenes.make_scene(seed)).kind != "equal"


def check(dump):
    """Holds the data to the list of misses; the exit code."""
    outcomes = {seed: kind for seed, kind in read(FILE).items() if seed <= SCENES}
    count = {kind: sum(found == kind for found in outcomes.values()) for kind in KINDS}
    label = (f"random scenes, {len(outcomes)} judged once: composition, but for {count['slow']} "
             "that OpenUSD does not finish in time")
    label += f" and {count['died']} that it dies of" if count["died"] else ""
    results = suite.Results("random_scenes", MISSES)
    for seed, kind in outcomes.items():
        if kind == "equal":
            results.add(label, f"scene {seed}", None)
        elif kind == "differs":
            differs = still_differs(dump, seed)
            results.add(label, f"scene {seed}", "differs" if differs else None)
    return results.finish()


if __name__ == "__main__":
    if len(sys.argv) > 2 and sys.argv[1] == "--merge":
        merge(sys.argv[2:])
    else:
        sys.exit(check(sys.argv[1]))
