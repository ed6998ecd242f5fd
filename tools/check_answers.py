#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds where answers are made: cli/ prints JSON and reads it, and builds none.

What a verb answers is a value that tenon/answers or tenon/asset makes, so that other programs can
ask too. cli/ names neither the library for JSON nor a key that it writes; DESCRIBES is what the
command says of itself.

Exit 0: held; 1: each fault on a line of its own.
"""

import os
import re
import sys

import source_files

DESCRIBES = ("cli/text/command_json.cpp",)
COMMENT = re.compile(r"//[^\n]*")
BUILDS = re.compile(
    r"nlohmann"                                   # the library itself
    r"|\bJson::\w+|\bJson[({]"                    # a value, an array, an object, parsing
    r'|\.dump\('                                  # printing past answers/json.h
    r'|(?:\bfinish\([^;{]*|\bpush_back\(|\bupdate\(|\breturn\s)\s*\{\s*\{\s*"[^"\n]*"\s*,'
    r'|\[\s*"[^"\n]*"\s*\]\s*=(?!=)')             # json["key"] =
VALUE = re.compile(r"\bJson\s+\w+\s*(?:;|\{|=\s*\{)")  # a value that is filled later


def check(root, files):
    """-> faults of the project at `root`, whose files are `files`."""
    faults = []
    for path in files:
        if not path.startswith("cli/") or not path.endswith(source_files.CODE) \
                or path.endswith("_test.cpp") or path in DESCRIBES:
            continue
        with open(os.path.join(root, path), encoding="utf-8") as file:
            text = COMMENT.sub("", file.read())
        for pattern in (BUILDS, VALUE):
            for found in pattern.finditer(text):
                line = text.count("\n", 0, found.start()) + 1
                faults.append(f"{path}:{line}: builds JSON: {found[0]!r}; make the answer in "
                              "tenon/answers or tenon/asset")
    return faults


def main():
    faults = check(source_files.ROOT, source_files.project_files())
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults of answers")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
