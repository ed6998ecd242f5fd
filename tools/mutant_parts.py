#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of the run on mutants (fuzz/mutants) that add up: fuzz/mutants/parts.tsv has a line for
each, and CONFORMANCE.md the sum per build.

usage: mutant_parts.py run release|sanitizers [--jobs N]        the next part, 25,000 mutants
       mutant_parts.py add JSON... --commit C --date D          parts that were run elsewhere
       mutant_parts.py write                                    the sums in CONFORMANCE.md

`run` goes on behind the last part of that build; a part with findings is run again first, and
takes the place of its line. TENON_MUTANTS_COUNT: mutants of a part. JSON: what
`tenon_mutants --json` wrote.
Exit 0: no finding; 1: findings, or a part that cannot be added; 2: usage.
"""

import argparse
import collections
import datetime
import json
import os
import re
import subprocess
import sys

import judge

TABLE = os.path.join(judge.ROOT, "fuzz/mutants/parts.tsv")
SECTION = re.compile(r"(<!-- mutants: .*? -->\n)(.*?)(<!-- end of mutants -->)", re.S)
HEAD = ("| build | mutants | parts | first | last | commits | findings |\n"
        "|---|---|---|---|---|---|---|\n")
COUNT = 25000
SEED = 15
# Where parts go on; other numbers of a build below these are older parts.
FIRST = {"release": 100000, "sanitizers": 550000}
PROGRAM = {"release": ["build/release/bin/tenon"],
           "sanitizers": ["build/dev/bin/tenon", "--sanitized"]}
Part = collections.namedtuple("Part", "date commit build seeds seed start count findings")


def read_parts():
    with open(TABLE, encoding="utf-8") as file:
        lines = [line.rstrip("\n").split("\t") for line in file][1:]
    return [Part(*line[:4], *map(int, line[4:])) for line in lines]


def write_parts(parts):
    with open(TABLE + ".new", "w", encoding="utf-8") as file:
        file.write("date\tcommit\tbuild\tseeds\tseed\tfrom\tcount\tfindings\n")
        file.writelines("\t".join(map(str, part)) + "\n" for part in parts)
    os.replace(TABLE + ".new", TABLE)


def overlap(one, other):
    return ((one.build, one.seed) == (other.build, other.seed)
            and one.start < other.start + other.count and other.start < one.start + one.count)


def added(parts, part):
    """`parts` and the new one; ValueError where numbers would count twice."""
    kept = [old for old in parts if not (old.findings and overlap(old, part))]
    for old in kept:
        if overlap(old, part):
            raise ValueError(f"{part.build} has mutants from {old.start} to "
                             f"{old.start + old.count - 1} already, of {old.commit}")
    return sorted([*kept, part], key=lambda each: (each.build, each.seed, each.start))


def next_of(parts, build, count):
    """-> (number of the first mutant, how many) of the part that is to be run."""
    own = [part for part in parts if (part.build, part.seed) == (build, SEED)]
    for part in own:
        if part.findings:
            return part.start, part.count
    return max([FIRST[build]] + [part.start + part.count for part in own]), count


def part_of(path, commit, date):
    """The part that a file of `tenon_mutants --json` is about."""
    with open(path, encoding="utf-8") as file:
        said = json.load(file)
    if said["runs"] != said["wanted"]:
        raise ValueError(f"{path}: {said['runs']} of {said['wanted']} mutants were run")
    return Part(date, commit, "sanitizers" if said["sanitized"] else "release",
                said["seeds"].zfill(16), said["seed"], said["from"], said["runs"],
                said["findings"])


def rows(parts):
    for build in dict.fromkeys(part.build for part in parts):
        own = [part for part in parts if part.build == build]
        commits = list(dict.fromkeys(part.commit for part in sorted(own)))
        yield (f"| {build} | {sum(part.count for part in own)} | {len(own)} "
               f"| {min(own).date} | {max(own).date} | {', '.join(commits)} "
               f"| {sum(part.findings for part in own)} |\n")


def with_sums(text, parts):
    found = SECTION.search(text)
    if found is None:
        sys.exit("CONFORMANCE.md has no part <!-- mutants: ... --> <!-- end of mutants -->")
    return text[:found.start(2)] + HEAD + "".join(rows(parts)) + text[found.end(2):]


def save(parts):
    write_parts(parts)
    with open(judge.DOCUMENT, encoding="utf-8") as file:
        text = file.read()
    with open(judge.DOCUMENT + ".new", "w", encoding="utf-8") as file:
        file.write(with_sums(text, parts))
    os.replace(judge.DOCUMENT + ".new", judge.DOCUMENT)


def run_next(build, jobs):
    start, count = next_of(read_parts(), build, int(os.environ.get("TENON_MUTANTS_COUNT", COUNT)))
    made = os.path.join(judge.LOGS, f"mutants_{build}_{start}")
    os.makedirs(judge.LOGS, exist_ok=True)
    commit = judge.commit()  # others may commit meanwhile
    status = subprocess.run(
        ["build/bench/bin/tenon_mutants", "--seeds", *judge.SEEDS, "--seed", str(SEED),
         "--from", str(start), "--count", str(count), "--jobs", str(jobs), "--findings", made,
         "--json", made + ".json", "--program", *PROGRAM[build]],
        cwd=judge.ROOT, check=False).returncode
    if status not in (0, 1):
        return status
    parts = added(read_parts(), part_of(made + ".json", commit, str(datetime.date.today())))
    save(parts)
    own = [part for part in parts if part.build == build]
    print(f"{sum(part.count for part in own)} mutants in {len(own)} parts; the last: "
          f"{count} from {start}, seed {SEED}, of seeds {own[-1].seeds}: "
          f"{sum(part.findings for part in own)} findings")
    return status


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    verbs = parser.add_subparsers(dest="verb", required=True)
    run = verbs.add_parser("run")
    run.add_argument("build", choices=PROGRAM)
    run.add_argument("--jobs", type=int, default=1)
    add = verbs.add_parser("add")
    add.add_argument("files", nargs="+")
    add.add_argument("--commit", required=True)
    add.add_argument("--date", required=True, type=datetime.date.fromisoformat)
    verbs.add_parser("write")
    options = parser.parse_args()
    try:
        if options.verb == "run":
            return run_next(options.build, options.jobs)
        parts = read_parts()
        for path in options.files if options.verb == "add" else []:
            parts = added(parts, part_of(path, options.commit, str(options.date)))
        save(parts)
    except ValueError as error:
        print(error)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
