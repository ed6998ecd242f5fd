# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What docs/start-training.md, docs/python.md and the examples show runs as it is written."""

import os
import re
import shutil
import subprocess
import sys
import unittest

import support

SNIPPET = re.compile(r"^```python\n(.*?)^```$", re.M | re.S)
EXAMPLES = support.ROOT / "python/examples"
HAND = "hand/inspire_hand.usda"
ARGUMENTS = {
    "author.py": ["box.usda"],
    "control.py": [HAND],
    "edit.py": [HAND, "/inspire_hand/Physics/right_index_1_joint", "60"],
    "grasp.py": ["hand/grasp.usda"],
    "masses.py": [HAND],
    "reacher.py": ["."],
}
SAID = {
    "author.py": "the box lies at 0.1 m",
    "control.py": "failed: 0",
    "edit.py": "errors: 0",
    "grasp.py": "observations (8, 31)",
    "masses.py": "together 0.5400 kg",
    "reacher.py": "observations (64, 7)",
}


class Snippets(support.FilesTestCase):
    def run_there(self, *arguments):
        done = subprocess.run([sys.executable, *arguments], capture_output=True, text=True,
                              cwd=self.folder, check=False,
                              env={**os.environ, "MPLBACKEND": "agg",
                                   "XDG_STATE_HOME": str(self.folder / "state")})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def place_examples(self):
        shutil.copytree(support.HAND.parent, self.folder / "examples/inspire_hand")
        shutil.copytree(support.HAND.parent, self.folder / "hand")
        shutil.copytree(support.ROOT / "examples/cpp/robots", self.folder / "robots")

    def test_the_lines_of_the_start_page(self):
        self.place_examples()
        (lines,) = SNIPPET.findall((support.ROOT / "docs/start-training.md").read_text())
        said = self.run_there("-c", lines)
        self.assertIn("/World/can 0.", said)
        self.assertGreater((self.folder / "heights.png").stat().st_size, 5000)

    def test_every_snippet_of_the_page(self):
        self.place_examples()
        snippets = SNIPPET.findall((support.ROOT / "docs/python.md").read_text())
        self.assertGreater(len(snippets), 6)
        # They go on from each other, as a reader takes them.
        self.run_there("-c", "\n".join(snippets))

    def test_the_page_about_tasks(self):
        self.place_examples()
        text = (support.ROOT / "docs/tasks.md").read_text()
        files = re.findall(r"^```toml\n# (\S+)\n(.*?)^```$", text, re.M | re.S)
        self.assertEqual([name for name, _ in files], ["balance.toml", "grasp.toml",
                                                   "swingup.toml"])
        for name, told in files:
            self.written(name, told)
        own = (support.ROOT / "python/tenon_usd/tasks/balance.toml").read_text()
        self.assertTrue(own.endswith(files[0][1]))
        reach = (support.ROOT / "python/tenon_usd/tasks/reach.toml").read_text()
        shown = re.search(r"^    \[\[goal\]\]\n.*?(?=^\S)", text, re.M | re.S).group()
        for part in shown.replace("\n    ", "\n").strip().split("\n\n"):
            self.assertIn(part + "\n", reach)
        snippets = SNIPPET.findall(text)
        self.assertGreater(len(snippets), 2)
        self.run_there("-c", "\n".join(snippets))

    def test_every_example(self):
        self.place_examples()
        self.assertEqual(sorted(path.name for path in EXAMPLES.glob("*.py")), sorted(ARGUMENTS))
        for name, arguments in ARGUMENTS.items():
            with self.subTest(name):
                self.assertIn(SAID[name], self.run_there(str(EXAMPLES / name), *arguments))


if __name__ == "__main__":
    support.main()
