# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What the tests of the package share."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
GRASP = ROOT / "examples/inspire_hand/grasp.usda"
SCENES = ROOT / "examples/scenes"


class FilesTestCase(unittest.TestCase):
    """With a folder of its own, and copies of examples in it."""

    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="tenon-python-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def copied_hand(self) -> Path:
        shutil.copytree(HAND.parent, self.folder / "hand", ignore=shutil.ignore_patterns("*.py"))
        return self.folder / "hand" / HAND.name

    def written(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.write_text(text)
        return path


def main() -> None:
    os.environ.setdefault("MUJOCO_GL", "disable")
    unittest.main(verbosity=1)
