#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The demonstration ends well without a Chromium, and says in one line how to get the picture.

    demo.py RELEASE_FOLDER
"""

import os
import pathlib
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RELEASE = pathlib.Path(sys.argv[1])


class Demo(unittest.TestCase):
    def test_it_ends_well_without_a_chromium(self):
        nowhere = {**os.environ, "TENON_CHROMIUM": "/nowhere/chromium"}
        done = subprocess.run([ROOT / "tools/demo.sh", RELEASE.resolve()], capture_output=True,
                              text=True, cwd="/", env=nowhere, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        advice = [line for line in done.stdout.splitlines() if line.startswith("== No picture")]
        self.assertEqual(len(advice), 1, done.stdout)
        self.assertRegex(advice[0], r"apt-get install (nodejs npm )?chromium")
        self.assertIn("== What to look at", done.stdout)
        self.assertNotIn("error:", done.stderr)


if __name__ == "__main__":
    if not (RELEASE / "bin/tenon").exists():
        print(f"skipped: no {RELEASE}/bin/tenon (make build)")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
