#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon check --profile isaac-3.0`: the example hand keeps to the structure; each rule finds its
breach, planted in a copy of it, in the file and line where it was planted.

    test_profile.py ROOT TENON
"""

import collections
import pathlib
import shutil
import sys
import tempfile
import unittest

from program import EXAMPLE, INCUMBENT, breaches, run

INTERFACE, BASE = "inspire_hand.usda", "payloads/base.usda"
PHYSICS, PHYSX = "payloads/Physics/physics.usda", "payloads/Physics/physx.usda"
ROBOT, MATERIAL = "payloads/robot.usda", "payloads/material.usda"

# Rule -> file, what to replace there, by what, and the text whose line the finding names.
PLANTED = {
    "structure.wrong-layer": (
        PHYSICS, "float physics:mass = 0.398207",
        "float physics:mass = 0.398207\n        bool physxRigidBody:enableCCD = 1",
        "physxRigidBody:enableCCD"),
    "structure.wrong-arc": (
        ROBOT, 'over "inspire_hand" (',
        'over "inspire_hand" (\n    prepend references = @./instances.usda@</Instances>',
        'references = @./instances.usda@</Instances>'),
    "structure.absolute-path": (
        MATERIAL, "float inputs:roughness = 0.45",
        "float inputs:roughness = 0.45\n            asset inputs:file = @/home/me/skin.png@",
        "inputs:file"),
    "structure.missing-file": (
        INTERFACE, "@./payloads/Physics/mujoco.usda@", "@./payloads/Physics/muscle.usda@",
        "@./payloads/Physics/muscle.usda@"),
    "structure.dangling-selection": (
        INTERFACE, 'string Physics = "physics"', 'string Physics = "PhysX"',
        'string Physics = "PhysX"'),
    "structure.dangling-target": (
        ROBOT, "rel isaac:physics:robotJoints\n",
        "rel isaac:physics:robotJoints = </inspire_hand/Physics/no_joint>\n",
        "</inspire_hand/Physics/no_joint>"),
    "structure.below-instance": (
        PHYSX, 'over "Physics"\n    {',
        'over "r_base_link"\n    {\n        over "r_base_link_1"\n        {\n'
        '            over "r_base_link"\n            {\n'
        '                float physxCollision:contactOffset = 1\n'
        '            }\n        }\n    }\n\n    over "Physics"\n    {',
        '            over "r_base_link"'),
    "structure.empty-over": (
        PHYSX, 'over "Physics"\n    {',
        'over "right_thumb_1"\n    {\n    }\n\n    over "Physics"\n    {',
        'over "right_thumb_1"'),
    "structure.live-collider": (
        BASE, 'def Xform "r_base_link_1" (\n            active = false',
        'def Xform "r_base_link_1" (', None),
    "structure.scene-not-composed": (
        PHYSICS, 'over "inspire_hand"',
        'def PhysicsScene "Scene"\n{\n}\n\nover "inspire_hand"', 'def PhysicsScene "Scene"'),
}


class Profile(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name) / "hand"
        shutil.copytree(EXAMPLE.parent, self.folder,
                        ignore=shutil.ignore_patterns("*.py", "generator", "__pycache__"))

    def check(self):
        return [d for d in breaches(self.folder / INTERFACE) if d["severity"] != "info"]

    def plant(self, name, old, new):
        path = self.folder / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new, 1), encoding="utf-8")
        return path

    def test_the_example_keeps_to_it(self):
        self.assertEqual(self.check(), [])
        done = run("check", EXAMPLE, "--profile", "isaac-3.0")
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_each_rule_finds_its_breach_where_it_is(self):
        for rule, (name, old, new, where) in PLANTED.items():
            with self.subTest(rule):
                kept = (self.folder / name).read_text(encoding="utf-8")
                path = self.plant(name, old, new)
                found = [d for d in self.check() if d["rule"] == rule]
                self.assertEqual(len(found), 1, self.check())
                self.assertTrue(found[0]["fix"])
                if where is not None:
                    self.assertTrue(found[0]["file"].endswith(name))
                    lines = path.read_text(encoding="utf-8").splitlines()
                    self.assertIn(where, lines[found[0]["line"] - 1])
                path.write_text(kept, encoding="utf-8")

    def test_orphan_files(self):
        shutil.copy(self.folder / PHYSX, self.folder / "payloads/Physics/spare.usda")
        found = self.check()
        self.assertEqual([d["rule"] for d in found], ["structure.orphan-file"])
        self.assertTrue(found[0]["file"].endswith("payloads/Physics/spare.usda"))

    def test_a_gripper_in_a_variant_of_its_own_set_keeps_to_it(self):
        body = 'prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]'
        source = self.folder / "arm.usda"
        source.write_text(f"""#usda 1.0
(
    defaultPrim = "Arm"
)
def Xform "Arm" (
    variants = {{ string Gripper = "two" }}
    prepend variantSets = "Gripper"
)
{{
    def Cube "base" ({body}) {{ }}
    variantSet "Gripper" = {{
        "none" {{ }}
        "two" {{
            def Cube "finger" ({body}) {{ }}
        }}
    }}
}}
""", encoding="utf-8")
        self.assertEqual(run("structure", source, "-o", self.folder / "made").returncode, 0)
        self.assertEqual(breaches(self.folder / "made/Arm.usda"), [])

    def test_what_has_no_such_structure(self):
        path = self.folder / "plain.usda"
        path.write_text('#usda 1.0\n(defaultPrim = "r")\ndef Xform "r" { }\n', encoding="utf-8")
        self.assertEqual([d["rule"] for d in breaches(path)], ["structure.not-structured"])

    def test_older_schemas_are_infos(self):
        rules = {d["rule"] for d in breaches(EXAMPLE)}
        self.assertEqual(rules, {"structure.legacy-schema"})

    def test_without_the_profile_nothing_of_it_is_asked(self):
        self.plant(*PLANTED["structure.empty-over"][:3])
        done = run("check", self.folder / INTERFACE, "--only", "structure", "--json")
        self.assertEqual(done.returncode, 0)
        self.assertNotIn("structure.", done.stdout.replace('"structure', ""))


class VendorsHand(unittest.TestCase):
    def test_its_real_defects_are_found(self):
        if not INCUMBENT.exists():
            self.skipTest(f"{INCUMBENT} is absent")
        counts = collections.Counter(d["rule"] for d in breaches(INCUMBENT))
        self.assertEqual(counts["structure.live-collider"], 13)
        self.assertGreater(counts["structure.dangling-target"], 0)
        self.assertGreater(counts["structure.legacy-schema"], 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
