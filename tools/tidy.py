#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the program's C++ files to .clang-tidy, with the version that tests/requirements.txt pins.

usage: tidy.py [--changed | FILE...] [--jobs N]

Without names all files are looked at (make tidy; about half an hour of processor time); when none
has a finding, the commit is written to tools/tidied.txt; until the first such run it names the
commit from which on changes are held. --changed, a test, looks at what changed since that commit.
Tests, benchmarks and fuzz targets are left out, as is generated code.
Exit 0: no finding; 1: findings; 77: clang-tidy is missing, or the commit is not in this clone.
"""

import argparse
import concurrent.futures
import os
import re
import subprocess
import sys

import source_files

SKIPPED = 77
ROOT = source_files.ROOT
RECORD = os.path.join(ROOT, "tools/tidied.txt")
DATABASE = os.path.join(ROOT, "build/tidy")
FOLDERS = ("tenon/", "cli/", "worker/")
# A comment, an included name, or text that may hold what looks like a comment: raw text, text, a
# character.
COMMENT = re.compile(r"#include[^\n]*|//(?:\\\n|[^\n])*|/\*.*?\*/"
                     r'|R"([^()\\\s]*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"'
                     r"|(?<![0-9a-fA-F])'(?:[^'\\\n]|\\.)+'", re.DOTALL)
FINDING = re.compile(r"^(?P<file>/[^:]+):\d+:\d+: (?:error|warning): ")
# The database is of the compiler that is there, whose options clang need not know.
MORE = ["--extra-arg=-Wno-unknown-warning-option", "--extra-arg=-Wno-pragma-once-outside-header"]


def program():
    """clang-tidy of the Python that runs this; None where it is not installed."""
    path = os.path.join(os.path.dirname(sys.executable), "clang-tidy")
    return path if os.path.exists(path) else None


def is_judged(name):
    """Whether a file is code of the program itself."""
    stem, kind = os.path.splitext(os.path.basename(name))
    return (name.startswith(FOLDERS) and kind in (".h", ".cpp") and not stem.endswith("_test")
            and not stem.startswith("test_") and not source_files.is_generated(name))


def git(*arguments):
    done = subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True,
                          check=False)
    return done.stdout if done.returncode == 0 else None


def recorded():
    with open(RECORD, encoding="utf-8") as file:
        return file.read().strip()


def changed_since(commit):
    """Names that differ from a commit, new files too; None where the commit is not known."""
    tracked = git("diff", "--name-only", commit, "--")
    new = git("ls-files", "--others", "--exclude-standard")
    return None if tracked is None or new is None else sorted(set((tracked + new).splitlines()))


def code_of(text):
    """The words of a C++ file without comments, line breaks and what its messages say: plain text
    in quotes, in one piece or several, is one word. NOLINT comments stay."""
    def kept(found):
        word = found.group(0)
        if word.startswith('"') and "\\" not in word:
            return ' "" '
        return " " if word[:2] in ("//", "/*") and "NOLINT" not in word else word
    words = COMMENT.sub(kept, text).split()
    return [word for word, before in zip(words, [None, *words]) if not word == before == '""']


def has_changed_code(name, commit):
    """Whether the code of a file differs from a commit, where it may be missing."""
    before = git("show", f"{commit}:{name}")
    with open(os.path.join(ROOT, name), encoding="utf-8") as file:
        return before is None or code_of(before) != code_of(file.read())


def configure():
    """Makes the list of compilations, each source by itself. -> whether it is there"""
    done = subprocess.run(["cmake", "--preset", "tidy"], cwd=ROOT, capture_output=True, text=True,
                          check=False)
    if done.returncode:
        print(done.stdout + done.stderr)
    return done.returncode == 0


def findings(clang_tidy, name):
    """What clang-tidy says of one file, a line each; what it says of system headers is left out."""
    done = subprocess.run([clang_tidy, "--quiet", "-p", DATABASE, *MORE, os.path.join(ROOT, name)],
                          cwd=ROOT, capture_output=True, text=True, check=False)
    found = [line.replace(ROOT + "/", "") for line in done.stdout.splitlines()
             if FINDING.match(line)]
    if done.returncode and not found:
        found = [f"{name}: clang-tidy failed: {done.stderr.strip()[-300:]}"]
    return found


def judge(clang_tidy, names, jobs, everywhere):
    """-> number of findings; each is printed once, though many files include a header. What is in
    headers that are not among the files counts only with `everywhere`. A header is seen with its
    source where that is among the files, too."""
    seen, own = set(), set(names)
    names = [name for name in names if not (name.endswith(".h") and name[:-1] + "cpp" in own)]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for found in pool.map(lambda name: findings(clang_tidy, name), names):
            for line in found:
                if line not in seen and (everywhere or line.split(":", 1)[0] in own):
                    seen.add(line)
                    print(line, flush=True)
    return len(seen)


def chosen(options):
    """The files to look at; None, and why on standard output, where it cannot be known."""
    names = options.files or [name for name in source_files.project_files() if is_judged(name)]
    if options.changed:
        changed = changed_since(recorded())
        if changed is None:
            print(f"skipped: commit {recorded()} of tools/tidied.txt is not in this clone")
            return None
        return [name for name in names
                if name in set(changed) and has_changed_code(name, recorded())]
    # Headers are seen with the sources.
    return names if options.files else [name for name in names if name.endswith(".cpp")]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("files", nargs="*")
    parser.add_argument("--changed", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    clang_tidy = program()
    if clang_tidy is None:
        print("skipped: clang-tidy is missing (tools/make_oracle.sh)")
        return SKIPPED
    names = chosen(options)
    if names is None:
        return SKIPPED
    if not configure():
        return 1
    everywhere = not options.files and not options.changed
    count = judge(clang_tidy, names, options.jobs, everywhere)
    print(f"{len(names)} files, {count} findings")
    if count == 0 and everywhere and git("status", "-s") == "":
        with open(RECORD, "w", encoding="utf-8") as file:
            file.write(git("rev-parse", "HEAD"))
    return 1 if count else 0


if __name__ == "__main__":
    sys.exit(main())
