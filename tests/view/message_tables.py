#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the tables of messages into docs/viewer.md, as the program tells them.

    message_tables.py ROOT TENON
"""

import pathlib
import re
import sys

import viewer

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())


def fields(row):
    properties = row["schema"]["properties"]
    needed = row["schema"]["required"]
    return "<br>".join(f"`{name}` {field['description']}{'' if name in needed else ' (optional)'}"
                       for name, field in properties.items() if name not in ("do", "is", "id"))


def table(rows, heads, last):
    lines = [f"| {' | '.join(heads)} |", "|" + "---|" * len(heads)]
    for row in rows:
        end = f" {row[last]} |" if last else ""
        lines.append(f"| `{row['name']}` | {row['meaning']} | {fields(row)} |{end}")
    return "\n".join(lines)


def with_tables(page, tables):
    """The page with its tables between the marks made anew."""
    made = {"requests": table(tables["requests"], ["`do`", "what", "fields", "result"], "answer"),
            "notices": table(tables["notices"], ["`is`", "what", "fields"], None)}
    for kind, text in made.items():
        page = re.sub(rf"(<!-- {kind} -->\n\n).*?(\n\n<!-- end -->)",
                      lambda found, text=text: found[1] + text + found[2], page, flags=re.DOTALL)
    return page


def main():
    page = ROOT / "docs/viewer.md"
    with viewer.Viewer(TENON, ROOT / "examples/scenes/box_on_box.usda") as view, \
            view.client() as client:
        tables = client.done("messages")
    page.write_text(with_tables(page.read_text(), tables))


if __name__ == "__main__":
    main()
