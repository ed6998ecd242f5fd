#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What `tenon sim` promises of every engine, on every engine that is here and every example.

    test_every_engine.py SOURCES TENON
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCES = pathlib.Path(sys.argv[1])
TENON = str(pathlib.Path(sys.argv[2]).absolute())


def run(*words, cwd=None):
    return subprocess.run([TENON, *map(str, words)], capture_output=True, text=True, cwd=cwd,
                          check=False)


def engines():
    return [engine["name"] for engine in json.loads(run("doctor", "--json").stdout)["engines"]
            if engine["available"]]


def series():
    """What --log can add, as the help lists it."""
    text = re.sub(r"\s+", " ", run("help", "sim").stdout)
    return re.search(r"--log WHAT .*?\((\w+(?:, \w+)+)\)", text)[1].split(", ")


def examples():
    """Layers of the examples that hold bodies."""
    for path in sorted((SOURCES / "examples").rglob("*.usda")):
        found = run("physics", path, "--json")
        if found.returncode < 2 and json.loads(found.stdout).get("bodies"):
            yield path


ENGINES, SERIES, EXAMPLES = engines(), series(), list(examples())


def numbers(value):
    """All numbers below a value of JSON."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for each in value:
            yield from numbers(each)
    elif isinstance(value, (int, float)):
        yield value


class EveryLog(unittest.TestCase):
    """Each series on each engine and example, from the frame at the start on."""

    def test_is_finite_from_the_start_on(self):
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder, "run.jsonl")
            for engine in ENGINES:
                for example in EXAMPLES:
                    with self.subTest(engine=engine, example=example.name):
                        done = run("sim", example, "--engine", engine, "--duration", "0.01", "-o",
                                   log, "--log", ",".join(SERIES))
                        self.assertEqual(done.returncode, 0, done.stderr)
                        lines = [json.loads(line) for line in log.read_text().splitlines()]
                        frames = [line for line in lines if "time" in line]
                        self.assertEqual(frames[0]["time"], 0)
                        for number in numbers(lines):
                            self.assertTrue(math.isfinite(number))


# Cubes on hinges without a drive, of which the last lies in the first by 80 mm: what pushes them
# apart gives energy in every step.
OVERLAP = """#usda 1.0
(
    defaultPrim = "Robot"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Robot" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def PhysicsScene "Scene" {}
%s
    def PhysicsFixedJoint "base" { rel physics:body1 = </Robot/base_link>
    }
    def PhysicsRevoluteJoint "first"
    {
        rel physics:body0 = </Robot/base_link>
        rel physics:body1 = </Robot/upper>
        uniform token physics:axis = "X"
        point3f physics:localPos0 = (0, 0, 0.05)
        point3f physics:localPos1 = (0, 0, -0.05)
    }
    def PhysicsRevoluteJoint "second"
    {
        rel physics:body0 = </Robot/upper>
        rel physics:body1 = </Robot/inside>
        uniform token physics:axis = "X"
        point3f physics:localPos0 = (0, 0, -0.04)
        point3f physics:localPos1 = (-0.01, 0, 0.04)
    }
}
""" % "".join("""    def Cube "%s" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
    )
    {
        double size = 0.1
        float physics:mass = %s
        double3 xformOp:translate = %s
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
""" % part for part in (("base_link", 1, "(0, 0, 0)"), ("upper", 0.01, "(0, 0, 0.1)"),
                        ("inside", 0.01, "(0.01, 0, 0.02)")))


class EnergyFromNowhere(unittest.TestCase):
    """No engine says that a run went well whose bodies move with energy that nothing gave."""

    def test_ends_the_run_with_the_body_and_the_time(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "overlap.usda")
            scene.write_text(OVERLAP)
            for engine in ENGINES:
                with self.subTest(engine=engine):
                    done = run("sim", scene, "--engine", engine, "--duration", "1", "--json")
                    answer = json.loads(done.stdout)
                    if done.returncode == 0:  # this engine holds it, and then no energy came
                        self.assertLess(answer["energy"]["final"], 1)
                        continue
                    self.assertEqual(done.returncode, 3)
                    self.assertTrue(answer["unstable"])
                    [found] = [d for d in answer["diagnostics"]
                               if d["rule"] == engine + ".unstable"]
                    self.assertTrue(found["prim"].startswith("/Robot/"), found)
                    self.assertRegex(found["message"], r"unstable at [\d.e-]+ s")


# A finger of 20 g on a drive that is stiff, strong and far from its target: for steps of 2 ms only
# an integrator that takes positions implicitly holds it. The tip starts outside of its limit.
FINGER = """#usda 1.0
(
    defaultPrim = "Robot"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Robot" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def PhysicsScene "Scene" {}
    def Xform "hand" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 5
        float3 physics:diagonalInertia = (0.01, 0.01, 0.01)
    }
    def Xform "finger" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 0.02
        point3f physics:centerOfMass = (0.02, 0, 0)
        float3 physics:diagonalInertia = (1e-6, 3e-6, 3e-6)
    }
    def PhysicsFixedJoint "base" { rel physics:body1 = </Robot/hand>
    }
    def PhysicsRevoluteJoint "knuckle" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
    {
        rel physics:body0 = </Robot/hand>
        rel physics:body1 = </Robot/finger>
        uniform token physics:axis = "Y"
        %s
        float drive:angular:physics:stiffness = %s
        float drive:angular:physics:damping = %s
        float drive:angular:physics:maxForce = 1.4
        float drive:angular:physics:targetPosition = %s
    }
}
"""


class Joints(unittest.TestCase):
    """A joint that shakes, or ends outside of its limits, is told on every engine."""

    def simulate(self, scene, engine, *words):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "finger.usda")
            path.write_text(scene)
            if "--duration" not in words:
                words += ("--duration", "1")
            return json.loads(run("sim", path, "--engine", engine, "--json", *words).stdout)

    def told(self, answer):
        return {d["rule"]: d["prim"] for d in answer["diagnostics"]}

    def test_a_drive_that_holds_is_silent(self):
        for engine in ENGINES:
            with self.subTest(engine=engine):
                answer = self.simulate(FINGER % ("", 5.24, 0.17, 0), engine)
                [position] = answer["joints"]["/Robot/knuckle"]["position"]
                self.assertAlmostEqual(position, 0, delta=0.5)
                self.assertFalse({"sim.joint-shakes", "sim.beyond-limit"} & set(self.told(answer)))

    def test_a_shaking_joint_is_told_and_so_is_the_integrator(self):
        scene = FINGER % ("", 5.24, 0.17, 20)
        told = self.told(self.simulate(scene, "mujoco"))
        self.assertEqual(told["mujoco.integrator"], "/Robot/knuckle")
        answer = self.simulate(scene, "mujoco", "--integrator", "implicitfast")
        told = self.told(answer)
        self.assertNotIn("mujoco.integrator", told)  # the user's choice wins
        if not answer["unstable"]:
            self.assertEqual(told["sim.joint-shakes"], "/Robot/knuckle")

    def test_a_joint_outside_of_its_limits_is_told(self):
        limits = ("float physics:lowerLimit = -10\n        float physics:upperLimit = 10\n"
                  "        float state:angular:physics:position = 60")
        drive = '"PhysicsDriveAPI:angular"'
        scene = (FINGER % (limits, 5.24, 0.17, 60)).replace(
            drive, drive + ', "PhysicsJointStateAPI:angular"')
        outside = 0
        for engine in ENGINES:
            for duration in ("0.004", "1"):
                with self.subTest(engine=engine, duration=duration):
                    answer = self.simulate(scene, engine, "--duration", duration)
                    if answer["unstable"]:
                        continue
                    [position] = answer["joints"]["/Robot/knuckle"]["position"]
                    is_outside = abs(position) > 10 + 2 + 0.02 * 20
                    outside += is_outside
                    self.assertEqual("sim.beyond-limit" in self.told(answer), is_outside)
        self.assertGreater(outside, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
