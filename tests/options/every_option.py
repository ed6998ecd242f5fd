#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every option of sim, bench, compare, bake, view and record on every engine: it acts, or it is
refused by name.

    every_option.py ROOT TENON [VERB...] [--all] [--only WORDS]

The options are those of the program's own table (`tenon help VERB --json`): one without a row in
of_verbs.py, of_pictures.py and what they call is a fault, and so is a choice of an option without
one. A row runs the verb twice on the asset of scenes.py, without and with the option.

Without --all the rows of `view`, `record` and `compare` take turns among the engines, of `view`
and `compare` but those of how steps are made; with it, every row is asked of every engine. Exit 0:
no fault; 1: faults.
"""

import argparse
import json
import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/engines_beside"), str(ROOT / "tests/view"),
                str(pathlib.Path(__file__).parent)]

# pylint: disable=wrong-import-position
import of_pictures
import of_verbs
import scenes
from program import Program

VERBS = {"sim": lambda table: of_verbs.sim(choices_of(table)),
         "bench": lambda table: of_verbs.bench(choices_of(table)),
         "compare": lambda table: of_verbs.compare(choices_of(table)),
         "bake": lambda table: of_verbs.bake(choices_of(table)),
         "view": of_pictures.view, "record": of_pictures.record}
TAKE_TURNS = ("compare", "view", "record")
# These are asked of every engine, always.
OF_ENGINES = ("--engine", "--dt", "--integrator", "--solver", "--iterations", "--commands")


def name_of(option):
    """The long name; of a positional argument its own."""
    return option["names"][-1]


def choices_of(table):
    return {name: option["choices"] for name, option in table.items()}


def table_of(program, verb):
    """Every option of a verb, by name, as the program tells it."""
    told = program.answer("help", verb)
    [row] = [row for row in told["verbs"] if row["name"] == verb]
    options = [option for option in told["options"] + row["options"] if not option["positional"]]
    return {name_of(option): option for option in options}


def faults_of_table(verb, table, rows):
    """Options and choices without a row, and rows of no option."""
    known = {row.option for row in rows}
    for option in sorted(table.keys() - known):
        yield f"{verb} {option}: no row says what comes of it"
    for option in sorted(known - table.keys()):
        yield f"{verb} {option}: a row of an option that the verb has not"
    for name, option in table.items():
        given = {word for row in rows for at, word in enumerate(row.words)
                 if at and row.words[at - 1] in option["names"]}
        for choice in option["choices"]:
            if choice not in given and "{engine}" not in str(given):
                yield f"{verb} {name} {choice}: no row gives this choice"


def engines_of(verb, row, number, engines, every):
    if row.once:
        return engines[:1]
    if every or verb not in TAKE_TURNS or (row.option in OF_ENGINES and verb != "record"):
        return engines
    return [engines[number % len(engines)]]


def check(program, verb, options):
    table = table_of(program, verb)
    rows = list(VERBS[verb](table))
    faults, count = list(faults_of_table(verb, table, rows)), 0
    for number, row in enumerate(rows):
        if options.only and options.only not in row.name() + " " + row.option:
            continue
        for engine in engines_of(verb, row, number, program.engines, options.all):
            count += 1
            try:
                fault = row.fault(engine, *program.both(verb, row, engine))
            except (KeyError, IndexError, TypeError, ValueError, AssertionError) as error:
                fault = f"{type(error).__name__}: {error}"[:600]
            if fault:
                faults.append(f"{verb} {row.name()} on {engine}: {fault}")
    return faults, count


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon", type=pathlib.Path)
    parser.add_argument("verbs", nargs="*", default=[])
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--only")
    options = parser.parse_args()
    faults, counts = [], []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        scenes.write(folder)
        program = Program(options.root.resolve(), options.tenon.resolve(), folder)
        for verb in options.verbs or VERBS:
            if verb in ("view", "record") and (shutil.which("node") is None or
                                               not program.has_page):
                print(f"skipped: {verb}: this build has no page")
                continue
            found, count = check(program, verb, options)
            faults += found
            counts.append(f"{verb} {count}")
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults; options x engines of {', '.join(counts)}")
    if not counts:
        return 77
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
