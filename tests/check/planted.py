# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The planted scenes of the rules, for tests that walk them: SCRIPT ROOT TENON.

tests/check/scenes/RULE.usda breaks RULE, RULE.clean.usda does not. A line `# tenon check OPTIONS`
in a scene names the options that it is checked with.
"""

import functools
import json
import pathlib
import re
import subprocess
import sys

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
SCENES = ROOT / "tests/check/scenes"


def run(*arguments):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False)


def check(*arguments):
    process = run("check", *arguments, "--json")
    if process.returncode not in (0, 1):
        raise AssertionError(f"{arguments}: exit {process.returncode}: {process.stdout[-2000:]}")
    return json.loads(process.stdout)


def options_of(scene):
    """-> what a scene wants to be checked with; file names in it are beside the scene."""
    line = re.search(r"^# tenon check (.*)$", scene.read_text(), re.MULTILINE)
    words = line.group(1).split() if line else []
    return [str(SCENES / word) if (SCENES / word).is_file() else word for word in words]


@functools.cache
def checked_scenes():
    """-> findings by file name, of all scenes: starting a process takes longer than a scene."""
    found = {path.name: [] for path in SCENES.glob("*.usda")}
    special = {name: options for name in found if (options := options_of(SCENES / name))}
    plain = sorted(found.keys() - special.keys())
    answer = check(*(SCENES / name for name in plain))
    assert len(answer["assets"]) == len(plain) and all(row["opened"] for row in answer["assets"])
    for name, options in special.items():
        found[name] = check(SCENES / name, *options)["diagnostics"]
    for finding in answer["diagnostics"]:
        path = pathlib.Path(finding["file"])
        if path.name in found:
            found[path.name].append(finding)
    for rule in PLANTED:  # a finding in a layer that a scene leads to does not name the scene
        if not found[f"{rule}.usda"] and f"{rule}.usda" not in special:
            for name in (f"{rule}.usda", f"{rule}.clean.usda"):
                found[name] = check(SCENES / name)["diagnostics"]
    return found


def findings(name):
    return checked_scenes()[f"{name}.usda"]


LISTED = json.loads(run("check", "--list-rules", "--json").stdout)["rules"]
RULES = {row["rule"]: row for row in LISTED}
PLANTED = sorted(p.stem for p in SCENES.glob("*.usda") if not p.stem.endswith(".clean"))
