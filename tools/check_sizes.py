#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the sizes that readers feel: function 60 lines of code and complexity 20, file 600 lines;
and that each .cpp of the program with 150 lines or more opens with what it does and why it works.
Counts of files and functions are a report (report_counts.py).

Exceptions stand by name and with their reason in tools/size_exceptions.txt; one that is no longer
needed is a fault too, so the list only shrinks. Exit 0: held; 1: faults; 77: lizard is missing.
"""

import os
import sys

import source_files

FUNCTION_LINES = 60
COMPLEXITY = 20
FILE_LINES = 600
HEAD_LINES = 150  # from here on a file needs a head
PLACES = ("tenon/", "cli/", "tests/", "bench/", "fuzz/", "tools/", "python/")
SUFFIXES = (".h", ".cpp", ".py")
SKIPPED = 77


def read_exceptions(path):
    """Lines `path | function or * | reason`; `*` stands for the file's length."""
    found = {}
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.strip()
            if not line or line.startswith("#"):
                continue
            parts = [part.strip() for part in line.split("|")]
            if len(parts) != 3 or not parts[2]:
                sys.exit(f"{path}:{number}: expected `path | function or * | reason`")
            found[(parts[0], parts[1])] = number
    return found


def oversized(path, text, functions):
    """-> (name, line, what is too big) of a file's functions and of the file (name `*`)."""
    lines = text.count("\n")
    if lines > FILE_LINES:
        yield "*", 1, f"file of {lines} lines, limit {FILE_LINES}"
    for function in functions:
        if function.nloc > FUNCTION_LINES:
            what = f"{function.nloc} lines of code, limit {FUNCTION_LINES}"
        elif function.cyclomatic_complexity > COMPLEXITY:
            what = f"complexity {function.cyclomatic_complexity}, limit {COMPLEXITY}"
        else:
            continue
        yield function.name, function.start_line, f"`{function.name}`: {what}"


def lacks_head(path, text):
    """Whether nothing is said between the licence and the first line of code of a long file."""
    is_program = path.startswith(("tenon/", "cli/", "worker/")) and path.endswith(".cpp")
    lines = text.split("\n")
    return (is_program and not path.endswith("_test.cpp") and len(lines) > HEAD_LINES
            and not lines[2].startswith("//"))


def check(root, analyze):
    table = os.path.join(root, "tools/size_exceptions.txt")
    unused = read_exceptions(table)
    paths = source_files.project_files(root)
    files, faults = 0, []
    for path in paths:
        if not path.startswith(PLACES) or not path.endswith(SUFFIXES):
            continue
        if source_files.is_generated(path):
            continue
        files += 1
        with open(os.path.join(root, path), encoding="utf-8") as file:
            text = file.read()
        if lacks_head(path, text):
            faults.append(f"{path}:3: {HEAD_LINES} lines and more: say first what it does and why "
                          "it works")
        functions = analyze(path, text).function_list
        excused = set(name for where, name in unused if where == path)
        for name, line, what in oversized(path, text, functions):
            if name in excused:
                unused.pop((path, name), None)
            else:
                faults.append(f"{path}:{line}: {what}")
    for (path, name), number in unused.items():
        faults.append(f"tools/size_exceptions.txt:{number}: `{path} | {name}` is not needed")
    return files, faults


def main():
    try:
        import lizard
    except ImportError:
        print("skipped: lizard is not installed here; `make test` installs it into build/oracle")
        return SKIPPED
    files, faults = check(source_files.ROOT, lizard.analyze_file.analyze_source_code)
    for fault in faults:
        print(fault)
    print(f"{files} files, {len(faults)} over the size limits")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
