# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs tenon for the tests of this folder."""

import json
import os
import pathlib
import subprocess
import sys

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT.parent / "shared"))
EXAMPLE = ROOT / "examples/inspire_hand/inspire_hand.usda"
INCUMBENT = SHARED / "assets/inspire_hand_isaac/inspire_hand.usda"


def run(*arguments):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False)


def tenon(*arguments):
    """-> the JSON object that a verb prints; it must say yes."""
    process = run(*arguments, "--json")
    if process.returncode != 0:
        raise AssertionError(f"{arguments}: exit {process.returncode}: {process.stdout[-2000:]}"
                             f"{process.stderr[-2000:]}")
    return json.loads(process.stdout)


def structure(asset, folder, *options):
    """-> path of the interface."""
    made = tenon("structure", asset, "-o", folder, *options)
    return pathlib.Path(folder) / made["interface"]


def breaches(asset):
    """-> findings of the rules on structure."""
    process = run("check", asset, "--profile", "isaac-3.0", "--only", "structure", "--json")
    return json.loads(process.stdout)["diagnostics"]


def files_of(folder):
    folder = pathlib.Path(folder)
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}
