#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the pages of docs/rules to the table of rules and to what the program prints.

    check_pages.py ROOT TENON [--write]

Each rule has a page with its facts, each page a rule or a family of rules; --explain prints it; the
index docs/rules/README.md is made of the rules and of tests/check/kinds.txt (--write makes it).
"""

import json
import pathlib
import subprocess
import sys

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
PAGES = ROOT / "docs/rules"
INDEX = PAGES / "README.md"
KINDS = ROOT / "tests/check/kinds.txt"
HEAD = """# Rules of tenon check

`tenon check FILE` checks an asset by these rules. A page for each says what is wrong, why, and
how to correct it.

- Search: the search of the site (`make site`) finds every page, and a box above its table filters
  the rules. In a terminal: `tenon check --list-rules | grep mass`.
- One page: `tenon explain RULE` prints it.
- Skip a rule: `tenon check FILE --skip RULE`; only one: `--only RULE`, or the part before the dot.
- Skip a rule for a repository, with the reason: [settings.md](../settings.md).
- Numbers such as S-83 are explained in [physics-conformance.md](../physics-conformance.md).
- Scripts read fields, not messages: [findings.md](../findings.md) lists the fields of a finding.

Made by `tests/check/check_pages.py --write` from the rules and `tests/check/kinds.txt`.
"""
LISTS = {
    "eight": "Eight defects that no validator found\n\nPlanted in one small stage: the validation "
             "framework of usd-core 26.11 and a vendor's\nvalidator found none of them.",
    "forty": "Kinds of defects in small scenes\n\nKinds that a survey planted one by one, and more "
             "that it met in converted robots. The best of six\nother tools found 17 of 40, twelve "
             "were found by none.",
    "isaac": "What Isaac's asset validation asks\n\nThe rules on physics, without their faults. "
             "Those on names of files, folders, thumbnails, layers and\non the Isaac robot schema "
             "are about the structure of an asset, not its physics.",
}


def rules():
    done = subprocess.run([TENON, "check", "--list-rules", "--json"], capture_output=True,
                          check=True)
    return json.loads(done.stdout)["rules"]


def kinds():
    rows = []
    for line in KINDS.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            parts = [part.strip() for part in line.split("|")]
            rows.append((parts[0], parts[1], [name.strip() for name in parts[2].split(",")]))
    return rows


def facts(rule):
    text = rule["severity"] + (f"; {rule['numbers']}" if rule["numbers"] else "")
    text += f"; `--for` {' '.join(rule['engines'])}" if rule["engines"] else ""
    text += "; `--fix` corrects it" if rule["autofix"] else ""
    return text + ("; `--fix --suggested` corrects it" if rule["suggestedFix"] else "")


def link(name):
    return f"[`{name}`]({name}.md)"


def index(table, rows):
    text = HEAD + f"\n## All {len(table)} rules\n\n| rule | severity | numbers | fix | about |\n"
    text += "|---|---|---|---|---|\n"
    for rule in table:
        fix = "yes" if rule["autofix"] else "suggested" if rule["suggestedFix"] else ""
        text += (f"| {link(rule['rule'])} | {rule['severity']} | {rule['numbers']} | {fix} | "
                 f"{rule['title']} |\n")
    for key, title in LISTS.items():
        text += f"\n## {title}\n\n| kind | rule |\n|---|---|\n"
        for name, kind, found in rows:
            if name == key:
                text += f"| {kind} | {', '.join(map(link, found))} |\n"
    families = sorted(page.stem for page in PAGES.glob("*.md") if "." not in page.stem)
    families.remove(INDEX.stem)
    return text + ("\n## Families of findings while files are read\n\n"
                   + ", ".join(map(link, families)) + "\n")


def page_faults(rule):
    page = PAGES / f"{rule['rule']}.md"
    if not page.is_file():
        yield f"{page.name}: missing"
        return
    lines = page.read_text(encoding="utf-8").split("\n")
    if lines[0] != f"# {rule['rule']}" or lines[2] != facts(rule):
        yield f"{page.name}: wants `# {rule['rule']}` and `{facts(rule)}` on top"
    if not rule["title"].endswith(".") or "\nTo correct: " not in "\n".join(lines):
        yield f"{page.name}: wants a sentence that says what is wrong and `To correct: `"
    shown = subprocess.run([TENON, "check", "--explain", rule["rule"]], capture_output=True,
                           check=True, text=True).stdout
    if shown != "\n".join(lines):
        yield f"{page.name}: --explain prints something else"


def faults(table, rows):
    known = {rule["rule"] for rule in table}
    for rule in table:
        yield from page_faults(rule)
    for page in sorted(PAGES.glob("*.md")):
        if page != INDEX and page.stem not in known and "." in page.stem:
            yield f"{page.name}: there is no such rule"
    for name, kind, found in rows:
        unknown = [rule for rule in found if rule not in known]
        if name not in LISTS or unknown:
            yield f"{KINDS.name}: {kind}: {unknown or name} is not known"
    if not known:
        yield "no rules"


def main():
    table, rows = rules(), kinds()
    found = list(faults(table, rows))
    text = index(table, rows)
    if "--write" in sys.argv:
        INDEX.write_text(text, encoding="utf-8")
    if not INDEX.is_file() or INDEX.read_text(encoding="utf-8") != text:
        found.append(f"{INDEX.name} is not up to date: run {pathlib.Path(__file__).name} --write")
    for fault in found:
        print(fault)
    print(f"{len(table)} rules, {len(rows)} kinds, {len(found)} faults of pages")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
