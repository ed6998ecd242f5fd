# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of published suites share: where the material lies, lists of known misses, and a
record of what was measured. The published material is a folder of its own, which may be absent;
then the layers that this project has written for its own tests are read alone.

A record is one small JSON file per suite in the folder TENON_MEASURED_DIR (set by ctest), from
which make_table.py makes the table of CONFORMANCE.md. A suite that skips, or runs on this project's
layers alone, leaves none.
A list of misses has one line for each case that is known to differ, `NAME | reason`; a case that
differs and is not listed fails the test, and so does a listed one that does not differ any more.
CONFORMANCE.md repeats the lists.
"""

import json
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
REPO = os.path.dirname(os.path.dirname(HERE))
SHARED = os.environ.get("TENON_SHARED_DIR", os.path.join(os.path.dirname(REPO), "shared"))
CONFORMANCE = os.path.join(SHARED, "conformance")
MISSES = os.path.join(HERE, "misses")
SKIPPED = 77
HAS_PUBLISHED = os.path.isfile(os.path.join(CONFORMANCE, "cases.txt"))
OWN_FOLDERS = ("examples", "fuzz/seeds", "tests")
OWN_LARGEST = 300_000  # bytes


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def cases(suite):
    """[(name, path)] that cases.txt lists for `suite`; none where it is absent."""
    if not HAS_PUBLISHED:
        return []
    with open(os.path.join(CONFORMANCE, "cases.txt"), encoding="utf-8") as file:
        rows = [line.rstrip("\n").split("\t") for line in file if not line.startswith("#")]
    return [(row[1], os.path.join(CONFORMANCE, row[2])) for row in rows if row[0] == suite]


def own_layers(step=1, suffixes=(".usda",)):
    """Layers that this project has written for its tests and examples, sorted; of them one in
    `step`."""
    found = []
    for folder in OWN_FOLDERS:
        for inside, _, names in os.walk(os.path.join(REPO, folder)):
            found += [os.path.join(inside, name) for name in names if name.endswith(suffixes)]
    return sorted(path for path in found
                  if not os.path.islink(path) and os.path.getsize(path) <= OWN_LARGEST)[::step]


def own_scenes():
    """Scenes of physics that this project has written, but for those of time samples and point
    instancers, which OpenUSD's physics parser does not read. No row of CONFORMANCE.md counts them."""
    sampled = ("gravity_and_limits.usda", "switches.usda", "write_back.usda")
    folders = [os.path.join(REPO, "examples", "scenes"), os.path.join(REPO, "tests/physics/scenes")]
    return [os.path.join(folder, name) for folder in folders for name in sorted(os.listdir(folder))
            if name.endswith(".usda") and name not in sampled]


def own_name(path):
    """Of a layer of this project, for a message: relative to the repository."""
    return "own " + os.path.relpath(path, REPO)


def read_misses(path):
    """{name: reason} of a list of misses; no file is no miss. The reason stands behind `|` or `#`,
    or, where a line has none, in the comment above it."""
    if not os.path.exists(path):
        return {}
    found, above, in_comment = {}, "", False
    with open(path, encoding="utf-8") as file:
        for line in file.read().splitlines():
            if line.startswith("#"):
                above = (above + " " if in_comment else "") + line.lstrip("# ").strip()
                in_comment = True
                continue
            in_comment = False
            name, _, reason = re.split(r"([|#])", line, maxsplit=1) if re.search(
                r"[|#]", line) else (line, "", "")
            if name.strip():
                found[name.strip()] = reason.strip() or above
            else:
                above = ""
    return found


def record(suite, rows, misses=None):
    """Notes what was measured: rows are (label, passed, total), misses {name: reason}."""
    folder = os.environ.get("TENON_MEASURED_DIR")
    if not folder:
        return
    os.makedirs(folder, exist_ok=True)
    rows = [{"label": label, "passed": passed, "total": total} for label, passed, total in rows]
    with open(os.path.join(folder, suite + ".json"), "w", encoding="utf-8") as file:
        json.dump({"suite": suite, "rows": rows, "misses": misses or {}}, file, indent=1)


def forget(suite):
    """Removes the record of an earlier run, in case this one skips."""
    path = os.path.join(os.environ.get("TENON_MEASURED_DIR", ""), suite + ".json")
    if os.path.exists(path):
        os.remove(path)


class Results:
    """Outcomes of one suite, by row of the table."""

    def __init__(self, suite, misses=None):
        self.suite = suite
        self.misses = misses or os.path.join(MISSES, suite + ".txt")
        self.rows = {}  # label -> {name: what differs, None when nothing does}
        forget(suite)

    def add(self, label, name, difference):
        row = self.rows.setdefault(label, {})
        if row.get(name) is None:
            row[name] = difference

    def finish(self, is_whole=True):
        """Prints and, when it is of the whole suite, records the outcome; the exit code."""
        known = read_misses(self.misses)
        differing, names = {}, set()
        for row in self.rows.values():
            names |= set(row)
            differing.update({name: text for name, text in row.items() if text})
        for name in sorted(set(differing) - set(known)):
            print(f"MISS {name}: {differing[name]}")
        fixed = sorted((set(known) & names) - set(differing))
        for name in fixed:
            print(f"FIXED {name}: remove it from {os.path.basename(self.misses)}")
        figures = []
        for label, row in self.rows.items():
            passed = sum(1 for difference in row.values() if not difference)
            print(f"{label}: {passed} of {len(row)}")
            figures.append((label, passed, len(row)))
        if is_whole:
            record(self.suite, figures, {name: known[name] for name in differing if name in known})
        return 1 if fixed or set(differing) - set(known) else 0
