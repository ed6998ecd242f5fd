#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the table of folders in ARCHITECTURE.md and the page docs/where-to-add.md of
tenon/folders.txt.

usage: make_architecture.py [ROOT] [--write]

Of the folders that a folder may include, the table names those that no other of them may include
already; check_folders.py holds the whole list. Exit 0: both are up to date, or were written; 1: one
is not, or a folder has no description.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BEGIN, END = "<!-- folders: made by tools/make_architecture.py -->\n", "<!-- end of folders -->\n"
PAGE_HEAD = """# Where do I add ...?

What changes when something new comes in, folder by folder in the order of the data flow
([ARCHITECTURE.md](../ARCHITECTURE.md)). Made by `tools/make_architecture.py` of
`tenon/folders.txt`.
"""


class Folder:
    """A row of folders.txt: its name in the clone, what it may include (None: everything), what it
    holds, its values in -> out, and [(what is added, where)]."""

    def __init__(self, name, uses):
        self.name, self.uses, self.holds, self.flow, self.additions = name, uses, "", "", []


def statements(text):
    """The lines of folders.txt, continued ones joined; without the head of the file."""
    joined = re.sub(r"\n#    +", " ", text)
    found = re.search(r"^\w+ :", joined, re.M)
    return joined[found.start():].splitlines() if found else []


def read_folders(text):
    folders = []
    for line in statements(text):
        row = re.match(r"([\w/]+) :(.*)", line)
        if row or line.startswith("#@ "):
            name = ("tenon/*.h" if row[1] == "tenon" else f"tenon/{row[1]}") if row else line[3:]
            folders.append(Folder(name, row[2].split() if row else None))
        elif line.startswith("#> "):
            folders[-1].flow = line[3:]
        elif line.startswith("#+ "):
            what, _, where = line[3:].partition(" | ")
            folders[-1].additions.append((what, where))
        elif line.startswith("# "):
            folders[-1].holds = line[2:]
        else:
            break  # what tests may include
    return folders


def nearest(folders):
    """{folder: those it may include which none of the others includes, as words}"""
    uses = {folder.name.removeprefix("tenon/").replace("*.h", "tenon"): set(folder.uses)
            for folder in folders if folder.uses is not None}
    found = {}
    for name, used in uses.items():
        below = set().union(*(uses[each] for each in used))
        found[name] = " ".join(each for each in uses if each in used - below)
    return found


def table(folders):
    above = nearest(folders)
    lines = ["| folder | holds | in -> out | above |\n|---|---|---|---|\n"]
    for folder in folders:
        key = folder.name.removeprefix("tenon/").replace("*.h", "tenon")
        cells = (f"`{folder.name}`", folder.holds, folder.flow, above.get(key, ""))
        lines.append("| " + " | ".join(cells) + " |\n")
    return "".join(lines)


def page(folders):
    parts = [PAGE_HEAD]
    for folder in folders:
        if folder.additions:
            parts.append(f"\n## {folder.name.rstrip('/')}\n\n| to add | go to |\n|---|---|\n")
            parts += [f"| {what} | {where.replace('](docs/', '](')} |\n"
                      for what, where in folder.additions]
    return "".join(parts)


def made(root):
    """{path: text as it should be}, [faults]"""
    folders = read_folders((root / "tenon/folders.txt").read_text(encoding="utf-8"))
    document = (root / "ARCHITECTURE.md").read_text(encoding="utf-8")
    faults = [f"tenon/folders.txt:1: `{folder.name}` does not say what it holds"
              for folder in folders if not folder.holds]
    before, begin, rest = document.partition(BEGIN)
    end = rest.partition(END)
    if not begin or not end[1]:
        return {}, [*faults, "ARCHITECTURE.md:1: the marks around the table of folders are gone"]
    return {root / "ARCHITECTURE.md": before + BEGIN + table(folders) + END + end[2],
            root / "docs/where-to-add.md": page(folders)}, faults


def main():
    words = [word for word in sys.argv[1:] if word != "--write"]
    root = pathlib.Path(words[0]) if words else ROOT
    texts, faults = made(root)
    for path, text in texts.items():
        if "--write" in sys.argv:
            path.write_text(text, encoding="utf-8")
        elif not path.exists() or path.read_text(encoding="utf-8") != text:
            faults.append(f"{path.relative_to(root)}:1: not as tenon/folders.txt says; run "
                          "tools/make_architecture.py --write")
    for fault in faults:
        print(fault)
    print(f"{len(texts)} files, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
