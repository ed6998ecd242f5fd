#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon benchmark`: good assets pass, and each test fails an asset with a planted fault, and why.

    test_benchmark.py ROOT TENON
"""

import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
sys.path.insert(0, str(ROOT / "tests/engines_beside"))
from author import body, drive, floor, joint, material, scene

TESTS = ["ground_drop", "slope_drop", "full_range_sweep", "effort_limit", "velocity_limit",
         "mimic_joint", "drive_gain_validation"]
DEGREE = math.pi / 180
INERTIA, ARM = 0.05, 0.3  # [kg m2] about the centre of mass, [m] from there to the axis
STIFFNESS = 50.0  # [N m/rad]: 18.9 rad/s with INERTIA + ARM^2
# From 0.4 m above the ground, twice the height of the box, to 0.1 m [s].
FALL = math.sqrt(2 * 0.3 / 9.81)
CRITICAL = 2 * math.sqrt(STIFFNESS * (INERTIA + ARM * ARM))


def tenon(*words, cwd=None):
    return subprocess.run([TENON, *map(str, words)], capture_output=True, text=True, check=False,
                          cwd=cwd)


ENGINES = [row["name"] for row in json.loads(tenon("doctor", "--json").stdout)["engines"]
           if row["available"]]


def box(**more):
    return scene(body("Box", (0, 0, 1), ("Cube", 0.2), mass=1.0, **more))


def link(name, height):
    """1 kg that lies ARM beside its axis, out of the way of others."""
    return body(name, (ARM, 0, height), ("Cube", 0.1), mass=1.0, inertia=(INERTIA,) * 3)


def arm(stiffness=STIFFNESS, damping=CRITICAL, limits=(-90, 90), axis="Z", more=(), apis=(),
        lines=(), max_force=None, physics=()):
    """A link on a base that is fixed to the world; `more`: further prims."""
    return scene(
        body("Base", (0, 0, 0.3), ("Cube", 0.1), mass=5.0, inertia=(0.1,) * 3),
        joint("fixed", "Hold", None, "/World/Base", (0, 0, 0.3)),
        link("Link", 1),
        joint("revolute", "Turn", "/World/Base", "/World/Link", (0, 0, 0.7), (-ARM, 0, 0),
              axis=axis, limits=limits, apis=apis, lines=lines,
              parts=[drive("angular", "force", stiffness * DEGREE, damping * DEGREE,
                           max_force=max_force)]),
        *more, articulated=True, gravity=physics, physics_apis=["MjcSceneAPI"] if physics else [])


def speed_limit(degrees):
    return {"apis": ["PhysxJointAPI"],
            "lines": [f"float physxJoint:maxJointVelocity = {degrees}"]}


def follower(frequency, multiplier=-1.0):
    """A second link that follows the first; `frequency` [Hz or rad/s] 0: rigidly."""
    words = {"apis": ["NewtonMimicAPI"],
             "lines": [f"float newton:mimicCoef1 = {multiplier}",
                       "rel newton:mimicJoint = </World/Turn>"]}
    if frequency:
        words = {"apis": ["PhysxMimicJointAPI:rotZ"],
                 "lines": [f"float physxMimicJoint:rotZ:gearing = {-multiplier}",
                           f"float physxMimicJoint:rotZ:naturalFrequency = {frequency}",
                           "float physxMimicJoint:rotZ:dampingRatio = 1",
                           "rel physxMimicJoint:rotZ:referenceJoint = </World/Turn>"]}
    return (link("Other", 2),
            joint("revolute", "Follow", "/World/Base", "/World/Other", (0, 0, 1.7), (-ARM, 0, 0),
                  axis="Z", limits=(-170, 170), **words))


class Benchmark(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_it(self, text, *words, code=None):
        """-> {(engine, test): result} of all engines."""
        path = self.folder / "asset.usda"
        path.write_text(text)
        done = tenon("benchmark", path, "--engine", "all", "--json", *words)
        if code is not None:
            self.assertEqual(done.returncode, code, done.stdout[-3000:] + done.stderr)
        told = json.loads(done.stdout)
        self.assertEqual(told["schema"], "tenon.benchmark/1")
        self.assertEqual([row["engine"] for row in told["engines"]], ENGINES)
        return {(row["engine"], test["test"]): test for row in told["engines"]
                for test in row["tests"]}

    def assert_all(self, verdict, results, test, reason="", engines=None):
        """-> the rows that decide, on each of the engines."""
        rows = []
        for engine in engines or ENGINES:
            result = results[engine, test]
            self.assertEqual(result["verdict"], verdict, (engine, result))
            row = result["rows"][0] if result["rows"] else None
            self.assertIn(reason, (row or result)["reason"] or "", (engine, result))
            rows.append(row)
        return rows

    # ---- good assets

    def test_a_box_passes_and_has_no_joints_to_test(self):
        results = self.run_it(box(), code=0)
        for row in self.assert_all("pass", results, "ground_drop"):
            self.assertAlmostEqual(row["numbers"]["contact"], FALL, delta=0.01)
            self.assertLess(row["numbers"]["deepest"], 0.02)
            self.assertGreater(row["measured"], 2.99)  # 1 s, and still for 2 s
        for row in self.assert_all("pass", results, "slope_drop"):
            self.assertGreater(row["measured"], 0.01)
        for test in TESTS[2:]:
            self.assert_all("skipped", results, test, "a position drive and two limits")

    def test_the_stage_may_have_other_units_and_another_up_axis(self):
        text = scene(body("Box", (0, 100, 0), ("Cube", 20), mass=1000.0), meters=0.01,
                     kilograms=0.001, up="Y")
        results = self.run_it(text, "--tests", "ground_drop,slope_drop", code=0)
        for row in self.assert_all("pass", results, "ground_drop"):
            self.assertAlmostEqual(row["numbers"]["contact"], FALL, delta=0.01)

    def test_an_own_floor_is_not_in_the_way(self):
        text = scene(body("Box", (0, 0, 0.1), ("Cube", 0.2), mass=1.0), floor())
        results = self.run_it(text, "--tests", "ground_drop", code=0)
        self.assert_all("pass", results, "ground_drop")

    def test_an_arm_passes_and_does_not_fall(self):
        stiffness = 200.0
        damping = 2 * math.sqrt(stiffness * 2 * (INERTIA + ARM * ARM))  # of both links
        results = self.run_it(arm(stiffness, damping, more=follower(0), **speed_limit(180)),
                              code=0)
        for test in TESTS[:2]:
            self.assert_all("skipped", results, test, "it hangs on the world by /World/Hold")
        for row in self.assert_all("pass", results, "velocity_limit"):
            self.assertEqual(row["prim"], "/World/Turn")
            self.assertAlmostEqual(row["numbers"]["limit"], math.pi, 5)
            # Without its limit it would reach 0.37 * 26.7 rad/s * 1.5 rad.
            self.assertGreater(row["measured"], 0.9 * math.pi)
        for row in self.assert_all("pass", results, "mimic_joint"):
            self.assertAlmostEqual(row["numbers"]["ratio"], 1, delta=0.02)
        for row in self.assert_all("pass", results, "drive_gain_validation"):
            self.assertLess(row["numbers"]["overshoot"], 0.02)
        for row in self.assert_all("pass", results, "effort_limit"):
            # 10 N at ARM for a sixth of a second: nearly what they turn it by in the end.
            self.assertLess(row["numbers"]["moved"], 1.02 * 10 * ARM / stiffness)
            self.assertGreater(row["numbers"]["moved"], 0.8 * 10 * ARM / stiffness)
        self.assert_all("pass", results, "full_range_sweep")

    # ---- planted faults

    def test_a_body_without_collider_falls_through(self):
        results = self.run_it(box(collides=False), "--tests", "ground_drop,slope_drop", code=1)
        for test in TESTS[:2]:
            for row in self.assert_all("fail", results, test, "the body has no collider"):
                self.assertEqual(row["prim"], "/World/Box")
                self.assertGreater(row["measured"], row["threshold"])

    def test_a_body_without_weight_does_not_come_down(self):
        text = box(lines=["bool physxRigidBody:disableGravity = 1"])
        results = self.run_it(text, "--tests", "ground_drop,slope_drop", code=1)
        self.assert_all("fail", results, "ground_drop", "it does not come down within 10 s")
        self.assert_all("fail", results, "slope_drop", "it does not come to the ramp")

    def test_a_ball_that_rolls_on_does_not_come_to_rest(self):
        text = scene(body("Ball", (0, 0, 1), ("Sphere", 0.1), mass=1.0, velocity=(2, 0, 0)))
        results = self.run_it(text, "--tests", "ground_drop", code=1)
        self.assert_all("fail", results, "ground_drop", "does not come to rest")

    def test_a_slab_that_grips_does_not_slide(self):
        half = math.radians(-45) / 2
        text = scene(material("Rubber", 3.0),
                     body("Slab", (0, 0, 1), ("Cube", 1), mass=1.0, material="/World/Rubber",
                          turn=(math.cos(half), math.sin(half), 0, 0), scale=(0.3, 0.3, 0.06)))
        results = self.run_it(text, "--tests", "slope_drop", code=1)
        self.assert_all("fail", results, "slope_drop", "its friction with 0.5 holds it")

    def test_a_drive_too_weak_for_the_weight(self):
        """1 kg ARM beside a level axis: 2.9 N m."""
        results = self.run_it(arm(axis="Y", max_force=1.0, limits=(-90, 25)), "--tests",
                              "full_range_sweep,drive_gain_validation", code=1)
        self.assert_all("fail", results, "full_range_sweep", "at its maxForce of 1 N m")
        self.assert_all("fail", results, "drive_gain_validation", "at its maxForce of 1 N m")

    def test_a_soft_drive_sags(self):
        """It rests where 5 N m/rad hold 2.9 N m."""
        results = self.run_it(arm(axis="Y", stiffness=5.0, damping=2.0), "--tests",
                              "full_range_sweep", code=1)
        self.assert_all("fail", results, "full_range_sweep", "away from its")

    def test_a_joint_without_strength_gives_way(self):
        """3 N m push 0.14 kg m2: 0.3 rad in a sixth of a second, and the limit is a soft spring."""
        text = arm(stiffness=0.05, damping=0.01, limits=(-8, 8), apis=["PhysxLimitAPI:angular"],
                   lines=["float physxLimit:angular:stiffness = 0.01",
                          "float physxLimit:angular:damping = 0.0001"])
        results = self.run_it(text, "--tests", "effort_limit", code=1)
        self.assert_all("fail", results, "effort_limit", "10 N push it beyond a limit")

    def test_a_velocity_limit_of_the_actuator_alone(self):
        """A performance envelope bounds the drive, which PhysX's adapter does not have at all."""
        text = arm(apis=["PhysxDrivePerformanceEnvelopeAPI:angular"], lines=[
            "float physxDrivePerformanceEnvelope:angular:maxActuatorVelocity = 20"])
        results = self.run_it(text, "--tests", "velocity_limit")
        engines = [name for name in ENGINES if name == "physx"]
        self.assert_all("fail", results, "velocity_limit", "its velocity limit is 0.349",
                        engines)

    def test_a_mimic_that_is_too_soft(self):
        results = self.run_it(arm(more=follower(0.1)), "--tests", "mimic_joint", code=1)
        for row in self.assert_all("fail", results, "mimic_joint", "times as far as its leader"):
            self.assertEqual(row["prim"], "/World/Follow")
            self.assertGreater(abs(row["numbers"]["ratio"] - 1), 0.1)

    def test_a_follower_of_a_follower(self):
        """It moves by the product of both multipliers, whichever of them is written wrong."""
        more = follower(0, -0.5) + (
            link("Third", 3),
            joint("revolute", "Last", "/World/Base", "/World/Third", (0, 0, 2.7), (-ARM, 0, 0),
                  axis="Z", limits=(-170, 170), apis=["NewtonMimicAPI"],
                  lines=["float newton:mimicCoef1 = -0.8",
                         "rel newton:mimicJoint = </World/Follow>"]))
        results = self.run_it(arm(more=more), "--tests", "mimic_joint", code=0)
        for row in self.assert_all("pass", results, "mimic_joint"):
            self.assertEqual(len(results[ENGINES[0], "mimic_joint"]["rows"]), 2)
            self.assertLess(row["measured"], 0.05)
        for engine in ENGINES:
            ratios = {row["prim"]: row["numbers"]["ratio"]
                      for row in results[engine, "mimic_joint"]["rows"]}
            self.assertAlmostEqual(ratios["/World/Follow"], 0.5, delta=0.05)
            self.assertAlmostEqual(ratios["/World/Last"], 0.4, delta=0.05)

    def test_a_follower_that_its_limits_hold_back(self):
        """Five times as far as its leader, which is more than it may turn: neither moves on."""
        results = self.run_it(arm(more=follower(0, -5.0)), "--tests", "mimic_joint", code=1)
        self.assert_all("fail", results, "mimic_joint",
                        "its leader Turn moves too little")

    def test_a_drive_without_damping_overshoots(self):
        results = self.run_it(arm(damping=0.0), "--tests", "drive_gain_validation", code=1)
        self.assert_all("fail", results, "drive_gain_validation", "too little damping")

    def test_gains_that_the_time_step_damps(self):
        """1e6 N m/rad swing at 425 Hz, which implicit steps of 1/240 s do not show."""
        results = self.run_it(arm(stiffness=1e6, damping=0.0), "--tests",
                              "drive_gain_validation", code=1)
        for row in self.assert_all("fail", results, "drive_gain_validation", "at 425 Hz"):
            self.assertEqual(row["numbers"]["dampingRatio"], 0)
        results = self.run_it(arm(stiffness=1e6, damping=1e3), "--tests",
                              "drive_gain_validation", code=0)
        self.assert_all("pass", results, "drive_gain_validation")

    def test_steps_that_are_too_coarse_become_unstable(self):
        """Runge-Kutta follows 1000 rad/s in steps of 1 ms, and not in those of 4 ms."""
        path = self.folder / "arm.usda"
        path.write_text(arm(stiffness=1.4e5, damping=100.0,
                            physics=['uniform token mjc:option:integrator = "rk4"']))
        tests = "full_range_sweep,effort_limit,drive_gain_validation"
        for step, verdict in ((0.001, "pass"), (0.004, "fail")):
            done = tenon("benchmark", path, "--json", "--engine", "mujoco", "--tests", tests,
                         "--dt", step)
            results = {result["test"]: result
                       for result in json.loads(done.stdout)["engines"][0]["tests"]}
            # The pushes start again, whatever became of the sweep before them.
            self.assertGreater(results["effort_limit"]["rows"][0]["numbers"]["moved"], 0)
            for test in ("full_range_sweep", "drive_gain_validation"):
                self.assertEqual(results[test]["verdict"], verdict, (step, results[test]))
                if verdict == "fail":
                    self.assertIn("it becomes unstable after ",
                                  results[test]["rows"][0]["reason"])

    def test_a_sweep_that_the_velocity_limit_forbids(self):
        """80 % of 180 degrees within 1.25 s, in the middle of a smooth step."""
        results = self.run_it(arm(**speed_limit(60)), "--tests", "full_range_sweep", code=1)
        self.assert_all("fail", results, "full_range_sweep",
                        "the sweep takes 3.02 rad/s, its velocity limit is 1.05")

    def test_what_a_tether_holds_does_not_fall(self):
        text = scene(body("Box", (0, 0, 1), ("Cube", 0.2), mass=1.0),
                     joint("distance", "Tether", None, "/World/Box", (0, 0, 2), (0, 0, 0),
                           lines=["float physics:maxDistance = 1.5"]))
        results = self.run_it(text, "--tests", "ground_drop,slope_drop", code=0)
        for test in TESTS[:2]:
            self.assert_all("skipped", results, test, "it hangs on the world by /World/Tether")

    def test_a_shelf_is_not_in_the_way(self):
        text = scene(body("Box", (0, 0, 1), ("Cube", 0.2), mass=1.0),
                     body("Shelf", (0, 0, 0.85), ("Cube", 0.1),
                          lines=["bool physics:kinematicEnabled = 1"]))
        results = self.run_it(text, "--tests", "ground_drop", code=0)
        self.assert_all("pass", results, "ground_drop")

    # ---- what else there is

    def test_the_example_hand(self):
        path = ROOT / "examples/inspire_hand/inspire_hand.usda"
        done = tenon("benchmark", path, "--json", "--engine", "mujoco", "--tests", "mimic_joint")
        result = json.loads(done.stdout)["engines"][0]["tests"][0]
        self.assertEqual(len(result["rows"]), 6)
        self.assertEqual(result["verdict"], "pass", result)

    def test_an_asset_without_physics_is_an_error(self):
        path = self.folder / "bare.usda"
        path.write_text('#usda 1.0\n(\n    defaultPrim = "A"\n)\ndef Xform "A"\n{\n'
                        '    def Cube "B"\n    {\n    }\n}\n')
        done = tenon("benchmark", path)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("[benchmark.no-body]", done.stderr)
        self.assertEqual(tenon("benchmark", self.folder / "none.usda").returncode, 2)

    def test_tests_are_listed_and_chosen(self):
        listed = json.loads(tenon("benchmark", "--list", "--json").stdout)["tests"]
        self.assertEqual([row["name"] for row in listed], TESTS)
        self.assertIn("ground_drop", tenon("benchmark", "--list").stdout)
        path = self.folder / "box.usda"
        path.write_text(box())
        text = tenon("benchmark", path, "--tests", "mimic_joint,ground_drop").stdout
        lines = text.strip().split("\n")
        self.assertEqual([line.split()[0] for line in lines], ["test", "ground_drop",
                                                               "mimic_joint"])
        self.assertEqual(lines[1].split()[2], "pass")
        self.assertEqual(tenon("benchmark", path, "--tests", "drop").returncode, 2)
        self.assertEqual(tenon("benchmark").returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=0)
