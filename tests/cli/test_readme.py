#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""README.md: its three commands on a robot work as they are typed, its make commands are targets,
and the two commands for a fresh machine are the first block.

    test_readme.py ROOT TENON
"""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import urllib.request

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
TEXT = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = [block.splitlines() for block in re.findall(r"^```\n(.*?)^```$", TEXT, re.M | re.S)]


class Readme(unittest.TestCase):
    def test_the_first_block_has_the_two_commands_of_a_fresh_machine(self):
        self.assertEqual([line.split("#")[0].strip() for line in BLOCKS[0]],
                         ["make demo", "make test"])

    def test_every_make_is_a_target(self):
        makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
        targets = set(re.findall(r"^([a-z-]+):", makefile, re.M))
        used = set(re.findall(r"\bmake ([a-z-]+)", "\n".join(sum(BLOCKS, []))))
        self.assertGreater(len(used), 3)
        self.assertEqual(used - targets, set())

    def test_the_page_of_commands_has_every_command(self):
        page = (ROOT / "docs/commands.md").read_text(encoding="utf-8")
        listed = subprocess.run([TENON, "help", "--json"], capture_output=True, check=True,
                                text=True).stdout
        verbs = {verb["name"] for verb in json.loads(listed)["verbs"]}
        self.assertEqual(verbs - set(re.findall(r"`tenon ([a-z-]+)", page)), set())

    def test_the_commands_on_a_robot_work_as_typed(self):
        self.assertIn("`export PATH=$PWD/build/release/bin:$PATH`", TEXT)
        (commands,) = [block for block in BLOCKS if any(line.startswith("tenon") for line in block)]
        self.assertEqual([line.split()[1] for line in commands], ["convert", "check", "view"])
        environment = {**os.environ, "PATH": f"{TENON.parent}:{os.environ['PATH']}"}
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(ROOT / "examples", f"{folder}/examples")
            for command in commands[:-1]:
                done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment,
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
            with subprocess.Popen(["bash", "-c", "exec " + commands[-1]], cwd=folder,
                                  env=environment, stdout=subprocess.PIPE, text=True) as viewer:
                try:
                    with urllib.request.urlopen(viewer.stdout.readline().strip()) as page:
                        self.assertIn(b"<html", page.read())
                finally:
                    viewer.send_signal(signal.SIGINT)
                self.assertEqual(viewer.wait(60), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
