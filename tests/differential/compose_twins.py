#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Composes random scenes with siblings that bring in the same twice: with what tenon shares between
them (tenon/compose/twins) and without. All that indices hold must be the same, and the work that
is counted.

usage: compose_twins.py DUMP [--scenes N] [--seed S]

DUMP is the program tests/tools/composition_dump.cpp. The scenes are those of random_scenes.py, in
which prims of the root layer get copies beside them; some copies lose or change a part.
"""

import argparse
import copy
import os
import random
import re
import sys
import tempfile

import compose_random
import random_scenes

COPIES = 3


def renamed(prim, name):
    twin = copy.deepcopy(prim)
    twin["head"] = re.sub(r'"[^"]*"', f'"{name}"', twin["head"])
    return twin


def name_of(prim):
    return re.search(r'"([^"]*)"', prim["head"]).group(1)


def change(prim, choose):
    """Takes something away from a copy, or says something below it."""
    part = choose.choice(["meta", "kids", "over", "props"])
    if part == "over":
        kid = {"head": f'over "{choose.choice(random_scenes.KIDS)}"', "meta": [],
               "props": ["custom double only_here = 1"], "kids": [], "sets": []}
        if name_of(kid) not in [name_of(known) for known in prim["kids"]]:
            prim["kids"].append(kid)
    elif prim[part]:
        del prim[part][choose.randrange(len(prim[part]))]


def add_twins(prims, choose, depth):
    """Copies beside some of these prims and of those below."""
    for prim in list(prims):
        if depth > 0:
            add_twins(prim["kids"], choose, depth - 1)
        if choose.random() < 0.7:
            for number in range(COPIES):
                twin = renamed(prim, f"{name_of(prim)}_twin{number}")
                if choose.random() < 0.3:
                    change(twin, choose)
                prims.append(twin)


def dump(dumper, words):
    status, lines = dumper.ask(words)
    return [str(status)] + lines


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("dump")
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    dumper = compose_random.Dumper(arguments.dump)
    different = prims = 0
    for seed in range(arguments.seed, arguments.seed + arguments.scenes):
        scene = random_scenes.make_scene(seed)
        add_twins(scene["layers"][0]["prims"], random.Random(seed), 2)
        with tempfile.TemporaryDirectory() as folder:
            for name, text in random_scenes.texts(scene).items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            words = compose_random.words_of(folder, scene["options"])
            work = [word if word != "--nodes" else "--work" for word in words]
            for asked in (words, work):
                shared, alone = dump(dumper, asked), dump(dumper, asked + ["--no-twins"])
                prims += sum(line.startswith("== /") for line in shared)
                if shared != alone:
                    different += 1
                    lines = [pair for pair in zip(shared, alone) if pair[0] != pair[1]]
                    print(f"seed {seed}: {asked[1]}: shared, alone: {lines[:3]}")
    print(f"{arguments.scenes} scenes from seed {arguments.seed} on, {prims} prims: "
          f"{different} dumps differ")
    return 1 if different or prims < 20 * arguments.scenes else 0


if __name__ == "__main__":
    sys.exit(main())
