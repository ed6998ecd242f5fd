#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every C++ snippet of docs/cpp is a part of a program in examples/cpp, line by line, so that what
is copied compiles and runs; and every one of those programs is shown somewhere.

Usage: check_snippets.py [ROOT]. Exit 0: so it is; 1: a line for each snippet that is not.
"""

import glob
import os
import re
import sys
import textwrap

SNIPPET = re.compile(r"^```cpp\n(.*?)^```$", re.M | re.S)


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
        text = read(page)
        for match in SNIPPET.finditer(text):
            count += 1
            snippet = match[1].rstrip("\n").split("\n")
            found = {name for name, program in programs.items() if has_part(program, snippet)}
            shown |= found
            if not found:
                line = text.count("\n", 0, match.start()) + 1
                faults.append(f"{os.path.relpath(page, root)}:{line}: no program in examples/cpp "
                              "has this snippet; copy it from one")
    faults += [f"examples/cpp/{name}:1: no page of docs/cpp shows a part of it"
               for name in sorted(set(programs) - shown)]
    return count, faults


def main():
    count, faults = check(sys.argv[1] if len(sys.argv) > 1 else ".")
    for fault in faults:
        print(fault)
    print(f"{count} snippets, {len(faults)} faults")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
