#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds where files are written: in tenon/bytes alone, and in cli/ through cli/output.cpp alone.

What writes is found, not listed: the headers of tenon/bytes whose sources change files, the
functions of tenon/ that use them, and the functions that call those. cli/ includes and calls none
of them, but in OUTPUTS.

Exit 0: held; 1: each fault on a line of its own.
"""

import os
import re
import sys

import source_files

OUTPUTS = ("cli/output.cpp", "cli/output.h", "cli/print.cpp")
# What the language and the system have to write with.
PRIMITIVES = re.compile(
    r"\b(?:std::)?(?:ofstream|fstream|fwrite|putchar|puts)\b|\bstd::(?:cout|printf|vprintf)\b"
    r"|\bf(?:printf|puts|putc)\([^;]*?\bstdout\b|(?<![\w.>])(?:std::|::)fopen\b"
    r"|\bO_(?:WRONLY|RDWR|CREAT|TMPFILE)\b"
    r"|(?<![\w.>])::(?:write\((?!STDERR_FILENO)|(?:rename|link|linkat|symlink)\()")
OPENERS = re.compile(r"(?<![\w.>])::(?:rename|linkat|unlink)\(")
IGNORED = re.compile(r'//[^\n]*|(?<!#include )"(?:[^"\\\n]|\\.)*"')
DEFINITION = re.compile(r"^[\w:][^\n;={}#]*?\b(?:\w+::)*(\w+)\([^;{}]*\)[^;{}()]*\{\n(.*?)^\}",
                        re.MULTILINE | re.DOTALL)
CALLS_WRITER = re.compile(r"\.commit\(|\bwrite_file\(|\.take_place\(|\bunpack_zip\(")
# Nothing is written: a stream is sent to nowhere.
NOWHERE = re.compile(r'(?:fopen\(|addopen\([^"]*)"/dev/null"')


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return IGNORED.sub(lambda text: '"/dev/null"' if "/dev/null" in text[0] else "",
                           file.read())


def product(files, folder):
    return [path for path in files if path.startswith(folder) and path.endswith(source_files.CODE)
            and not re.search(r"_test\.cpp$|/test_\w+\.h$|/killed_child\.h$", path)]


def headers_that_write(texts):
    """-> headers of tenon/bytes whose source changes files, by what it calls and includes."""
    writers = {path for path, text in texts.items()
               if path.startswith("tenon/bytes/") and OPENERS.search(text)}
    while True:
        headers = {re.sub(r"\.cpp$", ".h", path) for path in writers}
        more = {path for path, text in texts.items()
                if path.startswith("tenon/bytes/") and path.endswith(".cpp")
                and headers & set(re.findall(r'#include "([^"]+)"', text))}
        if more <= writers:
            return headers & set(texts)
        writers |= more


def space_of(path):
    """-> the namespace of a folder of tenon/, as code in cli/ writes it before a name."""
    folder = path.split("/")[1:-1]
    return "" if folder[:1] in ([], ["asset"]) else folder[-1] + "::"


def functions_that_write(texts, headers):
    """-> names of functions of tenon/, beside those of tenon/bytes, that end in a file's change."""
    bodies = [(space_of(path), name, body) for path, text in texts.items()
              if path.startswith("tenon/") and path.endswith(".cpp")
              and not path.startswith("tenon/bytes/")
              for name, body in DEFINITION.findall(text)]
    users = {space_of(path) for path, text in texts.items()
             if headers & set(re.findall(r'#include "([^"]+)"', text))}
    found = {(space, name) for space, name, body in bodies
             if space in users and CALLS_WRITER.search(body)}
    while True:
        more = {(space, name) for space, name, body in bodies
                if any(re.search(rf"(?<![\w:]){re.escape(other if near == space else near + other)}"
                                 r"\(", body) for near, other in found)}
        if more <= found:
            return {space + name for space, name in found}
        found |= more


def check(root, files):
    """-> faults of the project at `root`, whose files are `files`."""
    texts = {path: read(root, path) for path in product(files, ("tenon/", "cli/"))}
    faults = []
    headers = headers_that_write(texts)
    if not headers:
        faults.append("tenon/bytes: no header that writes files was found")
    names = "|".join(sorted(functions_that_write(texts, headers)))
    for path, text in texts.items():
        if path in OUTPUTS or path.startswith("tenon/bytes/"):
            continue
        for number, line in enumerate(text.split("\n"), 1):
            if PRIMITIVES.search(line) and not NOWHERE.search(line):
                faults.append(f"{path}:{number}: writes by itself: {line.strip()}")
            calls = names and re.search(rf"(?<![\w:.])(?:{names})\(", line)
            if path.startswith("cli/") and calls:
                faults.append(f"{path}:{number}: {calls[0]}...) writes files")
        if path.startswith("cli/"):
            faults += [f"{path}: includes {header}, which writes files"
                       for header in re.findall(r'#include "([^"]+)"', text)
                       if header in headers]
    return faults


def main():
    faults = check(source_files.ROOT, source_files.project_files())
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults of outputs")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
