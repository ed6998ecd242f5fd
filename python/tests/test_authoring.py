# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What Python authors beyond properties, prims and schemas: time samples, metadata, variants and
what is in them, arcs, order, connections; and requests as the command has them."""

from pathlib import Path

import numpy as np
import support

import tenon_usd as tenon

PART = '''#usda 1.0
(
    defaultPrim = "Part"
)
def Cube "Part"
{
    double size.timeSamples = {
        0: 1,
        10: 3,
    }
}
def Sphere "Other"
{
}
'''


class AuthoringTestCase(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        self.part = self.written("part.usda", PART)
        self.stage = tenon.new(self.folder / "a.usda")
        self.box = self.stage.define("/World/box", "Cube")

    def saved(self):
        self.stage.save()
        return tenon.open(self.folder / "a.usda")

    def refused(self, rule, kind, call):
        with self.assertRaises(kind) as caught:
            call()
        self.assertEqual(caught.exception.rule, rule)
        return str(caught.exception.fix)


class Samples(AuthoringTestCase):
    def test_samples_are_set_read_and_taken_away(self):
        for time, size in ((0.0, 1.0), (10.0, 3.0), (20.0, 9.0)):
            self.box.set("size", size, time=time)
        self.box["size"] = 7.0
        self.assertEqual(self.box.times("size"), [0, 10, 20])
        self.assertEqual((self.box.get("size", 5), self.box["size"]), (2, 7))
        (place,) = self.box.set("size", None, time=10)  # a block
        self.assertEqual(place["before"], "3")
        self.assertIsNone(self.box.get("size", 12))
        self.box.clear("size", time=10)
        self.assertEqual(self.saved()["/World/box"].times("size"), [0, 20])
        self.refused("edit.no-sample", tenon.NotFoundError, lambda: self.box.clear("size", time=3))
        self.refused("edit.type-mismatch", tenon.InvalidError,
                     lambda: self.box.set("proxyPrim", ["/World"], time=3))

    def test_samples_go_into_the_time_of_the_file(self):
        self.box.add_reference(self.part, offset=100, scale=2)
        self.box.set("size", 5.0, time=120, layer="part.usda")
        self.assertEqual(self.box.times("size"), [100, 120])
        self.stage.save()
        self.assertIn("10: 5", self.part.read_text())


class Metadata(AuthoringTestCase):
    def test_of_prims(self):
        for field, value in (("kind", "component"), ("documentation", 'of "it"\nall'),
                             ("active", True), ("instanceable", False), ("hidden", True),
                             ("displayName", "Box 1"), ("comment", "mine")):
            self.box.set_metadata(field, value)
            self.assertEqual(self.box.metadata(field), value, field)
        self.box.clear_metadata("kind")
        self.assertIsNone(self.box.metadata("kind"))
        opened = self.saved()["/World/box"]
        self.assertEqual(opened.metadata("documentation"), 'of "it"\nall')
        self.box.set_metadata("active", False)
        self.assertFalse(self.box.metadata("active"))

    def test_dictionaries(self):
        held = {"a": 1, "b": 2.5, "c": True, "d": 'x"y', "e": {"f": [1, 2], "g": ["p", "q"]},
                "h": (1.0, 2.0, 3.0), "i": 2**40, "with space": "s"}
        self.box.set_metadata("customData", held)
        self.assertEqual(self.box.metadata("assetInfo"), None)
        self.box.set_metadata("assetInfo", "1.2", key="version")
        found = self.saved()["/World/box"].metadata("customData")
        self.assertEqual(list(found.pop("e")["f"]), [1, 2])
        held.pop("e")
        self.assertEqual(found, held)
        self.box.set_metadata("customData", np.float32(0.5), key="e:n")
        self.assertEqual(self.box.metadata("customData")["e"]["n"], 0.5)
        self.box.clear_metadata("customData", key="e:n")
        self.assertNotIn("n", self.box.metadata("customData")["e"])
        self.assertEqual(self.box.metadata("assetInfo"), {"version": "1.2"})

    def test_of_properties_and_of_the_stage(self):
        self.box.set("mine", 1.0, type_name="double")
        self.box.set_metadata("documentation", "length", property="mine")
        self.box.set_metadata("customData", "m", property="mine", key="unit")
        self.assertEqual(self.box.metadata("documentation", "mine"), "length")
        self.assertEqual(self.box.metadata("customData", property="mine"), {"unit": "m"})
        self.stage.set_metadata("documentation", "a stage")
        self.stage.set_metadata("customLayerData", {"made": "here"})
        opened = self.saved()
        self.assertEqual(opened.metadata("documentation"), "a stage")
        self.assertEqual(opened.metadata("customLayerData"), {"made": "here"})

    def test_what_there_is_not(self):
        fix = self.refused("edit.unknown-metadata", tenon.InvalidError,
                           lambda: self.box.set_metadata("documentatoin", "x"))
        self.assertIn("did you mean documentation?", fix)
        self.refused("edit.type-mismatch", tenon.InvalidError,
                     lambda: self.box.set_metadata("active", "perhaps"))
        with self.assertRaises(TypeError):
            self.box.set_metadata("customData", {"a": object()})

    def test_types(self):
        self.box.set_type("Sphere")
        self.assertEqual(self.box.type_name, "Sphere")
        self.assertIn("Cube", self.refused("edit.unknown-type", tenon.InvalidError,
                                           lambda: self.box.set_type("Cubee")))


class Variants(AuthoringTestCase):
    def test_selected_and_authored(self):
        for name, size in (("small", 0.1), ("large", 5.0)):
            with self.stage.in_variant("/World/box", "size", name):
                self.box["size"] = size
                self.stage.define("/World/box/" + name, "Sphere")
        self.assertNotIn("/World/box/small", self.stage)
        self.box.select_variant("size", "small")
        self.assertEqual((self.box["size"], self.box.variants["size"][0]), (0.1, "small"))
        self.assertIn("/World/box/small", self.stage)
        self.stage.undo()
        self.assertNotIn("/World/box/small", self.stage)
        self.stage.redo()
        opened = self.saved()
        self.assertEqual(opened["/World/box"]["size"], 0.1)
        self.box.select_variant("size", None)
        self.assertEqual(self.box.variants["size"][0], "")
        self.assertIn("large", self.refused(
            "edit.no-variant", tenon.NotFoundError,
            lambda: self.box.select_variant("size", "lrage")))
        with self.stage.in_variant("/World/box", "size", "small"):
            self.refused("edit.outside-target", tenon.InvalidError,
                         lambda: self.stage.define("/World/other", "Cube"))
            self.refused("edit.outside-target", tenon.InvalidError, self.box.remove)

    def test_of_a_block(self):
        with self.stage.edits(), self.stage.in_variant("/World/box", "size", "small"):
            self.box["size"] = 0.1
            self.box.set_metadata("kind", "component")
        self.assertNotEqual(self.box["size"], 0.1)
        self.box.select_variant("size", "small")
        self.assertEqual((self.box["size"], self.box.metadata("kind")), (0.1, "component"))
        self.stage.undo()
        self.stage.undo()
        self.assertEqual(self.box.variants, {})

    def test_of_the_hand(self):
        """In an asset of files with roles the selection goes to its interface."""
        hand = self.copied_hand()
        stage = tenon.open(hand)
        (place,) = stage.default_prim.select_variant("Physics", "mujoco")
        self.assertEqual(Path(place["file"]).name, hand.name)
        stage.save()
        self.assertEqual(tenon.open(hand).default_prim.variants["Physics"][0], "mujoco")


class Arcs(AuthoringTestCase):
    def test_references_and_payloads(self):
        top = self.stage.define("/World/top", "")
        top.add_reference(self.part)
        self.assertEqual((top.type_name, top.get("size", 10)), ("Cube", 3))
        top.add_payload(self.part, "/Other", offset=5, scale=2)
        kinds = [(arc["kind"], Path(arc["file"]).name, arc["prim"], arc["offset"], arc["scale"])
                 for arc in top.arcs]
        self.assertEqual(kinds, [("reference", "part.usda", "", 0, 1),
                                 ("payload", "part.usda", "/Other", 5, 2)])
        top.remove_reference(self.part)
        self.assertEqual(top.type_name, "Sphere")
        top.add_reference(prim="/World/box", first=True)
        top.remove_payload(self.part, "/Other")
        self.assertEqual(top.type_name, "Cube")
        opened = self.saved()["/World/top"]
        self.assertEqual([arc["prim"] for arc in opened.arcs], ["/World/box"])
        self.refused("edit.no-spec", tenon.NotFoundError, lambda: top.remove_reference(self.part))
        with self.assertRaises(ValueError):
            top.add_reference()

    def test_classes(self):
        self.stage.define("/World/base", "Sphere")
        top = self.stage.define("/World/top", "")
        top.add_inherit("/World/base")
        self.assertEqual(top.type_name, "Sphere")
        top.remove_inherit("/World/base")
        top.add_specialize("/World/later")  # may be made later
        self.assertEqual([(arc["kind"], arc["prim"]) for arc in top.arcs],
                         [("specialize", "/World/later")])
        top.remove_specialize("/World/later")
        self.assertEqual(top.arcs, [])

    def test_what_leads_nowhere(self):
        top = self.stage.define("/World/top", "")
        for call in (lambda: top.add_reference(self.folder / "none.usda"),
                     lambda: self.stage.define("/World/x", reference=self.folder / "none.usda"),
                     lambda: top.add_payload(self.part, "/Othr"),
                     lambda: top.add_reference(prim="/World/bxo")):
            fix = self.refused("edit.no-target", tenon.NotFoundError, call)
        self.assertIn("did you mean /World/box?", fix)
        self.assertIn("/Other", self.refused("edit.no-target", tenon.NotFoundError,
                                             lambda: top.add_payload(self.part, "/Othr")))
        self.assertEqual(top.arcs, [])
        self.assertNotIn("/World/x", self.stage)


class Rest(AuthoringTestCase):
    def test_order(self):
        for name in "abc":
            self.stage.define("/World/" + name, "Cube")
        world = self.stage["/World"]
        world.reorder(["c", "a", "b"])
        self.assertEqual([one.name for one in world.children][-3:], ["c", "a", "b"])
        self.box.set("x", 1.0, type_name="double")
        self.box["size"] = 3.0
        self.box.reorder_properties(["x", "size"])
        self.assertEqual(self.box.authored, ["x", "size"])
        self.assertIn("mean a?", self.refused(
            "edit.no-prim", tenon.NotFoundError, lambda: world.reorder(["A"])))

    def test_connections(self):
        material = self.stage.define("/World/m", "Material")
        self.stage.define("/World/m/s", "Shader").set("outputs:surface", None, type_name="token")
        material.connect("outputs:surface", "/World/m/s.outputs:surface")
        self.assertEqual(self.saved()["/World/m"].connections("outputs:surface"),
                         ["/World/m/s.outputs:surface"])
        material.connect("outputs:surface", None)
        self.assertEqual(material.connections("outputs:surface"), [])


class Requests(AuthoringTestCase):
    def test_add_and_remove(self):
        box = self.stage.add("/World/b", "cube", "body", "collider", "mass", size=0.1,
                             at=(0, 0, 1), mass=2)
        hinge = self.stage.add("/World/hinge", "revolute", body1=box, axis="Z",
                               set={"physics:breakForce": 5.0})
        self.assertEqual((box["size"], box["physics:mass"], hinge["physics:axis"]), (0.1, 2, "Z"))
        self.assertEqual(hinge["physics:breakForce"], 5)
        self.stage.add("/World/hinge", "drive", stiffness=10, damping=1)
        self.assertTrue(hinge.has_api("PhysicsDriveAPI:angular"))
        self.stage.remove("/World/hinge", "drive")
        self.assertFalse(hinge.has_api("PhysicsDriveAPI:angular"))
        self.stage.remove("/World/b")
        self.assertFalse(box.exists or hinge.exists)
        self.assertTrue(self.stage.undo())
        self.assertTrue(box.exists and hinge.exists)
        with self.assertRaisesRegex(tenon.InvalidError, "cube"):
            self.stage.add("/World/c", "cubee")

    def test_an_option_that_is_a_word_of_python(self):
        self.stage.define("/World/lid", "Cube")
        self.stage.add("/World/box", "filtered-pair", with_="/World/lid")
        self.assertEqual(self.box["physics:filteredPairs"], ["/World/lid"])
        self.stage.remove("/World/box", "filtered-pair", with_="/World/lid")
        self.assertFalse(self.box.has_api("PhysicsFilteredPairsAPI"))

    def test_all_prims_that_a_pattern_means(self):
        lid = self.stage.define("/World/lid", "Cube")
        self.stage.define("/World/other", "Xform")
        changed = self.stage.add_matching("box|lid|other", "collider")
        self.assertEqual(changed, [self.box, lid])
        self.assertTrue(lid.has_api("PhysicsCollisionAPI"))
        self.refused("edit.no-prim", tenon.NotFoundError,  # they have it
                     lambda: self.stage.add_matching("box|lid", "collider"))
        fix = self.refused("edit.bad-argument", tenon.InvalidError,
                           lambda: self.stage.add_matching("box", "cube"))
        self.assertRegex(fix, r"call add\(\)")
        self.assertTrue(self.stage.undo())
        self.assertFalse(self.box.has_api("PhysicsCollisionAPI"))

    def test_messages_name_arguments(self):
        with self.assertRaisesRegex(tenon.InvalidError, r"^error: mass= heavy is not a mass"):
            self.stage.add("/World/box", "mass", mass="heavy")
        with self.assertRaisesRegex(tenon.InvalidError, r"with_= is not an option of scope"):
            self.stage.add("/World/s", "scope", with_="/World/box")
        with self.assertRaisesRegex(tenon.InvalidError, r"set_metadata\(\) takes timeCodes"):
            self.stage.set_metadata("metersPerUnits", 1)

    def test_another_file_than_the_one_that_owns_it(self):
        hand = self.copied_hand()
        stage = tenon.open(hand)
        joint = stage["/inspire_hand/Physics/right_index_1_joint"]
        for place in (*joint.apply("PhysxJointAPI", layer=hand.name),
                      *joint.add_targets("physics:body0", "/inspire_hand", layer=hand.name),
                      *stage.default_prim.add_variant("look", "red", layer=hand.name)):
            self.assertEqual(Path(place["file"]), hand)
        stage.define("/inspire_hand/eye", "Camera", layer=hand.name)
        self.assertEqual(stage.save(), [str(hand)])
        (place,) = stage[joint.path].apply("MjcJointAPI", engine="mujoco")
        self.assertEqual(Path(place["file"]).name, "mujoco.usda")

    def test_set(self):
        stage = tenon.open(self.copied_hand(), physics="physics")
        joint, palm = "/inspire_hand/Physics/right_index_1_joint", "/inspire_hand/r_base_link"
        places = stage.set(joint + ".physics:upperLimit=60", mass={palm: 0.5},
                           drive={joint: {"stiffness": 0.25, "damping": 0.125}})
        self.assertEqual(stage[joint]["drive:angular:physics:stiffness"], 0.25)
        self.assertEqual(stage[palm]["physics:mass"], 0.5)
        self.assertEqual(stage[joint]["physics:upperLimit"], 60)
        self.assertGreater(len(places), 3)
        self.assertTrue(stage.undo())
        self.assertFalse(stage.undo())  # one step
        stage.set(filter=[(palm, "/inspire_hand/right_index_2")])
        with self.assertRaisesRegex(TypeError, "maas"):
            stage.set(maas={})


if __name__ == "__main__":
    support.main()
