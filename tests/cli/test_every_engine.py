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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
