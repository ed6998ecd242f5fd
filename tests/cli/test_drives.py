#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon drives`: what motors have to hold, and limits from data sheets, in every form of them.

    test_drives.py ROOT TENON
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv[1])
TENON = os.path.abspath(sys.argv[2])
HAND = ROOT / "examples/inspire_hand"
THUMB = "/inspire_hand/Physics/right_thumb_2_joint"

# A drawer of 3 kg that a drive lifts, and a lid of 2 kg that turns about x, 0.2 m from its hinge.
# Units are centimetres.
CHEST = """#usda 1.0
(
    defaultPrim = "Chest"
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "Chest"
{
    def Xform "drawer" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 3
        float3 physics:diagonalInertia = (100, 100, 100)
    }
    def Xform "lid" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 2
        point3f physics:centerOfMass = (0, 20, 0)
        float3 physics:diagonalInertia = (100, 100, 100)
        def Xform "tip"
        {
            double3 xformOp:translate = (5, 40, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
    }
    def PhysicsPrismaticJoint "lift" (prepend apiSchemas = ["PhysicsDriveAPI:linear"])
    {
        rel physics:body1 = </Chest/drawer>
        uniform token physics:axis = "Z"
        float physics:lowerLimit = 0
        float physics:upperLimit = 50
        float drive:linear:physics:stiffness = 1000
        float drive:linear:physics:maxForce = 2000
    }
    def PhysicsRevoluteJoint "hinge" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
    {
        rel physics:body1 = </Chest/lid>
        uniform token physics:axis = "X"
        float physics:lowerLimit = -90
        float physics:upperLimit = 60
        float drive:angular:physics:stiffness = 1000
    }
}
"""


class Drives(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.chest = self.folder / "chest.usda"
        self.chest.write_text(CHEST, encoding="utf-8")

    def run_it(self, *arguments, code=0):
        done = subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                              check=False,
                              env={**os.environ, "XDG_STATE_HOME": str(self.folder / "state")})
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def drives(self, asset, *arguments, code=0):
        answer = json.loads(self.run_it("drives", asset, "--json", *arguments, code=code))
        return {row["joint"].rpartition("/")[2]: row for row in answer["drives"]}

    def specs(self, text):
        file = self.folder / "motors.toml"
        file.write_text(text, encoding="utf-8")
        return file

    def test_weight_at_the_start_and_at_the_worst_posture(self):
        rows = self.drives(self.chest, code=1)
        self.assertAlmostEqual(rows["lift"]["weight"], 3 * 9.81, delta=1e-4)
        self.assertAlmostEqual(rows["lift"]["maxEffort"], 20, delta=1e-5)
        self.assertTrue(rows["lift"]["tooWeak"])
        self.assertAlmostEqual(rows["hinge"]["weight"], 2 * 9.81 * 0.2, delta=1e-4)
        self.assertIsNone(rows["hinge"]["maxEffort"])
        self.assertFalse(rows["hinge"]["tooWeak"])
        self.assertIn("too weak", self.run_it("drives", self.chest, code=1))
        # The start is the worst posture of the lid; a start at 60 degrees is not.
        text = CHEST.replace('["PhysicsDriveAPI:angular"]',
                             '["PhysicsDriveAPI:angular", "PhysicsJointStateAPI:angular"]')
        text = text.replace("float drive:angular",
                            "float state:angular:physics:position = 60\n"
                            "        float drive:angular")
        self.chest.write_text(text, encoding="utf-8")
        start = self.drives(self.chest, code=1)["hinge"]["weight"]
        self.assertAlmostEqual(start, 2 * 9.81 * 0.2 / 2, delta=1e-4)
        drawn = self.drives(self.chest, "--sample", "500", code=1)["hinge"]
        self.assertAlmostEqual(drawn["weight"], 2 * 9.81 * 0.2, delta=1e-3)
        self.assertLess(abs(drawn["weightAt"]), math.radians(2))
        again = self.drives(self.chest, "--sample", "500", code=1)["hinge"]
        self.assertEqual(drawn, again)

    def test_every_key_of_a_data_sheet(self):
        for keys, joint, effort, speed in (
                ('max_effort = 25\nmax_speed = 0.1', "lift", 25, 0.1),
                ('max_effort = "3 kgf"\nmax_speed = "20 mm/s"', "lift", 3 * 9.80665, 0.02),
                ('tip_force = 12\nchain_factor = 2', "lift", 24, None),
                ('max_effort = "850 mN m"', "hinge", 0.85, None),
                ('tip_force = "10 N"\nlever_arm = "84 mm"\nchain_factor = 2', "hinge", 1.68, None),
                ('tip_force = 10\ntip = "/Chest/lid/tip"', "hinge", 4, None),
                ('motor_torque = "20 mN m"\ngear_ratio = 100\nefficiency = 0.8\n'
                 'motor_speed = "6000 rpm"', "hinge", 1.6, 2 * math.pi),
                ('torque_constant = 0.05\nmax_current = 4\ngear_ratio = 10', "hinge", 2, None),
                ('max_speed = 260', "hinge", None, math.radians(260))):
            self.chest.write_text(CHEST, encoding="utf-8")
            self.run_it("drives", self.chest, "--specs", self.specs(f"[{joint}]\n{keys}\n"))
            rows = json.loads(subprocess.run([TENON, "drives", self.chest, "--json"],
                                             capture_output=True, text=True, check=False).stdout)
            row = next(row for row in rows["drives"] if row["joint"].endswith(joint))
            for name, expected in (("maxEffort", effort), ("speedLimit", speed)):
                if expected is not None:
                    self.assertAlmostEqual(row[name], expected, delta=1e-6 * expected, msg=keys)

    def test_what_a_data_sheet_may_not_say(self):
        for text, words in (
                ("[lift]\nmax_force = 1\n", "unknown key"),
                ("[nothing]\nmax_effort = 1\n", "no driven joint"),
                ("max_effort = 1\n", "is no table"),
                ("[lift]\nmax_effort = \"1 N m\"\n", "wrong unit"),
                ("[hinge]\nmax_effort = \"1 N\"\n", "wrong unit"),
                ("[hinge]\nmax_effort = \"1 furlong\"\n", "no number with one of its units"),
                ("[hinge]\nmax_effort = -1\n", "above 0"),
                ("[hinge]\nmax_effort = 1e300\n", "finite number above 0"),
                ('["(((a{1000}){1000}){1000})"]\nmax_effort = 1\n', "written out"),
                ("[hinge]\nmax_effort = true\n", "not a number"),
                ("[hinge]\nefficiency = 2\n", "no such factor"),
                ("[hinge]\ntip_force = 1\n", "without a lever arm"),
                ("[hinge]\ntip_force = 1\ntip = \"/Chest/nothing\"\n", "no prim"),
                ("[hinge]\ntip_force = 1\ntip = \"/Chest/drawer\"\n", "on the axis"),
                ("[hinge]\ntip_force = 1\nmax_effort = 1\n", "several keys"),
                ("[hinge]\ntorque_constant = 1\n", "belong together"),
                ("[lift]\nmotor_torque = 1\n", "the joint slides"),
                ("[lift\n", "")):
            file = self.specs(text)
            said = self.run_it("drives", self.chest, "--specs", file, code=2)
            self.assertIn(words, said, text)
            self.assertIn("motors.toml:", said, text)
        self.assertEqual(self.chest.read_text(encoding="utf-8"), CHEST)

    def test_the_hand_gets_its_limits_in_every_form(self):
        asset = self.folder / "hand"
        shutil.copytree(HAND, asset)
        before = {path: path.read_bytes() for path in asset.rglob("*") if path.is_file()}
        hand = asset / "inspire_hand.usda"
        file = self.specs('[".*_1_joint|right_thumb_2_joint"]\ntip_force = "10 N"\n'
                          'lever_arm = 0.084\nchain_factor = 2\nmax_speed = "200 deg/s"\n')
        told = self.run_it("drives", hand, "--specs", file, "--dry-run")
        self.assertIn("+", told)
        self.assertEqual({path: path.read_bytes() for path in before}, before)
        self.run_it("drives", hand, "--specs", file)
        changed = {path.name for path in before if path.read_bytes() != before[path]}
        self.assertEqual(changed, {"physics.usda", "mujoco.usda", "physx.usda"})
        for variant in ("physics", "physx", "mujoco"):
            for row in self.drives(hand, "--physics", variant).values():
                self.assertAlmostEqual(row["maxEffort"], 1.68, delta=1e-6, msg=variant)
                self.assertAlmostEqual(row["speedLimit"], math.radians(200), delta=1e-6)
        physx = (asset / "payloads/Physics/physx.usda").read_text(encoding="utf-8")
        self.assertEqual(physx.count("physxJoint:maxJointVelocity = 200"), 6)
        after = {path: path.read_bytes() for path in before}
        self.run_it("drives", hand, "--specs", file)  # once more changes nothing
        self.assertEqual({path: path.read_bytes() for path in before}, after)
        self.run_it("undo", hand)
        self.assertEqual({path: path.read_bytes() for path in before}, before)

    def test_a_speed_limit_that_was_nowhere(self):
        self.run_it("drives", self.chest, "--specs", self.specs("[lift]\nmax_speed = 0.3\n"))
        text = self.chest.read_text(encoding="utf-8")
        self.assertIn("newton:velocityLimit = 30", text)
        self.assertNotIn("physxJoint", text)

    def test_compliance_of_mimics(self):
        asset = self.folder / "hand"
        shutil.copytree(HAND, asset)
        hand = asset / "inspire_hand.usda"
        for mimic, numbers in (("25,0.1", (25, 0.1)), ("rigid", (0, 0))):
            self.run_it("drives", hand, "--mimic", mimic)
            answer = json.loads(self.run_it("drives", hand, "--physics", "physx", "--json"))
            self.assertEqual(len(answer["followers"]), 6)
            for row in answer["followers"]:
                for name, number in zip(("naturalFrequency", "dampingRatio"), numbers):
                    self.assertAlmostEqual(row[name], number, places=6, msg=mimic)
        self.run_it("drives", hand, "--mimic", "soft", code=2)
        self.assertIn("PhysxMimicJointAPI",
                      self.run_it("drives", self.chest, "--mimic", "rigid", code=2))

    def test_followers_and_assets_without_drives(self):
        rows = self.drives(HAND / "inspire_hand.usda")
        self.assertEqual(rows["right_thumb_2_joint"]["followers"],
                         [THUMB.replace("_2_", "_3_"), THUMB.replace("_2_", "_4_")])
        self.chest.write_text("#usda 1.0\n", encoding="utf-8")
        self.assertIn("no joint has a drive", self.run_it("drives", self.chest, "-q"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
