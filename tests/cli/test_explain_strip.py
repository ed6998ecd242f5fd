#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs that explain physics, take it out and mute it: what they say, and that nothing else of
an asset changes.

    test_explain_strip.py ROOT TENON
"""

import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
SCENES = ROOT / "tests/physics/scenes"
GOLDEN = ROOT / "tests/golden/physics"
PHYSICS = ("physics:", "isaac:physics:", "physx", "newton:", "mjc:", "drive:", "limit:", "state:",
           "material:binding:physics")

try:
    from pxr import Usd, UsdPhysics
except ImportError:
    Usd = None

CORNER = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "L" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"]
)
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [3, 2, 1, 0, 5, 4, 3, 0, 6, 7, 8, 9, 6, 9, 10, 11,
        0, 1, 7, 6, 1, 2, 8, 7, 2, 3, 9, 8, 3, 4, 10, 9, 4, 5, 11, 10, 5, 0, 6, 11]
    point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0),
        (0, 0, 1), (2, 0, 1), (2, 1, 1), (1, 1, 1), (1, 2, 1), (0, 2, 1)]
    uniform token physics:approximation = "convexDecomposition"
}
"""
STRONG = """#usda 1.0
(
    defaultPrim = "World"
    subLayers = [@./weak.usda@]
    upAxis = "Z"
    metersPerUnit = 1
)
over "World"
{
    over "Box"
    {
        float physics:mass = 2  # the box's own
    }
}
"""
WEAK = """#usda 1.0
(
    defaultPrim = "World"
    upAxis = "Z"
    metersPerUnit = 1
    kilogramsPerUnit = 1
)
def Xform "World"
{
    # what falls
    def Cube "Box" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
        customData = { string note = "keep" }
    )
    {
        double size = 1
        float physics:mass = 5
        custom double isaac:physics:Rot_X:DofOffset:op = 1
        custom string isaac:license = "MIT"
        color3f[] primvars:displayColor = [(1, 0, 0)]  # red
        rel material:binding:physics = </World/Ice>
    }
    def Cube "Floor" (
        prepend apiSchemas = ["PhysicsCollisionAPI"]
    )
    {
        double3 xformOp:translate = (0, 0, -9)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Material "Ice" (
        prepend apiSchemas = ["PhysicsMaterialAPI"]
    )
    {
        float physics:staticFriction = 0.1
    }
    def PhysicsScene "Scene"
    {
    }
    def PhysicsFixedJoint "Hold"
    {
        rel physics:body1 = </World/Box>
        def Sphere "Mark"
        {
        }
    }
    def Xform "Asset" (
        variants = { string Look = "plain" }
        prepend variantSets = "Look"
    )
    {
        variantSet "Look" = {
            "plain" {
                def PhysicsRevoluteJoint "J"
                {
                    rel physics:body0 = </World/Box>
                }
            }
            "fancy" {
                over "J"
                {
                    float physics:lowerLimit = 3
                }
            }
        }
    }
}
"""


def tenon(*arguments):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False)


class Base(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def layered(self):
        (self.folder / "strong.usda").write_text(STRONG)
        (self.folder / "weak.usda").write_text(WEAK)
        return self.folder / "strong.usda"

    def json(self, *arguments, code=0):
        process = tenon(*arguments, "--json")
        self.assertEqual(process.returncode, code, process.stderr + process.stdout)
        answer = json.loads(process.stdout)
        self.assertEqual(answer["schema"], f"tenon.{arguments[0]}/1")
        return answer


class Explain(Base):
    def test_opinions_stand_strongest_first_with_their_lines(self):
        answer = self.json("explain", self.layered(), "/World/Box.physics:mass")
        self.assertEqual(answer["value"], "2")
        found = [(pathlib.Path(o["file"]).name, o["line"], o["value"], o["used"])
                 for o in answer["opinions"]]
        self.assertEqual(found, [("strong.usda", 12, "2", True), ("weak.usda", 17, "5", False)])
        text = tenon("explain", self.layered(), "/World/Box.physics:mass").stdout
        self.assertIn("strong.usda:12:9  default 2", text)
        self.assertIn("(weaker)", text)

    def test_mass_names_what_it_beat(self):
        answer = self.json("explain", self.layered(), "/World/Box")
        account = answer["body"]["massProvenance"]
        masses = [(c["value"], c["used"], c["rule"]) for c in account["candidates"]
                  if c["quantity"] == "mass"]
        self.assertEqual(masses, [("2 kg", True, "S-39"), ("1000 kg", False, "S-39")])
        self.assertEqual(account["colliders"][0]["candidates"][0]["value"], "1000 kg/m^3")

    def test_meshes_are_taken_apart_as_for_the_other_verbs(self):
        corner = self.folder / "corner.usda"
        corner.write_text(CORNER)
        listed = self.json("physics", corner)
        explained = self.json("explain", corner, "/L")
        body, = listed["bodies"]
        self.assertEqual(explained["body"]["mass"], body["mass"])
        pieces = listed["colliders"][0].get("pieces")
        if not pieces:
            self.skipTest("no CoACD: the hull counts")
        self.assertAlmostEqual(body["mass"], 3000, delta=30)  # the hull has 3500 kg
        model = self.folder / "corner.xml"
        self.assertEqual(tenon("convert", corner, model).returncode, 0)
        colliders = [line for line in model.read_text().splitlines() if 'group="3"' in line]
        self.assertEqual(len(colliders), pieces)

    def test_density_chain_is_listed_whole(self):
        scene = GOLDEN / "density_chain/input.usda"
        account = self.json("explain", scene, "/W/B")["body"]["massProvenance"]
        densities = [(c["value"], c["used"]) for c in account["colliders"][0]["candidates"]]
        self.assertEqual(densities, [("500 kg/m^3", True), ("5000 kg/m^3", False),
                                     ("2000 kg/m^3", False), ("1000 kg/m^3", False)])

    def test_pair_names_group_pair_joint_and_switch(self):
        def reasons(scene, a, b):
            answer = self.json("explain", scene, a, b)
            self.assertFalse(answer["collide"])
            return {(r["rule"], r["prim"]) for row in answer["pairs"] for r in row["reasons"]}
        self.assertEqual(reasons(SCENES / "groups.usda", "/World/Low", "/World/High"),
                         {("S-77", "/World/Ghosts")})
        self.assertEqual(reasons(SCENES / "pairs.usda", "/World/Low", "/World/High"),
                         {("S-81", "/World/Low")})
        self.assertEqual(reasons(SCENES / "driven_turn.usda", "/World/Bar", "/World/Post"),
                         {("S-92", "/World/Turn")})
        free = self.json("explain", SCENES / "pairs.usda", "/World/Low", "/World/Slab")
        self.assertTrue(free["collide"])

    def test_joint_lists_frames_and_degrees_of_freedom(self):
        joint = self.json("explain", SCENES / "driven_turn.usda", "/World/Turn")["joint"]
        free = [row["dof"] for row in joint["dofs"] if not row["locked"]]
        self.assertEqual(free, ["rotZ"])
        self.assertIsNone(joint["side0"]["body"])
        self.assertEqual(joint["side1"]["body"], "/World/Bar")

    def scene(self, text):
        path = self.folder / "scene.usda"
        path.write_text("#usda 1.0\n(\n    metersPerUnit = 1\n)\n" + text)
        return path

    def test_a_spherical_joint_shows_both_cones(self):
        path = self.scene("""def Cube "B" (apiSchemas = ["PhysicsRigidBodyAPI"])
{
}
def PhysicsSphericalJoint "J"
{
    rel physics:body1 = </B>
    uniform token physics:axis = "Y"
    float physics:coneAngle0Limit = 20
}
""")
        cones = self.json("explain", path, "/J")["joint"]["cones"]
        self.assertEqual(cones["axis"], "Y")
        self.assertEqual([(side["axis"], side["property"]) for side in cones["toward"]],
                         [("Z", "physics:coneAngle0Limit"), ("X", "physics:coneAngle1Limit")])
        self.assertAlmostEqual(cones["toward"][0]["limit"], math.radians(20))
        self.assertIsNone(cones["toward"][1]["limit"])
        text = tenon("explain", path, "/J").stdout
        self.assertIn("the axis Y tilts toward Z by at most 20 deg", text)

    def test_mass_of_a_group_is_named_by_its_colliders(self):
        path = self.scene("""def Xform "B" (apiSchemas = ["PhysicsRigidBodyAPI"])
{
    def Xform "G" (apiSchemas = ["PhysicsMassAPI"])
    {
        float physics:mass = 6
        def Cube "C" (apiSchemas = ["PhysicsCollisionAPI"])
        {
        }
    }
}
""")
        mass = self.json("explain", path, "/B")["body"]["massProvenance"]
        first = mass["colliders"][0]["candidates"][0]
        self.assertEqual((first["prim"], first["property"], first["used"]),
                         ("/B/G", "physics:mass", True))

    def test_self_collision_names_the_layer_that_says_so(self):
        path = self.scene("""def Xform "R" (
    apiSchemas = ["PhysicsArticulationRootAPI", "PhysxArticulationAPI"]
)
{
    bool physxArticulation:enabledSelfCollisions = 0
    def Cube "A" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
    }
    def Cube "B" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
    }
    def PhysicsRevoluteJoint "J"
    {
        rel physics:body0 = </R/A>
        rel physics:body1 = </R/B>
        bool physics:collisionEnabled = 1
    }
}
""")
        reasons = self.json("explain", path, "/R/A", "/R/B")["pairs"][0]["reasons"]
        own = [reason for reason in reasons if reason["rule"] == "S-115"]
        self.assertEqual(own[0]["property"], "physxArticulation:enabledSelfCollisions")
        self.assertEqual(own[0]["opinions"][0]["line"], 9)

    def test_binding_says_where_it_comes_from(self):
        collider = self.json("explain", self.layered(), "/World/Box")["collider"]
        self.assertEqual(collider["binding"]["material"], "/World/Ice")
        self.assertEqual(collider["binding"]["opinions"][0]["line"], 21)

    def test_unknown_objects_are_2(self):
        for name in ("/Nowhere", "/World/Box.nothing"):
            self.assertEqual(tenon("explain", self.layered(), name).returncode, 2, name)

    def test_mass_table_has_a_reason_for_every_body(self):
        masses = self.json("physics", HAND, "--physics", "physx", "--mass")["masses"]
        self.assertEqual(len(masses), 13)
        for row in masses:
            self.assertTrue(all(row["reason"].values()), row)


def without_physics(dump):
    """A stage's dump less everything that is physics."""
    prims = []
    for prim in dump["prims"]:
        if prim["type"].startswith("Physics") and not prim["path"].endswith("Hold"):
            continue
        prims.append((prim["path"], "" if prim["type"].startswith("Physics") else prim["type"],
                      [p for p in prim.get("properties", {}) if not p.startswith(PHYSICS)]))
    return prims


class Strip(Base):
    def test_in_place_keeps_every_other_line(self):
        asset = self.layered()
        answer = self.json("strip", asset, "--in-place")
        self.assertEqual(len(answer["layers"]), 2)
        kept = (self.folder / "weak.usda").read_text()
        for line in ('    # what falls', '        customData = { string note = "keep" }',
                     '        color3f[] primvars:displayColor = [(1, 0, 0)]  # red'):
            self.assertIn(line + "\n", kept)
        for word in ("physics:", "Physics", "lowerLimit", "kilogramsPerUnit"):
            self.assertNotIn(word, kept)
            self.assertNotIn(word, asset.read_text())
        self.assertIn('def Sphere "Mark"', kept)
        self.assertIn('isaac:license = "MIT"', kept)
        again = self.json("strip", asset, "--in-place")
        self.assertEqual((again["prims"], again["apiSchemas"], again["properties"]), (0, 0, 0))

    def test_output_leaves_the_asset_alone_and_composes_alike(self):
        asset = self.layered()
        before = {p: p.read_bytes() for p in self.folder.iterdir()}
        other = self.folder / "out"
        other.mkdir()
        self.json("strip", asset, "-o", other / "visual.usda")
        self.assertEqual(before, {p: p.read_bytes() for p in before})
        counts = self.json("info", other / "visual.usda")["physics"]
        self.assertEqual((counts["bodies"], counts["colliders"], counts["scenes"]), (0, 0, 0))
        flat = tenon("cat", "--flatten", other / "visual.usda").stdout
        self.assertIn('"keep"', flat)
        self.assertIn("displayColor", flat)

    def test_a_folder_takes_the_asset_with_its_layers(self):
        asset = self.layered()
        before = {p: p.read_bytes() for p in self.folder.iterdir()}
        other = self.folder / "bare"
        self.json("strip", asset, "-o", other)
        self.assertEqual({p.name for p in other.iterdir()}, {asset.name, "weak.usda"})
        self.assertEqual(before, {p: p.read_bytes() for p in before})
        counts = self.json("info", other / asset.name)["physics"]
        self.assertEqual((counts["bodies"], counts["colliders"], counts["scenes"]), (0, 0, 0))
        for options in ([], ["--mute"]):
            own = tenon("strip", asset, "-o", self.folder, *options)
            self.assertEqual(own.returncode, 2)
            self.assertIn("--in-place", own.stderr)
        self.assertEqual(before, {p: p.read_bytes() for p in before})

    def test_standard_output_takes_one_layer(self):
        asset = self.layered()
        process = tenon("strip", asset, "-o", "-")
        self.assertEqual(process.returncode, 2)  # the layer below holds physics, too
        self.assertIn("weak.usda", process.stderr)
        self.assertEqual(process.stdout, "")
        process = tenon("strip", self.folder / "weak.usda", "-o", "-", "--json")
        self.assertEqual(process.returncode, 0, process.stderr)
        self.json("strip", self.folder / "weak.usda", "-o", self.folder / "visual.usda")
        self.assertTrue(process.stdout.startswith("#usda 1.0"))
        (self.folder / "printed.usda").write_text(process.stdout)
        (self.folder / "copied.usda").write_text((self.folder / "visual.usda").read_text())
        printed, copied = (tenon("cat", self.folder / name).stdout
                           for name in ("printed.usda", "copied.usda"))
        self.assertEqual(printed, copied)
        self.assertNotIn("physics:", printed)

    def test_hand_loses_physics_under_every_variant_and_keeps_its_looks(self):
        out = self.folder / "visual.usda"
        self.json("strip", HAND, "-o", out)
        for variant in ("physics", "physx", "mujoco", "none"):
            counts = self.json("info", out, "--physics", variant)["physics"]
            self.assertEqual((counts["bodies"], counts["colliders"]), (0, 0), variant)
            after = self.shapes(out, variant)
            self.assertEqual(after, self.shapes(HAND, variant), variant)

    @staticmethod
    def shapes(asset, variant):
        """Meshes and their points of the flattened stage."""
        text = tenon("cat", "--flatten", asset, "--physics", variant).stdout
        return sorted(line.strip() for line in text.splitlines()
                      if "point3f[] points" in line or "matrix4d xformOp" in line)

    @unittest.skipIf(Usd is None, "no OpenUSD modules in this Python")
    def test_openusd_finds_nothing_and_all_else(self):
        asset = self.layered()
        out = self.folder / "visual.usda"
        self.json("strip", asset, "-o", out)
        stage, old = Usd.Stage.Open(str(out)), Usd.Stage.Open(str(asset))
        found = UsdPhysics.LoadUsdPhysicsFromRange(stage, ["/"])
        self.assertEqual(sum(len(rows[0]) for rows in found.values()), 0)
        for prim in old.TraverseAll():
            if prim.GetTypeName().startswith("Physics") and prim.GetName() != "Hold":
                continue
            left = stage.GetPrimAtPath(prim.GetPath())
            self.assertTrue(left, prim.GetPath())
            wanted = {p.GetName(): str(p.Get() if hasattr(p, "Get") else p.GetTargets())
                      for p in prim.GetAuthoredProperties()
                      if not p.GetName().startswith(PHYSICS)}
            self.assertEqual(wanted, {p.GetName(): str(p.Get() if hasattr(p, "Get")
                                                       else p.GetTargets())
                                      for p in left.GetAuthoredProperties()})


    def test_layers_that_composition_finds_are_found(self):
        """By the folder of the asset's root layer, whichever layer names them."""
        files = {"root.usda": ('defaultPrim = "A"', 'def "A" (references = @./sub/part.usda@</P>) '
                                                    '{ }'),
                 "sub/part.usda": ("", 'def Xform "P" (references = @body.usda@</B>) { }'),
                 "body.usda": ("", 'def Cube "B" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) '
                                   '{ }')}
        for name, (head, text) in files.items():
            (self.folder / name).parent.mkdir(exist_ok=True)
            (self.folder / name).write_text(f"#usda 1.0\n(\n{head}\n)\n{text}\n")
        self.json("strip", self.folder / "root.usda", "--in-place")
        self.assertNotIn("Physics", (self.folder / "body.usda").read_text())

    def test_what_is_missing_is_told_once(self):
        asset = self.folder / "a.usda"
        asset.write_text('#usda 1.0\ndef Xform "A" (payload = @./gone.usda@</X>) { }\n'
                         'def Xform "B" (references = @./there.usda@</X>) { }\n')
        (self.folder / "there.usda").write_text('#usda 1.0\ndef Xform "X" { }\n')
        for arguments in (["strip", asset, "-o", self.folder / "s.usda"],
                          ["set", asset, "/A.visibility=invisible"]):
            answer = self.json(*arguments, code=1)
            rules = [d["rule"] for d in answer["diagnostics"]]
            self.assertEqual(rules.count("compose.invalid-asset-path"), 1, arguments)


class Mute(Base):
    def test_overlay_switches_off_and_the_asset_stays(self):
        asset = self.layered()
        before = {p: p.read_bytes() for p in self.folder.iterdir()}
        out = self.folder / "muted.usda"
        answer = self.json("strip", asset, "--mute", "-o", out)
        self.assertEqual((answer["bodies"], answer["colliders"], answer["joints"]), (1, 2, 2))
        self.assertEqual(before, {p: p.read_bytes() for p in before})
        muted = self.json("physics", out)
        self.assertEqual(muted["bodies"], [])
        self.assertFalse(any(c["enabled"] for c in muted["colliders"]))
        # Back: without the overlay the asset says what it said.
        self.assertEqual(len(self.json("physics", asset)["bodies"]), 1)

    def test_a_folder_takes_the_overlay_by_the_name_of_the_asset(self):
        asset = self.layered()
        self.json("strip", asset, "--mute", "-o", f"{self.folder}/muted/")
        muted = self.json("physics", self.folder / "muted" / asset.name)
        self.assertEqual(muted["bodies"], [])

    def test_in_place_adds_flags_only(self):
        asset = self.layered()
        self.json("strip", asset, "--mute", "--in-place")
        text = asset.read_text()
        self.assertIn("float physics:mass = 2  # the box's own\n", text)
        self.assertIn("bool physics:rigidBodyEnabled = 0", text)
        again = self.json("strip", asset, "--mute", "--in-place")
        self.assertEqual((again["bodies"], again["colliders"], again["joints"]), (0, 0, 0))

    def test_a_place_is_needed(self):
        self.assertEqual(tenon("strip", self.layered()).returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
