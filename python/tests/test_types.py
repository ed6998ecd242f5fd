# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Type checkers accept the package and the examples: mypy --strict."""

import os
import pathlib
import subprocess
import sys

import support

import tenon_usd

EXAMPLES = sorted((support.ROOT / "python/examples").glob("*.py"))
WRONG = """
import tenon_usd as tenon

tenon.open("a.usda", phsyics="mujoco")
mass: str = tenon.physics("a.usda").bodies[0].mass
"""


class Types(support.FilesTestCase):
    def check(self, *arguments):
        done = subprocess.run(
            [sys.executable, "-m", "mypy", "--strict", *map(str, arguments)], capture_output=True,
            text=True, cwd=self.folder, check=False,
            env={**os.environ, "MYPYPATH": str(self.folder), "PYTHONPATH": ""})
        return done.stdout + done.stderr if done.returncode else ""

    def test_the_package_the_examples_and_what_is_wrong(self):
        # The package alone, apart from the NumPy that it was installed with.
        (self.folder / "tenon_usd").symlink_to(pathlib.Path(tenon_usd.__file__).parent)
        self.assertEqual(self.check("-p", "tenon_usd"), "")
        self.assertTrue(EXAMPLES)
        for example in EXAMPLES:
            self.assertEqual(self.check(example), "")
        said = self.check(self.written("wrong.py", WRONG))
        self.assertIn("phsyics", said)
        self.assertIn("float", said)


if __name__ == "__main__":
    support.main()
