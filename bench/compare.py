#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares this tree with another commit: both programs, the same inputs, in turns.

usage: compare.py COMMIT [--build DIR] [--rounds N] [--scale N] [ROW...]   (make bench BASE=COMMIT)

The commit is built once, in build/base-<commit>, with flags of the preset `bench`. Every row of
command_rows.py is counted once under callgrind and then timed in turns, A B B A ..., each run a
process on one processor. Marked are rows whose instructions differ by more than 0.5 % and rows
whose times differ by more than the noise: three times the spread of the differences between
neighbours.
"""

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time

import command_rows

ROOT = command_rows.ROOT
WORK = os.path.join(tempfile.gettempdir(), "tenon_instructions_work")
INSTRUCTIONS_THAT_COUNT = 0.005


def commit_of(name):
    done = subprocess.run(["git", "rev-parse", "--verify", "--quiet", name + "^{commit}"], cwd=ROOT,
                          capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"compare.py: no commit `{name}` here; give one that `git log` knows")
    return done.stdout.strip()


def build_base(commit):
    """-> the program of that commit, built in a folder of its own when it is not there yet."""
    folder = os.path.join(ROOT, "build", "base-" + commit[:12])
    source = os.path.join(folder, "source")
    program = os.path.join(source, "build/bench/bin/tenon")
    if os.path.exists(os.path.join(folder, "built")):
        return program
    print(f"building {commit[:12]} in {os.path.relpath(folder, ROOT)}", flush=True)
    os.makedirs(source, exist_ok=True)
    with subprocess.Popen(["git", "archive", commit], cwd=ROOT, stdout=subprocess.PIPE) as archive:
        subprocess.run(["tar", "-x", "-C", source], stdin=archive.stdout, check=True)
    os.makedirs(os.path.join(source, "build"), exist_ok=True)
    link = os.path.join(source, "build/_deps")
    if not os.path.lexists(link):
        os.symlink(os.path.join(ROOT, "build/_deps"), link)
    subprocess.run(["cmake", "--preset", "bench"], cwd=source, stdout=subprocess.DEVNULL,
                   check=True)
    subprocess.run(["cmake", "--build", "build/bench", "--target", "tenon_cli"], cwd=source,
                   stdout=subprocess.DEVNULL, check=True)
    with open(os.path.join(folder, "built"), "w", encoding="utf-8"):
        pass
    return program


def seconds_of(name, program):
    """Processor time of one run, children included."""
    command_rows.clear_outputs(WORK)
    process = subprocess.Popen(command_rows.command(name, program, WORK), cwd=WORK,
                               env=command_rows.environment(WORK), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL,
                               preexec_fn=command_rows.on_one_processor)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in command_rows.ANSWERS:
        raise command_rows.Failure(f"{name}: exit {process.returncode}")
    return usage.ru_utime + usage.ru_stime


def time_in_turns(name, base, here, rounds):
    """-> (median of the base, median of this tree, do they differ beyond noise)"""
    pairs = []
    for number in range(rounds):  # who goes first finds caches colder: they take turns in it
        order = (base, here) if number % 2 == 0 else (here, base)
        seconds = {program: seconds_of(name, program) for program in order}
        pairs.append((seconds[base], seconds[here]))
    differences = [own - other for other, own in pairs]
    middle = statistics.median(differences)
    spread = statistics.median(abs(difference - middle) for difference in differences)
    noise = 3 * 1.4826 * spread / rounds ** 0.5
    return (statistics.median(other for other, _ in pairs),
            statistics.median(own for _, own in pairs), abs(middle) > noise)


def counts(name, base, here, before):
    """Instructions of both; nothing for a row that one of them cannot do."""
    try:
        return [command_rows.count_instructions(name, program, WORK, before)
                for program in (base, here)]
    except command_rows.Failure as failure:
        print(f"{name:16} left out: {str(failure).splitlines()[0]}")
        return None


def compare(rows, base, here, rounds):
    before = ["setarch", "-R"] if command_rows.has_setarch() else []
    print(f"{'row':16} {'instructions':>14} {'now':>14} {'change':>9}   {'ms':>8} {'now':>8} "
          f"{'change':>9}")
    changed = 0
    for name in rows:
        pair = counts(name, base, here, before)
        if pair is None:
            continue
        growth = pair[1] / pair[0] - 1
        old, new, beyond = time_in_turns(name, base, here, rounds)
        marks = ("#" if abs(growth) > INSTRUCTIONS_THAT_COUNT else " ", "*" if beyond else " ")
        changed += marks != (" ", " ")
        print(f"{name:16} {pair[0]:14,} {pair[1]:14,} {100 * growth:+7.2f} %{marks[0]} "
              f"{1e3 * old:8.2f} {1e3 * new:8.2f} {100 * (new / old - 1):+7.2f} %{marks[1]}",
              flush=True)
    print(f"{changed} rows changed: # instructions by more than "
          f"{100 * INSTRUCTIONS_THAT_COUNT:g} %, * processor time beyond noise")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("commit")
    parser.add_argument("rows", nargs="*")
    parser.add_argument("--build", default=os.path.join(ROOT, "build/bench"))
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--scale", type=int, default=1, help="size of the generated inputs")
    arguments = parser.parse_intermixed_args()
    start = time.monotonic()
    base = build_base(commit_of(arguments.commit))
    here = os.path.join(arguments.build, "bin/tenon")
    command_rows.make_inputs(WORK, base, arguments.scale)
    compare(arguments.rows or command_rows.rows_here(), base, here, arguments.rounds)
    print(f"{time.monotonic() - start:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
