# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Authoring beyond single values: blocks of edits, what is refused with the name that was meant,
references, renaming, variants, metadata."""

import contextlib
import pathlib
import time
import warnings

import numpy as np
import support

import tenon_usd as tenon

MASS = "physics:mass"
INDEX = "/inspire_hand/right_index_1"
THUMB = "/inspire_hand/right_thumb_1"


def many_bodies(count):
    prims = "".join(f'def Cube "b{i}" (prepend apiSchemas = ["PhysicsMassAPI"])\n{{\n'
                    "float physics:mass = 1\n}\n" for i in range(count))
    return f'#usda 1.0\n(\ndefaultPrim = "W"\n)\ndef Xform "W"\n{{\n{prims}}}\n'


class Blocks(support.FilesTestCase):
    def hand(self):
        stage = tenon.open(self.copied_hand(), physics="physics")
        return stage, stage[INDEX][MASS], stage[THUMB][MASS]

    def test_a_block_is_one_step(self):
        stage, index, thumb = self.hand()
        stage[THUMB][MASS] = 0.5  # a step before it
        with stage.edits() as edits:
            self.assertEqual(stage[INDEX].set(MASS, 2.0), [])
            stage[THUMB][MASS] = 3.0
            stage[THUMB].set("physics:density", 7.0)
        self.assertEqual([place["after"] for place in edits.places], ["2", "3", "7"])
        self.assertEqual((stage[INDEX][MASS], stage[THUMB][MASS]), (2.0, 3.0))
        self.assertTrue(stage.undo())
        self.assertEqual((stage[INDEX][MASS], stage[THUMB][MASS]), (index, 0.5))
        self.assertTrue(stage.redo())
        self.assertEqual((stage[INDEX][MASS], stage[THUMB][MASS]), (2.0, 3.0))
        self.assertTrue(stage.undo())
        self.assertTrue(stage.undo())
        self.assertFalse(stage.undo())
        self.assertEqual((stage[INDEX][MASS], stage[THUMB][MASS]), (index, thumb))

    def test_a_file_may_be_named_by_its_end(self):
        stage, _, _ = self.hand()
        owner = stage[INDEX].set(MASS, 2.0)[0]["file"]
        for name in (pathlib.Path(owner).name, "/".join(pathlib.Path(owner).parts[-2:])):
            stage[INDEX].set(MASS, 3.0, layer=name)
            self.assertEqual(stage[INDEX][MASS], 3.0)
        with self.assertRaisesRegex(tenon.Error, "no layer of the asset is called"):
            stage[INDEX].set(MASS, 4.0, layer="nope.usda")

    def test_what_is_read_in_a_block_is_as_edited(self):
        stage = tenon.new(self.folder / "a.usda")
        with stage.edits():
            box = stage.define("/World/box", "Cube")
            box.apply("PhysicsRigidBodyAPI")
            self.assertTrue(box.has_api("PhysicsRigidBodyAPI"))
            box.apply("PhysicsMassAPI")
            box[MASS] = 2.0
            self.assertEqual(box[MASS], 2.0)
            with stage.edits() as inner:
                box["size"] = 0.5
            self.assertEqual(inner.places, [])  # part of the block around it
            box[MASS] = 4.0
        self.assertEqual((box[MASS], box["size"]), (4.0, 0.5))
        self.assertTrue(stage.undo())
        self.assertFalse(box.exists)
        self.assertFalse(stage.undo())
        stage.redo()
        stage.save()
        self.assertEqual(tenon.open(self.folder / "a.usda")["/World/box"][MASS], 4.0)

    def test_a_block_that_fails_leaves_nothing(self):
        stage, index, _ = self.hand()
        for wrong in (lambda: stage[THUMB].set(MASS, "heavy"),  # told when it is made
                      lambda: 1 / 0):                           # or at once
            with self.assertRaises((tenon.InvalidError, ZeroDivisionError)), stage.edits():
                stage[INDEX][MASS] = 2.0
                self.assertEqual(stage[INDEX][MASS], 2.0)
                stage[INDEX][MASS] = 3.0
                wrong()
            self.assertEqual(stage[INDEX][MASS], index)
            self.assertFalse(stage.undo())
        with self.assertRaises(tenon.InvalidError), stage.edits():
            with self.assertRaises(ZeroDivisionError), stage.edits():
                raise ZeroDivisionError
            stage[INDEX][MASS] = 2.0
        self.assertEqual(stage[INDEX][MASS], index)
        for call in (stage.save, stage.undo, stage.redo):
            with self.assertRaises(tenon.InvalidError) as caught, stage.edits():
                call()
            self.assertEqual(caught.exception.rule, "edit.open-edits")
        with stage.edits():
            stage[INDEX][MASS] = 5.0
        self.assertEqual(stage[INDEX][MASS], 5.0)

    def test_edits_that_change_nothing_are_no_steps(self):
        stage, index, _ = self.hand()
        stage[INDEX][MASS] = 2.0
        stage[INDEX][MASS] = 2.0
        with stage.edits():
            stage[INDEX][MASS] = 2.0
        with stage.edits():
            pass
        self.assertTrue(stage.undo())
        self.assertEqual(stage[INDEX][MASS], index)

    def test_an_edit_costs_the_same_in_a_large_stage(self):
        """Of values, schemas and targets; composing the stage for each cost 8 times as much."""
        spent = []
        for count in (200, 1600):
            path = self.written(f"many{count}.usda", many_bodies(count))
            stage = tenon.open(path)
            prims = [prim for prim in stage.prims if prim.has_api("PhysicsMassAPI")][:200]
            prims[0][MASS] = 5.0  # the editor opens the asset
            prims[0].apply("PhysicsCollisionAPI")
            begun = time.process_time()
            for prim in prims:
                prim[MASS] = 2.0
                prim.apply("PhysicsFilteredPairsAPI")
                prim["physics:filteredPairs"] = ["/W/b7"]
            spent.append(time.process_time() - begun)
            self.assertEqual({prim[MASS] for prim in prims}, {2.0})
            self.assertEqual({tuple(prim["physics:filteredPairs"]) for prim in prims}, {("/W/b7",)})
        self.assertLess(spent[1], 3 * spent[0])

    def test_edits_one_by_one_are_those_of_a_block(self):
        """Values, new properties, schemas and prims, in files, on the stage and when taken back."""
        texts, shown = [], []
        for in_block in (False, True):
            path = self.written(f"both{in_block}.usda", many_bodies(3))
            stage = tenon.open(path)
            with stage.edits() if in_block else contextlib.nullcontext():
                for name in ("b0", "b1"):
                    stage["/W/" + name][MASS] = 2.0
                    stage["/W/" + name].apply("PhysicsCollisionAPI")
                    stage["/W/" + name]["physics:collisionEnabled"] = False
                    stage.define(f"/W/{name}/part", "Xform")
                    made = stage.define(f"/W/{name}/part/pin", "Cube")
                    made.apply("PhysicsMassAPI")
                    made[MASS] = 3.0
                    made["size"] = 0.5
                stage["/W/b2"].unapply("PhysicsMassAPI")
                stage["/W/b2"].clear(MASS)
                stage["/W/b2"].remove()
            shown.append([(prim.path, prim.type_name, list(prim.authored)) for prim in stage.prims])
            before = [prim.path for prim in stage.prims]
            stage.save()
            texts.append(pathlib.Path(path).read_text(encoding="utf-8"))
            self.assertEqual([prim.path for prim in tenon.open(path).prims], before)
        self.assertEqual(texts[0], texts[1])
        self.assertEqual(shown[0], shown[1])

    def test_a_stage_outlives_the_editor(self):
        stage, _, thumb = self.hand()
        prim = stage[INDEX]
        prim[MASS] = 2.0
        stage.save()
        self.assertEqual((prim[MASS], stage[THUMB][MASS]), (2.0, thumb))
        prim[MASS] = 3.0
        self.assertEqual(prim[MASS], 3.0)


class Refused(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        self.stage = tenon.new(self.folder / "a.usda")

    def test_types_that_there_are_not(self):
        with self.assertRaises(tenon.InvalidError) as caught:
            self.stage.define("/World/x", "Cubee")
        self.assertIn("did you mean Cube?", caught.exception.fix)
        self.assertEqual(caught.exception.rule, "edit.unknown-type")
        with self.assertRaisesRegex(tenon.InvalidError, "API schema.*apply"):
            self.stage.define("/World/x", "PhysicsMassAPI")
        with self.assertRaises(tenon.InvalidError):
            self.stage.define("/World/x", "Gprim")  # abstract
        self.assertNotIn("/World/x", self.stage)
        self.assertEqual(self.stage.define("/World/x", "Cubee", any_type=True).type_name, "Cubee")
        self.assertEqual(self.stage.define("/World/y").type_name, "Xform")
        self.assertEqual(self.stage.define("/World/z", "").type_name, "")

    def test_prims_and_properties_that_there_are_not(self):
        self.stage.define("/World/parts")
        box = self.stage.define("/World/parts/box", "Cube")
        for written, meant in (("/World/parts/bxo", "/World/parts/box"),
                               ("/Wrold/parts/box", "/World/parts/box")):
            with self.assertRaises(tenon.NotFoundError) as caught:
                self.stage[written]
            self.assertEqual((caught.exception.rule, caught.exception.fix),
                             ("edit.no-prim", f"did you mean {meant}?"))
        with self.assertRaisesRegex(tenon.NotFoundError, "did you mean size"):
            box["sise"]
        with self.assertRaisesRegex(tenon.NotFoundError, "Stage.prims lists all"):
            self.stage["/nothing/like/it"]
        with self.assertRaisesRegex(tenon.NotFoundError, "Prim.properties lists all"):
            box["nothing:like:it"]

    def test_a_target_that_is_not_there_is_told(self):
        box = self.stage.define("/World/box", "Cube")
        joint = self.stage.define("/World/j", "PhysicsRevoluteJoint")
        with self.assertWarnsRegex(UserWarning, "</World/bxo>.*did you mean /World/box"):
            joint["physics:body0"] = "/World/bxo"
        self.assertEqual(joint["physics:body0"], ["/World/bxo"])
        (found,) = [d for d in self.stage.diagnostics if d.rule == "edit.no-target"]
        self.assertEqual((found.prim, found.property_name), ("/World/j", "physics:body0"))
        self.assertEqual([r.path for r in found.related], ["/World/bxo"])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            joint["physics:body0"] = box
            joint.set("physics:body0", None)
            with self.stage.edits():  # in whichever order
                joint["physics:body1"] = "/World/later"
                self.stage.define("/World/later", "Cube")
        with self.assertWarns(UserWarning), self.stage.edits():
            joint.add_targets("physics:body0", ["/World/nowhere"])


class Values(support.FilesTestCase):
    def test_none_blocks_a_value(self):
        stage = tenon.open(self.copied_hand(), physics="physics")
        stage[INDEX].set(MASS, None)
        self.assertIsNone(stage[INDEX][MASS])
        stage[THUMB][MASS] = None
        self.assertIsNone(stage[THUMB][MASS])


class Kinds(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        self.stage = tenon.new(self.folder / "a.usda")

    def test_references_and_payloads(self):
        part = self.written("part.usda", '#usda 1.0\n(\n    defaultPrim = "P"\n)\n'
                            'def Cube "P"\n{\n    double size = 3\n}\ndef Sphere "Q"\n{\n}\n')
        with self.stage.edits():
            first = self.stage.define("/World/a", reference=part)
            other = self.stage.define("/World/b", payload=(str(part), "/Q"))
        self.assertEqual((first.type_name, first["size"]), ("Cube", 3.0))
        self.assertEqual(other.type_name, "Sphere")
        self.stage.save()
        text = (self.folder / "a.usda").read_text()
        self.assertIn("@part.usda@", text.replace("@./part", "@part"))
        self.assertIn("payload", text)
        for wrong in ({"reference": part, "payload": part}, {"reference": (part, "/Q", 1)}):
            with self.assertRaises(ValueError):
                self.stage.define("/World/c", **wrong)

    def test_names(self):
        box = self.stage.define("/World/box", "Cube")
        joint = self.stage.define("/World/j", "PhysicsRevoluteJoint")
        joint["physics:body0"] = box
        renamed = box.rename("crate")
        self.assertEqual((renamed.path, box.exists), ("/World/crate", False))
        self.assertEqual(joint["physics:body0"], ["/World/crate"])
        renamed.set("mine", 3.0, type_name="double")
        renamed.rename_property("mine", "ours")
        self.assertEqual(renamed["ours"], 3.0)
        self.assertTrue(self.stage.undo() and self.stage.undo() and self.stage.undo())
        self.assertTrue(box.exists)

    def test_targets_one_by_one(self):
        a, b = (self.stage.define(f"/World/{name}", "Cube") for name in "ab")
        a.apply("PhysicsFilteredPairsAPI")
        a.add_targets("physics:filteredPairs", b)
        a.add_targets("physics:filteredPairs", ["/World/a"])
        self.assertEqual(a["physics:filteredPairs"], ["/World/b", "/World/a"])
        a.remove_targets("physics:filteredPairs", [b])
        self.assertEqual(a["physics:filteredPairs"], ["/World/a"])

    def test_variants(self):
        box = self.stage.define("/World/box", "Cube")
        box.add_variant("size", "small")
        box.add_variant("size", "large")
        self.assertEqual(box.variants["size"][1], ["large", "small"])
        box.remove_variant("size", "small")
        self.assertEqual(box.variants["size"][1], ["large"])

    def test_metadata_of_the_stage(self):
        self.stage.define("/World/box", "Cube")
        self.stage.set_metadata("metersPerUnit", 0.01)
        self.stage.set_metadata("upAxis", "Y")
        self.assertEqual((self.stage.metadata("metersPerUnit"), self.stage.metadata("upAxis")),
                         (0.01, "Y"))
        with self.assertRaises(tenon.InvalidError):
            self.stage.set_metadata("metresPerUnit", 1)
        self.stage.undo()
        self.assertEqual(self.stage.metadata("upAxis"), "Z")
        np.testing.assert_equal(self.stage.metadata("metersPerUnit"), 0.01)


if __name__ == "__main__":
    support.main()
