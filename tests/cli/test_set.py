#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon set: each edit in the file that owns it, nothing else changed, and proved.

    test_set.py ROOT TENON CLASS...

The hand of ../shared joins in where it is there.
"""

import difflib
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT.parent / "shared"))
ISAAC = SHARED / "assets/inspire_hand_isaac/inspire_hand.usda"
R = "/inspire_hand"
JOINT = f"{R}/Physics/right_thumb_1_joint"
FOLLOWER = f"{R}/Physics/right_thumb_4_joint"
COLLIDER = f"{R}/r_base_link/r_base_link_1/r_base_link"
PHYSICS, PHYSX = "payloads/Physics/physics.usda", "payloads/Physics/physx.usda"
MUJOCO = "payloads/Physics/mujoco.usda"


def tenon(*arguments, cwd=None):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False, cwd=cwd)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.take(HAND)

    def take(self, asset):
        self.home = self.folder / asset.parent.name
        shutil.copytree(asset.parent, self.home)
        for path in self.home.rglob("*"):
            path.chmod(0o755 if path.is_dir() else 0o644)
        self.hand = self.home / asset.name
        self.original = self.files()

    def files(self):
        return {str(path.relative_to(self.home)): path.read_bytes()
                for path in self.home.rglob("*") if path.is_file()}

    def changed(self):
        """File -> lines that went and came."""
        lines = {}
        for name, data in self.files().items():
            before = self.original[name]
            if data != before:
                lines[name] = [line for line in difflib.ndiff(before.decode().splitlines(),
                                                              data.decode().splitlines())
                               if line[0] in "+-"]
        return lines

    def set(self, *arguments, code=0):
        process = tenon("set", self.hand, *arguments, "--json")
        self.assertEqual(process.returncode, code, process.stdout + process.stderr)
        return json.loads(process.stdout)

    def refused(self, *arguments):
        answer = self.set(*arguments, code=2)
        self.assertEqual(self.files(), self.original)
        finding = answer["diagnostics"][-1]
        return f"{finding['file']} {finding['message']} {finding['fix']} [{finding['rule']}]"

    def value(self, path, variant="physics"):
        process = tenon("where", self.hand, path, "--physics", variant, "--json")
        return json.loads(process.stdout)["value"]


class Edits(Case):
    def test_each_property_lands_in_its_file(self):
        for path, value, file in (
                (f"{JOINT}.physics:upperLimit", "60", PHYSICS),
                (f"{JOINT}.drive:angular:physics:stiffness", "0.25", PHYSICS),
                (f"{R}/r_base_link.physics:mass", "0.4", PHYSICS),
                (f"{FOLLOWER}.physxMimicJoint:rotX:naturalFrequency", "25", PHYSX),
                (f"{FOLLOWER}.physxMimicJoint:rotX:dampingRatio", "0.005", PHYSX),
                (f"{R}.isaac:license", "MIT", "payloads/robot.usda"),
                (f"{R}/right_thumb_1.xformOp:translate", "(1, 2, 3)", "payloads/base.usda"),
                (f"{COLLIDER}.physics:approximation", "convexDecomposition",
                 "payloads/instances.usda")):
            answer = self.set(f"{path}={value}")
            changed = self.changed()
            self.assertEqual(list(changed), [file], path)
            self.assertEqual([line[0] for line in changed[file]], ["-", "+"], changed)
            self.assertIn(value, changed[file][1])
            place = answer["edits"][0]
            self.assertTrue(place["file"].endswith(file))
            line = (self.home / file).read_text().splitlines()[place["line"] - 1]
            self.assertEqual("+ " + line, changed[file][1])
            self.assertEqual(self.value(path, "physx").strip('"'), value)
            (self.home / file).write_bytes(self.original[file])

    def test_a_value_that_is_new_is_made_with_the_type_of_the_schema(self):
        answer = self.set(f"{JOINT}.physics:breakForce=12.5")
        self.assertEqual(self.changed()[PHYSICS], ["+             float physics:breakForce = 12.5"])
        self.assertEqual(answer["edits"][0]["variants"], ["physics", "mujoco", "physx"])

    def test_several_edits_at_once_and_comments_stay(self):
        path = self.home / PHYSICS
        text = path.read_text().replace("def PhysicsRevoluteJoint \"right_thumb_1_joint\"",
                                        "# mine\n        def PhysicsRevoluteJoint "
                                        "\"right_thumb_1_joint\"", 1)
        path.write_text(text)
        self.original = self.files()
        self.set(f"{JOINT}.physics:upperLimit=60", f"{JOINT}.physics:lowerLimit=-5",
                 f"{FOLLOWER}.physxMimicJoint:rotX:offset=0.2")
        changed = self.changed()
        self.assertEqual({name: len(lines) for name, lines in changed.items()},
                         {PHYSICS: 4, PHYSX: 2})
        self.assertIn("# mine", path.read_text())

    def test_a_dry_run_shows_what_patch_applies(self):
        process = tenon("set", self.hand.name, f"{JOINT}.physics:upperLimit=60", "--dry-run",
                        cwd=self.home)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(self.files(), self.original)
        self.assertIn("-            float physics:upperLimit = 75\n"
                      "+            float physics:upperLimit = 60\n", process.stdout)
        patch = subprocess.run(["patch", "-p1", "-s"], cwd=self.home, input=process.stdout,
                               text=True, check=False) if shutil.which("patch") else None
        if patch is not None:
            self.assertEqual(patch.returncode, 0)
            self.assertEqual(self.value(f"{JOINT}.physics:upperLimit"), "60")

    def test_an_engine_has_values_of_its_own(self):
        path = f"{JOINT}.physics:upperLimit"
        answer = self.set("--engine", "mujoco", f"{path}=55")
        self.assertEqual(list(self.changed()), [MUJOCO])
        self.assertEqual(answer["edits"][0]["variants"], ["mujoco"])
        self.assertEqual(self.value(path, "mujoco"), "55")
        self.assertEqual(self.value(path, "physx"), "75")
        # The neutral value goes to its file and does not count where the engine has its own.
        answer = self.set(f"{path}=60")
        self.assertEqual([d["rule"] for d in answer["diagnostics"]], ["edit.hidden-in-variant"])
        self.assertEqual((self.value(path), self.value(path, "mujoco")), ("60", "55"))

    def test_a_value_that_would_not_count_is_refused(self):
        path = f"{JOINT}.physics:upperLimit"
        self.set("--engine", "mujoco", f"{path}=55")
        self.original = self.files()
        text = self.refused("--physics", "mujoco", f"{path}=60")
        self.assertIn("mujoco.usda", text)
        self.assertIn("edit.hidden", text)


class Refusals(Case):
    def test_what_cannot_be_is_refused_with_a_way_out(self):
        for arguments, words in (
                ((f"{JOINT}.physics:uperLimit=1",), "did you mean physics:upperLimit?"),
                ((f"{JOINT}.physics:upperLimit=high",), "not a value of type float"),
                ((f"{JOINT}.physics:axis=W",), "choose one of: X, Y, Z"),
                ((f"{R}/nowhere.physics:mass=1",), "no prim"),
                ((f"{JOINT}.physics:mass=1",), "PhysicsMassAPI"),
                ((f"{R}.notknown=1",), "--type"),
                (("--engine", "mujoco", f"{COLLIDER}.physics:approximation=none"),
                 "inside an instance"),
                (("--engine", "havok", f"{JOINT}.physics:upperLimit=1"), "no file for havok"),
                (("--engine", "mujoco", f"{FOLLOWER}.physxMimicJoint:rotX:offset=1"),
                 "nothing that mujoco reads"),
                (("--in", "nosuch.usda", f"{JOINT}.physics:upperLimit=1"), "choose one of"),
                (("--apply", f"{R}/r_base_link=PhysicsMassApi"), "did you mean PhysicsMassAPI?"),
                (("--apply", f"{JOINT}=PhysicsDriveAPI"), "PhysicsDriveAPI:angular"),
                (("nonsense",), "PATH.attribute=VALUE")):
            self.assertIn(words, self.refused(*arguments), arguments)

    def test_all_or_nothing(self):
        self.assertIn("no prim", self.refused(f"{JOINT}.physics:upperLimit=60",
                                              f"{R}/nowhere.physics:mass=1"))

    def test_files_in_a_package_are_not_changed(self):
        package = self.folder / "hand.usdz"
        tenon("zip", self.hand, "-o", package)
        before = package.read_bytes()
        process = tenon("set", package, f"{JOINT}.physics:upperLimit=60")
        self.assertEqual(process.returncode, 2)
        self.assertIn("--extract", process.stderr)
        self.assertEqual(package.read_bytes(), before)


class Kinds(Case):
    def test_a_file_can_be_forced(self):
        self.set("--in", "inspire_hand.usda", f"{JOINT}.physics:upperLimit=50")
        self.assertEqual(list(self.changed()), ["inspire_hand.usda"])
        self.assertEqual(self.value(f"{JOINT}.physics:upperLimit"), "50")

    def test_schemas_are_applied_and_removed_in_the_file_that_owns_them(self):
        self.set("--apply", f"{R}/r_base_link=PhysxRigidBodyAPI",
                 f"{R}/r_base_link.physxRigidBody:linearDamping=0.1")
        self.assertEqual(list(self.changed()), [PHYSX])
        self.set("--remove", f"{R}/r_base_link=PhysxRigidBodyAPI",
                 "--clear", f"{R}/r_base_link.physxRigidBody:linearDamping")
        rows = json.loads(tenon("where", self.hand, f"{R}/r_base_link", "--physics", "physx",
                                "--json").stdout)["opinions"]
        self.assertNotIn("PhysxRigidBodyAPI", json.dumps(rows))

    def test_relationships_are_set_in_the_namespace_of_their_file(self):
        self.set(f"{FOLLOWER}.physxMimicJoint:rotX:referenceJoint={JOINT}")
        self.assertEqual(list(self.changed()), [PHYSX])
        self.assertEqual(self.value(f"{FOLLOWER}.physxMimicJoint:rotX:referenceJoint", "physx"),
                         [JOINT])

    def test_typed_edits(self):
        self.set("--mass", f"{R}/r_base_link=0.5", "--drive", f"{JOINT}=stiffness:2,damping:0.1",
                 "--collider", f"{COLLIDER}=boundingCube",
                 "--mimic", f"{FOLLOWER}={JOINT},0.5,2")
        self.assertEqual(set(self.changed()), {PHYSICS, "payloads/instances.usda"})
        for path, value in ((f"{R}/r_base_link.physics:mass", "0.5"),
                            (f"{JOINT}.drive:angular:physics:stiffness", "2"),
                            (f"{COLLIDER}.physics:approximation", '"boundingCube"'),
                            (f"{FOLLOWER}.newton:mimicCoef1", "0.5"),
                            (f"{FOLLOWER}.newton:mimicCoef0", "2"),
                            (f"{FOLLOWER}.newton:mimicJoint", [JOINT])):
            self.assertEqual(self.value(path), value, path)
        self.set("--engine", "physx", "--mimic", f"{FOLLOWER}={JOINT},0.5,2")
        self.assertEqual(self.value(f"{FOLLOWER}.physxMimicJoint:rotX:gearing", "physx"), "-0.5")

    def test_a_joint_that_one_engine_alone_has(self):
        self.hand.write_text('''#usda 1.0
(
    defaultPrim = "R"
)

def Xform "R" (
    variants = {
        string Physics = "none"
    }
    append variantSets = "Physics"
)
{
    variantSet "Physics" = {
        "newton" {
            def Xform "a" (
                prepend apiSchemas = ["PhysicsRigidBodyAPI"]
            )
            {
            }

            def PhysicsRevoluteJoint "j"
            {
                rel physics:body1 = </R/a>
            }
        }
        "none" {
        }
    }
}
''', encoding="utf-8")
        self.set("--drive", "/R/j=stiffness:3")
        self.assertEqual(self.value("/R/j.drive:angular:physics:stiffness", "newton"), "3")

    def test_a_material_is_bound_within_what_instances_share(self):
        instances, binding = self.home / "payloads/instances.usda", (
            "            rel material:binding:physics = "
            "</Instances/r_base_link_1/Materials/Rubber_Contact>")
        instances.write_text(instances.read_text().replace(binding + "\n", ""))
        self.original = self.files()
        link = f"{R}/r_base_link/r_base_link_1"
        self.set("--material", f"{COLLIDER}={link}/Materials/Rubber_Contact")
        self.assertEqual(self.changed(), {"payloads/instances.usda": ["+ " + binding]})
        self.assertEqual(self.value(f"{COLLIDER}.material:binding:physics"),
                         [f"{link}/Materials/Rubber_Contact"])
        self.original = self.files()
        self.assertIn("cannot be named in this file",
                      self.refused("--material", f"{COLLIDER}={R}/elsewhere"))

    def test_an_asset_without_the_structure(self):
        weak = self.folder / "weak.usdc"
        text = self.folder / "weak.usda"
        text.write_text('#usda 1.0\n(\n    defaultPrim = "A"\n)\ndef Cube "A"\n{\n'
                        '    double size = 1\n}\n')
        tenon("cat", text, "-o", weak)
        root = self.folder / "root.usda"
        root.write_text('#usda 1.0\n# kept\n(\n    subLayers = [@./weak.usdc@]\n)\n')
        process = tenon("set", root, "/A.size=3", "/A.visibility=invisible", "--json")
        self.assertEqual(process.returncode, 0, process.stderr)
        edits = json.loads(process.stdout)["edits"]
        self.assertTrue(edits[0]["file"].endswith("weak.usdc"))
        self.assertIn("strongest opinion", edits[0]["why"])
        self.assertTrue(edits[1]["file"].endswith("root.usda"))
        self.assertEqual(weak.read_bytes()[:8], b"PXR-USDC")
        self.assertIn("double size = 3", tenon("cat", weak).stdout)
        self.assertIn("# kept", root.read_text())

    def test_the_hand_of_isaacs_own_pipeline(self):
        if not ISAAC.exists():
            self.skipTest(f"{ISAAC} does not exist")
        self.take(ISAAC)
        joint = "/Lhand/Physics/R_thumb_proximal_yaw_joint"
        link = "/Lhand/Geometry/right_wrist_yaw_link/R_hand_base_link"
        for arguments, file in (
                ((f"{joint}.physics:upperLimit=60",), PHYSICS),
                (("--engine", "physx", f"{joint}.drive:angular:physics:damping=1"), PHYSX),
                ((f"{joint}.physxJoint:armature=0.01",), PHYSX),
                ((f"{link}/R_hand_base_link_1/R_hand_base_link.physics:approximation=none",),
                 "payloads/instances.usda"),
                (("--mass", f"{link}=0.2"), PHYSICS),
                ((f"{link}.xformOp:translate=(0.05, 0, 0)",), "payloads/base.usda")):
            self.set(*arguments)
            self.assertEqual(list(self.changed()), [file], arguments)
            (self.home / file).write_bytes(self.original[file])
    def test_an_engine_without_a_layer_gets_one(self):
        path = f"{JOINT}.physics:upperLimit"
        dry = self.set("--engine", "newton", f"{path}=50", "--dry-run")
        self.assertEqual(self.files(), self.original)
        self.assertEqual(len(dry["files"]), 2)
        answer = self.set("--engine", "newton", f"{path}=50")
        self.assertEqual(answer["edits"][0]["variants"], ["newton"])
        new = set(self.files()) - set(self.original)
        self.assertEqual(new, {"payloads/Physics/newton.usda"})
        for name, data in self.original.items():
            self.assertEqual(self.files()[name] == data, name != "inspire_hand.usda", name)
        self.assertEqual((self.value(path, "newton"), self.value(path)), ("50", "75"))
        check = tenon("check", self.hand, "--profile", "isaac-3.0", "--json")
        self.assertEqual(check.returncode, 0, check.stdout)
        self.set("--engine", "newton", f"{path}=51")
        self.assertEqual(self.value(path, "newton"), "51")

    def test_a_layer_for_an_engine_can_be_made_without_an_edit(self):
        self.assertEqual(len(self.set("--engine", "newton")["files"]), 2)
        process = tenon("structure", self.hand, "-o", self.folder / "again")
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertTrue((self.folder / "again/payloads/Physics/newton.usda").exists())

    def test_a_layer_that_no_variant_loads_is_taken(self):
        (self.home / "payloads/Physics/newton.usda").write_text(
            (self.home / MUJOCO).read_text().split("over ")[0])
        self.set("--engine", "newton", f"{JOINT}.physics:upperLimit=50")
        self.assertIn("MuJoCo only", (self.home / "payloads/Physics/newton.usda").read_text())
        self.assertEqual(self.value(f"{JOINT}.physics:upperLimit", "newton"), "50")


ACTUATED = """#usda 1.0
(
    defaultPrim = "R"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "R" ( prepend apiSchemas = ["PhysicsArticulationRootAPI"] )
{
    def Cube "a" ( prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"] )
    {
        double size = 0.1
        float physics:mass = 1
    }
    def Cube "b" ( prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"] )
    {
        double size = 0.1
        float physics:mass = 1
    }
    def PhysicsRevoluteJoint "j" ( prepend apiSchemas = ["PhysicsDriveAPI:angular"] )
    {
        rel physics:body0 = </R/a>
        rel physics:body1 = </R/b>
        uniform token physics:axis = "Z"
        float drive:angular:physics:stiffness = 1
        float drive:angular:physics:damping = 0.1
    }
    def MjcActuator "act"
    {
        uniform double[] mjc:biasPrm = [0, -2, -0.1]
        uniform token mjc:biasType = "affine"
        uniform double[] mjc:gainPrm = [2]
        uniform token mjc:gainType = "fixed"
        rel mjc:target = </R/j>
    }
}
"""


class Effects(Case):
    """What engines receive before and after, under every variant."""

    def take_text(self, text):
        self.home = self.folder / "plain"
        self.home.mkdir()
        self.hand = self.home / "a.usda"
        self.hand.write_text(text)
        self.original = self.files()

    def vain(self, *arguments):
        answer = self.set(*arguments, code=1)
        self.assertEqual(self.files(), self.original)
        self.assertFalse(answer["ok"])
        findings = [d for d in answer["diagnostics"] if d["rule"] == "edit.no-effect"]
        self.assertTrue(findings, answer["diagnostics"])
        return f"{findings[0]['message']}; {findings[0]['fix']}"

    @staticmethod
    def effect(answer):
        """Variant -> object, what, before, after."""
        return {one["variant"]: [(row["path"], row["what"], row["before"], row["after"])
                                 for row in one["differences"]] for one in answer["physics"]}

    def test_old_and_new_are_told_under_every_variant(self):
        effect = self.effect(self.set("--mass", f"{R}/right_thumb_1=0.25"))
        self.assertEqual(set(effect), {"physics", "physx", "mujoco", "none"})
        self.assertEqual(effect["none"], [])
        for variant in ("physics", "physx", "mujoco"):
            (path, what, _, after), = effect[variant]
            self.assertEqual((path, what, after), (f"{R}/right_thumb_1", "mass", 0.25))
        text = tenon("set", self.hand, "--mass", f"{R}/right_thumb_1=0.5").stdout
        self.assertIn(f"body {R}/right_thumb_1  mass 0.25 kg -> 0.5 kg  "
                      "(Physics=physics, mujoco, physx)", text)

    def test_an_actuator_that_replaces_the_drive_is_told(self):
        answer = self.set("--drive", f"{JOINT}=stiffness:3")
        effect = self.effect(answer)
        self.assertEqual([row[1] for row in effect["physx"]], ["drive rotZ stiffness"])
        self.assertEqual(effect["mujoco"], [])
        self.assertEqual(answer["edits"][0]["variants"], ["physics", "physx"])
        finding, = [d for d in answer["diagnostics"] if d["rule"] == "edit.no-effect-in-variant"]
        self.assertIn("under Physics=mujoco", finding["message"])
        self.assertIn(f"{R}/Physics/right_thumb_1_actuator", finding["message"])
        self.assertIn("--all-engines", finding["fix"])

    def test_a_mimic_that_another_schema_says_as_well_is_told(self):
        answer = self.set("--mimic", f"{FOLLOWER}={JOINT},0.5,2")
        self.assertEqual(answer["edits"][0]["variants"], ["physics", "mujoco"])
        finding, = [d for d in answer["diagnostics"] if d["rule"] == "edit.no-effect-in-variant"]
        self.assertIn("PhysxMimicJointAPI counts", finding["message"])

    def test_all_engines_edits_each_form(self):
        self.take_text(ACTUATED)
        answer = self.set("--drive", "/R/j=stiffness:3,damping:0.5,maxForce:7", "--all-engines")
        effect = {row[1]: row[3] for row in self.effect(answer)[None]}
        self.assertEqual(list(effect), ["drive rotZ stiffness", "drive rotZ damping",
                                        "drive rotZ maximum force"])
        for got, want in zip(effect.values(), (540 / math.pi, 90 / math.pi, 7)):
            self.assertAlmostEqual(got, want, 12)
        # The gain of the control and the stiffness stay the same number.
        self.assertEqual(self.value("/R/act.mjc:gainPrm"), "[171.88733853924697]")

    def test_all_engines_edits_the_file_of_each(self):
        effect = self.effect(self.set("--drive", f"{JOINT}=stiffness:0.2", "--all-engines"))
        self.assertEqual(set(self.changed()), {PHYSICS, MUJOCO})
        for variant in ("physics", "physx", "mujoco"):
            self.assertAlmostEqual(effect[variant][0][3], 36 / math.pi, 6)

    def test_all_engines_edits_each_schema_of_a_mimic(self):
        answer = self.set("--mimic", f"{FOLLOWER}={JOINT},0.5,2", "--all-engines")
        self.assertEqual(set(self.changed()), {PHYSICS, PHYSX})
        self.assertEqual([d for d in answer["diagnostics"] if d["severity"] == "warning"
                          and d["rule"].startswith("edit.")], [])
        effect = self.effect(answer)
        self.assertEqual([row[2:] for row in effect["physx"]],
                         [row[2:] for row in effect["mujoco"]])
        self.assertEqual(self.value(f"{FOLLOWER}.physxMimicJoint:rotX:gearing", "physx"), "-0.5")

    def test_all_engines_edits_what_an_engine_has_of_its_own(self):
        path = f"{JOINT}.physics:upperLimit"
        self.set("--engine", "mujoco", f"{path}=55")
        answer = self.set(f"{path}=60", "--all-engines")
        self.assertNotIn("edit.hidden-in-variant", {d["rule"] for d in answer["diagnostics"]})
        self.assertEqual((self.value(path), self.value(path, "mujoco")), ("60", "60"))
        answer = self.set(f"{path}=61", "--all-engines", "--engine", "mujoco", code=2)
        self.assertEqual(answer["diagnostics"][-1]["rule"], "usage.conflict")

    def test_pairs_are_filtered(self):
        one, other = f"{R}/right_thumb_4", f"{R}/right_index_2"
        effect = self.effect(self.set("--filter", f"{one},{other}"))
        self.assertEqual(set(self.changed()), {PHYSICS})
        self.assertEqual(self.value(f"{one}.physics:filteredPairs"), [other])
        self.assertEqual(len(effect["physx"]), 3)
        self.original = self.files()
        # Links of one joint do not touch anyway.
        self.assertIn("could touch", self.vain("--filter", f"{one},{R}/right_thumb_3"))

    def test_lists_are_added_to_and_taken_from(self):
        one = f"{R}/right_thumb_4"
        pairs = f"{one}.physics:filteredPairs"
        self.set("--filter", f"{one},{R}/right_index_2", f"{pairs}+={R}/right_ring_2")
        self.assertEqual(self.value(pairs), [f"{R}/right_index_2", f"{R}/right_ring_2"])
        effect = self.effect(self.set(f"{pairs}-={R}/right_index_2"))
        self.assertEqual(self.value(pairs), [f"{R}/right_ring_2"])
        self.assertEqual(len(effect["physics"]), 3)
        self.original = self.files()
        self.assertIn("is not a relationship", self.refused(f"{JOINT}.physics:upperLimit+=5"))

    def test_many_edits_at_once_are_judged_one_by_one(self):
        scene = json.loads(tenon("physics", self.hand, "--json").stdout)
        joints = [row["path"] for row in scene["joints"] if row["type"] != "fixed"]
        bodies = [row["path"] for row in scene["bodies"]]
        edits = [f"{path}.{edit}" for path in joints for edit in (
            "physics:upperLimit=65", "physics:lowerLimit=-3", "physics:breakForce=1e5",
            "physics:breakTorque=1e4", "physics:collisionEnabled=true",
            "physics:localPos0=(0.01, 0, 0)", "physics:localPos1=(0, 0.01, 0)")]
        edits += [f"{path}.{edit}" for path in bodies for edit in (
            "physics:mass=0.07", "physics:velocity=(0, 0, 1)", "physics:startsAsleep=true",
            "physics:angularVelocity=(0, 10, 0)", "physics:centerOfMass=(0, 0, 0.002)")]
        answer = self.set(*edits)
        self.assertEqual(len(answer["edits"]), len(edits))
        self.assertTrue(all(edit["variants"] == ["physics", "mujoco", "physx"]
                            for edit in answer["edits"]))

    def test_without_an_effect_nothing_is_written(self):
        self.take_text(ACTUATED)
        self.assertIn("</R/act>: the actuator's gains", self.vain("--drive", "/R/j=stiffness:3"))
        self.assertIn("of type Xform, which is not a collider shape; choose a shape below it: "
                      "--collider /R/a=convexHull", self.vain("--collider", "/R=convexHull"))
        self.assertIn("belongs to no body", self.vain("--mass", "/R=2"))
        self.assertIn("does not change; tenon set ASSET --clear /R/a.physics:mass",
                      self.vain("/R/a.physics:density=7"))
        self.set("--collider", "/R/a=on")
        self.original = self.files()
        self.assertIn("meshes alone are approximated", self.vain("--collider", "/R/a=convexHull"))

    def test_one_vain_edit_among_others_is_found(self):
        self.take_text(ACTUATED)
        good = ["/R/a.physics:mass=2", "/R/b.physics:mass=3", "/R/j.physics:upperLimit=5",
                "/R/j.physics:lowerLimit=-5", "/R/a.physics:velocity=(0, 0, 1)",
                "/R/act.mjc:biasPrm=[0, -3, -0.1]"]
        text = self.vain(*good[:3], "/R/j.drive:angular:physics:damping=7", *good[3:])
        self.assertIn("drive:angular:physics:damping", text)
        answer = self.set(*good)
        self.assertEqual(len(self.effect(answer)[None]), 8)

    def test_what_is_so_already_and_what_is_no_physics_is_no_fault(self):
        self.take_text(ACTUATED)
        self.set("/R/a.physics:mass=1")
        self.set("/R/j.drive:angular:physics:stiffness=1")
        self.set("/R/a.visibility=invisible", "--clear", "/R/j.drive:angular:physics:damping")
        self.set("/R/a.size=0.2")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
