#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Reports the largest classes by private member functions and the fullest folders by files, for
whoever looks for what should be divided. A report, no test: a limit on counts would shape the
design instead of the reader's needs.

usage: report_counts.py [--most N]

Counted is what is declared below `private:` of a class or struct, constructors included, friends
and the functions of classes inside not; of a folder its own files, tests included.
"""

import argparse
import collections
import os
import re
import sys

import source_files

PROGRAM = ("tenon/", "cli/", "worker/")
PLACES = ("tenon/", "cli/", "worker/", "tests/", "bench/", "fuzz/")
# Comments, literals and lines of the preprocessor, with its continued ones: no code of a class.
NO_CODE = re.compile(
    r'//[^\n]*|/\*.*?\*/|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*'
    r'|R"([^(\s]*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)+\'(?!\w)', re.S | re.M)
HEAD = re.compile(r"\b(class|struct)\s+(?:\[\[[^\]]*\]\]\s*|\w+\([^)]*\)\s*)?"
                  r"(\w+(?:::\w+)*(?:<[^;{}()]*>)?)\s*(?:final\s*)?(?::(?!:)[^;{}()]*)?\{")
ACCESS = re.compile(r"\b(public|protected|private)\s*:(?!:)")
NO_FUNCTION = re.compile(r"^(?:friend|using|typedef|static_assert|enum|class|struct|union)\b")
OPERATOR = re.compile(r"operator\s*(?:\(\)|[^\w\s(]+)")
TEMPLATE = re.compile(r"<[^<>]*>")


def code_of(text):
    """The same text with blanks for what is no code; lines keep their numbers."""
    return NO_CODE.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def end_of_braces(code, begin):
    """Behind the brace that closes the one at `begin`."""
    depth = 0
    for at in range(begin, len(code)):
        depth += {"{": 1, "}": -1}.get(code[at], 0)
        if depth == 0:
            return at + 1
    return len(code)


def members(code, begin, end):
    """The text of a class between its braces; what stands in braces inside is left out."""
    parts, at = [], begin
    while at < end:
        if code[at] == "{":
            at = end_of_braces(code, at)
            parts.append("{}")
        else:
            parts.append(code[at])
            at += 1
    return "".join(parts)


def is_function(statement):
    """Whether a statement of a class declares or defines a member function."""
    statement = OPERATOR.sub("operator", statement.strip())
    while TEMPLATE.search(statement):
        statement = TEMPLATE.sub("", statement)
    statement = re.sub(r"^template\s*|\[\[.*?\]\]\s*|\balignas\([^)]*\)\s*", "", statement)
    statement = re.sub(r"^template\s*|^requires\b[^{;]*?\s(?=\w+ \w+\()", "", statement.strip())
    return not NO_FUNCTION.match(statement) and "(" in re.split(r"[={]", statement)[0]


def statements(text):
    """Splits the members of a class at `;` and behind bodies. An initializer in braces, of a
    variable or in a constructor's list, is followed by `;`, `,` or a body: its part goes on."""
    for part in text.split(";"):
        ends = [found.end() for found in re.finditer(r"\{\}(?!\s*(?:,|\{\}|$))", part)]
        for begin, end in zip([0, *ends], [*ends, len(part)]):
            if part[begin:end].strip():
                yield part[begin:end]


def private_functions(kind, text):
    """Number of private member functions of a class with these members."""
    pieces = ACCESS.split(text)
    access = ["private" if kind == "class" else "public", *pieces[1::2]]
    return sum(is_function(statement) for word, piece in zip(access, pieces[::2])
               if word == "private" for statement in statements(piece))


def classes(text):
    """-> (name, line, number of private member functions) of each class that is defined here."""
    code = code_of(text)
    for found in HEAD.finditer(code):
        if re.search(r"\benum\s*$", code[:found.start()]):
            continue
        end = end_of_braces(code, found.end() - 1)
        inside = members(code, found.end(), end - 1)
        line = code.count("\n", 0, found.start()) + 1
        yield found[2], line, private_functions(found[1], inside)


def class_rows(root):
    """[(number of private member functions, file, line, name)], the largest first."""
    found = []
    for path in source_files.project_files(root):
        if path.startswith(PLACES) and path.endswith(source_files.CODE):
            with open(os.path.join(root, path), encoding="utf-8") as file:
                found += [(count, path, line, name) for name, line, count in classes(file.read())]
    return sorted(found, reverse=True)


def folder_rows(root):
    """[(number of files, folder of the program)], the fullest first."""
    folders = collections.Counter(os.path.dirname(path) for path in
                                  source_files.project_files(root)
                                  if path.startswith(PROGRAM) and path.endswith(source_files.CODE))
    return sorted(((count, folder) for folder, count in folders.items()), reverse=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--most", type=int, default=10, help="rows of each list")
    most = parser.parse_args().most
    for count, path, line, name in class_rows(source_files.ROOT)[:most]:
        print(f"{count:4} private member functions  {path}:{line}: {name}")
    for count, folder in folder_rows(source_files.ROOT)[:most]:
        print(f"{count:4} files  {folder}")


if __name__ == "__main__":
    main()
