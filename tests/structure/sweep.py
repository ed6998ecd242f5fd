#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon structure` on layers of this project, and on the USD files of ../shared where that is,
that name a default prim: it proves itself, makes the same bytes of its own result, moves nothing a
second time, and breaks no rule on structure that the source does not break.

    sweep.py ROOT TENON [--all]

A fixed sample, or with --all every file, two at a time. Three answers of the program besides a
clean one are right, and judged as such:
- A file that it leaves out of a result with an error `read.*` (docs/reading.md) may be missing
  there, at the very place that the error names, and nothing else may be.
- A source that composes beyond a limit of docs/limits.md is refused by that limit's name, with
  exit 2 and no result, where `info` says the same of the source.
- A mesh whose collider takes in the meshes below it, which no engine does, is refused by its name,
  without a result, where `check` warns of the same prim (collider.submeshes).
What misses is named in sweep_misses.txt, which may only shrink; without such a file nothing does.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from program import ROOT, SHARED, TENON, files_of

sys.path.insert(0, str(ROOT / "tests/conformance"))
import suite  # pylint: disable=wrong-import-position

MISSES = ROOT / "tests/structure/sweep_misses.txt"
ENDINGS = (".usd", ".usda", ".usdc", ".usdz")
SAMPLE = 30
SAMPLE_BYTES = 20_000
LIMIT_S = 120
# Files that no structure could come of: without a default prim, or not readable.
REFUSALS = ("stage.default-prim-missing", "text.", "crate.", "file.", "package.", "zip.")
# Found in results -> what the check of the source says of the same fault.
OF_SOURCE = {"structure.missing-file": {"stage.asset-missing"},
             "structure.dangling-target": {"stage.target-missing", "filter.target-missing",
                                           "joint.body-missing", "scene.owner-missing"}}
KNOWN_LIMITS = set(re.findall(r"^\| `(k\w+)`", (ROOT / "docs/limits.md").read_text("utf-8"), re.M))
LIMIT = re.compile(r"\((k[A-Z]\w+)\)")  # as messages name one
NAMED_FILE = re.compile(r"@([^@]*)@|$")
# A line of the interface's record of the files that it was written with.
RECORDED = re.compile(rb'^ +string "[^"]+" = "[0-9a-f]{16}"\n', re.M)
HOLDS, NOTHING, REFUSED = "holds", "has no structure", "is refused by name"


class Miss(Exception):
    """Why an asset is one."""


def answer(*arguments):
    process = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True,
                             text=True, check=False, timeout=LIMIT_S)
    try:
        return {**json.loads(process.stdout), "exit": process.returncode}
    except json.JSONDecodeError:
        raise Miss(f"{arguments[0]} ends with {process.returncode}: "
                   f"{process.stderr[-300:]}") from None


def rules_of(report, *severities):
    return {d["rule"] for d in report["diagnostics"] if d["severity"] in severities}


def limits_of(report):
    """-> the limits that its errors name, of those that docs/limits.md has."""
    messages = [d["message"] for d in report["diagnostics"] if d["severity"] == "error"]
    return {name for text in messages for name in LIMIT.findall(text) if name in KNOWN_LIMITS}


def united_colliders(report, severity, rule):
    """-> prims that it says to be colliders together with the meshes below them."""
    return {d["prim"] for d in report["diagnostics"]
            if (d["severity"], d["rule"]) == (severity, rule) and
            "below this one are part of its collider" in d["message"]}


def left_out(report):
    """-> [(place, file)] of what it says that it does not read."""
    return [((d["prim"], d["property"]), NAMED_FILE.search(d["message"])[1])
            for d in report["diagnostics"]
            if d["severity"] == "error" and d["rule"].startswith("read.")]


def refusal(asset, made, folder):
    """Of a run without a result."""
    if any(rule.startswith(REFUSALS) for rule in rules_of(made, "error")):
        return NOTHING
    limits = limits_of(made)
    if limits and made["exit"] == 2 and not folder.exists():
        if limits & limits_of(answer("info", asset)):
            return REFUSED
    united = united_colliders(made, "error", "structure.differs")
    if united and made["exit"] == 2 and not folder.exists():
        if united <= united_colliders(answer("check", asset), "warning", "collider.submeshes"):
            return REFUSED
    raise Miss(f"refused: {made['diagnostics'][-1:]}")


def check_again(interface, folder):
    """What is made of a result in `folder` / "a" is the same, but for files that the second run
    says it leaves out."""
    again = answer("structure", folder / "a" / interface, "-o", folder / "b")
    first, second = files_of(folder / "a"), files_of(folder / "b")
    said = {file for _, file in left_out(again)}
    gone = {name for name in first if str(folder / "a" / name) in said}
    first = {name: text for name, text in first.items() if name not in gone}
    if gone and first.keys() == second.keys():
        for files in (first, second):
            files[interface] = RECORDED.sub(b"", files[interface])
            for name in [name for name in files if name.startswith(".tenon/")]:
                del files[name]  # the copy of what was made, the interface file included
    if first != second:
        raise Miss("not the same bytes again")
    if again["moved"]:
        raise Miss(f"moved again: {again['moved'][:2]}")


def check_rules(asset, interface, made):
    """The result breaks no rule on structure, but where the source breaks the same or where the
    run said that a file stays out."""
    said = {place for place, _ in left_out(made)}
    found = {d["rule"]
             for d in answer("check", interface, "--profile", "isaac-3.0")["diagnostics"]
             if d["severity"] in ("error", "warning") and d["rule"].startswith("structure.") and
             not (d["rule"] == "structure.missing-file" and (d["prim"], d["property"]) in said)}
    if found:
        source = rules_of(answer("check", asset), "error", "warning")
        found = {rule for rule in found if not OF_SOURCE.get(rule, set()) & source}
    if found:
        raise Miss(f"breaks {sorted(found)}")


def judge(asset, folder):
    """-> HOLDS, NOTHING or REFUSED; Miss says what is wrong."""
    made = answer("structure", asset, "-o", folder / "a")
    if "interface" not in made:
        return refusal(asset, made, folder / "a")
    if left_out(made) and made["exit"] != 1:
        raise Miss(f"leaves files out and ends with {made['exit']}")
    check_again(made["interface"], folder)
    check_rules(asset, folder / "a" / made["interface"], made)
    return HOLDS


def verdict(asset):
    """-> (HOLDS, NOTHING, REFUSED or None, what is wrong)."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            return judge(asset, pathlib.Path(folder).resolve()), ""
        except Miss as miss:
            return None, str(miss)
        except subprocess.TimeoutExpired:
            return None, f"takes more than {LIMIT_S} s"


def assets(everything):
    """All files, or some small ones of those that name a default prim where it can be seen; hands
    have tests of their own."""
    found = sorted(path for path in SHARED.rglob("*") if path.suffix in ENDINGS and path.is_file())
    own = map(pathlib.Path, suite.own_layers())
    found += [path for path in own if "payloads" not in path.parts]
    if everything:
        return found
    named = [path for path in found
             if "assets/inspire_hand" not in str(path) and
             path.stat().st_size < SAMPLE_BYTES and b"defaultPrim" in path.read_bytes()]
    own = [path for path in named if ROOT in path.parents]
    named = [path for path in named if ROOT not in path.parents]
    return named[::max(1, len(named) // SAMPLE)] + own[::max(1, len(own) // SAMPLE)]


def name_of(path):
    return str(path.relative_to(ROOT if ROOT in path.parents else SHARED))


def main():
    everything = "--all" in sys.argv
    known = suite.read_misses(MISSES)
    chosen = assets(everything)
    with concurrent.futures.ThreadPoolExecutor(min(2, os.cpu_count() or 1)) as pool:
        verdicts = dict(zip([name_of(path) for path in chosen],
                            pool.map(verdict, chosen)))
    misses = {name: what for name, (outcome, what) in verdicts.items() if outcome is None}
    for name, what in misses.items():
        print(f"{'known' if name in known else 'MISS'} {name}: {what}")
    right = [name for name in known if name in verdicts and name not in misses]
    for name in right:
        print(f"HOLDS {name}: remove it from {MISSES.name}")
    names = {kind: [name for name, (outcome, _) in verdicts.items() if outcome == kind]
             for kind in (HOLDS, NOTHING, REFUSED)}
    for name in names[REFUSED]:
        print(f"refused by name {name}")
    print(f"{len(names[HOLDS])} of {len(names[HOLDS]) + len(misses)} assets hold, "
          f"{len(set(misses) & set(known))} of the others known; "
          f"{len(names[REFUSED])} are refused by name, "
          f"{len(names[NOTHING])} files have no default prim or cannot be read")
    return 1 if set(misses) - set(known) or right or not names[HOLDS] else 0


if __name__ == "__main__":
    sys.exit(main())
