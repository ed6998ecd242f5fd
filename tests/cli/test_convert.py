#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon convert` into a folder: the structured asset in one command.

    test_convert.py ROOT TENON
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
ROBOT = ROOT / "tests/convert/urdf/shapes.urdf"


def tenon(*arguments):
    process = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True,
                             text=True, check=False)
    return process.returncode, json.loads(process.stdout)


def files_of(folder):
    return {p.relative_to(folder).as_posix(): p.read_bytes()
            for p in folder.rglob("*") if p.is_file()}


class IntoAFolder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_gives_what_convert_and_structure_give(self):
        plain, two, one = self.folder / "plain.usda", self.folder / "two", self.folder / "one"
        self.assertEqual(tenon("convert", ROBOT, plain)[0], 0)
        self.assertEqual(tenon("structure", plain, "-o", two)[0], 0)
        self.assertEqual(tenon("convert", ROBOT, one)[0], 0)
        self.assertEqual(files_of(one), files_of(two))
        self.assertTrue(any(name.endswith(".png") for name in files_of(one)))
        code, answer = tenon("check", next(one.glob("*.usda")), "--profile", "isaac-3.0", "--only",
                             "structure")
        self.assertEqual((code, answer["diagnostics"]), (0, []))

    def test_replaces_such_an_asset_and_nothing_else(self):
        target = self.folder / "robot.v2"  # a folder by its slash, whatever its name
        self.assertEqual(tenon("convert", ROBOT, f"{target}/")[0], 0)
        first = files_of(target)
        self.assertEqual(tenon("convert", ROBOT, target)[0], 0)
        self.assertEqual(files_of(target), first)
        (target / "notes.txt").write_text("mine")
        self.assertEqual(tenon("convert", ROBOT, f"{target}/", "--flat")[0], 2)
        self.assertEqual(files_of(target), {**first, "notes.txt": b"mine"})

    def test_a_format_that_is_none_is_no_folder(self):
        self.assertEqual(tenon("convert", ROBOT, self.folder / "robot.step")[0], 2)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
