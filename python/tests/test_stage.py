# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Stages, prims and values: read, set, save."""

import gc
import threading

import numpy as np
import support

import tenon_usd as tenon

JOINT = "/inspire_hand/Physics/right_index_1_joint"


class Reading(support.FilesTestCase):
    def test_prims_are_walked_and_looked_up(self):
        stage = tenon.open(support.HAND)
        prims = stage.prims
        self.assertGreater(len(prims), 50)
        self.assertEqual(stage.default_prim, stage["/inspire_hand"])
        self.assertIn(JOINT, stage)
        joint = stage[JOINT]
        self.assertEqual(joint.type_name, "PhysicsRevoluteJoint")
        self.assertTrue(joint.is_a("PhysicsJoint"))
        self.assertEqual(joint.parent.path, "/inspire_hand/Physics")
        self.assertIn(joint, joint.parent.children)
        self.assertIn("physics:upperLimit", joint.properties)

    def test_values_of_each_kind(self):
        path = self.written("kinds.usda", '''#usda 1.0
(
    metersPerUnit = 0.01
)
def Scope "S"
{
    bool b = true
    int i = -3
    double d = 0.5
    half h = 1.5
    string s = "a \\"quoted\\" word"
    token t = "word"
    asset a = @./other.usda@
    float3 v = (1, 2, 3)
    quatf q = (1, 0, 0, 0)
    matrix2d m = ((1, 2), (3, 4))
    point3f[] points = [(0, 0, 0), (1, 2, 3)]
    int[] counts = [3, 4]
    string[] words = ["x", "y"]
    float blocked = None
    float moving.timeSamples = { 0: 1, 10: 2 }
    rel target = </S>
}
''')
        prim = tenon.open(path)["/S"]
        self.assertIs(prim["b"], True)
        self.assertEqual((prim["i"], prim["d"], prim["h"]), (-3, 0.5, 1.5))
        self.assertEqual((prim["s"], prim["t"]), ('a "quoted" word', "word"))
        self.assertEqual(prim["a"].path, "./other.usda")
        self.assertEqual(prim["v"], (1.0, 2.0, 3.0))
        self.assertEqual(prim["q"], (1.0, 0.0, 0.0, 0.0))
        self.assertEqual(prim["m"], ((1.0, 2.0), (3.0, 4.0)))
        self.assertEqual(prim["words"], ["x", "y"])
        self.assertIsNone(prim["blocked"])
        self.assertEqual(prim.get("moving", 5), 1.5)
        self.assertEqual(prim.times("moving"), [0.0, 10.0])
        self.assertEqual(prim["target"], ["/S"])
        np.testing.assert_array_equal(prim["points"], [[0, 0, 0], [1, 2, 3]])
        self.assertEqual(prim["counts"].tolist(), [3, 4])
        with self.assertRaises(tenon.NotFoundError):
            prim["none"]

    def test_arrays_are_views_that_outlive_the_stage(self):
        path = self.written("points.usda", '#usda 1.0\ndef Mesh "M"\n{\n    point3f[] points = ['
                            + ", ".join(f"({i}, 0, 0)" for i in range(1000)) + "]\n}\n")
        points = tenon.open(path)["/M"]["points"]
        gc.collect()
        self.assertFalse(points.flags.writeable)
        self.assertFalse(points.flags.owndata)
        self.assertEqual(points[:, 0].sum(), 499500)

    def test_errors_carry_their_place(self):
        path = self.written("bad.usda", '#usda 1.0\ndef Xform "A"\n{\n    float x = "word"\n}\n')
        with self.assertRaises(tenon.ParseError) as caught:
            tenon.open(path)
        error = caught.exception
        self.assertEqual((error.file, error.line), (str(path), 4))
        self.assertTrue(str(error).startswith(f"{path}:4:"))
        self.assertIsInstance(error, ValueError)
        with self.assertRaises(OSError):
            tenon.open(self.folder / "nothing.usda")
        with self.assertRaises(TypeError):
            tenon.open(support.HAND, phsyics="mujoco")
        with self.assertRaises(tenon.NotFoundError):
            tenon.open(support.HAND, physics="nothing")

    def test_missing_references_are_findings(self):
        path = self.written("missing.usda",
                            '#usda 1.0\ndef "A" (\n    references = @./none.usda@\n)\n{\n}\n')
        findings = tenon.open(path).diagnostics
        self.assertEqual([finding.prim for finding in findings], ["/A"])
        self.assertEqual(findings[0].line, 3)
        self.assertEqual(findings[0].related, [])

    def test_findings_name_what_they_are_about(self):
        path = self.written("lost.usda", '#usda 1.0\ndef "A" (\n    references = </B>\n)\n{\n}\n')
        (related,) = tenon.open(path).diagnostics[0].related
        self.assertEqual((related.path, related.role), ("/B", "prim"))
        self.assertTrue(related.file.endswith("lost.usda"))


class Editing(support.FilesTestCase):
    def test_a_value_lands_in_the_file_that_owns_it(self):
        path = self.copied_hand()
        stage = tenon.open(path)
        joint = stage[JOINT]
        before = joint["physics:upperLimit"]
        (place,) = joint.set("physics:upperLimit", before - 10)
        self.assertTrue(place["file"].endswith("physics.usda"))
        self.assertEqual(joint["physics:upperLimit"], before - 10)
        self.assertEqual(tenon.open(path)[JOINT]["physics:upperLimit"], before)
        self.assertTrue(stage.undo())
        self.assertEqual(joint["physics:upperLimit"], before)
        self.assertTrue(stage.redo())
        self.assertEqual(stage.save(), [place["file"]])
        self.assertEqual(tenon.open(path)[JOINT]["physics:upperLimit"], before - 10)
        joint["physics:upperLimit"] = before  # after saving
        stage.save()
        self.assertEqual(tenon.open(path)[JOINT]["physics:upperLimit"], before)

    def test_a_new_asset_is_authored(self):
        path = self.folder / "box.usda"
        stage = tenon.new(path)
        box = stage.define("/World/box", "Cube")
        stage.define("/World/scene", "PhysicsScene")
        for schema in ("PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"):
            box.apply(schema)
        box["size"] = 0.2
        box["physics:density"] = 500
        box["extent"] = np.array([[-0.1] * 3, [0.1] * 3])
        self.assertEqual(box.apis,
                         ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"])
        stage.save()
        (body,) = tenon.physics(path).bodies
        self.assertAlmostEqual(body.mass, 4.0, places=5)
        with self.assertRaises(tenon.FileError):
            tenon.new(path)
        with self.assertRaises(tenon.InvalidError):
            box["size"] = "wide"
        box.remove()
        self.assertFalse(box.exists)
        with self.assertRaises(tenon.NotFoundError):
            box["size"]

    def test_strings_are_written_as_they_are(self):
        path = self.written("s.usda", '#usda 1.0\ndef "A"\n{\n    string s = "x"\n'
                            '    string[] many = []\n    asset a = @x@\n}\n')
        stage = tenon.open(path)
        for word in ('say "hi"', "None", "'", "a\\b", "two\nlines", "/World", ""):
            stage["/A"]["s"] = word
            self.assertEqual(stage["/A"]["s"], word)
        stage["/A"]["many"] = ["/World", 'a"b']
        self.assertEqual(stage["/A"]["many"], ["/World", 'a"b'])
        stage["/A"]["a"] = tenon.AssetPath("y.png")
        self.assertEqual(stage["/A"]["a"].path, "y.png")

    def test_flattened_is_no_input(self):
        path = self.copied_hand()
        stage = tenon.open(path)
        self.assertTrue(stage.flatten().startswith("#usda 1.0"))
        stage.flatten(self.folder / "flat.usdc")
        self.assertEqual(len(tenon.open(self.folder / "flat.usdc").layers), 1)
        with self.assertRaises(tenon.InvalidError) as caught:
            stage.flatten(path)
        self.assertEqual(caught.exception.rule, "output.is-input")


class Threads(support.FilesTestCase):
    def test_one_stage_from_several_threads(self):
        stage = tenon.open(support.HAND)
        wanted = [body.mass for body in stage.physics().bodies]
        failures = []

        def look():
            try:
                for _ in range(3):
                    if [body.mass for body in stage.physics().bodies] != wanted:
                        raise AssertionError("other masses")
                    if len([prim.type_name for prim in stage.prims]) < 50:
                        raise AssertionError("fewer prims")
            except BaseException as failure:
                failures.append(failure)

        threads = [threading.Thread(target=look) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])


if __name__ == "__main__":
    support.main()
