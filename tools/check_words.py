#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds pages, comments and messages to docs/glossary.md: phrases in backquotes in the last column
of its tables do not occur, except as often as tools/words_left.txt allows for a file.

usage: check_words.py [--all | --write]

--all prints each place with the word to use. --write lowers the numbers of tools/words_left.txt to
what is there; it raises none. Exit 0: held; 1: a line for each place in a file with too many.
"""

import os
import re
import sys

import source_files

GLOSSARY, LEFT = "docs/glossary.md", "tools/words_left.txt"
FOLDERS = ("tenon/", "cli/", "worker/")
ROW = re.compile(r"^\| *([^|]+?) *\|[^|]*\|([^|]*)\|$", re.MULTILINE)
TEXT = re.compile(r'"(?:[^"\\]|\\.)*"|//.*')
FENCE = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)


def pattern_of(phrase):
    """`take* ... apart` as an expression for the words of a line; not within names like a.b-c."""
    words = [r"(?:[\w'`]+ ){0,3}" if word == "..." else re.escape(word).replace(r"\*", r"\w*") + " "
             for word in phrase.split()]
    return re.compile(r"(?<![\w.-])" + "".join(words).rstrip(" ") + r"(?![\w-])", re.IGNORECASE)


def avoided(glossary):
    """-> [(pattern, word to use)] of the tables."""
    return [(pattern_of(phrase), word) for word, phrases in ROW.findall(glossary)
            for phrase in re.findall(r"`([^`]+)`", phrases)]


def prose(path, text):
    """The lines that people read, code blanked: all of a page, comments and texts of code."""
    if path.endswith((".md", ".txt")):
        return FENCE.sub(lambda found: "\n" * found[0].count("\n"), text).split("\n")
    return [" ".join(TEXT.findall(line)) for line in text.split("\n")]


def is_held(path):
    code = path.startswith(FOLDERS) and path.endswith(source_files.CODE + (".txt",))
    page = path.endswith(".md") and path != GLOSSARY
    return (code or page) and not source_files.is_generated(path)


def places(path, text, rules):
    """-> a line for each phrase of a file that the glossary avoids."""
    return [f"{path}:{number}: \"{found[0]}\"; write: {word}"
            for number, line in enumerate(prose(path, text), 1)
            for rule, word in rules for found in rule.finditer(line)]


def read_left(text):
    """-> {path: count} of lines `count path`"""
    rows = [line.split(" ", 1) for line in text.splitlines() if line and not line.startswith("#")]
    return {path: int(count) for count, path in rows}


def too_many(found, left):
    """The places of files that have more of them than allowed."""
    return [place for path, lines in found.items() if len(lines) > left.get(path, 0)
            for place in lines]


def lowered(left, found):
    """The numbers as they may be from now on; none is raised."""
    counts = {path: min(count, len(found.get(path, []))) for path, count in left.items()}
    return {path: count for path, count in counts.items() if count}


def read(path):
    with open(os.path.join(source_files.ROOT, path), encoding="utf-8") as file:
        return file.read()


def main():
    rules, text = avoided(read(GLOSSARY)), read(LEFT)
    left = read_left(text)
    found = {path: places(path, read(path), rules)
             for path in source_files.project_files() if is_held(path)}
    if "--write" in sys.argv[1:]:
        head = [line for line in text.splitlines() if line.startswith("#")]
        rows = [f"{count} {path}" for path, count in sorted(lowered(left, found).items())]
        with open(os.path.join(source_files.ROOT, LEFT), "w", encoding="utf-8") as file:
            file.write("\n".join(head + rows) + "\n")
        left = lowered(left, found)
    faults = too_many(found, left)
    for place in [line for lines in found.values() for line in lines] \
            if "--all" in sys.argv[1:] else faults:
        print(place)
    print(f"{len(found)} files, {sum(map(len, found.values()))} phrases that the glossary avoids, "
          f"{len(faults)} faults")
    return 1 if faults or not rules or not found else 0


if __name__ == "__main__":
    sys.exit(main())
