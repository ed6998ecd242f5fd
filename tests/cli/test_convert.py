#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon convert` into a folder: the structured asset in one command.

    test_convert.py ROOT TENON
"""

import json
import math
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
ROBOT = ROOT / "tests/convert/urdf/shapes.urdf"


def tenon(*arguments):
    process = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True,
                             text=True, check=False)
    return process.returncode, json.loads(process.stdout)


def files_of(folder):
    return {p.relative_to(folder).as_posix(): p.read_bytes()
            for p in folder.rglob("*") if p.is_file()}


class StartPoses(unittest.TestCase):
    """Joints whose limits exclude 0: told, and with --start valid they start inside of them."""

    LINK = ('<link name="{0}"><inertial><origin xyz="0.1 0 0"/><mass value="1"/><inertia ixx="0.1" '
            'iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>')
    JOINT = ('<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/>'
             '<origin xyz="0 0 0.5" rpy="0.3 0 0"/><axis xyz="0 1 0"/>'
             '<limit lower="{4}" upper="{5}" effort="50" velocity="9"/>{6}</joint>')
    ROBOT = ('<robot name="r">' + "".join(map(LINK.format, "abcd")) +
             JOINT.format("elbow", "revolute", "a", "b", 0.5, 2.5, "") +
             JOINT.format("slide", "prismatic", "b", "c", -0.3, -0.1, "") +
             JOINT.format("follower", "revolute", "c", "d", -3, 3,
                          '<mimic joint="elbow" multiplier="-1" offset="0.2"/>') + "</robot>")
    STARTS = {"elbow": 0.6, "slide": -0.11, "follower": -0.4}

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "r.urdf").write_text(self.ROBOT, encoding="utf-8")

    def rules(self, answer):
        return [finding["rule"] for finding in answer["diagnostics"]]

    def test_they_start_where_their_limits_are(self):
        for extra in ([], ["--flat"], ["--names", "tutorial"]):
            asset = self.folder / ("made" + "".join(extra).replace(" ", ""))
            code, made = tenon("convert", self.folder / "r.urdf", asset, "--fix-base", *extra,
                               "--gains", "100,10", "--start", "valid")
            self.assertEqual(code, 0, made)
            self.assertNotIn("convert.outside-limits", self.rules(made))
            _, poses = tenon("inertia", asset / "r.usda")
            for row in poses["coordinates"]:
                self.assertAlmostEqual(row["position"],
                                       self.STARTS[row["joint"].rpartition("/")[2]], places=6)
            _, kept = tenon("pose", asset / "r.usda")  # that start, by name
            self.assertEqual([pose["name"] for pose in kept["poses"]], ["valid"])
            for row in kept["poses"][0]["joints"]:
                self.assertIsNone(row["problem"], row)
                self.assertAlmostEqual(row["value"],
                                       self.STARTS[row["joint"].rpartition("/")[2]], places=6)
            _, findings = tenon("check", asset / "r.usda")
            told = set(self.rules(findings))
            self.assertFalse(told & {"pose.joint-missing", "pose.outside-limits",
                                     "pose.value-count", "joint.outside-limit",
                                     "joint.state-differs",
                                     "joint.frames-apart", "drive.target-outside-limit",
                                     "mimic.violated"}, told)
            # Back in URDF it is the robot that it was.
            code, _ = tenon("convert", asset / "r.usda", self.folder / "back.urdf", "--force")
            self.assertEqual(code, 0)
            again = self.folder / "again"
            tenon("convert", self.folder / "back.urdf", again, "--fix-base")
            _, joints = tenon("physics", again / "r.usda")
            limits = {joint["path"].rpartition("/")[2]: (joint["lower"], joint["upper"])
                      for joint in joints["joints"]}
            self.assertAlmostEqual(limits["elbow"][0], 0.5, places=6)
            self.assertAlmostEqual(limits["slide"][1], -0.1, places=6)
            shutil.rmtree(again)

    def test_without_it_they_are_told(self):
        code, made = tenon("convert", self.folder / "r.urdf", self.folder / "made")
        self.assertEqual(code, 0)
        told = [finding for finding in made["diagnostics"]
                if finding["rule"] == "convert.outside-limits"]
        self.assertEqual([finding["severity"] for finding in told], ["warning"] * 2)
        self.assertIn('"elbow", 28.6479 to 143.239 degrees', told[0]["message"])
        self.assertIn("--start valid to start it at -0.11 m", told[1]["fix"])


class BadMeshes(unittest.TestCase):
    """A mesh with numbers that are none is skipped: no NaN reaches an asset."""

    HEAD = struct.pack("<80xI", 2)
    FIRST = struct.pack("<12f2x", *[0.0] * 3, 0, 0, 0, 1, 0, 0, 0, 1, 0)
    SECOND = struct.pack("<12f2x", *[0.0] * 3, 0, 0, 0, 1, math.nan, 0, 0, 1, 0)
    MESHES = {
        "a.stl": (HEAD + FIRST + SECOND, "triangle 2 has a coordinate that is not a finite"),
        "b.stl": (b"solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex inf 0 0\nendfacet\n",
                  "b.stl:5: error: triangle 1 has"),
        "a.obj": (b"v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", "a.obj:3: error: a point has"),
        "b.obj": (b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
                  'b.obj:4: error: a face names "4" of 3 so far'),
        # Cut in the middle.
        "c.stl": (b"solid s\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nfacet\n",
                  'c.stl:7: error: the file ends inside the solid that begins in line 1: it has no '
                  '"endsolid"'),
        "d.stl": (HEAD + FIRST, "d.stl: error: the file counts 2 triangles, but has 134 bytes, "),
        "c.ply": (b"ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nend_header\n0\n",
                  "c.ply: error: the file counts 9 of \"vertex\" and is too short for them"),
    }

    def test_are_told_and_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, (contents, words) in self.MESHES.items():
                pathlib.Path(folder, name).write_bytes(contents)
                robot, asset = pathlib.Path(folder, "r.urdf"), pathlib.Path(folder, "r.usda")
                mesh = f'<geometry><mesh filename="{name}"/></geometry>'
                robot.write_text(f'<robot name="r"><link name="l">\n<visual>{mesh}</visual>\n'
                                 f"<collision>{mesh}</collision></link></robot>\n")
                with self.subTest(name):
                    code, answer = tenon("convert", robot, asset)
                    self.assertEqual(code, 1)
                    told = [d["message"] for d in answer["diagnostics"]
                            if d["rule"] == "convert.mesh-unreadable"]
                    self.assertEqual(len(told), 1)
                    self.assertIn(words, told[0])
                    self.assertIn("is skipped", told[0])
                    text = asset.read_text(encoding="utf-8")
                    self.assertNotRegex(text, r"\b(nan|inf)\b")
                    self.assertNotIn("def Mesh", text)


class MissingMeshes(unittest.TestCase):
    def test_are_not_counted(self):
        with tempfile.TemporaryDirectory() as folder:
            robot = pathlib.Path(folder, "r.urdf")
            robot.write_text('<robot name="r"><link name="l"><visual><geometry>'
                             '<mesh filename="gone.stl"/></geometry></visual></link></robot>\n')
            code, answer = tenon("convert", robot, pathlib.Path(folder, "r.usda"))
            self.assertEqual((code, answer["meshes"]), (1, 0))


class UnlimitedJoints(unittest.TestCase):
    """What a description cannot leave open is told by names of joints, and read as open."""

    ROBOT = ('<robot name="r"><link name="world"/><link name="a"/><link name="b"/>'
             '<joint name="j" type="revolute"><parent link="world"/><child link="a"/>'
             '<limit lower="-1" upper="1" effort="5" velocity="2"/></joint>'
             '<joint name="k" type="prismatic"><parent link="a"/><child link="b"/><limit/></joint>'
             '</robot>')

    def test_are_told_and_come_back(self):
        with tempfile.TemporaryDirectory() as folder:
            asset = pathlib.Path(folder, "r.usda")
            urdf = pathlib.Path(folder, "r.urdf")
            pathlib.Path(folder, "a.urdf").write_text(self.ROBOT, encoding="utf-8")
            tenon("convert", pathlib.Path(folder, "a.urdf"), asset)
            _, answer = tenon("convert", asset, urdf)
            told = "\n".join(d["message"] for d in answer["diagnostics"]
                             if d["rule"] == "urdf.replaced" and d["severity"] == "warning")
            self.assertIn('the range of joint "k" has no end', told)
            self.assertIn('joint "k" has no limit of effort', told)
            self.assertIn('joint "k" has no limit of speed', told)
            self.assertNotIn('"j"', told)
            tenon("convert", urdf, pathlib.Path(folder, "back.usda"))
            again = pathlib.Path(folder, "back.usda").read_text(encoding="utf-8")
            self.assertNotIn("1e9", again.replace("1000000000", "1e9"))
            self.assertIn("lowerLimit = -57.29578", again)

    def test_limits_of_speed_that_mjcf_lacks_are_told(self):
        with tempfile.TemporaryDirectory() as folder:
            asset = pathlib.Path(folder, "r.usda")
            pathlib.Path(folder, "a.urdf").write_text(self.ROBOT, encoding="utf-8")
            tenon("convert", pathlib.Path(folder, "a.urdf"), asset)
            _, answer = tenon("convert", asset, pathlib.Path(folder, "r.xml"))
            self.assertEqual([(d["severity"], d["prim"][-1]) for d in answer["diagnostics"]
                              if d["property"] == "velocityLimit"], [("warning", "j")])


class NamesOfImages(unittest.TestCase):
    """An image whose name no asset path can hold is skipped; the result can be read."""

    MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"
    ROBOT = ('<robot name="r"><material name="m"><texture filename="a%s.png"/></material>'
             '<link name="l"><visual><geometry><mesh filename="m.obj"/></geometry>'
             '<material name="m"/></visual></link></robot>').encode()
    # Their bytes in the description and in the name of the file.
    NAMES = {"plain": (b"b c", b"b c"), "at signs": (b"@@@@", b"@@@@"),
             "new line": (b"&#10;", b"\n"), "delete": (b"\x7f", b"\x7f"),
             "not UTF-8": (b"\xff", b"\xff")}
    GOOD = {"plain", "at signs"}

    def test_fit_into_asset_paths(self):
        image = ROOT / "tests/convert/urdf/stripes.png"
        for name, (written, own) in self.NAMES.items():
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                robot = pathlib.Path(folder, "r.urdf")
                robot.write_bytes(self.ROBOT % written)
                pathlib.Path(folder, "m.obj").write_text(self.MESH)
                with open(folder.encode() + b"/a" + own + b".png", "wb") as file:
                    file.write(image.read_bytes())
                for output in ("r.usda", "r.usdc", "asset/"):
                    code, answer = tenon("convert", robot, f"{folder}/{output}")
                    self.assertEqual(code, 0 if name in self.GOOD else 1, answer)
                    rules = {d["rule"] for d in answer["diagnostics"]}
                    self.assertEqual("read.unreadable" in rules, name not in self.GOOD)
                for asset in ("r.usda", "r.usdc", "asset/r.usda"):
                    done = subprocess.run([TENON, "cat", "--flatten", f"{folder}/{asset}"],
                                          capture_output=True, text=True, check=False)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual("inputs:file" in done.stdout, name in self.GOOD)


class Kinds(unittest.TestCase):
    """URDF and MJCF are told apart by the root element, whatever stands before it."""

    URDF = '<robot name="r"><link name="l"/></robot>'
    MJCF = '<mujoco model="m"><worldbody><geom size="1"/></worldbody></mujoco>'
    FRONTS = ["", "\ufeff", '<?xml version="1.0"?>\n', "<!-- <robot> and <mujoco>, or > -->",
              '<!DOCTYPE any [<!ELEMENT robot ANY> <!ELEMENT mujoco ANY>]>\n', "<!DOCTYPE mujoco>"]

    def test_by_the_root(self):
        with tempfile.TemporaryDirectory() as folder:
            for number, front in enumerate(self.FRONTS):
                for body in (self.URDF, self.MJCF):
                    robot = pathlib.Path(folder, f"r{number}.xml")
                    robot.write_text(front + body, encoding="utf-8")
                    code, answer = tenon("convert", robot, robot.with_suffix(".usda"), "--force")
                    with self.subTest(front=front, body=body):
                        if body == self.URDF:
                            self.assertEqual((code, answer["links"]), (0, 1), answer)
                        # MuJoCo's own reader takes no declarations in a document type.
                        for finding in answer["diagnostics"]:
                            self.assertFalse(finding["rule"].startswith("urdf."), finding)

    def test_what_is_neither_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            for text in ("", "<", "<!--", "<?", "<!DOCTYPE [", "<!", "mujoco", "<a><mujoco/></a>"):
                robot = pathlib.Path(folder, "r.xml")
                robot.write_text(text, encoding="utf-8")
                code, answer = tenon("convert", robot, robot.with_suffix(".usda"))
                self.assertEqual(code, 2, text)
                self.assertTrue(answer["diagnostics"][0]["rule"].startswith("urdf."), text)


class IntoAFolder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_gives_what_convert_and_structure_give(self):
        plain, two, one = self.folder / "plain.usda", self.folder / "two", self.folder / "one"
        self.assertEqual(tenon("convert", ROBOT, plain)[0], 0)
        self.assertEqual(tenon("structure", plain, "-o", two)[0], 0)
        self.assertEqual(tenon("convert", ROBOT, one)[0], 0)
        self.assertEqual(files_of(one), files_of(two))
        self.assertTrue(any(name.endswith(".png") for name in files_of(one)))
        code, answer = tenon("check", next(one.glob("*.usda")), "--profile", "isaac-3.0", "--only",
                             "structure")
        self.assertEqual((code, answer["diagnostics"]), (0, []))

    def test_the_output_may_be_named_by_an_option(self):
        one, two = self.folder / "one/robot.usda", self.folder / "two/robot.usda"
        one.parent.mkdir()
        two.parent.mkdir()
        self.assertEqual(tenon("convert", ROBOT, one)[0], 0)
        self.assertEqual(tenon("convert", ROBOT, "-o", two)[0], 0)
        self.assertEqual(tenon("convert", "--output", two, "--force", ROBOT)[0], 0)
        self.assertEqual(two.read_bytes(), one.read_bytes())
        self.assertEqual(tenon("convert", ROBOT, one, "-o", two)[0], 2)
        self.assertEqual(tenon("convert", ROBOT)[0], 2)

    def test_replaces_such_an_asset_and_nothing_else(self):
        target = self.folder / "robot.v2"  # a folder by its slash, whatever its name
        self.assertEqual(tenon("convert", ROBOT, f"{target}/")[0], 0)
        first = files_of(target)
        self.assertEqual(tenon("convert", ROBOT, target)[0], 0)
        self.assertEqual(files_of(target), first)
        (target / "notes.txt").write_text("mine")
        self.assertEqual(tenon("convert", ROBOT, f"{target}/", "--flat")[0], 2)
        self.assertEqual(files_of(target), {**first, "notes.txt": b"mine"})

    def test_gives_what_the_tutorial_has(self):
        hand, module = self.folder / "hand", self.folder / "Plastic_ABS.mdl"
        module.write_text("mdl 1.7;\nexport material Plastic_ABS() = material();\n")
        inertial = ('<inertial><origin xyz="-0.0 0 1e-18"/><mass value="1"/><inertia ixx="1" '
                    'iyy="1" izz="1"/></inertial>')
        look = ('<visual><geometry><box size="1 1 1"/></geometry><material name="Plastic_ABS">'
                '<texture filename="Plastic_ABS.mdl"/></material></visual>')
        links = "".join(f'<link name="{name}">{inertial}{look}</link>' for name in "abc")
        joints = "".join(
            f'<joint name="j{c}" type="revolute"><parent link="{p}"/><child link="{c}"/>'
            f'<origin xyz="0.1 -0.0 0.2" rpy="1.5707963267948966 0 {z}"/><axis xyz="0 0 1"/>'
            f'<limit lower="-0.0" upper="1" effort="1.5" velocity="2"/>{mimic}</joint>'
            for p, c, z, mimic in (("a", "b", 3.141592653589793, ""),
                                   ("b", "c", 0, '<mimic joint="jb" multiplier="0.5"/>')))
        robot = self.folder / "X.urdf"
        robot.write_text(f'<robot name="Lhand">{links}{joints}</robot>')
        code, answer = tenon("convert", robot, f"{hand}/", "--name", "inspire_hand", "--names",
                             "tutorial")
        self.assertEqual((code, [d for d in answer["diagnostics"] if d["severity"] != "info"]),
                         (0, []))
        files = {n: t.decode() for n, t in files_of(hand).items() if not n.startswith(".tenon/")}
        self.assertEqual(set(files), {
            "inspire_hand.usda", "Materials/Plastic_ABS.mdl", "payloads/base.usda",
            "payloads/material.usda", "payloads/robot.usda", "payloads/Physics/physics.usda",
            "payloads/Physics/physx.usda", "payloads/Physics/mujoco.usda"})
        for variant in ("none", "physics", "physx", "mujoco"):
            self.assertIn(f'"{variant}"', files["inspire_hand.usda"])
        for line in ('string[] isaac:changelog (\n        displayName = "Changelog"',
                     'string isaac:description (\n        displayName = "Description"',
                     'token isaac:license (\n        displayName = "License"',
                     'string isaac:namespace (\n        displayName = "Namespace"\n'
                     '        doc = "Namespace of the prim in Isaac Sim"',
                     'rel isaac:physics:robotJoints (\n        displayName = "Robot Joints"'):
            self.assertIn(line, files["payloads/robot.usda"])
        for line in ("custom float urdf:limit:effort = 1.5", "custom float urdf:limit:velocity = 2",
                     "rel physics:body0 = </inspire_hand/b>", 'displayName = "Actuator"',
                     'string isaac:NameOverride (', 'token[] isaac:physics:DofOffsetOpOrder ('):
            self.assertIn(line, files["payloads/Physics/physics.usda"])
        for line in ("dampingRatio = 0.005", "gearing = -0.5", "naturalFrequency = 25",
                     "offset = 0\n"):
            self.assertIn(line, files["payloads/Physics/physx.usda"])
        base = files["payloads/base.usda"]
        for line in ("quatf xformOp:orient = (0, 0, 0.70710677, 0.70710677)",
                     "float3 xformOp:scale = (1, 1, 1)", "translate = (0.1, 0, 0.2)",
                     '["xformOp:translate", "xformOp:orient", "xformOp:scale"]'):
            self.assertIn(line, base)
        for line in ("asset info:mdl:sourceAsset = @../Materials/Plastic_ABS.mdl@",
                     'token info:mdl:sourceAsset:subIdentifier = "Plastic_ABS"',
                     'token info:implementationSource = "sourceAsset"', 'renderType = "material"',
                     "token outputs:mdl:surface.connect = "
                     "</Materials/Plastic_ABS/Shader.outputs:out>"):
            self.assertIn(line, files["payloads/material.usda"])
        for name, text in files.items():
            self.assertNotRegex(text, r"[(= ]-0[,)\n]|\de-1[5-9]", name)
        again = self.folder / "again"
        self.assertEqual(tenon("structure", hand / "inspire_hand.usda", "-o", again, "--names",
                               "tutorial")[0], 0)
        self.assertEqual(files_of(again), files_of(hand))
        self.assertEqual(tenon("convert", robot, self.folder / "x.usda", "--names",
                               "tutorial")[0], 2)

    def test_check_has_nothing_against_links_below_links(self):
        inertial = ('<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial>'
                    '<collision><geometry><sphere radius="0.1"/></geometry></collision>')
        robot = self.folder / "r.urdf"
        robot.write_text(
            f'<robot name="r"><link name="a">{inertial}</link><link name="b">{inertial}</link>'
            '<joint name="j" type="revolute"><parent link="a"/><child link="b"/>'
            '<limit lower="0" upper="1" effort="100" velocity="1"/></joint></robot>')
        self.assertEqual(tenon("convert", robot, self.folder / "r/")[0], 0)
        code, answer = tenon("check", self.folder / "r/r.usda")
        found = {d["rule"]: d["severity"] for d in answer["diagnostics"]}
        self.assertEqual((code, found["body.nested"]), (0, "info"))
        self.assertEqual({rule for rule, how in found.items() if how != "info"}, set(), found)

    def test_a_format_that_is_none_is_no_folder(self):
        self.assertEqual(tenon("convert", ROBOT, self.folder / "robot.step")[0], 2)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
