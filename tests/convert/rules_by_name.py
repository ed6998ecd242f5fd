#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Options of `tenon convert` for joints and links by regular expression.

    rules_by_name.py ROOT TENON
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
MESH = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
MASS = ('<inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" '
        'izz="0.01"/></inertial>')
LINK = ('<link name="{0}">{1}<collision name="{0}_mesh"><geometry><mesh filename="m.obj"/>'
        "</geometry></collision></link>")
JOINT = ('<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/><axis xyz="1 0 0"/>'
         '<limit lower="-1" upper="1" effort="5" velocity="2"/><dynamics friction="0.5"/>{4}'
         "</joint>")
ROBOT = ('<robot name="r">' + LINK.format("palm", MASS) + LINK.format("finger_1", MASS) +
         LINK.format("finger_2", MASS) + LINK.format("tip", "") +
         '<link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision>'
         "</link>" +
         JOINT.format("finger_1_joint", "revolute", "palm", "finger_1", "") +
         JOINT.format("finger_2_joint", "revolute", "palm", "finger_2",
                      '<mimic joint="finger_1_joint"/>') +
         JOINT.format("tip_joint", "revolute", "finger_1", "tip", "") +
         JOINT.format("slide", "prismatic", "palm", "ball", "") + "</robot>")


class Rules(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "m.obj").write_text(MESH, encoding="utf-8")
        self.robot = self.folder / "r.urdf"
        self.robot.write_text(ROBOT, encoding="utf-8")
        self.asset = self.folder / "r.usda"

    def run_tenon(self, *words):
        done = subprocess.run([TENON, *map(str, words), "--json"], capture_output=True, text=True,
                              check=False)
        return done.returncode, json.loads(done.stdout)

    def convert(self, *options):
        code, answer = self.run_tenon("convert", self.robot, self.asset, "--force", *options)
        self.assertEqual(code, 0, answer)
        code, scene = self.run_tenon("physics", self.asset)
        self.assertEqual(code, 0, scene)
        return answer, scene

    def joints(self, scene, value):
        return {joint["path"].rpartition("/")[2]: value(joint) for joint in scene["joints"]}

    def gains(self, *options):
        _, scene = self.convert(*options)
        return self.joints(scene, lambda joint: tuple(
            round(joint["drives"][0][name], 4) for name in ("stiffness", "damping")))

    def test_gains(self):
        self.assertEqual(
            self.gains("--gains", "400,40", "--gains", "finger_[12]_joint=50,5"),
            {"finger_1_joint": (50, 5), "finger_2_joint": (0, 0), "tip_joint": (400, 40),
             "slide": (400, 40)})
        # Of several that match the last counts; the order of a plain one does not.
        self.assertEqual(
            self.gains("--gains", ".*_joint=1,2", "--gains", "400,40", "--gains", "tip.*=3,4"),
            {"finger_1_joint": (1, 2), "finger_2_joint": (0, 0), "tip_joint": (3, 4),
             "slide": (400, 40)})
        # A whole name, not a part of it.
        self.assertEqual(self.gains("--gains", "slide=7,8")["tip_joint"], (0, 0))

    def test_armature_and_friction(self):
        _, scene = self.convert("--armature", "0.01", "--armature", "finger.*=0.02",
                                "--friction", "slide=0.3")
        self.assertEqual(self.joints(scene, lambda j: round(j["armature"], 6)),
                         {"finger_1_joint": 0.02, "finger_2_joint": 0.02, "tip_joint": 0.01,
                          "slide": 0.01})
        self.assertEqual(self.joints(scene, lambda j: round(j["friction"], 6)),
                         {"finger_1_joint": 0.5, "finger_2_joint": 0.5, "tip_joint": 0.5,
                          "slide": 0.3})

    def test_collision(self):
        wanted = {"palm": "none", "finger_1": "convexDecomposition",
                  "finger_2": "convexDecomposition", "tip": "boundingSphere"}
        for extra in ([], ["--merge-fixed"]):
            self.convert("--collision", "decomposition", "--collision", "palm=none", "--collision",
                         "t.p=sphere", *extra)
            for link, token in wanted.items():
                path = {"palm": "", "tip": "finger_1/"}.get(link, "") + link
                prim = ("/r/Geometry/" + ("" if link == "palm" else "palm/") + path + "/" + link +
                        "_mesh.physics:approximation")
                code, answer = self.run_tenon("where", self.asset, prim)
                self.assertEqual(code, 0, answer)
                self.assertEqual(answer["value"], f'"{token}"')
        self.convert()
        self.assertEqual(self.asset.read_text().count('"convexHull"'), 4)

    def test_density(self):
        answer, scene = self.convert("--density", "2700")
        masses = {body["path"].rpartition("/")[2]: body["mass"] for body in scene["bodies"]}
        self.assertAlmostEqual(masses["ball"] / (2700 * 4 / 3 * 3.14159265 * 1e-3), 1, places=5)
        self.assertAlmostEqual(masses["tip"] / (2700 * 1e-3 / 6), 1, places=4)
        self.assertAlmostEqual(masses["palm"], 1)
        told = [d for d in answer["diagnostics"] if d["rule"] == "convert.no-mass"]
        self.assertEqual([d["severity"] for d in told], ["info"] * 2)
        self.assertIn("at 2700 kg/m^3", told[0]["message"])

    def test_what_nothing_in_the_robot_needs_is_told(self):
        weighed = self.folder / "weighed.urdf"
        weighed.write_text('<robot name="w">' + LINK.format("a", MASS) + '<link name="b"/>' +
                           JOINT.format("j", "fixed", "a", "b", "") + "</robot>", encoding="utf-8")
        for option in (["--density", "2700"], ["--scene"]):
            with self.subTest(option[0]):
                words = ["convert", str(weighed), str(self.asset), "--force", *option]
                told = subprocess.run([TENON, *words], capture_output=True, text=True, check=True)
                self.assertIn(f"{option[0]} has no effect: ", told.stderr + told.stdout)
                code, answer = self.run_tenon(*words)
                found = [d for d in answer["diagnostics"] if d["rule"] == "convert.without-effect"]
                self.assertEqual((code, len(found)), (0, 1), answer)
                self.assertEqual(found[0]["severity"], "info")
        answer, _ = self.convert("--density", "2700")
        self.assertNotIn("convert.without-effect", [d["rule"] for d in answer["diagnostics"]])

    def test_options_of_the_other_direction_are_refused(self):
        self.convert()
        for option in (["--density", "5"], ["--gains", "1,2"], ["--fix-base"], ["--name", "x"],
                       ["--start", "valid"], ["--flat"], ["--package", "a=."]):
            for ending in (".urdf", ".xml"):
                with self.subTest(option[0] + ending):
                    code, answer = self.run_tenon("convert", self.asset,
                                                  self.folder / ("back" + ending), *option)
                    [error] = answer["diagnostics"]
                    self.assertEqual((code, error["rule"]), (2, "convert.option"), answer)
                    self.assertIn(option[0], error["message"])
                    self.assertEqual(error["fix"], f"leave {option[0]} out")
        code, answer = self.run_tenon("convert", self.robot, self.asset, "--force", "--physics",
                                      "physx")
        self.assertEqual((code, answer["diagnostics"][0]["rule"]), (2, "convert.option"), answer)

    def test_what_matches_nothing_is_an_error(self):
        for words, said, fix in (
                (["--gains", "tip_jiont=1,2"], "joint with one axis that follows no other",
                 "did you mean tip_joint?"),
                (["--gains", "finger_2_joint=1,2"], "joint with one axis that follows no other",
                 "finger_1_joint"),
                # No match of a part of a name, whatever its parentheses.
                (["--gains", "sl)|zz=1,2"], "joint with one axis that follows no other",
                 "finger_1_joint"),
                (["--armature", "thumb.*=1"], "joint with one axis",
                 "finger_1_joint, finger_2_joint, tip_joint, slide"),
                (["--friction", "slider=1"], "joint with one axis", "did you mean slide?"),
                (["--collision", "ball=none"], "link with a mesh that collides", "palm, finger_1"),
                (["--collision", "Palm=sphere"], "link with a mesh that collides",
                 "did you mean palm?")):
            code, answer = self.run_tenon("convert", self.robot, self.asset, *words)
            with self.subTest(words[1]):
                [error] = answer["diagnostics"]
                self.assertEqual((code, error["rule"]), (2, "convert.no-match"), answer)
                self.assertIn("matches no " + said, error["message"])
                self.assertIn(fix, error["fix"])
                self.assertFalse(self.asset.exists())

    def test_what_is_no_rule_is_an_error(self):
        for words in (["--gains", "tip=1"], ["--armature", "-1"], ["--armature", "tip=heavy"],
                      ["--friction", "nan"], ["--collision", "box"], ["--collision", "tip=Hull"],
                      ["--density", "0"], ["--gains", "(=1,2"], ["--armature", "(a)\\1=1"],
                      ["--gains", "sl)|(ide=1,2"], ["--gains", "inf,1"],
                      ["--gains", "tip_joint=1e300,1"]):
            code, answer = self.run_tenon("convert", self.robot, self.asset, *words)
            with self.subTest(words[1]):
                self.assertEqual(code, 2, answer)
                self.assertFalse(self.asset.exists())

    def test_a_file_of_gains_that_cannot_be_used(self):
        file = self.robot.parent / "gains.json"
        for text, said, line in (("{}", "not a JSON object with", None), ("", "it is empty", 1),
                                 ('{"tip": [1, 2],\n "tip": [3, 4]}', "there twice", None),
                                 ('{\n"tip": [1, 1e400]}', "too large", 2),
                                 ('{"tip": [1, 1e300]}', "two finite numbers", None),
                                 ('{\n"tip": [1, 2]\n', "ends too early", 3)):
            file.write_text(text)
            code, answer = self.run_tenon("convert", self.robot, self.asset, "--gains", file)
            with self.subTest(text):
                [error] = answer["diagnostics"]
                self.assertEqual((code, error["line"]), (2, line), answer)
                self.assertIn(said, error["message"])
                self.assertFalse(self.asset.exists())

    def test_of_mjcf_another_robot_goes_back(self):
        model = ('<mujoco model="m"><worldbody><body name="b"><joint name="j" axis="0 1 0"/>'
                 '<geom type="sphere" size="0.1"/></body></worldbody></mujoco>')
        (self.folder / "m.xml").write_text(model, encoding="utf-8")
        code, answer = self.run_tenon("convert", self.folder / "m.xml", self.folder / "m.usda",
                                      "--armature", "j=0.25")
        self.assertEqual(code, 0, answer)
        code, answer = self.run_tenon("convert", self.folder / "m.usda", self.folder / "back.xml")
        self.assertIn('armature="0.25"', (self.folder / "back.xml").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
