#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What of a scene is composed: --load, --unloaded, --mask, --mute-layer, --physics.

usage: test_selection.py TENON
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

TENON = ""
ROOT = """#usda 1.0
(
    subLayers = [@./sub/weak.usda@]
)
def "A" (payload = @./payload.usda@</P>)
{
    def "Own" (payload = @./payload.usda@</P>)
    {
    }
}
def "B" (payload = @./payload.usda@</P>)
{
}
def "C" (references = @./payload.usda@</P>)
{
}
"""
ROBOT = """#usda 1.0
(
    defaultPrim = "R"
    metersPerUnit = 1
)
def Xform "R" (
    variants = {
        string Physics = "none"
    }
    prepend variantSets = "Physics"
)
{
    def Cube "box"
    {
    }
    variantSet "Physics" = {
        "light" {
            over "box" (
                prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
            )
            {
                float physics:mass = 1
            }
        }
        "heavy" {
            over "box" (
                prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
            )
            {
                float physics:mass = 9
            }
        }
        "none" {
        }
    }
}
"""
ROBOTS = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
)
def Xform "World"
{
    def "left" (
        prepend references = @./robot.usda@
    )
    {
    }
    def "right" (
        instanceable = true
        prepend references = @./robot.usda@
    )
    {
    }
    def Xform "group" (
        instanceable = true
        prepend references = @./group.usda@</G>
    )
    {
    }
}
"""
GROUP = """#usda 1.0
def Xform "G"
{
    def "inner" (
        prepend references = @./robot.usda@
    )
    {
    }
}
"""
WHOLE = ["/A", "/A/Own", "/A/Own/Kid", "/A/Kid", "/B", "/B/Kid", "/C", "/C/Kid", "/Weak"]


class Case(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = os.path.realpath(temporary.name)
        self.root = self.put("root.usda", ROOT)
        self.put("sub/weak.usda", '#usda 1.0\ndef "Weak"\n{\n}\n')
        self.put("payload.usda", '#usda 1.0\ndef "P"\n{\n    def "Kid"\n    {\n    }\n}\n')

    def put(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def run_tenon(self, *words, folder=None):
        return subprocess.run([TENON, *words], capture_output=True, text=True, check=False,
                              cwd=folder or self.folder)


class Selection(Case):
    def prims(self, *options, folder=None):
        done = self.run_tenon("tree", self.root, "--json", *options, folder=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return sorted(prim["path"] for prim in json.loads(done.stdout)["prims"])

    def without(self, *left_out):
        return sorted(path for path in WHOLE if path not in left_out)

    def test_payloads_are_loaded_as_asked(self):
        for options in ((), ("--load", "all")):
            self.assertEqual(self.prims(*options), sorted(WHOLE))
        for options in (("--load", "none"), ("--unloaded",)):
            self.assertEqual(self.prims(*options), self.without("/A/Own/Kid", "/A/Kid", "/B/Kid"))
        self.assertEqual(self.prims("--load", "/B"), self.without("/A/Own/Kid", "/A/Kid"))
        self.assertEqual(self.prims("--load", "/A"), self.without("/B/Kid"))
        self.assertEqual(self.prims("--load", "/A/Own,/B"), sorted(WHOLE))

    def test_a_muted_layer_is_as_absent(self):
        sub = os.path.join(self.folder, "sub")
        for name in ("sub/weak.usda", "./sub/weak.usda", os.path.join(sub, "weak.usda")):
            self.assertEqual(self.prims("--mute-layer", name), self.without("/Weak"))
        for folder, name in (("/", "sub/weak.usda"), (sub, "weak.usda")):
            self.assertEqual(self.prims("--mute-layer", name, folder=folder), self.without("/Weak"))
        kids = ("/A/Own/Kid", "/A/Kid", "/B/Kid", "/C/Kid")
        self.assertEqual(self.prims("--mute-layer", "payload.usda,sub/weak.usda"),
                         self.without("/Weak", *kids))

    def test_a_mask_and_loading_together(self):
        self.assertEqual(self.prims("--mask", "/A,/C", "--load", "none"),
                         ["/A", "/A/Own", "/C", "/C/Kid"])

    def test_what_is_no_path_is_refused(self):
        for options in (("--load", "A"), ("--load", "/A.x"), ("--load", "none,/A")):
            done = self.run_tenon("tree", self.root, *options)
            self.assertNotEqual(done.returncode, 0, options)
            self.assertIn("is not the path of a prim", done.stderr)

    def test_other_verbs_understand_the_same(self):
        flat = self.run_tenon("cat", self.root, "--load", "none", "--mute-layer", "sub/weak.usda")
        self.assertNotIn("Weak", flat.stdout)
        self.assertEqual(flat.stdout.count('"Kid"'), 1)
        dump = self.run_tenon("dump", self.root, "--load", "/B")
        self.assertNotIn("/A/Kid", json.loads(dump.stdout)["prims"])
        self.assertIn("/B/Kid", json.loads(dump.stdout)["prims"])
        index = self.run_tenon("dump-index", self.root, "--mute-layer", "sub/weak.usda")
        self.assertNotIn("weak.usda", index.stdout)


class PhysicsBelow(Case):
    """--physics reaches robots that a scene references."""

    def setUp(self):
        super().setUp()
        self.scene = self.put("scene.usda", ROBOTS)
        self.put("robot.usda", ROBOT)
        self.put("group.usda", GROUP)

    def masses(self, variant, code=0):
        done = self.run_tenon("physics", self.scene, "--physics", variant, "--json")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        answer = json.loads(done.stdout)
        self.found = {finding["rule"]: finding for finding in answer["diagnostics"]}
        return {body["path"]: body["mass"] for body in answer.get("bodies", [])}

    def test_a_variant_is_selected_on_every_prim_that_has_it(self):
        self.assertEqual(self.masses("heavy"), {"/World/left/box": 9, "/World/right/box": 9})
        self.assertNotIn("variant.no-physics-set", self.found)
        self.assertEqual(self.found["variant.in-instance"]["prim"], "/World/group/inner")

    def test_each_prim_may_have_its_own(self):
        self.assertEqual(self.masses("/World/left=light,/World/right=heavy"),
                         {"/World/left/box": 1, "/World/right/box": 9})
        self.assertEqual(self.masses("heavy,/World/left=none"), {"/World/right/box": 9})

    def test_what_there_is_not_is_refused(self):
        for variant, words in (("physx", "has no variant"), ("/World/left=physx", "has no variant"),
                               ("/World/none=light", "has no variant set")):
            self.masses(variant, code=2)
            self.assertIn(words, self.found["variant.unknown"]["message"])
        done = self.run_tenon("info", self.root, "--physics", "physx", "--json")
        self.assertIn("no prim has a variant set", done.stdout)

    def test_a_scene_without_a_default_prim(self):
        self.scene = self.put("loose.usda", ROBOTS.replace('    defaultPrim = "World"\n', ""))
        self.assertEqual(len(self.masses("heavy")), 2)

    def test_a_baked_motion_repeats_what_ran(self):
        out = os.path.join(self.folder, "motion.usda")
        done = self.run_tenon("bake", self.scene, "--physics", "heavy,/World/right=light",
                              "--duration", "0.01", "-o", out, "--uninstance")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.run_tenon("variant", out, "--json")
        selected = {row["prim"]: row["selection"]
                    for row in json.loads(done.stdout)["variants"]}
        self.assertEqual((selected["/World/left"], selected["/World/right"]), ("heavy", "light"))

    def test_edits_count_under_the_variant_of_robots_below(self):
        mass = "/World/left/box.physics:mass=4"
        done = self.run_tenon("set", self.scene, "--physics", "heavy", mass, "--json")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(self.masses("heavy")["/World/left/box"], 4)


if __name__ == "__main__":
    TENON = os.path.abspath(sys.argv.pop(1))
    unittest.main()
