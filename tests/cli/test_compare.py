#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon compare`: gaps, bounds and reports, and whether it finds the cause that was planted.

    test_compare.py ROOT TENON
"""

import csv
import html.parser
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"

# A driven arm of two links, a box that slides down a slope and a ball that is thrown.
BASE = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "Scene"
    {
        vector3f physics:gravityDirection = (0, 0, -1)
        float physics:gravityMagnitude = 9.81
    }
    def Xform "Arm" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
    {
        def Cube "upper" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
        {
            float physics:mass = 1
            point3f physics:centerOfMass = (0.2, 0, 0)
            float3 physics:diagonalInertia = (0.002, 0.02, 0.02)
        }
        def Cube "lower" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
        {
            float physics:mass = 0.5
            point3f physics:centerOfMass = (0.2, 0, 0)
            float3 physics:diagonalInertia = (0.001, 0.01, 0.01)
            double3 xformOp:translate = (0.4, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
        def PhysicsRevoluteJoint "shoulder" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
        {
            rel physics:body1 = </World/Arm/upper>
            uniform token physics:axis = "Y"
            float drive:angular:physics:stiffness = 0.5
            float drive:angular:physics:damping = 0.05
            float drive:angular:physics:targetPosition = -30
        }
        def PhysicsRevoluteJoint "elbow"
        {
            rel physics:body0 = </World/Arm/upper>
            rel physics:body1 = </World/Arm/lower>
            point3f physics:localPos0 = (0.4, 0, 0)
            uniform token physics:axis = "Y"
            float physics:lowerLimit = -170
            float physics:upperLimit = 170
        }
    }
    def Cube "slope" (prepend apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI"])
    {
        double size = 1
        rel material:binding:physics = </World/Rubber>
        double3 xformOp:translate = (0, 5, -0.5)
        double3 xformOp:rotateXYZ = (0, 20, 0)
        double3 xformOp:scale = (20, 2, 0.2)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ", "xformOp:scale"]
    }
    def Cube "box" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI",
                              "MaterialBindingAPI"]
    )
    {
        double size = 0.2
        float physics:mass = 1
        rel material:binding:physics = </World/Rubber>
        double3 xformOp:translate = (0.0684, 5, -0.312)
        double3 xformOp:rotateXYZ = (0, 20, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
    }
    def Material "Rubber" (prepend apiSchemas = ["PhysicsMaterialAPI"])
    {
        float physics:staticFriction = 0.2
        float physics:dynamicFriction = 0.2
    }
    def Sphere "ball" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        double radius = 0.1
        float physics:mass = 0.3
        vector3f physics:velocity = (1, 0, 4)
        double3 xformOp:translate = (0, -5, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
"""
# What stands in a variant is the only difference of the two engines' layers.
SCENE = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def Xform "World" (
    variants = { string Physics = "mujoco" }
    prepend variantSets = "Physics"
    prepend references = @base.usda@
)
{
    variantSet "Physics" = {
        "mujoco" {
%s
        }
        "physx" {
%s
        }
    }
}
"""


def over(path, body, schemas=""):
    """Nested overs of a path below World."""
    names = path.split("/")
    text = body
    for i, name in enumerate(reversed(names)):
        meta = f" (prepend apiSchemas = [{schemas}])" if schemas and i == 0 else ""
        text = f'over "{name}"{meta}\n{{\n{text}\n}}\n'
    return text


SHOULDER, ELBOW, BOX = "Arm/shoulder", "Arm/elbow", "box"
LAYER = "layer"
# name: (property of the first reason, its kind, what PhysX's layer says)
PLANTED = {
    "stiffness": ("joints.drives.stiffness", LAYER,
                  over(SHOULDER, "float drive:angular:physics:stiffness = 0.2")),
    "damping": ("joints.drives.damping", LAYER,
                over(SHOULDER, "float drive:angular:physics:damping = 0.2")),
    "target": ("joints.drives.targetPosition", LAYER,
               over(SHOULDER, "float drive:angular:physics:targetPosition = 10")),
    "target velocity": ("joints.drives.targetVelocity", LAYER,
                        over(SHOULDER, "float drive:angular:physics:targetVelocity = 60")),
    "max force": ("joints.drives.maxForce", LAYER,
                  over(SHOULDER, "float drive:angular:physics:maxForce = 2")),
    "drive type": ("joints.drives.type", LAYER,
                   over(SHOULDER, 'uniform token drive:angular:physics:type = "acceleration"')),
    "upper limit": ("joints.upper", LAYER, over(ELBOW, "float physics:upperLimit = 5")),
    "joint frame": ("joints.frame0", LAYER, over(ELBOW, "point3f physics:localPos0 = (0.3, 0, 0)")),
    "joint off": ("joints.enabled", LAYER, over(ELBOW, "bool physics:jointEnabled = false")),
    "armature": ("joints.armature", LAYER,
                 over(ELBOW, "float physxJoint:armature = 0.2", '"PhysxJointAPI"')),
    "no gravity": ("bodies.gravityScale", LAYER,
                   over("ball", "bool physxRigidBody:disableGravity = true",
                        '"PhysxRigidBodyAPI"')),
    "mass": ("bodies.mass", LAYER, over("Arm/lower", "float physics:mass = 1")),
    "centre of mass": ("bodies.centerOfMass", LAYER,
                       over("Arm/lower", "point3f physics:centerOfMass = (0.1, 0, 0)")),
    "inertia": ("bodies.inertia", LAYER,
                over("Arm/lower", "float3 physics:diagonalInertia = (0.001, 0.1, 0.1)")),
    "velocity": ("bodies.linearVelocity", LAYER,
                 over("ball", "vector3f physics:velocity = (2, 0, 4)")),
    "linear damping": ("bodies.linearDamping", LAYER,
                       over("ball", "float physxRigidBody:linearDamping = 1",
                            '"PhysxRigidBodyAPI"')),
    "gravity": ("scenes.gravity", LAYER, over("Scene", "float physics:gravityMagnitude = 5")),
    "kinematic": ("bodies.kinematic", LAYER, over("ball", "bool physics:kinematicEnabled = true")),
    "friction": ("materials.dynamicFriction", LAYER,
                 over("Rubber", "float physics:dynamicFriction = 0.05")),
    "collider off": ("colliders.enabled", LAYER,
                     over(BOX, "bool physics:collisionEnabled = false")),
}


class Compare(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def scene(self, physx="", mujoco=""):
        file = self.folder / "scene.usda"
        (self.folder / "base.usda").write_text(BASE)
        file.write_text(SCENE % (mujoco, physx))
        return file

    def run_tenon(self, *arguments):
        return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True)

    def compare(self, file, *arguments, code=0):
        run = self.run_tenon("compare", file, *arguments, "--json")
        self.assertEqual(run.returncode, code, run.stderr + run.stdout[-2000:])
        return json.loads(run.stdout)

    def gap(self, answer, metric):
        return next(gap for gap in answer["pairs"][0]["gaps"] if gap["metric"] == metric)

    def test_the_planted_cause_comes_first(self):
        missed = {}
        for name, (expected, kind, layer) in PLANTED.items():
            answer = self.compare(self.scene(layer), "--engines", "mujoco,physx", "--duration", 1)
            reasons = answer["pairs"][0]["reasons"]
            first = reasons[0] if reasons else {"property": None, "kind": None}
            if (first["property"], first["kind"]) != (expected, kind):
                missed[name] = [(r["property"], r["share"]) for r in reasons]
        self.assertLessEqual(len(missed), len(PLANTED) // 10, missed)

    def test_a_long_step_is_the_reason_where_it_is(self):
        answer = self.compare(self.scene(), "--engines", "mujoco,physx", "--duration", 1,
                              "--dt", 0.02)
        kinds = [reason["kind"] for reason in answer["pairs"][0]["reasons"]]
        self.assertIn("timeStep", kinds)

    def test_one_engine_twice_has_no_reason(self):
        for engine in ("mujoco", "physx"):
            answer = self.compare(self.scene(), "--engines", f"{engine},{engine}", "--duration", 1)
            pair = answer["pairs"][0]
            self.assertEqual(pair["reasons"], [])
            self.assertEqual({gap["largest"] for gap in pair["gaps"]}, {0})
            self.assertEqual(pair["first"], f"{engine}:{engine}")
            self.assertEqual(pair["second"], f"{engine}:{engine} (2)")

    def test_the_hand_agrees_within_a_degree(self):
        answer = self.compare(HAND, "--engines", "mujoco,physx", "--duration", 2, "--no-reasons",
                              "--fail-above", "5mm,1deg")
        self.assertEqual(answer["exceeded"], [])
        self.assertEqual([one["variant"] for one in answer["engines"]], ["mujoco", "physx"])

    def test_bounds_decide_the_exit_code(self):
        file = self.scene(PLANTED["velocity"][2])
        run = ["--engines", "mujoco,physx", "--duration", 0.5, "--no-reasons"]
        answer = self.compare(file, *run, "--fail-above", "1mm", code=1)
        self.assertEqual(answer["exceeded"][0]["metric"], "position")
        self.assertEqual(answer["exceeded"][0]["bound"], 0.001)
        # 0.5 m in 0.5 s
        self.assertAlmostEqual(self.gap(answer, "position")["largest"], 0.5, 3)
        self.assertEqual(self.gap(answer, "position")["object"], "/World/ball")
        self.compare(file, *run, "--fail-above", "position=60cm")
        bad = self.run_tenon("compare", file, *run, "--fail-above", "5 apples")
        self.assertEqual(bad.returncode, 2)
        self.assertIn("5mm, 1deg", bad.stderr)

    def test_variants_of_one_engine(self):
        answer = self.compare(self.scene(PLANTED["mass"][2]), "--engines",
                              "mujoco:mujoco,mujoco:physx", "--duration", 0.5)
        reasons = answer["pairs"][0]["reasons"]
        self.assertEqual(reasons[0]["property"], "bodies.mass")
        self.assertIn("0.5 kg for mujoco:mujoco, 1 kg for mujoco:physx", reasons[0]["what"])
        self.assertAlmostEqual(reasons[0]["share"], 1, 6)

    def test_drives_of_one_layer_alone_that_follow_samples(self):
        driven = over(ELBOW, """float drive:angular:physics:stiffness = 1
            float drive:angular:physics:targetPosition.timeSamples = { 0: 0, 24: 40 }""",
                      '"PhysicsDriveAPI:angular"')
        for layers in ((driven, ""), ("", driven)):
            answer = self.compare(self.scene(*layers), "--engines", "mujoco,physx", "--duration", 1)
            first = answer["pairs"][0]["reasons"][0]
            self.assertEqual(first["property"], "joints.drives")
            self.assertGreater(first["share"], 0.9)

    def test_reports(self):
        class Page(html.parser.HTMLParser):
            plots, links, policies = 0, [], []

            def handle_starttag(self, tag, attributes):
                self.plots += tag == "svg"
                self.links += [value for key, value in attributes if key in ("href", "src")]
                named = dict(attributes)
                if named.get("http-equiv") == "Content-Security-Policy":
                    self.policies.append(named["content"])

        file = self.scene(PLANTED["velocity"][2])
        for ending in ("html", "csv", "json"):
            run = self.run_tenon("compare", file, "--engines", "mujoco,physx", "--duration", 0.5,
                                 "-o", self.folder / f"report.{ending}")
            self.assertEqual(run.returncode, 0, run.stderr)
        page = Page()
        page.feed((self.folder / "report.html").read_text())
        self.assertEqual(page.links, [])
        self.assertEqual(page.policies, ["default-src 'none'; style-src 'unsafe-inline'"])
        self.assertGreaterEqual(page.plots, 5)
        rows = list(csv.DictReader((self.folder / "report.csv").read_text().splitlines()))
        position = next(row for row in rows if row["metric"] == "position")
        self.assertEqual(position["object"], "/World/ball")
        told = json.loads((self.folder / "report.json").read_text())
        self.assertAlmostEqual(self.gap(told, "position")["largest"], float(position["largest"]))

    def test_commands_outside_of_the_run_are_told_like_those_of_sim(self):
        table = self.folder / "c.csv"
        for verb in ("sim", "compare"):
            words = (self.scene(), "--duration", 0.1, "--commands", table)
            table.write_text("time,/World/Arm/shoulder.target\n-1,0\n0.01,1\n5,2\n")
            told = self.run_tenon(verb, *words).stderr
            self.assertIn("1 of 3 rows of commands are before time 0", told)
            self.assertIn("the run ends at 0.1 s, before 5 s", told)
            table.write_text("time,/World/Arm/shoulder.target\n0,0\n0.1,1\n")
            self.assertNotIn("sim.commands", self.run_tenon(verb, *words).stderr)

    def test_an_engine_that_is_not_there_is_told(self):
        run = self.run_tenon("compare", self.scene(), "--engines", "mujoco,bullet")
        self.assertEqual(run.returncode, 2)
        self.assertIn("bullet", run.stderr)

    def test_what_cannot_be_compared_is_told(self):
        run = self.run_tenon("compare", self.scene(), "--engines", "mujoco")
        self.assertEqual(run.returncode, 2)
        self.assertIn("one engine", run.stderr)
        run = self.run_tenon("compare", self.folder / "none.usda", "--engines", "mujoco,mujoco")
        self.assertEqual(run.returncode, 2)
        run = self.run_tenon("compare", self.scene(), "--engines", "mujoco,mujoco", "-o",
                             self.folder / "report.png")
        self.assertEqual(run.returncode, 2)
        self.assertIn("output.kind", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
