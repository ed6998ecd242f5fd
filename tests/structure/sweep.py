#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon structure` on the USD files of ../shared that name a default prim: it proves itself, makes
the same bytes of its own result, moves nothing a second time, and breaks no rule on structure that
the source does not break.

    sweep.py ROOT TENON [--all]

A fixed sample, or with --all every file, two at a time. What misses is named in sweep_misses.txt,
which may only shrink; without such a file nothing does. Exit 77: ../shared is absent.
"""

import concurrent.futures
import json
import os
import pathlib
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
OF_SOURCE = {"structure.missing-file": "stage.asset-missing",
             "structure.dangling-target": "stage.target-missing"}


class Miss(Exception):
    """Why an asset is one."""


def answer(*arguments):
    process = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True,
                             text=True, check=False, timeout=LIMIT_S)
    try:
        return json.loads(process.stdout)
    except json.JSONDecodeError:
        raise Miss(f"{arguments[0]} ends with {process.returncode}: "
                   f"{process.stderr[-300:]}") from None


def rules_of(report, *severities):
    return {d["rule"] for d in report["diagnostics"] if d["severity"] in severities}


def judge(asset, folder):
    """-> whether the asset was structured; Miss says what is wrong."""
    made = answer("structure", asset, "-o", folder / "a")
    if "interface" not in made:
        errors = rules_of(made, "error")
        if any(rule.startswith(REFUSALS) for rule in errors):
            return False
        raise Miss(f"refused: {made['diagnostics'][-1:]}")
    interface = folder / "a" / made["interface"]
    again = answer("structure", interface, "-o", folder / "b")
    if files_of(folder / "a") != files_of(folder / "b"):
        raise Miss("not the same bytes again")
    if again["moved"]:
        raise Miss(f"moved again: {again['moved'][:2]}")
    found = rules_of(answer("check", interface, "--profile", "isaac-3.0"), "error", "warning")
    found = {rule for rule in found if rule.startswith("structure.")}
    if found:
        source = rules_of(answer("check", asset), "error", "warning")
        found = {rule for rule in found if OF_SOURCE.get(rule) not in source}
    if found:
        raise Miss(f"breaks {sorted(found)}")
    return True


def verdict(asset):
    """-> None where nothing could be structured, "" where all holds, else what is wrong."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            return "" if judge(asset, pathlib.Path(folder)) else None
        except Miss as miss:
            return str(miss)
        except subprocess.TimeoutExpired:
            return f"takes more than {LIMIT_S} s"


def assets(everything):
    """All files, or some small ones of those that name a default prim where it can be seen; hands
    have tests of their own."""
    found = sorted(path for path in SHARED.rglob("*") if path.suffix in ENDINGS and path.is_file())
    if everything:
        return found
    named = [path for path in found
             if "assets/inspire_hand" not in str(path) and
             path.stat().st_size < SAMPLE_BYTES and b"defaultPrim" in path.read_bytes()]
    return named[::max(1, len(named) // SAMPLE)]


def main():
    if not (SHARED / "conformance").exists():
        print(f"{SHARED} is absent")
        return suite.SKIPPED
    everything = "--all" in sys.argv
    known = suite.read_misses(MISSES)
    chosen = assets(everything)
    with concurrent.futures.ThreadPoolExecutor(min(2, os.cpu_count() or 1)) as pool:
        verdicts = dict(zip([str(path.relative_to(SHARED)) for path in chosen],
                            pool.map(verdict, chosen)))
    misses = {name: what for name, what in verdicts.items() if what}
    for name, what in misses.items():
        print(f"{'known' if name in known else 'MISS'} {name}: {what}")
    held = [name for name in known if verdicts.get(name, "a miss") in (None, "")]
    for name in held:
        print(f"HOLDS {name}: remove it from {MISSES.name}")
    structured = sum(1 for what in verdicts.values() if what is not None)
    print(f"{structured - len(misses)} of {structured} assets hold; {len(chosen) - structured} "
          "files have no default prim or cannot be read")
    return 1 if set(misses) - set(known) or held or structured == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
