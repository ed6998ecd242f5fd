#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds how much a class may do behind its door: at most 20 private member functions. More are
steps on data that everything may touch: values and free functions say what each of them needs.

Counted is what is declared below `private:` of a class or struct, constructors included, friends
and the functions of classes inside not. Exit 0: held; 1: each class with more on a line.
"""

import collections
import os
import re
import sys

import source_files

PRIVATE_FUNCTIONS = 20
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


def check(root):
    found = []
    for path in source_files.project_files(root):
        if path.startswith(PLACES) and path.endswith(source_files.CODE):
            with open(os.path.join(root, path), encoding="utf-8") as file:
                found += [(count, path, line, name) for name, line, count in classes(file.read())]
    return sorted(found, reverse=True)


def over_the_limit(rows):
    return [row for row in rows if row[0] > PRIVATE_FUNCTIONS]


def main():
    found = check(source_files.ROOT)
    faults = over_the_limit(found)
    for count, path, line, name in faults:
        print(f"{path}:{line}: `{name}` has {count} private member functions, at most "
              f"{PRIVATE_FUNCTIONS}: make values and free functions of them")
    print(f"{len(found)} classes, {len(faults)} with too many private member functions")
    return 1 if faults or not found else 0


if __name__ == "__main__":
    sys.exit(main())
