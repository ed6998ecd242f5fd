#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon inertia`: numbers of small scenes by closed forms, poses, and what is refused.

    test_inertia.py ROOT TENON
"""

import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv[1])
TENON = os.path.abspath(sys.argv[2])
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"

# An arm in centimetres: a link of 2 kg turns about y, a slider of 1 kg moves along it, and a wheel
# follows the arm.
ARM = """#usda 1.0
(
    defaultPrim = "Arm"
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "Arm" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def Xform "link" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 2
        point3f physics:centerOfMass = (30, 0, 0)
        float3 physics:diagonalInertia = (100, 200, 300)
    }
    def Xform "slider" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        double3 xformOp:translate = (50, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        float physics:mass = 1
        float3 physics:diagonalInertia = (10, 10, 10)
    }
    def Xform "wheel" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        double3 xformOp:translate = (0, 100, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        float physics:mass = 1
        float3 physics:diagonalInertia = (50, 50, 50)
    }
    def PhysicsRevoluteJoint "shoulder"
    {
        rel physics:body1 = </Arm/link>
        uniform token physics:axis = "Y"
    }
    def PhysicsPrismaticJoint "slide"
    {
        rel physics:body0 = </Arm/link>
        rel physics:body1 = </Arm/slider>
        point3f physics:localPos0 = (50, 0, 0)
        uniform token physics:axis = "X"
    }
    def PhysicsRevoluteJoint "spin" (prepend apiSchemas = ["NewtonMimicAPI"])
    {
        rel physics:body1 = </Arm/wheel>
        point3f physics:localPos0 = (0, 100, 0)
        uniform token physics:axis = "Z"
        rel newton:mimicJoint = </Arm/shoulder>
        float newton:mimicCoef1 = 3
    }
}
"""


class Inertia(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.arm = pathlib.Path(cls.folder.name) / "arm.usda"
        cls.arm.write_text(ARM, encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_it(self, *arguments):
        return subprocess.run([TENON, "inertia", *map(str, arguments)], capture_output=True,
                              text=True, check=False)

    def rows(self, *arguments):
        done = self.run_it(self.arm, "--json", *arguments)
        self.assertEqual(done.returncode, 0, done.stdout)
        answer = json.loads(done.stdout)
        return {row["joint"].rpartition("/")[2]: row for row in answer["coordinates"]}, answer

    def near(self, value, expected):
        self.assertAlmostEqual(value, expected, delta=1e-6 * max(1.0, abs(expected)))

    def test_numbers_of_the_arm(self):
        rows, answer = self.rows("--matrix")
        arm = 0.02 + 2 * 0.3 ** 2 + 0.001 + 1 * 0.5 ** 2
        wheel = 0.005
        self.near(rows["shoulder"]["held"], arm + 9 * wheel)
        self.near(rows["spin"]["held"], arm / 9 + wheel)
        self.near(rows["slide"]["held"], 1)
        self.near(rows["shoulder"]["gravity"], 9.81 * (2 * 0.3 + 1 * 0.5))
        self.near(rows["slide"]["gravity"], 0)
        self.near(answer["mass"], 4)
        self.assertEqual(len(answer["massMatrix"]), 3)
        places = [row["joint"].rpartition("/")[2] for row in answer["coordinates"]]
        first = places.index("shoulder")
        self.near(answer["massMatrix"][first][first], arm)

    def test_a_pose_moves_joints_and_their_followers(self):
        for pose, reach in (("shoulder=60", 0.5), ("shoulder=60deg,slide=25", 0.75),
                            ("sho.*=%rrad,slide=250mm" % math.radians(60), 0.75),
                            ("/Arm/shoulder:rotY=60,slide=0.25m", 0.75)):
            rows, _ = self.rows("--pose", pose)
            self.near(rows["shoulder"]["position"], math.radians(60))
            self.near(rows["spin"]["position"], math.radians(180))
            self.near(rows["shoulder"]["gravity"], 9.81 * (2 * 0.3 + reach) * 0.5)
            self.near(rows["slide"]["gravity"], 9.81 * math.sin(math.radians(60)))

    def test_runs_start_at_a_pose(self):
        engines = json.loads(subprocess.run([TENON, "doctor", "--json"], capture_output=True,
                                            text=True, check=False).stdout)["engines"]
        ready = [engine["name"] for engine in engines if engine["available"]]
        self.assertTrue(ready)
        for engine in ready:
            log = pathlib.Path(self.folder.name) / "log.csv"
            done = subprocess.run([TENON, "sim", self.arm, "--engine", engine, "--duration", "0.01",
                                   "--pose", "shoulder=30,slide=20", "-o", log], check=False,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with open(log, encoding="utf-8", newline="") as file:
                first = next(csv.DictReader(file))
            for joint, expected in (("shoulder", 30), ("slide", 20), ("spin", 90)):
                name = next(name for name in first if name.startswith(f"/Arm/{joint}.position"))
                self.assertAlmostEqual(float(first[name]), expected, delta=1e-3, msg=engine)
        done = subprocess.run([TENON, "sim", self.arm, "--pose", "shoulder=1m"], check=False,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)

    def test_what_no_joint_can_do_is_refused(self):
        for pose, words in (("sholder=1", "did you mean shoulder?"), ("spin=1", "/Arm/shoulder"),
                            ("shoulder=1m", "turns"), ("slide=2deg", "slides"),
                            ("shoulder", "give joints"), ("shoulder=x", "no number"),
                            ("shoulder=inf", "no number"), ("(=1", "no name pattern"),
                            ("slide:rotZ=1", "no movable joint")):
            done = self.run_it(self.arm, "--pose", pose)
            self.assertEqual(done.returncode, 2, pose)
            self.assertIn(words, done.stdout + done.stderr, pose)

    def test_the_table_of_the_hand(self):
        done = self.run_it(HAND, "-q")
        self.assertEqual(done.returncode, 0)
        lines = done.stdout.splitlines()
        self.assertIn("others held", lines[1])
        self.assertEqual(len(lines), 14, "12 joints of the hand move")
        self.assertTrue(all("kg m^2" in line for line in lines[2:]))

    def test_an_asset_without_joints_says_so(self):
        scene = pathlib.Path(self.folder.name) / "still.usda"
        scene.write_text('#usda 1.0\ndef Cube "box" (prepend apiSchemas = ["PhysicsCollisionAPI"])'
                         "\n{\n}\n", encoding="utf-8")
        done = self.run_it(scene, "-q")
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]), (0, "nothing moves"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
