#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Many environments by `tenon bench`: what varies, what does not, and what is told.

    test_bench.py ROOT TENON
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
GRASP = ROOT / "examples/inspire_hand/grasp.usda"
# A ball falls for 0.3 s onto the ground, another one flies freely.
BALLS = """#usda 1.0
(
    metersPerUnit = 1
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def PhysicsScene "Scene"
{
    vector3f physics:gravityDirection = (0, 0, -1)
    float physics:gravityMagnitude = 10
}
def Plane "ground" (prepend apiSchemas = ["PhysicsCollisionAPI"])
{
    uniform token axis = "Z"
}
def Sphere "ball" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
)
{
    double radius = 0.1
    float physics:mass = 1
    double3 xformOp:translate = (0, 0, 0.55)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Sphere "pushed" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{
    float physics:mass = 1
    vector3f physics:velocity = (%s, 0, 0)
    double3 xformOp:translate = (0, 5, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


class Bench(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "balls.usda"
        self.file.write_text(BALLS % 1)

    def run_tenon(self, *arguments):
        return subprocess.run([TENON, "bench", *map(str, arguments)], capture_output=True,
                              text=True)

    def bench(self, *arguments, code=0):
        run = self.run_tenon(*arguments, "--json")
        self.assertEqual(run.returncode, code, run.stderr + run.stdout[-2000:])
        return json.loads(run.stdout)

    def test_threads_change_nothing(self):
        told = [self.bench(GRASP, "--envs", 6, "-j", threads, "--duration", 0.1, "--vary",
                           "bodyMass=0.8..1.2", "--vary", "gravity=0.9..1.1", "--steps", steps)
                for threads, steps in ((1, 0), (2, 0), (3, 7))]
        self.assertEqual(len({one["digest"] for one in told}), 1)
        self.assertEqual(told[0]["each"], told[2]["each"])
        self.assertEqual(told[0]["steps"], 6 * 50)
        self.assertEqual(told[0]["scenes"], 1)
        self.assertGreater(told[0]["stepsPerCpuSecond"], 0)

    def test_each_engine_gives_the_same_bits_twice(self):
        doctor = json.loads(subprocess.run([TENON, "doctor", "--json"], capture_output=True,
                                           text=True).stdout)
        for engine in (one["name"] for one in doctor["engines"] if one["available"]):
            first, second = (self.bench(self.file, "--engine", engine, "--envs", 3, "--duration",
                                        0.4, "-j", threads, "--vary", "bodyPosition=-0.01..0.01")
                             for threads in (1, 3))
            self.assertEqual(first["digest"], second["digest"], engine)

    def test_an_environment_is_the_same_among_few_and_many(self):
        vary = ["--duration", 0.02, "--vary", "bodyMass=0.5..2", "--vary", "jointPosition=0..0.1"]
        few = self.bench(GRASP, "--envs", 2, *vary)
        many = self.bench(GRASP, "--envs", 5, *vary)
        self.assertEqual(few["each"], many["each"][:2])
        other = self.bench(GRASP, "--envs", 2, *vary, "--seed", 1)
        self.assertNotEqual(few["each"], other["each"])
        for end in many["each"]:
            self.assertTrue(0.5 <= end["numbers"][0][0] <= 2)
            self.assertTrue(0 <= end["numbers"][1][0] <= 0.1)
        self.assertEqual(len({end["numbers"][0][0] for end in many["each"]}), 5)

    def test_every_kind_of_variation_changes_the_end(self):
        still = self.bench(self.file, "--envs", 1, "--duration", 0.5)["digest"]
        for vary in ("gravity=0.5", "bodyPosition=0.1", "colliders.shape.radius@/ball=2",
                     "bodies.linearVelocity@/pushed=2"):
            told = self.bench(self.file, "--envs", 1, "--duration", 0.5, "--vary", vary)
            self.assertNotEqual(told["digest"], still, vary)
        same = self.bench(self.file, "--envs", 1, "--duration", 0.5, "--vary", "gravity=1")
        self.assertEqual(same["digest"], still)
        fields = self.bench(self.file, "--envs", 3, "--duration", 0.1, "--vary",
                            "colliders.shape.radius=0.9..1")
        self.assertEqual(fields["scenes"], 3)

    def test_an_object_is_named_by_its_path_or_the_last_element_of_it(self):
        for what in ("bodyMass@{}=2", "bodyPosition@{}=0.1", "bodies.mass@{}=2",
                     "colliderFriction@{}=2"):
            by_path, by_name, none = (
                self.bench(GRASP, "--envs", 1, "--duration", 0.02, *vary)["digest"]
                for vary in (("--vary", what.format("/World/can")),
                             ("--vary", what.format("can")), ()))
            self.assertEqual(by_path, by_name, what)
            self.assertNotEqual(by_path, none, what)

    def test_wrong_variations_are_told(self):
        for vary, said in (("beauty=1..2", "bodyMass"), ("gravity=2..1", "range"),
                           ("gravity", "not a variation"), ("bodyMass@/none=1", "nothing at"),
                           ("bodyMass@shed=1", "nothing at"),
                           ("joints.upper=2", "nothing of the asset"),
                           ("bodyMass@=1", "no path")):
            run = self.run_tenon(self.file, "--envs", 2, "--duration", 0.1, "--vary", vary)
            self.assertEqual(run.returncode, 2, vary)
            self.assertIn(said, run.stderr, vary)

    def test_one_that_fails_is_told_and_the_others_go_on(self):
        told = self.bench(self.file, "--envs", 3, "--duration", 0.1, "--vary",
                          "bodies.linearVelocity@/pushed=1e300..1e308", code=3)
        self.assertEqual(told["failed"], 3)
        self.assertTrue(all(end["failure"] for end in told["each"]))
        text = self.run_tenon(self.file, "--envs", 3, "--duration", 0.1, "--vary",
                              "bodies.linearVelocity@/pushed=1e300..1e308")
        self.assertIn("environment 0 failed", text.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
