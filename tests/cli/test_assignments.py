#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""PATH.property=VALUE means the same in `tenon set` and in `tenon sim --set`.

    test_assignments.py TENON
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TENON = os.path.abspath(sys.argv[1])
SCENE = """#usda 1.0
(
    defaultPrim = "W"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "W" (
    prepend apiSchemas = ["CollectionAPI:all"]
)
{
    def PhysicsScene "scene"
    {
    }
    def Cube "box" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 1
        asset file
        string note
        rel to
        double[] list
    }
}
"""
GOOD = [
    "/W/box.physics:mass=2", "/W/box.physics:mass=None",
    "/W/box.physics:centerOfMass=(0, 0, 1)",
    "/W/box.note=a \"b\" \\ c", "/W/box.note='x'", "/W/box.file=a.png", "/W/box.file=@a.png@",
    "/W/box.to=</W>", "/W/box.to=/W, /W/box", "/W/box.to=[</W>, </W/box>]",
    "/W/box.visibility=invisible", "/W/box.list=[1, 2]", "/W/box.list=[]",
    "/W/box.physics:velocity=(1, 2, 3)", "/W.collection:all:membershipExpression=//",
]
BAD = [
    "/W/box.physics:mass", "=3", "/W/box=3", "W/box.physics:mass=3", "/W/none.physics:mass=3",
    "/W/box.physics:mas=3", "/W/box.physics:mass=heavy", "/W/box.visibility=seen",
    "/W/box.to=W", "/W/box.list=1", "/W/box.physics:kinematicEnabled=maybe",
    "/W/box.physics:lowerLimit=1",
]


def run(*words):
    done = subprocess.run([TENON, *words, "--json"], capture_output=True, text=True, timeout=120,
                          check=False)
    return done.returncode, json.loads(done.stdout)


def errors_of(answer):
    return sorted((row["rule"], row["message"]) for row in answer["diagnostics"]
                  if row["severity"] == "error")


class Assignments(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)
        self.scene = os.path.join(self.folder, "scene.usda")
        pathlib.Path(self.scene).write_text(SCENE, encoding="utf-8")

    def both(self, text):
        simulated = run("sim", self.scene, "--set", text, "--duration", "0")
        self.assertEqual(pathlib.Path(self.scene).read_text(encoding="utf-8"), SCENE)
        edited = run("set", self.scene, text, "--dry-run")
        return edited, simulated

    def test_what_one_takes_the_other_takes(self):
        for text in GOOD:
            with self.subTest(text):
                edited, simulated = self.both(text)
                self.assertEqual(edited[0], 0, errors_of(edited[1]))
                self.assertEqual(simulated[0], 0, errors_of(simulated[1]))

    def test_what_one_refuses_the_other_refuses_for_the_same_reason(self):
        for text in BAD:
            with self.subTest(text):
                edited, simulated = self.both(text)
                self.assertEqual((edited[0], simulated[0]), (2, 2))
                self.assertEqual([rule for rule, _ in errors_of(edited[1])],
                                 [rule for rule, _ in errors_of(simulated[1])])

    def test_the_value_counts(self):
        _, answer = run("sim", self.scene, "--set", "/W/box.physics:mass=None", "--set",
                        "/W/box.physics:density=7", "--duration", "0")
        self.assertEqual(errors_of(answer), [])
        _, answer = run("sim", self.scene, "--set", "/W/scene.physics:gravityMagnitude=2",
                        "--duration", "1")
        height = answer["bodies"]["/W/box"]["position"][2]
        self.assertAlmostEqual(height, -1, places=2)


if __name__ == "__main__":
    sys.argv[1:] = sys.argv[2:]
    unittest.main()
