#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon new, add, remove, rename: scenes made of verbs alone.

    test_authoring.py ROOT TENON CLASS...

Kinds are those that the program names; one without a row here is a fault.
"""

import json
import re
import shutil
import sys
import unittest
import unittest.mock

from authoring_case import PART, ROOT, SHARED, Case, tenon

HAND = ROOT / "examples/inspire_hand"

# What each kind takes to be added: {W} is a prim that holds others, {W}/a and {W}/b bodies with
# cubes, {W}/m a mesh, {W}/j a joint of six degrees of freedom, {W}/h a hinge, {W}/M a material.
JOINT = ["--body0", "{W}/a", "--body1", "{W}/b", "--at", "0.1,0.2,0.3"]
ROWS = {
    "xform": [["--at", "1,2,3", "--rotate", "0,0,90", "--scale", "1,2,1"]],
    "scope": [[]],
    "cube": [["--size", "0.5"], ["--at", "0,0,1", "--set", "primvars:displayColor=[(1, 0, 0)]"]],
    "sphere": [["--radius", "0.5"]],
    "cylinder": [["--radius", "0.5", "--height", "2", "--axis", "X"]],
    "capsule": [["--radius", "0.5"]],
    "cone": [["--height", "2"]],
    "plane": [["--width", "3", "--length", "4", "--axis", "Z"]],
    "mesh": [["--file", "part.stl"], ["--file", "part.obj", "--at", "0,0,1", "--file-up", "Y"],
             ["--file", "part.ply", "--file-meters", "0.001"], ["--file", "part.glb"]],
    "ground": [[]],
    "reference": [["--file", "part.usda"], ["--file", "part.usda", "--prim", "/Part/inner"]],
    "payload": [["--file", "part.usda", "--at", "0,0,2"]],
    "distant-light": [["--intensity", "3000", "--angle", "1"]],
    "dome-light": [["--color", "1,0.5,0.5"]],
    "sphere-light": [["--radius", "2", "--at", "0,0,5"]],
    "disk-light": [["--radius", "2"]],
    "rect-light": [["--width", "2", "--height", "1"]],
    "camera": [["--focal-length", "35", "--rotate", "0.5,0.5,0.5,0.5"]],
    "scene": [["--gravity-direction", "0,0,-1", "--gravity-magnitude", "5"]],
    "material": [["--static-friction", "0.8", "--density", "100"]],
    "physics-material": [["--restitution", "0.5"]],
    "collision-group": [["--members", "{W}/a,{W}/b", "--filtered", "{W}/new"]],
    "fixed": [JOINT],
    "revolute": [[*JOINT, "--axis", "Z", "--lower", "-10", "--upper", "20"],
                 ["--body1", "{W}/b", "--axis", "1,1,0"]],
    "prismatic": [[*JOINT, "--axis", "Y", "--collide", "true"]],
    "spherical": [[*JOINT, "--cone0", "30", "--cone1", "40"]],
    "distance": [["--body0", "{W}/a", "--body1", "{W}/b", "--min", "0.5", "--max", "9"]],
    "d6": [[*JOINT, "--break-force", "100", "--break-torque", "10"]],
    "body": [["--velocity", "1,0,0", "--angular-velocity", "0,10,0"], ["--kinematic", "true"]],
    "collider": [["--approximation", "convexHull"]],
    "mass": [["--mass", "2", "--com", "0,0,0.1", "--inertia", "1,2,2", "--principal-axes",
              "1,0,0,0"]],
    "articulation": [[]],
    "binding": [["--material", "{W}/M"]],
    "filtered-pair": [["--with", "{W}/b"]],
    "limit": [["--dof", "rotX", "--low", "-10", "--high", "10"], ["--low", "-5"]],
    "drive": [["--dof", "rotZ", "--stiffness", "10", "--damping", "1", "--max-force", "5",
               "--target-position", "3", "--target-velocity", "1", "--drive-type", "acceleration"]],
    "mimic": [["--leader", "{W}/h2", "--multiplier", "-1", "--offset", "5"]],
    "variant": [["--variant", "look=red"]],
    "engine": [["--engine", "newton"]],
}
# Where kinds that are put on a prim go, for each row.
PLACES = {"physics-material": ["{W}/L"],
          "body": ["{W}/m", "{W}/m"], "collider": ["{W}/m"], "mass": ["{W}/a"],
          "articulation": ["{W}/b"], "binding": ["{W}/a"], "filtered-pair": ["{W}/a"],
          "limit": ["{W}/j", "{W}/h"], "drive": ["{W}/j"], "mimic": ["{W}/h"],
          "variant": ["{W}"], "engine": ["{W}"]}
# What remove needs to know which one goes; without it everything of the kind does.
NAMES = {"limit": ["--dof"], "drive": ["--dof"], "variant": ["--variant"], "engine": ["--engine"]}

def kinds():
    """The kinds that the program knows."""
    error = json.loads(tenon("add", ROOT / "examples/scenes/joint.usda", "/x=?", "--json").stdout)
    found = error["diagnostics"][0]["fix"].split(": ")[1].split(", ")
    if len(found) < 30:
        raise AssertionError(f"the kinds are said to be {found}")
    return found


class ThereAndBack(Case):
    """remove gives back, byte for byte, what add was given."""

    def go(self, asset, world):
        for kind in kinds():
            for number, row in enumerate(ROWS[kind]):
                if kind == "engine" and asset == self.scene:
                    continue
                place = PLACES.get(kind, ["{W}/new"] * 9)[number].format(W=world)
                arguments = [word.format(W=world) for word in row]
                names = [word for name in NAMES.get(kind, []) if name in arguments
                         for word in (name, arguments[arguments.index(name) + 1])]
                with self.subTest(kind=kind, number=number):
                    if kind == "mesh" and asset != self.scene:  # its file of meshes is shared
                        self.assertIn("--in", self.refused("edit.no-file", "add", asset,
                                                           f"{place}={kind}", *arguments))
                        continue
                    before = self.files()
                    self.do("add", asset, f"{place}={kind}", *arguments)
                    self.assertNotEqual(self.files(), before)
                    self.do("remove", asset, f"{place}={kind}", *names)
                    self.assertEqual(self.files(), before)

    def test_in_a_text_with_comments(self):
        self.go(self.laid_out(), "/World")

    def test_in_a_new_scene_of_several_layers(self):
        self.do("new", "base.usda")
        self.scene.write_text('#usda 1.0\n(\n    defaultPrim = "World"\n    subLayers = '
                              '[@./base.usda@]\n)\n# over it\n', encoding="utf-8")
        for name in "ab":
            self.do("add", "base.usda", f"/World/{name}=cube,body,collider",
                    "--at", f"{ord(name)},0,0")
        self.do("add", "base.usda", "/World/M=material")
        self.do("add", "base.usda", "/World/j=d6", "--body0", "/World/a", "--body1", "/World/b",
                "--collide", "true")
        for name in ("h", "h2"):
            self.do("add", self.scene, f"/World/{name}=revolute", "--body1",
                    "/World/a" if name == "h" else "/World/b")
        self.do("add", self.scene, "/World/m=sphere")
        self.do("add", "base.usda", "/World/L=material")
        self.do("remove", "base.usda", "/World/L=physics-material")
        rows = {**ROWS, "collider": [[]]}
        with unittest.mock.patch.dict(ROWS, rows):
            self.go(self.scene, "/World")

    def test_in_a_structured_hand(self):
        shutil.copytree(HAND, self.folder / "hand")
        for path in self.folder.rglob("*"):
            path.chmod(0o755 if path.is_dir() else 0o644)
        asset, world = self.folder / "hand/inspire_hand.usda", "/inspire_hand"
        for name in "ab":
            self.do("add", asset, f"{world}/{name}=cube,body,collider", "--at", f"{ord(name)},0,0")
        self.do("add", asset, f"{world}/M=material")
        self.do("add", asset, f"{world}/j=d6", "--body0", f"{world}/a", "--body1", f"{world}/b",
                "--collide", "true")
        for name in ("h", "h2"):
            self.do("add", asset, f"{world}/{name}=revolute", "--body1",
                    f"{world}/a" if name == "h" else f"{world}/b")
        self.do("add", asset, f"{world}/m=sphere")
        self.do("add", asset, f"{world}/L=material")
        self.do("remove", asset, f"{world}/L=physics-material")
        with unittest.mock.patch.dict(ROWS, {"collider": [[]]}):
            self.go(asset, world)

    def test_a_mimic_of_physx_alone(self):
        shutil.copytree(HAND, self.folder / "hand")
        for path in self.folder.rglob("*"):
            path.chmod(0o755 if path.is_dir() else 0o644)
        asset, joints = self.folder / "hand/inspire_hand.usda", "/inspire_hand/Physics"
        before = self.files()
        self.do("add", asset, f"{joints}/right_index_1_joint=mimic", "--leader",
                f"{joints}/right_thumb_1_joint", "--engine", "physx")
        changed = [name for name, text in self.files().items() if text != before[name]]
        self.assertEqual(changed, ["hand/payloads/Physics/physx.usda"])
        self.do("remove", asset, f"{joints}/right_index_1_joint=mimic")
        self.assertEqual(self.files(), before)

    def test_every_kind_has_a_row(self):
        self.assertEqual(sorted(kinds()), sorted(ROWS))


def seven_scenes():
    """(name among the examples, name in ../shared, commands) of each."""
    scenes = []
    for line in (ROOT / "tests/cli/seven_scenes.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            scenes.append((*line.strip("[]").split(), []))
        elif not line.startswith("#"):
            scenes[-1][2].append(line.split())
    return scenes


class SevenScenes(Case):
    """Made of bare geometry by verbs alone, they are what they were."""

    def make(self, scene, commands):
        name = re.search(r'def PhysicsScene "(\w+)"', scene.read_text(encoding="utf-8"))[1]
        self.do("strip", scene, "-o", self.scene)
        self.do("diff", scene, self.scene, "--show", "physics", code=1)
        for verb, *arguments in commands:
            self.do(verb, self.scene, *(word.replace("SCENE", name) for word in arguments))
        self.do("diff", scene, self.scene, "--show", "physics")
        self.assertEqual(tenon("check", scene, "--json").returncode,
                         tenon("check", self.scene, "--json").returncode)

    def test_our_own(self):
        scenes = seven_scenes()
        self.assertEqual(len(scenes), 7)
        for own, _, commands in scenes:
            with self.subTest(scene=own):
                self.make(ROOT / f"examples/scenes/{own}.usda", commands)

    def test_the_published_ones(self):
        if not (SHARED / "scenes").is_dir():
            self.skipTest("../shared is not here")
        for _, published, commands in seven_scenes():
            with self.subTest(scene=published):
                self.make(SHARED / f"scenes/{published}.usda", commands)


class Verbs(Case):
    """What they make, tell and refuse."""

    def scene_with_boxes(self):
        self.do("new", self.scene)
        self.do("add", self.scene, "/World/scene=scene", "/World/ground=ground")
        self.do("add", self.scene, "/World/box=cube,body,collider,mass", "--size", "0.1", "--at",
                "0,0,1", "--mass", "2")
        self.do("add", self.scene, "/World/tip=sphere,body,collider", "--radius", "0.05", "--at",
                "0,0,1.2", "--rotate", "0,90,0")
        self.do("add", self.scene, "/World/hinge=revolute", "--body0", "/World/box", "--body1",
                "/World/tip", "--at", "0,0,1.05", "--axis", "Y", "--lower", "-30", "--upper", "30")
        self.do("add", self.scene, "/World/hinge=drive", "--stiffness", "10", "--damping", "1")
        return self.scene

    def test_check_is_silent_on_what_is_made(self):
        answer = json.loads(self.do("check", self.scene_with_boxes(), "--json").stdout)
        self.assertEqual(answer["diagnostics"], [])

    def test_a_new_file_is_as_asked_and_replaces_none(self):
        self.do("new", self.scene, "--up", "Y", "--meters", "0.01", "--kilograms", "0.001",
                "--default-prim", "Stage")
        text = self.scene.read_text(encoding="utf-8")
        for part in ('upAxis = "Y"', "metersPerUnit = 0.01", "kilogramsPerUnit = 0.001",
                     'defaultPrim = "Stage"', 'def Xform "Stage"'):
            self.assertIn(part, text)
        self.refused("output.exists", "new", self.scene)
        answer = json.loads(self.do("new", self.scene, "--force", "--json").stdout)
        self.assertEqual((answer["upAxis"], answer["defaultPrim"]), ("Z", "World"))
        self.do("new", "crate.usdc")
        self.assertTrue((self.folder / "crate.usdc").read_bytes().startswith(b"PXR-USDC"))
        self.do("add", "crate.usdc", "/World/a=cube")
        self.assertIn('def Cube "a"', self.do("cat", "crate.usdc").stdout)

    def test_kilograms_are_brought_to_the_unit_of_the_asset(self):
        self.do("new", self.scene, "--kilograms", "0.001")
        self.do("add", self.scene, "/World/a=cube,body,collider,mass", "--mass", "2")
        self.assertIn("physics:mass = 2000", self.scene.read_text(encoding="utf-8"))

    def test_frames_of_a_joint_meet_where_it_was_said(self):
        self.scene_with_boxes()
        joint = json.loads(self.do("physics", self.scene, "--json").stdout)["joints"][0]
        for value, wanted in zip(joint["frame0"]["position"], (0, 0, 0.05)):
            self.assertAlmostEqual(value, wanted, 6)
        # The tip is turned about Y by 90 degrees: down is its X.
        for value, wanted in zip(joint["frame1"]["position"], (0.15, 0, 0)):
            self.assertAlmostEqual(value, wanted, 6)
        self.assertEqual(joint["axis"], "Y")

    def test_frames_of_bodies_that_are_scaled_and_turned_meet(self):
        self.do("new", self.scene, "--meters", "0.01")
        self.do("add", self.scene, "/World/group=xform", "--rotate", "10,20,30", "--at", "5,6,7",
                "--scale", "2,2,2")
        self.do("add", self.scene, "/World/group/a=cube,body,collider", "--rotate", "40,50,60",
                "--scale", "1,2,3", "--at", "1,2,3")
        self.do("add", self.scene, "/World/b=cube,body,collider", "--at", "20,0,0")
        for axis in ("X", "Y", "Z", "1,2,-3", "-1,0,0"):
            self.do("add", self.scene, "/World/j=prismatic", "--body0", "/World/group/a", "--body1",
                    "/World/b", "--at", "3,4,5", "--axis", axis)
            self.assertNotIn("joint.", self.do("check", self.scene).stdout)
            self.do("remove", self.scene, "/World/j")

    def test_a_dry_run_writes_nothing_and_prints_the_difference(self):
        self.scene_with_boxes()
        before = self.files()
        shown = self.do("add", self.scene, "/World/c=cube", "--dry-run").stdout
        self.assertIn('+    def Cube "c"', shown)
        answer = json.loads(self.do("remove", self.scene, "/World/tip", "--dry-run",
                                    "--json").stdout)
        self.assertTrue(answer["dryRun"])
        self.assertEqual(self.files(), before)

    def test_a_prim_goes_with_all_that_names_it(self):
        self.scene_with_boxes()
        self.do("add", self.scene, "/World/g=collision-group", "--members", "/World/box,/World/tip")
        self.do("add", self.scene, "/World/ground=filtered-pair", "--with", "/World/tip")
        self.do("remove", self.scene, "/World/tip")
        text = self.scene.read_text(encoding="utf-8")
        self.assertNotIn("tip", text)
        self.assertNotIn("hinge", text)  # a joint of what is gone
        self.assertIn("</World/box>", text)

    def robot(self):
        """A robot of three links in the structure, whose second joint follows the first."""
        link = ('<link name="{0}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" '
                'ixy="0" ixz="0" iyz="0"/></inertial></link>')
        joint = ('<joint name="j{1}" type="revolute"><parent link="{0}"/><child link="{1}"/>'
                 '<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>{2}'
                 "</joint>")
        text = "".join(map(link.format, "abc")) + joint.format("a", "b", "") + joint.format(
            "b", "c", '<mimic joint="jb" multiplier="2"/>')
        (self.folder / "r.urdf").write_text(f'<robot name="r">{text}</robot>', encoding="utf-8")
        self.do("convert", "r.urdf", "r/", "--schema", "both", "--flat")
        return self.folder / "r/r.usda"

    def test_followers_of_a_leader_that_goes_follow_nothing(self):
        asset = self.robot()
        out = self.do("remove", asset, "/r/Physics/jb").stdout
        for path in (self.folder / "r").rglob("*.usda"):
            text = path.read_text(encoding="utf-8")
            self.assertNotRegex(text, "(?i)mimic|EqualityJoint|mjc:coef", path)
            self.assertNotIn("/jb>", text, path)
        self.assertIn("/r/Physics/jc", out)
        answer = json.loads(self.do("physics", asset, "--json").stdout)
        self.assertEqual([(j["path"], j["mimics"]) for j in answer["joints"]],
                         [("/r/Physics/jc", [])])

    def test_what_joins_a_robot_is_in_its_lists(self):
        asset = self.robot()
        before = self.files()

        def lists():
            properties = json.loads(self.do("dump", asset).stdout)["prims"]["/r"]["properties"]
            return [properties[f"isaac:physics:robot{what}"]["targets"]
                    for what in ("Links", "Joints")]

        links, joints = lists()
        self.do("add", asset, "/r/d=xform,body,mass", "--mass", "1")
        self.do("add", asset, "/r/Physics/jd=revolute", "--body0", "/r/c", "--body1", "/r/d")
        self.assertEqual(lists(), [[*links, "/r/d"], [*joints, "/r/Physics/jd"]])
        self.do("remove", asset, "/r/Physics/jd")
        self.do("remove", asset, "/r/d=body")
        self.assertEqual(lists(), [links, joints])
        self.do("remove", asset, "/r/d")
        self.assertEqual(self.files(), before)

    def test_a_new_name_is_everywhere(self):
        self.scene_with_boxes()
        before = self.scene.read_text(encoding="utf-8")
        self.do("rename", self.scene, "/World/tip", "finger")
        text = self.scene.read_text(encoding="utf-8")
        self.assertEqual(text, before.replace("tip", "finger"))
        self.do("rename", self.scene, "/World/finger", "tip")
        self.assertEqual(self.scene.read_text(encoding="utf-8"), before)
        self.refused("edit.prim-exists", "rename", self.scene, "/World/tip", "box")
        self.refused("edit.bad-name", "rename", self.scene, "/World/tip", "a-b")

    def test_what_cannot_be_opened_is_not_referenced(self):
        self.do("new", self.scene)
        before = self.scene.read_bytes()
        for name, text in (("shape.obj", "v 0 0 0\n"), ("robot.xml", "<mujoco/>\n"),
                           ("broken.usda", "#usda 1.0\ndef {\n")):
            file = self.folder / name
            file.write_text(text, encoding="utf-8")
            for kind in ("reference", "payload"):
                self.refused("edit.not-a-layer", "add", self.scene, f"/World/part={kind}",
                             "--file", file)
        done = tenon("add", self.scene, "/World/part=reference", "--file",
                          self.folder / "nowhere.usda")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nowhere.usda", done.stderr)
        self.assertEqual(self.scene.read_bytes(), before)

    def test_a_property_gets_a_new_name_where_it_stands(self):
        self.scene.write_text("""#usda 1.0
(
    defaultPrim = "r"
)

def Material "r"
{
    # how much it gives way
    float outputs:softness.connect = </r/b.hardness>

    def Xform "b" (
        variants = {
            string v = "x"
        }
        prepend variantSets = "v"
    )
    {
        custom float hardness = 3 (  # kept
            doc = "of the skin"
        )
        float hardness.timeSamples = {
            1: 2,
        }
        variantSet "v" = {
            "x" {
                float hardness = 4
            }
        }
    }
}
""", encoding="utf-8")
        before = self.scene.read_text(encoding="utf-8")
        self.do("rename", self.scene, "/r/b.hardness", "inputs:hardness")
        self.assertEqual(self.scene.read_text(encoding="utf-8"),
                         before.replace("float hardness", "float inputs:hardness")
                         .replace("b.hardness", "b.inputs:hardness"))
        self.do("rename", self.scene, "/r/b.inputs:hardness", "hardness")
        self.assertEqual(self.scene.read_text(encoding="utf-8"), before)
        self.refused("edit.bad-name", "rename", self.scene, "/r/b.hardness", "a-b")
        self.refused("edit.no-spec", "rename", self.scene, "/r/b.nothing", "something")
        self.refused("edit.property-exists", "rename", self.scene, "/r.outputs:softness",
                     "outputs:softness")

    def test_texts_that_are_paths_follow_a_new_name(self):
        self.scene.write_text("""#usda 1.0
(
    defaultPrim = "r"
)

def Xform "r" (
    customData = {
        dictionary NameOverride = {
            string "/r/old/x" = "/r/older"
            dictionary inner = {
                string at = "/r/old.size"
            }
        }
    }
)
{
    custom token part = "/r/old"
    custom string[] parts = ["/r/old/x", "see /r/old"]

    def Xform "old"
    {
    }
}
""", encoding="utf-8")
        before = self.scene.read_text(encoding="utf-8")
        self.do("rename", self.scene, "/r/old", "new")
        text = self.scene.read_text(encoding="utf-8")
        wanted = before.replace('"/r/old/x"', '"/r/new/x"').replace('"/r/old"', '"/r/new"')
        wanted = wanted.replace("/r/old.size", "/r/new.size").replace('"old"', '"new"')
        self.assertEqual(text, wanted)

    def test_a_link_of_a_structured_hand_gets_another_name_in_all_files(self):
        shutil.copytree(HAND, self.folder / "hand")
        for path in self.folder.rglob("*"):
            path.chmod(0o755 if path.is_dir() else 0o644)
        asset = self.folder / "hand/inspire_hand.usda"
        self.do("rename", asset, "/inspire_hand/right_thumb_1", "thumb_root")
        for path in (self.folder / "hand").rglob("*.usda"):
            if path.name == "instances.usda":  # has a scope of its own, with meshes of that name
                continue
            text = path.read_text(encoding="utf-8")
            self.assertNotIn("/inspire_hand/right_thumb_1>", text, path)
            self.assertNotIn('\n    def Xform "right_thumb_1"', text, path)
            self.assertNotIn('\n    over "right_thumb_1"', text, path)
        masses = []
        for hand in (HAND / "inspire_hand.usda", asset):
            text = self.do("physics", hand, "--json", "--physics", "physics").stdout
            masses.append(sorted(body["mass"] for body in json.loads(text)["bodies"]))
        self.assertEqual(*masses)
        self.do("rename", asset, "/inspire_hand/thumb_root", "right_thumb_1")
        for path in (self.folder / "hand").rglob("*.usda"):
            original = HAND / path.relative_to(self.folder / "hand")
            self.assertEqual(path.read_bytes(), original.read_bytes(), path)

    def test_wrong_use_is_refused_with_what_to_do(self):
        scene = self.scene_with_boxes()
        (self.folder / "part.usda").write_text(PART, encoding="utf-8")
        self.do("add", scene, "/World/part=reference", "--file", "part.usda")
        self.assertIn("@./part.usda@", scene.read_text(encoding="utf-8"))
        for rule, words in (
                ("edit.has-it-already", "add /World/box=collider"),
                ("edit.has-it-already", "add /World/hinge=drive"),
                ("edit.has-it-already", "add /World/hinge=limit --low 1"),
                ("edit.prim-exists", "add /World/box=cube"),
                ("edit.no-prim", "add /World/none/x=cube"),
                ("edit.no-prim", "add /World/none=collider"),
                ("edit.no-body", "add /World/j=fixed"),
                ("edit.no-body", "add /World/j=fixed --body1 /World/ground"),
                ("edit.no-body", "add /World/j=fixed --body0 /World/tip --body1 /World/tip"),
                ("edit.unknown-kind", "add /World/j=colider"),
                ("edit.bad-argument", "add /World/j"),
                ("edit.bad-argument", "add /World/j=sphere --size 2"),
                ("edit.bad-argument", "add /World/j=cube,body --mass 2"),
                ("edit.bad-argument", "add /World/j=reference"),
                ("edit.bad-argument", "add /World/j=fixed --body1 /World/tip --at 1,2"),
                ("edit.bad-argument", "add /World/ground=mass,cube"),
                ("edit.wrong-type", "add /World/box=drive --dof rotX"),
                ("edit.bad-path", "add box=body"),
                ("edit.has-none", "remove /World/ground=body"),
                ("edit.wrong-type", "remove /World/box=sphere"),
                ("edit.no-prim", "remove /World/none"),
                ("edit.over-arc", "remove /World/part/inner"),
                ("edit.over-arc", "rename /World/part/inner core")):
            verb, *arguments = words.split()
            with self.subTest(words=words):
                self.refused(rule, verb, scene, *arguments)
        self.assertIn('did you mean "collider"?',
                      self.refused("edit.unknown-kind", "add", scene, "/World/j=colider"))
        self.assertIn("it belongs to mass: write cube,body,mass", self.refused(
            "edit.bad-argument", "add", scene, "/World/j=cube,body", "--mass", "2"))

    def test_what_changes_nothing_is_not_written(self):
        self.scene_with_boxes()
        before = self.files()
        self.do("add", self.scene, "/World/x=xform")
        self.assertIn("edit.no-effect",
                      self.do("add", self.scene, "/World/x=collider", code=1).stderr)
        self.do("remove", self.scene, "/World/x")
        self.assertEqual(self.files(), before)

    def test_one_wish_for_all_prims_that_match(self):
        scene = self.laid_out()
        self.do("add", scene, "/World/c_col=cube", "--at", "9,0,0")
        self.do("add", scene, "/World/d_col=xform")
        self.do("add", scene, "/World/d_col/e_col=sphere")
        self.do("add", scene, ".*_col=collider", "--match")
        colliders = json.loads(self.do("physics", scene, "--json").stdout)["colliders"]
        names = sorted(collider["path"].rsplit("/", 1)[1] for collider in colliders)
        self.assertEqual(names, ["a", "b", "c_col", "e_col"])
        self.do("add", scene, "m=collider", "--match", "--approximation", "convexHull")
        self.assertEqual(scene.read_text(encoding="utf-8").count("PhysicsMeshCollisionAPI"), 1)
        self.do("add", scene, "[ab]=mass", "--match", "--mass", "2")
        for rule, words in (("edit.no-prim", ".*_col=collider"), ("edit.no-prim", "x.*=mass"),
                            ("edit.bad-argument", "a=cube"), ("name.bad-pattern", "((=mass")):
            self.refused(rule, "add", scene, words, "--match")

    def test_drives_for_all_joints_that_can_have_one(self):
        scene, some = self.laid_out(), "(turn|weld|slide)=drive"
        self.do("add", scene, "/World/turn=revolute", "--body1", "/World/a")
        self.do("add", scene, "/World/weld=fixed", "--body0", "/World/a", "--body1", "/World/b")
        self.do("add", scene, "/World/turn=drive", "--stiffness", "3")
        self.refused("edit.no-prim", "add", scene, some, "--match", "--stiffness", "5")
        self.do("add", scene, "/World/slide=prismatic", "--body1", "/World/b")
        self.do("add", scene, some, "--match", "--stiffness", "5")
        joints = json.loads(self.do("physics", scene, "--json").stdout)["joints"]
        self.assertEqual({joint["path"] for joint in joints if joint["drives"]},
                         {"/World/turn", "/World/slide"})

    def test_inside_an_instance_nothing_goes(self):
        self.scene.write_text('#usda 1.0\ndef "W"\n{\n    def "i" (\n        instanceable = true\n'
                              '        references = @./part.usda@\n    )\n    {\n    }\n}\n',
                              encoding="utf-8")
        self.refused("edit.instance-proxy", "remove", self.scene, "/W/i/inner")
        self.refused("edit.instance-proxy", "add", self.scene, "/W/i/inner/x=cube")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
