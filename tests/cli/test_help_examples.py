#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The examples of every help are typed, one after the other, on a hand with the names in them.

    test_help_examples.py ROOT TENON

Those that need what a machine may lack (a browser, another engine, Ray) are named in SKIPPED.
"""

import pathlib
import re
import shlex
import shutil
import struct
import subprocess
import tempfile
import unittest

import test_advice
from test_advice import ROOT, TENON

EXAMPLE = re.compile(r"^  tenon (.+)$", re.MULTILINE)
# What is not typed: the begin of the command, and why.
SKIPPED = {
    "compare": "it takes another engine",
    "report hand.usda -o hand.html --compare": "it takes another engine",
    "record": "it takes Chromium",
    "view": "it takes Chromium, or goes on until it is ended",
    "sweep": "it takes the Python package", "excite": "it takes the Python package",
    "identify": "it takes the Python package",
    "bench hand.usda --envs 1024": "it takes too long here",
    "completion": "it is for the files of a shell",
    "manual": "it opens a pager",
    "info *.usd": "a shell finds the files",
    "doctor": "what it says depends on the machine",
    "convert hand.usda hand.urdf": "hand.usda was made of that file here",
    "set hand.usda /hand/palm.physics:filteredPairs-=/hand/thumb": "a joint holds both",
    "pairs hand.usda --unfilter /hand/palm,/hand/thumb": "a joint holds both",
    "pose hand.usda --ik": "where its tip can be depends on the hand",
}
# Verbs whose examples build on each other; those of others have a folder each.
IN_TURN = ("add", "sim", "undo", "zip")
SCENE = ["new s.usda", "add s.usda /World/box=cube,body,collider --size 0.1 --at 0,0,1"]
HINGE = "add s.usda /World/hinge=revolute --body1 /World/box --at 0,0,1.05 --axis Z"
# What runs before the examples of a verb.
BEFORE = {
    "add": ["new s.usda", "add s.usda /World/part_collision=mesh --file part.stl --at 0,0,9"],
    "cat": ["cat hand.usda --flatten -o geometry.usdc"],
    "check": ["check assets --write-baseline known.json"],
    "convert": ["convert hand.usda humanoid.xml"],
    "diff": ["cat hand.usda --flatten -o hand.usdc", "zip hand.usda -o hand.usdz",
             "zip hand.usdz --extract hand"],
    "pose": ["pose hand.usda --save point"],
    "remove": [*SCENE, HINGE, "add s.usda /World/box=mass --mass 1",
               "add s.usda /World/hinge=limit --low -10 --high 10"],
    "rename": [*SCENE, "set s.usda --type float /World/box.mass=1"],
    "set": ["new scene.usda"],
    "sim": ["cat box.usda -o pile.usda"],
    "test-runner": ["cat box.usda -o model.usdc"],
    "undo": ["set hand.usda --mass /hand/palm=3"],
}


def examples():
    """-> by verb, the commands of its help in their order."""
    found = {}
    for place, _, words in test_advice.all_sentences():
        if "Example" in words and place.startswith("cli/verbs/"):
            for line in EXAMPLE.findall(words):
                command = re.split(r"  +", line)[0]
                found.setdefault(command.split()[0], []).append(command)
    return found


def skipped(command):
    return any(command == begin or command.startswith(begin + " ") for begin in SKIPPED)


class HelpExamples(unittest.TestCase):
    def setUp(self):
        self.base = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.base)
        self.plant(self.base / "planted")

    def run_in(self, folder, command):
        return subprocess.run([TENON, *shlex.split(command)], cwd=folder, capture_output=True,
                              text=True, timeout=300)

    def plant(self, folder):
        """The files that examples name; hand.usda has the links and joints in them."""
        folder.mkdir()
        shutil.copy(ROOT / "tests/cli/error_advice/tri.obj", folder / "part.obj")
        robot = (ROOT / "tests/cli/help_examples/hand.urdf").read_text()
        for name in ("hand", "X", "arm", "ur5"):
            (folder / f"{name}.urdf").write_text(robot)
        made = self.run_in(folder, "convert hand.urdf made/ --names tutorial --name hand "
                                   "--gains 10,1")
        self.assertEqual(made.returncode, 0, made.stderr)
        shutil.copytree(folder / "made", folder, dirs_exist_ok=True)
        corners = (0, 0, 0, 1, 0, 0, 0, 1, 0)
        (folder / "part.stl").write_bytes(struct.pack("<80xI12f2x", 1, 0, 0, 1, *corners))
        for command in ("new box.usda", "add box.usda /World/can=cube,body,collider --at 0,0,2",
                        "add box.usda /World/floor=ground", "cat box.usda -o a.usda",
                        "cat box.usda -o b.usda", "cat box.usda -o grasp.usda",
                        "cat box.usda -o robot.usda", *SCENE, HINGE,
                        "add s.usda /World/hinge=drive --stiffness 10", "rename s.usda /World Door",
                        "cat s.usda -o door.usda"):
            self.assertEqual(self.run_in(folder, command).returncode, 0, command)
        (folder / "s.usda").unlink()
        (folder / "grasp.csv").write_text("time,/hand/Physics/thumb_joint.target\n0.5,30\n")
        (folder / "motors.toml").write_text('["thumb.*"]\nmax_effort = "4 N m"\n')
        for name in ("old", "new", "assets"):
            (folder / name).mkdir()
            shutil.copy(folder / "box.usda", folder / name / "hand.usda")

    def begun(self, verb):
        """-> a new folder in which the examples of a verb can begin."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.base)) / verb
        shutil.copytree(self.base / "planted", folder)
        for command in BEFORE.get(verb, []):
            done = self.run_in(folder, command)
            self.assertIn(done.returncode, (0, 1), f"{command}: {done.stderr}")
        return folder

    def test_each_example_is_typed(self):
        typed = 0
        for verb, commands in examples().items():
            folder = None
            for command in commands:
                if skipped(command):
                    continue
                typed += 1
                if folder is None or verb not in IN_TURN:
                    folder = self.begun(verb)
                with self.subTest(command):
                    done = self.run_in(folder, command)
                    self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertGreater(typed, 70)

    def test_what_is_skipped_is_an_example(self):
        commands = [command for of_verb in examples().values() for command in of_verb]
        for begin in SKIPPED:
            with self.subTest(begin):
                self.assertTrue([c for c in commands if (c + " ").startswith(begin + " ")])


if __name__ == "__main__":
    unittest.main(argv=["test_help_examples.py"])
