#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every fault of the small scenes is named by its cause, and nothing else is told.

    test_small_scenes.py TENON
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import small_scenes

TENON = sys.argv[1]


def found_in(scenes):
    """-> rules of warnings and errors by scene."""
    with tempfile.TemporaryDirectory() as folder:
        files = [pathlib.Path(folder) / f"{i:03}.usda" for i in range(len(scenes))]
        for file, (_, parts, _) in zip(files, scenes):
            file.write_text(small_scenes.text_of(**parts))
        done = subprocess.run([TENON, "check", "--json", *files], check=False, capture_output=True,
                              text=True)
        answer = json.loads(done.stdout)
    found = [{} for _ in scenes]
    for finding in answer["diagnostics"]:
        if finding["severity"] != "info":
            at = int(pathlib.Path(finding["file"]).stem)
            found[at].setdefault(finding["rule"], finding["message"])
    return found


class SmallScenes(unittest.TestCase):
    def test_each_fault_is_named_by_its_cause(self):
        scenes = small_scenes.SCENES
        self.assertGreater(len(scenes), 60)
        for (name, _, rules), found in zip(scenes, found_in(scenes)):
            with self.subTest(name):
                self.assertEqual(set(found), set(filter(None, rules.split(", "))), found)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
