#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the rules of text: licence lines, white space, line length, names, addresses.

Exit 0: held; 1: each fault on a line of its own.
"""

import os
import re
import sys

import source_files

SPDX = ("SPDX-FileCopyrightText: tenon authors", "SPDX-License-Identifier: Apache-2.0")
WITH_SPDX = (".h", ".cpp", ".def", ".inc", ".py", ".sh", ".cmake", "CMakeLists.txt", "Makefile")
TEXT = WITH_SPDX + (".md", ".txt", ".json", ".clang-format", ".clang-tidy", ".gitignore")
# Inputs and expected outputs of tests are what they are.
DATA = ("tests/golden/", "tests/conformance/", "tests/data/", "fuzz/corpus/", "examples/")
LINE_LENGTH = 100
# Pages that are read from top to bottom.
MOST_LINES = {"ARCHITECTURE.md": 150, "README.md": 100, "CHANGELOG.md": 150}
VAGUE = re.compile(r"(^|[/_])(utils?|helpers?|common|managers?|misc)([_./]|$)")
ADDRESS = re.compile(r"\b(?!package:|model:)[a-z]+://([A-Za-z0-9.-]+)")  # ROS's name packages
# The package is on no index, so nobody may be told to take it from there; with its wheel installed,
# the name with an extra, as in tenon-usd[gym], takes the extra alone.
NOT_PUBLISHED = re.compile(r"pip install '?tenon-usd(?!\[)")
# Hosts that a file may name. Where packages come from is the user's own configuration.
HOSTS = {"www.apache.org", "spdx.org", "openusd.org", "aousd.org", "mujoco.org",
         "mujoco.readthedocs.io", "docs.isaacsim.omniverse.nvidia.com", "github.com",
         "json.schemastore.org", "git-lfs.github.com",
         "json-schema.org",
         "127.0.0.1", "localhost", "evil.example"}  # this machine, and nobody (RFC 2606)


def check_lines(path, text):
    code = path.endswith(source_files.CODE + (".py", ".cmake", ".sh", "CMakeLists.txt"))
    for number, line in enumerate(text.split("\n"), 1):
        if line != line.rstrip():
            yield number, "white space at the end of the line"
        if "\t" in line and not path.endswith("Makefile"):
            yield number, "tab"
        if code and len(line) > LINE_LENGTH and not source_files.is_generated(path):
            yield number, f"{len(line)} characters, limit {LINE_LENGTH}"
        if NOT_PUBLISHED.search(line):
            yield number, "tenon-usd is on no index: name the wheel, dist/tenon_usd-*.whl"
        for host in ADDRESS.findall(line):
            if host.lower() not in HOSTS:
                yield number, f"address of {host}; see HOSTS in tools/check_text.py"


def check_whole(path, text):
    if VAGUE.search(path):
        yield 1, "the name says nothing; name the file by what it holds"
    if path.endswith(WITH_SPDX):
        head = text.split("\n")[:4]
        for wanted in SPDX:
            if not any(wanted in line for line in head):
                yield 1, f"missing `{wanted}` in the first lines"
    if not text.endswith("\n") or text.endswith("\n\n"):
        yield text.count("\n") + 1, "a file ends with one line feed"
    if path.endswith(".h") and "#pragma once" not in text:
        yield 1, "missing `#pragma once`"
    most = MOST_LINES.get(path)
    if most and text.count("\n") > most:
        yield most + 1, f"longer than {most} lines"


def check_file(path, text):
    for number, what in [*check_whole(path, text), *check_lines(path, text)]:
        yield f"{path}:{number}: {what}"


def main():
    faults, files = [], 0
    for path in source_files.project_files():
        if not path.endswith(TEXT) or path.startswith(DATA):
            continue
        files += 1
        with open(os.path.join(source_files.ROOT, path), encoding="utf-8") as file:
            faults.extend(check_file(path, file.read()))
    for fault in faults:
        print(fault)
    print(f"{files} files, {len(faults)} faults of text")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
