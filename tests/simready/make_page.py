#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds docs/simready.md to the table of requirements.

    make_page.py ROOT [--write]

The page's tables stand between marks and are made of tenon/check/simready/requirements.def.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
PAGE = ROOT / "docs/simready.md"
TABLE = ROOT / "tenon/check/simready/requirements.def"
ROW = re.compile(r'^TENON_(REQUIREMENT|OPEN)\("(\w+)", "([^"]+)", (\w+), (\w+), "(\w*)",(.*?)\)$',
                 re.M | re.S)
TEXTS = re.compile(r'((?:\s*"(?:[^"\\]|\\.)*")+)')
PARTS = re.compile(r'"((?:[^"\\]|\\.)*)"')
WORDS = {"Must": "must", "May": "may", "No": ""}


def rows():
    for kind, family, code, robot, prop, runtime, rest in ROW.findall(TABLE.read_text("utf-8")):
        texts = ["".join(PARTS.findall(text)).replace('\\"', '"') for text in TEXTS.findall(rest)]
        yield kind == "OPEN", f"{family}.{code}", WORDS[robot], WORDS[prop], runtime, texts


def tables():
    decided = "| code | robot | prop | with | asks |\n|---|---|---|---|---|\n"
    left = "| code | robot | prop | asks | why not |\n|---|---|---|---|---|\n"
    for is_open, code, robot, prop, runtime, texts in rows():
        if is_open:
            left += f"| {code} | {robot} | {prop} | {texts[0]} | {texts[1]} |\n"
        else:
            decided += f"| {code} | {robot} | {prop} | {runtime} | {texts[0]} |\n"
    return {"decided": decided, "open": left}


def main():
    text = PAGE.read_text("utf-8")
    made = text
    for name, table in tables().items():
        pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- end of {name} -->)", re.S)
        made, count = pattern.subn(lambda at, table=table: at[1] + table + at[2], made)
        if count != 1:
            print(f"{PAGE.name}: {count} places for the table {name}")
            return 1
    if "--write" in sys.argv:
        PAGE.write_text(made, "utf-8")
    elif made != text:
        print(f"{PAGE.name} is not up to date: run {pathlib.Path(__file__).name} . --write")
        return 1
    print(f"{len(list(rows()))} requirements")
    return 0


if __name__ == "__main__":
    sys.exit(main())
