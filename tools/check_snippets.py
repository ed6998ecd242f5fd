#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every C++ snippet of docs/cpp is a part of a program in examples/cpp, line by line, so that what
is copied compiles and runs; and every one of those programs is shown somewhere. A name that the
program shortens (`using tenon::layer::Value;`, `namespace fs = std::filesystem;`) is shortened on
the page too, before it is used there. No console block
of any page shows a command that fails, unless the line before the block says why it should:

    <!-- meant to fail: the two versions differ -->

Usage: check_snippets.py [ROOT]. Exit 0: so it is; 1: a line for each fault.
"""

import glob
import os
import re
import sys
import textwrap

import source_files

SNIPPET = re.compile(r"^```cpp\n(.*?)^```$", re.M | re.S)


CONSOLE = re.compile(r"(^<!-- meant to fail: .+ -->\n)?^```console\n(.*?)^```$", re.M | re.S)
FAILED = re.compile(r"^\[exit code \d+\]$", re.M)


def failures(path, text):
    """Commands of console blocks that fail though nobody meant it, and marks without a failure."""
    for block in CONSOLE.finditer(text):
        failed = FAILED.search(text, block.start(2), block.end(2))
        if failed and not block[1]:
            command = text.rfind("\n$ ", 0, failed.start()) + 1
            line = text.count("\n", 0, command) + 1
            yield (f"{path}:{line}: this command fails; correct it, or say why it should with "
                   "<!-- meant to fail: REASON --> in the line before the block")
        if block[1] and not failed:
            line = text.count("\n", 0, block.start()) + 1
            yield f"{path}:{line}: nothing in this block fails; remove the mark"


#: What gives a name its short form, and that name.
SHORT = re.compile(r"^(?:using [\w:]+::(\w+);|namespace (\w+) = [\w:]+;|using (\w+) = .*;)$")


def unexplained(program, snippet, shown):
    """Lines of `program` that shorten a name which `snippet` uses, and which the page does not have
    up to here (`shown`, its lines)."""
    text = "\n".join(snippet)
    for line in program:
        match = SHORT.match(line.strip())
        if match and line.strip() not in shown:
            name = match[1] or match[2] or match[3]
            if re.search(rf"(?<![\w:.>]){name}\b", text):
                yield line.strip()


def has_part(program, snippet):
    """`snippet` stands in `program` as it is, moved to the right as a whole or not."""
    size = len(snippet)
    for start in range(len(program) - size + 1):
        if textwrap.dedent("\n".join(program[start:start + size])).split("\n") == snippet:
            return True
    return False


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def check(root):
    """-> (number of snippets, [faults])"""
    programs = {os.path.basename(path): read(path).split("\n")
                for path in glob.glob(os.path.join(root, "examples/cpp/*.cpp"))}
    faults, shown, count = [], set(), 0
    for page in sorted(glob.glob(os.path.join(root, "docs/cpp/*.md"))):
        text, lines = read(page), set()
        for match in SNIPPET.finditer(text):
            count += 1
            snippet = match[1].rstrip("\n").split("\n")
            lines |= {each.strip() for each in snippet}
            found = {name for name, program in programs.items() if has_part(program, snippet)}
            shown |= found
            line = text.count("\n", 0, match.start()) + 1
            lacking = [set(unexplained(programs[name], snippet, lines)) for name in found]
            if lacking and all(lacking):  # of several programs one will do
                faults += [f"{os.path.relpath(page, root)}:{line}: this does not compile without "
                           f"`{each}`; show that line, too" for each in sorted(lacking[0])]
            if not found:
                faults.append(f"{os.path.relpath(page, root)}:{line}: no program in examples/cpp "
                              "has this snippet; copy it from one")
    faults += [f"examples/cpp/{name}:1: no page of docs/cpp shows a part of it"
               for name in sorted(set(programs) - shown)]
    for path in source_files.project_files(root):
        if path.endswith(".md"):
            faults += failures(path, read(os.path.join(root, path)))
    return count, faults


def main():
    count, faults = check(sys.argv[1] if len(sys.argv) > 1 else ".")
    for fault in faults:
        print(fault)
    print(f"{count} snippets, {len(faults)} faults")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
