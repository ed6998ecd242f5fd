#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes with a known answer on every engine: right, told or silent.

usage: closed_forms.py TENON PAGE MISSES [--write] [--few] [--only NAME...] [--engine NAME...]
       [--show]

A scene is *right* where every quantity is within its tolerance and no warning of the run calls it
into doubt; *told* where one is not and a message names it; *silent* where nothing does. Silent ones
and *false alarms*, warnings on what is right, are misses. MISSES names those that are known, one a
line, `engine scene: what`; a miss that is not there is a fault, and so is a line without a miss, so
that the file only shrinks. --write makes PAGE, and takes the lines without a miss out of MISSES.
--few runs some scenes of each kind; then, and with --only and --engine, PAGE is left alone.
Exit 0: as MISSES and PAGE say; 1: not.
"""

import argparse
import json
import math
import multiprocessing.pool
import os
import pathlib
import subprocess
import sys
import tempfile

import page
import table
from form import RATE, Run

FEW = 3  # scenes of each kind
PATIENCE = 120  # [s] for one run
# Findings about how other programs read the layer: they do not concern the motion here.
OF_READERS = {"body.velocity-space"}
# Rules about what no engine does at its default.
OF_MOTION = {"mass.contact-ratio", "mass.ratio", "material.simultaneous-impacts"}
READ_BY = {"mujoco": "mujoco", "physx": "physx"}  # engine -> what `tenon check --for` calls it


class Outcome:
    """One scene on one engine."""

    def __init__(self, form, engine):
        self.form, self.engine = form, engine
        self.wrong = []  # (quantity, expected, measured or words)
        self.warned, self.told = [], []  # rules, and what else names a deviation

    def name(self):
        return f"{self.engine} {self.form.name}"

    def verdict(self):
        if self.warned and (self.form.quiet or not self.wrong):
            return "false alarm"
        if not self.wrong:
            return "right"
        return "told" if self.warned or self.told else "silent"

    def is_miss(self):
        return self.verdict() in ("silent", "false alarm")

    def said(self):
        return list(dict.fromkeys(self.warned + self.told))

    def what(self):
        """The deviation in few words."""
        if self.verdict() == "false alarm":
            return ", ".join(self.warned) + " on a right motion"
        return "; ".join(
            f"{what}: {page.number(measured)} instead of {page.number(expected)}"
            for what, expected, measured in self.wrong
        )


def measure(form, run):
    """-> the quantities that are not as expected"""
    wrong = []
    for see in form.sees:
        try:
            value = see.measured(run)
        except (IndexError, KeyError, AssertionError, ValueError):
            wrong.append((see.what, see.expected, math.nan))  # the run ended before, or has no such
            continue
        if not abs(value - see.expected) <= see.tolerance:
            wrong.append((see.what, see.expected, value))
    return wrong


def listen(outcome, answer):
    """What the run says about itself."""
    for finding in answer.get("diagnostics", []):
        rule = finding["rule"]
        if rule in outcome.form.says or rule in OF_READERS:
            continue
        if finding["severity"] in ("warning", "error"):
            outcome.warned.append(rule)
        elif rule.startswith((outcome.engine + ".", "sim.")):
            outcome.told.append(rule)
    for each in answer.get("notMapped", []):
        words = f"not mapped: {each['property']}"
        if words not in outcome.form.beside:
            outcome.told.append(words)


def run(tenon, folder, form, engine):
    outcome = Outcome(form, engine)
    log = folder / f"{form.name}.{engine}.jsonl"
    words = [
        tenon,
        "sim",
        folder / f"{form.name}.usda",
        "--engine",
        engine,
        "--duration",
        str(form.seconds),
        "--fps",
        str(RATE),
        "--json",
        "-o",
        log,
        *(["--log", form.log] if form.log else []),
    ]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=PATIENCE)
    try:
        answer = json.loads(done.stdout)
    except json.JSONDecodeError:
        outcome.wrong.append((f"the run, exit {done.returncode}", 0, math.nan))
        return outcome
    frames = []
    if log.exists():
        frames = [json.loads(line) for line in log.read_text(encoding="utf-8").splitlines()]
        log.unlink()
    outcome.wrong = measure(form, Run(frames, answer))
    listen(outcome, answer)
    return outcome


def ask_rules_of_motion(tenon, folder, outcomes):
    """What `tenon check` says of scenes that engines get wrong, on any of them. On a scene that all
    get right it is a false alarm."""
    by_file = {}
    for each in outcomes:
        by_file.setdefault(f"{each.form.name}.usda", []).append(each)
    words = [tenon, "check", *(folder / name for name in by_file), "--json"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    for finding in json.loads(done.stdout)["diagnostics"]:
        same = by_file[pathlib.Path(finding["file"]).name]
        if finding["rule"] in OF_MOTION and finding["rule"] not in same[0].form.says:
            wrong = [each for each in same if each.wrong]
            for each in wrong or same:
                (each.told if wrong else each.warned).append(finding["rule"])


def ask_check(tenon, folder, outcomes):
    """What `tenon check --for ENGINE` says of the wrong ones."""
    for engine, reader in READ_BY.items():
        wrong = {
            f"{each.form.name}.usda": each
            for each in outcomes
            if each.engine == engine and each.wrong
        }
        if not wrong:
            continue
        words = [
            tenon,
            "check",
            *(folder / name for name in wrong),
            "--for",
            reader,
            "--only",
            "portability",
            "--json",
        ]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        for finding in json.loads(done.stdout)["diagnostics"]:
            rule = finding["rule"]
            if rule.startswith("portability.") and rule not in page.NOT_OF_THE_ENGINE:
                wrong[pathlib.Path(finding["file"]).name].told.append(rule)


def engines_of(tenon):
    done = subprocess.run([tenon, "doctor", "--json"], capture_output=True, text=True, check=False)
    return [each["name"] for each in json.loads(done.stdout)["engines"] if each["available"]]


def chosen(arguments):
    found = {}
    for form in table.forms():
        found.setdefault(form.kind, []).append(form)
    if arguments.few:
        # First, middle, last: parameters of a kind go up.
        found = {
            kind: [forms[i] for i in sorted({0, len(forms) // 2, len(forms) - 1})][:FEW]
            for kind, forms in found.items()
        }
    return [
        form
        for forms in found.values()
        for form in forms
        if not arguments.only or form.name in arguments.only
    ]


def known_misses(path):
    """-> {`engine scene`: line}"""
    found = {}
    for line in path.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            found[line.split(":")[0]] = line
    return found


def held(outcomes, misses):
    """-> faults, and lines of MISSES that are no longer misses"""
    faults, over = [], []
    for outcome in outcomes:
        name = outcome.name()
        if outcome.is_miss() and name not in misses:
            faults.append(f"{outcome.verdict()}: {name}: {outcome.what()}")
        if not outcome.is_miss() and name in misses:
            over.append(name)
    names = {outcome.name() for outcome in outcomes}
    return faults, over, sorted(set(misses) - names)


def run_all(arguments, folder, engines):
    forms = chosen(arguments)
    for form in forms:
        (folder / f"{form.name}.usda").write_text(form.layer, encoding="utf-8")
    jobs = [(arguments.tenon, folder, form, engine) for form in forms for engine in engines]
    with multiprocessing.pool.ThreadPool(os.cpu_count()) as pool:
        outcomes = pool.starmap(run, jobs, 1)
    ask_rules_of_motion(arguments.tenon, folder, outcomes)
    ask_check(arguments.tenon, folder, outcomes)
    return outcomes


def keep_page(arguments, outcomes, misses, over):
    """-> what is wrong with the page"""
    text = page.text(outcomes, table.kinds())
    if arguments.write:
        arguments.page.write_text(text, encoding="utf-8")
        lines = arguments.misses.read_text(encoding="utf-8").splitlines(True)
        arguments.misses.write_text(
            "".join(line for line in lines if line.split(":")[0] not in over), encoding="utf-8"
        )
        return []
    old = arguments.page.read_text(encoding="utf-8") if arguments.page.exists() else ""
    return [] if page.same(old, text) else [f"{arguments.page} is not what the run makes: --write"]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tenon")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("misses", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--few", action="store_true")
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--engine", nargs="*")
    parser.add_argument("--show", action="store_true", help="tell every scene")
    arguments = parser.parse_args()
    built = engines_of(arguments.tenon)
    engines = [each for each in built if not arguments.engine or each in arguments.engine]
    with tempfile.TemporaryDirectory() as folder:
        outcomes = run_all(arguments, pathlib.Path(folder), engines)
    misses = known_misses(arguments.misses)
    faults, over, gone = held(outcomes, misses)
    for outcome in outcomes:
        if arguments.show:
            print(
                f"{outcome.verdict():11} {outcome.name():40} "
                f"{'' if outcome.verdict() == 'right' else outcome.what()} {outcome.said()}"
            )
    if not (arguments.only or arguments.few or arguments.engine):
        faults += [f"{name} is no scene: take it out of {arguments.misses}" for name in gone]
        faults += keep_page(arguments, outcomes, misses, over)
    if not arguments.write:
        faults += [
            f"{name} is no longer a miss: take it out of {arguments.misses}" for name in over
        ]
    print("\n".join(faults))
    print(page.result(outcomes, len(faults)))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
