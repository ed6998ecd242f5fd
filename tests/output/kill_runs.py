#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Kills every verb that writes at random times, and runs each twice at once: files are as before or
as they are to be, never a mix, and no edit is lost without a message.

    kill_runs.py ROOT TENON [--runs N] [--pairs N] [--seed N]
"""

import argparse
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

from program import EDITS, TENON, WRITING, make_inputs, settle, snapshot, verbs


class Failure(Exception):
    pass


def cases():
    """-> (arguments, arguments of a second run at the same time) of everything that writes."""
    for verb in verbs():
        for arguments in WRITING[verb]:
            named = [part.replace("OUT", "out") if part.startswith("OUT") else part
                     for part in arguments]
            yield named, named
        yield from EDITS.get(verb, [])


def start(folder, arguments):
    return subprocess.Popen([TENON, *arguments], cwd=folder, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE)


def finish(process):
    said = process.communicate(timeout=120)[1]
    return process.returncode, said.decode(errors="replace")


class Bench:
    """One folder, put back to the same files before each run."""

    def __init__(self, home):
        self.clean = home / "clean"
        self.clean.mkdir()
        make_inputs(self.clean)
        self.folder = home / "work"

    def reset(self):
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.clean, self.folder)

    def outcome(self, *runs):
        """-> files after these runs, one after the other, and the time of the first."""
        self.reset()
        began = time.monotonic()
        for arguments in runs:
            code, said = finish(start(self.folder, arguments))
            if code not in (0, 1):
                raise Failure(f"{' '.join(arguments)}: exit {code}: {said}")
        return snapshot(self.folder), (time.monotonic() - began) / len(runs)


def kill_at_random(bench, arguments, runs, chance):
    old = snapshot(bench.clean)
    new, seconds = bench.outcome(arguments)
    count = {"old": 0, "new": 0}
    for _ in range(runs):
        bench.reset()
        process = start(bench.folder, arguments)
        time.sleep(chance.uniform(0, 1.1 * seconds))
        process.kill()
        process.communicate()
        settle(bench.folder)
        after = snapshot(bench.folder)
        if after not in (old, new):
            names = [name for name in sorted({*old, *after}) if after.get(name) != old.get(name)]
            raise Failure(f"{' '.join(arguments)}: a mix after a kill: {names}")
        count["new" if after == new else "old"] += 1
        # What is left does not hinder the next run.
        code, said = finish(start(bench.folder, arguments))
        if code not in (0, 1) and after == old:
            raise Failure(f"{' '.join(arguments)} after a kill: exit {code}: {said}")
    return count


def run_at_once(bench, first, second, pairs):
    """Both, in either order, or one of them with a message."""
    wanted = [bench.outcome(first, second)[0], bench.outcome(second, first)[0]]
    alone = [bench.outcome(first)[0], bench.outcome(second)[0]]
    for _ in range(pairs):
        bench.reset()
        ends = [finish(process) for process in [start(bench.folder, first),
                                                start(bench.folder, second)]]
        after = snapshot(bench.folder)
        failed = [said for code, said in ends if code not in (0, 1)]
        if any("error" not in said for said in failed):
            raise Failure(f"{' '.join(first)}, twice: a failure without a message")
        if after not in (wanted + alone if failed else wanted):
            raise Failure(f"{' '.join(first)}, twice: an edit is lost without a message")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root")
    parser.add_argument("tenon")
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--pairs", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    chance = random.Random(options.seed)
    failures = 0
    with tempfile.TemporaryDirectory() as home:
        bench = Bench(pathlib.Path(home))
        for first, second in cases():
            try:
                count = kill_at_random(bench, first, options.runs, chance)
                run_at_once(bench, first, second, options.pairs)
                print(f"{' '.join(first)}: {count['old']} old, {count['new']} new, "
                      f"{options.pairs} pairs")
            except Failure as failure:
                failures += 1
                print(f"FAILED {failure}")
    print(f"{failures} verbs left something else")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
