#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What new users stumble over: files of other formats, options in other words, texts that mislead.

    test_first_steps.py ROOT TENON
"""

import json
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())

ARM = """<?xml version="1.0"?>
<robot name="arm">
  <link name="{root}">
    <inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision>
  </link>
  <link name="upper">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry>{shape}</geometry></collision>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="{root}"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="1.5" effort="20" velocity="{velocity}"/>
  </joint>
</robot>
"""
MJCF = """<!-- a model -->
<mujoco model="m"><worldbody><body name="b" pos="0 0 1"><freejoint/><geom size="0.1"/></body>
</worldbody></mujoco>"""
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"

# Contents and what a message has to call them.
FOREIGN = {
    "robot.urdf": (ARM.format(root="base", shape='<box size="1 1 1"/>', velocity=1), "a URDF",
                   "tenon convert robot.urdf out/"),
    "model.xml": (MJCF, "an MJCF model", "tenon convert model.xml out/"),
    "world.sdf": ('<?xml version="1.0"?><sdf version="1.9"><model name="m"/></sdf>',
                  "an SDF model", "tenon convert world.sdf out/"),
    "robot.urdf.xacro": ('<robot name="r" xmlns:xacro="x"><xacro:macro name="m"/></robot>',
                         "a URDF with macros of xacro", "tenon convert robot.urdf.xacro out/"),
    "can.obj": ("# a can\n" + TETRAHEDRON, "an OBJ mesh", "can.obj"),
    "can.stl": ("solid can\n facet normal 0 0 1\n outer loop\n", "an STL mesh", "can.stl"),
    "binary.stl": (b"\xff" * 80 + struct.pack("<I", 1) + bytes(50), "an STL mesh", "binary.stl"),
    "can.gltf": ('{"asset": {"version": "2.0"}}', "a glTF mesh", "can.gltf"),
    "can.glb": (b"glTF" + struct.pack("<II", 2, 12), "a glTF mesh", "can.glb"),
}

# Verbs that read an asset, with what they want beside it; every verb is in one of the two.
READS = {
    "add": ["/World/box=cube"], "bake": ["-o", "baked.usda"], "bench": [],
    "benchmark": [], "cat": [], "check": [],
    "colliders": [], "compare": [], "diff": ["{file}"], "dump": [], "drives": [], "dump-index": [],
    "explain": ["/World"], "inertia": [], "info": [], "pairs": [], "physics": [],
    "pose": [],
    "record": ["-o", "film.png"], "remove": ["/World"],
    "rename": ["/World", "Other"], "report": ["-o", "page.html"], "set": ["/World.a=1"], "sim": [],
    "strip": ["-o", "stripped.usda"], "structure": ["-o", "structured/"], "tree": [],
    "tune": [],
    "variant": [], "view": ["--screenshot", "picture.png"], "where": ["/World.a"],
    "zip": ["-o", "packed.usdz"],
}
OTHERS = {"completion", "convert", "doctor", "excite", "help", "identify", "manual", "new",
          "sweep", "test-runner", "undo", "version"}


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, contents):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(contents if isinstance(contents, bytes) else contents.encode())
        return path

    def tenon(self, *arguments, code=0):
        process = subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                                 cwd=self.folder, check=False)
        if code is not None:
            self.assertEqual(process.returncode, code, process.stdout + process.stderr)
        return process

    def json(self, *arguments, code=0):
        return json.loads(self.tenon(*arguments, "--json", code=code).stdout)

    def arm(self, name="arm.urdf", root="base", shape='<box size="0.1 0.1 0.3"/>', velocity=3):
        return self.write(name, ARM.format(root=root, shape=shape, velocity=velocity))


class OtherFormats(Case):
    def test_every_verb_that_reads_names_the_format_and_what_to_run(self):
        verbs = {verb["name"] for verb in self.json("help")["verbs"]}
        self.assertLessEqual(verbs, READS.keys() | OTHERS, "a verb without a row here")
        for name, (contents, called, advice) in FOREIGN.items():
            self.write(name, contents)
        for verb, extra in READS.items():
            if verb not in verbs:
                continue
            # Every format in the verb that is used most, one of each kind in the others.
            names = FOREIGN if verb == "info" else ("robot.urdf", "can.obj")
            for name in names:
                with self.subTest(verb=verb, name=name):
                    _, called, advice = FOREIGN[name]
                    arguments = [text.format(file=name) for text in extra]
                    process = self.tenon(verb, name, *arguments, code=None)
                    if process.returncode == 4:
                        continue  # what the verb needs is not installed, and that is said first
                    self.assertEqual(process.returncode, 2, process.stderr)
                    text = process.stdout + process.stderr
                    self.assertIn(called, text)
                    self.assertIn(advice, text)
                    self.assertNotIn("add the line", text)

    def test_convert_names_meshes(self):
        for name in ("can.obj", "can.stl", "binary.stl", "can.glb", "can.gltf"):
            contents, called, _ = FOREIGN[name]
            self.write(name, contents)
            process = self.tenon("convert", name, "out.usda", code=2)
            self.assertIn(called, process.stderr)
            self.assertNotIn("document element", process.stderr)

    def test_the_advice_works(self):
        self.arm("robot.urdf")
        text = self.tenon("info", "robot.urdf", code=2).stderr
        command = re.search(r"`tenon (convert .*?)`", text).group(1)
        self.tenon(*command.split())
        self.assertTrue((self.folder / "out/arm.usda").exists())

    def test_a_macro_in_a_mesh_name_is_called_a_xacro(self):
        self.arm(shape='<mesh filename="$(arg meshes)/x.STL"/>')
        text = self.tenon("convert", "arm.urdf", "arm.usda", code=1).stderr
        self.assertIn("unexpanded xacro", text)
        self.assertNotIn("put the file", text)


class Conversion(Case):
    def test_a_root_that_floats_is_told_with_the_option_that_holds_it(self):
        self.arm()
        self.assertIn("--fix-base", self.tenon("convert", "arm.urdf", "arm/").stderr)
        rules = [d["rule"] for d in self.json("convert", "arm.urdf", "b/")["diagnostics"]]
        self.assertIn("convert.free-root", rules)
        for option in ("--fix-base", "--float-base"):
            text = self.tenon("convert", "arm.urdf", f"arm{option}/", option).stderr
            self.assertNotIn("free to move", text)
        self.arm("world.urdf", root="base_link")
        self.assertNotIn("free to move", self.tenon("convert", "world.urdf", "w/").stderr)

    def test_it_names_the_file_to_open(self):
        self.arm()
        text = self.tenon("convert", "arm.urdf", "out/").stderr
        opened = re.search(r"wrote (\S+): 2 links, 1 joint, 0 mesh files", text).group(1)
        self.tenon("info", opened)
        for output in ("back.xml", "back.urdf"):
            self.assertIn(f"wrote {output}: ", self.tenon("convert", opened, output).stderr)

    def test_a_converted_asset_is_used_without_a_word_about_scenes(self):
        self.arm()
        self.tenon("convert", "arm.urdf", "arm.usda", "--fix-base")
        for verb in (["info"], ["tree"], ["sim", "--duration", "0.01"], ["physics"], ["check"]):
            process = self.tenon(verb[0], "arm.usda", *verb[1:], code=None)
            self.assertNotIn("scene.missing", process.stdout + process.stderr, verb)
            told = [d for d in self.json(verb[0], "arm.usda", *verb[1:], code=None)["diagnostics"]
                    if d["rule"] == "scene.missing"]
            self.assertEqual([d["severity"] for d in told], [] if verb == ["tree"] else ["info"],
                             verb)

    def test_no_verb_has_a_word_about_the_scene_that_conversion_leaves_out(self):
        self.arm()
        self.tenon("convert", "arm.urdf", "made.usda", "--fix-base")
        short = {verb: ["--duration", "0.01"] for verb in ("bake", "bench", "report", "sim")}
        short["compare"] = ["--duration", "0.01", "--engines", "mujoco,mujoco"]
        short["benchmark"] = ["--tests", "ground_drop"]
        rows = {verb: behind for verb, behind in READS.items() if verb not in ("record", "view")}
        for verb, behind in [*rows.items(), ("convert", ["back.xml"]), ("convert", ["back.urdf"])]:
            shutil.copy(self.folder / "made.usda", self.folder / "arm.usda")
            words = [word.format(file="made.usda").replace("/World", "/arm").replace(
                ".a=1", ".visibility=inherited").replace(".a", ".visibility") for word in behind]
            process = self.tenon(verb, "arm.usda", *words, *short.get(verb, []), code=None)
            self.assertNotEqual(process.returncode, 2, process.stderr)
            self.assertNotIn("scene.missing", process.stdout + process.stderr, verb)

    def test_urdf_of_joints_without_a_speed_limit_lets_them_move(self):
        self.write("arm.xml", """<mujoco model="r"><worldbody><body name="a">
            <geom size="0.1"/><body name="b" pos="0 0 1"><joint name="j" axis="0 1 0" range="-60 60"
            limited="true"/><geom size="0.1"/></body></body></worldbody></mujoco>""")
        self.tenon("convert", "arm.xml", "arm.usda")
        self.tenon("convert", "arm.usda", "arm.urdf")
        text = (self.folder / "arm.urdf").read_text()
        limits = re.findall(r"<limit[^>]*>", text)
        self.assertTrue(limits)
        for limit in limits:
            for name in ("velocity", "effort"):
                self.assertGreater(float(re.search(rf'{name}="([^"]*)"', limit).group(1)), 1e6)
        again = self.json("convert", "arm.urdf", "again.usda")
        self.assertNotIn("urdf.zero-limit", [d["rule"] for d in again["diagnostics"]])
        joints = self.json("physics", "again.usda")["joints"]
        self.assertEqual([d["maxForce"] for j in joints for d in j["drives"]
                          if d["maxForce"] is not None], [])

    def test_missing_meshes_of_a_folder_are_one_short_finding(self):
        links = "".join(
            f'<link name="{folder}{i}"><visual><geometry><mesh filename="../../{folder}/m/'
            f'part{i}.stl"/></geometry></visual></link><joint name="j{folder}{i}" type="fixed">'
            f'<parent link="base"/><child link="{folder}{i}"/></joint>'
            for i in range(20) for folder in ("left", "right"))
        self.write("a/robot/r.urdf", f'<robot name="r"><link name="base"/>{links}</robot>')
        found = [d for d in self.json("convert", "a/robot/r.urdf", "r.usda", code=1)["diagnostics"]
                 if d["rule"] == "urdf.mesh-missing"]
        self.assertEqual(len(found), 2, found)
        for finding, folder in zip(found, ("left", "right")):
            self.assertIn("20 meshes", finding["message"])
            self.assertIn(f"../../{folder}/m/", finding["message"])
            self.assertLess(len(finding["message"]), 200)

    def test_one_run_with_the_advice_finds_all_meshes(self):
        links = ""
        for folder in ("left", "right"):
            for i in range(5):
                self.write(f"{folder}/deep/part{i}.obj", TETRAHEDRON)
                links += (f'<link name="{folder}{i}"><visual><geometry><mesh filename="../../'
                          f'{folder}/deep/part{i}.obj"/></geometry></visual></link><joint name='
                          f'"j{folder}{i}" type="fixed"><parent link="base"/><child link="{folder}'
                          f'{i}"/></joint>')
        self.write("a/robot/r.urdf", f'<robot name="r"><link name="base"/>{links}</robot>')
        answer = self.json("convert", "a/robot/r.urdf", "r.usda", code=None)
        errors = [d for d in answer["diagnostics"] if d["severity"] == "error"]
        self.assertEqual(len(errors), 2, errors)
        options = re.findall(r"--allow-read (\S+)", errors[0]["fix"])
        self.assertEqual(len(options), 2, errors)
        arguments = [part for option in options for part in ("--allow-read", option)]
        answer = self.json("convert", "a/robot/r.urdf", "r2.usda", *arguments)
        self.assertEqual([d for d in answer["diagnostics"] if d["severity"] == "error"], [])

    def test_a_zip_of_a_model_has_one_finding_for_kept_meshes(self):
        geoms = ""
        assets = ""
        for i in range(12):
            self.write(f"m{i}.obj", TETRAHEDRON)
            assets += f'<mesh name="m{i}" file="m{i}.obj"/>'
            geoms += f'<geom type="mesh" mesh="m{i}" pos="{i} 0 0"/>'
        self.write("r.xml", f'<mujoco model="r"><asset>{assets}</asset><worldbody><body name="a">'
                            f"<freejoint/>{geoms}</body></worldbody></mujoco>")
        self.tenon("convert", "r.xml", "r/", code=None)
        answer = self.json("zip", "r/r.usda", "-o", "r.usdz", code=None)
        found = [d for d in answer["diagnostics"] if d["rule"] == "package.file-type"]
        self.assertLessEqual(len(found), 1, found)
        for finding in found:
            self.assertIn("11 more of type .obj", finding["message"])


class Filters(Case):
    SCENE = """#usda 1.0
(
    defaultPrim = "World"
    upAxis = "Z"
)
def "World"
{
%s}
class "Shape"
{
    def Cube "box" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
        double size = 1
    }
}
"""
    BODY = """    def Xform "%s" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])
    {
        double3 xformOp:translate = (%s, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def "shape" (
            instanceable = true
            references = </Shape>
        )
        {
        }
    }
"""

    def setUp(self):
        super().setUp()
        bodies = "".join(self.BODY % (name, 0.3 * i) for i, name in enumerate("abc"))
        self.write("s.usda", self.SCENE % bodies)

    def overlaps(self):
        return [d for d in self.json("check", "s.usda", code=None)["diagnostics"]
                if d["rule"] == "collider.overlap-at-start"]

    def test_colliders_in_instances_stand_for_their_bodies(self):
        for _ in range(3):  # pairs of three bodies, by the first of each finding
            finding = self.overlaps()[0]
            other = re.search(r"/World/\w+/shape/box", finding["message"]).group(0)
            self.tenon("set", "s.usda", "--filter", f"{finding['prim']},{other}")
        self.assertEqual(self.overlaps(), [])
        text = (self.folder / "s.usda").read_text()
        self.assertIn("</World/b>", text)
        self.assertNotIn("shape/box>", text)

    def test_each_pair_is_told_and_many_are_counted(self):
        self.assertEqual(len(self.overlaps()), 3)
        instances = "".join(
            f'def Xform "{name}" (\ninstanceable = true\nreferences = </Part>\n)\n{{\n'
            f"double3 xformOp:translate = ({0.1 * i}, 0, 0)\n"
            'uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
            for i, name in enumerate("abc"))
        part = ('class "Part"\n{\ndef Cube "box" (prepend apiSchemas = ["PhysicsCollisionAPI",'
                '"PhysicsRigidBodyAPI"])\n{\n}\n}\n')
        self.write("s.usda", self.SCENE % instances + part)
        self.assertEqual(len(self.overlaps()), 3)  # of one place in the file
        bodies = "".join(self.BODY % (f"b{i}", 0.001 * i) for i in range(20))
        self.write("s.usda", self.SCENE % bodies)
        found = self.overlaps()
        self.assertEqual(len(found), 100)
        self.assertEqual(sum("and 90 more pairs overlap" in d["message"] for d in found), 1)
        self.tenon("set", "s.usda", "--filter-overlaps")
        self.assertEqual(self.overlaps(), [])

    def test_all_of_them_in_one_command(self):
        fix = self.overlaps()[0]["fix"]
        command = re.search(r"`tenon (set .*?)`", fix).group(1).replace("ASSET", "s.usda")
        self.tenon(*command.split())
        self.assertEqual(self.overlaps(), [])
        before = (self.folder / "s.usda").read_bytes()
        self.assertIn("nothing to filter", self.tenon(*command.split()).stderr)
        self.assertEqual((self.folder / "s.usda").read_bytes(), before)

    def test_two_colliders_of_one_body_are_refused(self):
        pair = "/World/a/shape/box,/World/a"
        text = self.tenon("set", "s.usda", "--filter", pair, code=2).stderr
        self.assertIn("of one body", text)


class Mistakes(Case):
    """What is typed wrongly: the first line says what to type."""

    def test_files_that_are_none(self):
        self.arm()
        self.tenon("convert", "arm.urdf", "arm/")
        folder = "this is a folder, not a file; name the file in it: arm/arm.usda"
        for name, told in (("arm", folder), ("arm/payloads", "name a file in it"),
                           ("arm/amr.usda", "did you mean arm/arm.usda?"),
                           ("https://localhost/a.usda", "URLs are not opened")):
            for verb in ("info", "sim"):
                self.assertIn(told, self.tenon(verb, name, code=2).stderr)
        text = self.tenon("convert", "arn.urdf", "x/", code=2).stderr
        self.assertIn("did you mean arm.urdf?", text)
        found = self.json("info", "arm", code=2)["diagnostics"][0]
        self.assertEqual(found["fix"], "name the file in it: arm/arm.usda")

    def test_an_empty_file_is_called_empty(self):
        for verb, name in (("info", "e.usda"), ("convert", "e.urdf")):
            self.write(name, "")
            text = self.tenon(verb, name, *(["x/"] if verb == "convert" else []), code=2).stderr
            self.assertIn("the file is empty", text)

    def test_verbs_of_other_tools(self):
        for typed, verb in (("simulate", "sim"), ("validate", "check"), ("export", "convert"),
                            ("Lint", "check"), ("chek", "check")):
            self.assertIn(f'did you mean "{verb}"?', self.tenon(typed, "a.usda", code=2).stderr)

    def test_a_name_for_a_path(self):
        self.arm()
        self.tenon("convert", "arm.urdf", "arm.usda")
        text = self.tenon("explain", "arm.usda", "shoulder", code=2).stderr
        meant = re.search(r"did you mean (\S+)\?", text).group(1)
        self.tenon("explain", "arm.usda", meant)

    def test_a_rule_that_is_mistyped(self):
        text = self.tenon("explain", "joint.outside-limits", code=2).stderr
        self.assertIn('did you mean "joint.outside-limit"?', text)

    def test_standard_input_where_a_file_is_needed(self):
        text = self.tenon("check", "-", code=2).stderr
        self.assertIn("does not read standard input (-)", text)

    def test_a_fixed_joint_has_no_degree_of_freedom(self):
        joint = '    def PhysicsFixedJoint "j"\n    {\n    }\n'
        self.write("s.usda", Filters.SCENE % joint)
        text = self.tenon("add", "s.usda", "/World/j=drive", "--stiffness", "1", code=2).stderr
        self.assertIn("</World/j> is fixed: it has no degree of freedom", text)

    def test_what_is_undone_is_named_by_its_whole_path(self):
        self.tenon("new", "s.usda")
        self.assertNotIn("../", self.tenon("undo", "s.usda", code=None).stderr)

    def test_a_mesh_for_a_structured_asset_names_the_file_that_takes_it(self):
        self.arm()
        self.tenon("convert", "arm.urdf", "arm/")
        self.write("m.obj", TETRAHEDRON)
        arguments = ["add", "arm/arm.usda", "/arm/m=mesh", "--file", "m.obj"]
        told = self.json(*arguments, code=2)["diagnostics"][-1]
        self.assertEqual(told["rule"], "edit.no-file")
        self.tenon(*arguments, "--in", told["fix"].split(": ")[1])


class Quiet(Case):
    """A robot of many links does not print as many lines."""

    def robot_of_many_links(self):
        parts = "".join(
            f'<link name="l{i}"/><joint name="j{i}" type="revolute"><parent link="base"/><child '
            f'link="l{i}"/><limit lower="-{i}.5" upper="1" effort="0" velocity="1"/></joint>'
            f'<sensor name="s{i}"><parent link="l{i}"/></sensor>' for i in range(30))
        self.write("r.urdf", f'<robot name="r"><link name="base"/>{parts}</robot>')
        return self.tenon("convert", "r.urdf", "r/").stderr

    def test_three_lines_of_a_kind(self):
        text = self.robot_of_many_links()
        self.assertLess(len(text.splitlines()), 20, text)
        self.assertEqual(text.count("[urdf.zero-limit]"), 3, text)
        self.assertIn("and 27 more like it", text)
        self.assertIn('the sensor "s0" without a type', text)

    def test_long_values_are_cut(self):
        self.robot_of_many_links()
        text = self.tenon("add", "r/r.usda", "/r/b=cube,body,collider").stdout
        self.assertIn("characters in all)", text)
        self.assertLess(max(map(len, text.splitlines())), 700)

    def test_a_simulation_lists_joints_that_move(self):
        self.arm()
        self.tenon("convert", "arm.urdf", "arm.usda", "--fix-base")
        text = self.tenon("sim", "arm.usda", "--engine", "mujoco", "--duration", "0.01").stdout
        joints = text[text.index("joint positions"):text.index("body positions")].splitlines()[1:]
        self.assertEqual([line.split()[0] for line in joints], ["/arm/Physics/shoulder"])

    def test_structure_names_the_file_to_open(self):
        self.arm()
        self.tenon("convert", "arm.urdf", "arm.usda")
        text = self.tenon("structure", "arm.usda", "-o", "made").stderr
        self.tenon("info", re.search(r"wrote (\S+): \d+ files", text).group(1))


class Packages(Case):
    def test_a_missing_mesh_of_a_package_that_is_there(self):
        mesh = '<visual><geometry><mesh filename="package://shop/{}.obj"/></geometry></visual>'
        self.write("shop/a.obj", TETRAHEDRON)
        self.write("r.urdf", '<robot name="r"><link name="a">' + mesh.format("a") +
                   mesh.format("b") + "</link></robot>")
        (found,) = [d for d in self.json("convert", "r.urdf", "r/", code=1)["diagnostics"]
                    if d["rule"] == "urdf.mesh-missing"]
        self.assertRegex(found["fix"], r'^put "b.obj" into the package\'s folder, shop, or give ')


class Words(Case):
    def test_set_names_the_part_that_is_wrong(self):
        joint = '    def PhysicsRevoluteJoint "j"\n    {\n    }\n'
        self.write("s.usda", Filters.SCENE % joint)
        for option, value, told in (
                ("--drive", "/World/j=naturalFrequency:30", "unknown key \"naturalFrequency\""),
                ("--drive", "j=stiffness:1", "\"j\" is not the path of a prim"),
                ("--drive", "/World/j", "no ="),
                ("--drive", "/World=stiffness:1", "neither a revolute nor a prismatic joint"),
                ("--mass", "/World=heavy", "the mass \"heavy\""),
                ("--filter", "/World", "not two paths")):
            text = self.tenon("set", "s.usda", option, value, code=2).stderr
            self.assertIn(told, text)
            self.assertNotIn("does not say what to do", text)

    def test_other_names_of_kinds_are_known(self):
        self.tenon("new", "s.usda")
        for other, kind in (("box", "cube"), ("hinge", "revolute"), ("slider", "prismatic"),
                            ("colider", "collider")):
            text = self.tenon("add", "s.usda", f"/World/x={other}", code=2).stderr
            self.assertIn(f'unknown kind "{other}"; did you mean "{kind}"?', text)
            self.assertLess(len(text), 200)

    def test_kinds_stand_in_a_table(self):
        text = self.tenon("help", "add").stdout
        rows = text[text.index("Kinds"):].split("\n")
        names = [m.group(1) for row in rows if (m := re.match(r"  (\S+)  +\S", row))]
        self.assertGreater(len(names), 30)
        self.assertIn("revolute", names)
        for row in rows[2:]:
            self.assertRegex(row, r"^(  \S+  +\S.*| {18,}\S.*|)$")

    def test_help_refers_to_lists_that_are_there(self):
        for verb in self.json("help")["verbs"]:
            text = self.tenon("help", verb["name"]).stdout
            self.assertNotIn("of those below", text, verb["name"])
            if "--reading" in text and verb["name"] != "physics":
                self.assertIn("tenon help physics", text, verb["name"])
        self.assertIn("Where readers of UsdPhysics disagree", self.tenon("help", "physics").stdout)

    def test_one_of_a_thing_is_singular(self):
        self.arm()
        self.tenon("convert", "arm.urdf", "arm.usda", "--scene", "--fix-base")
        text = self.tenon("info", "arm.usda").stdout
        self.assertIn("1 articulation\n", text)
        self.assertIn("1 degree of freedom,", text)
        plurals = ("scenes|bodies|articulations|drives|limits|mimics|layers|steps|contacts|files|"
                   "environments|threads|rows|columns|frames|triangles")
        self.assertNotRegex(text, rf"\b1 ({plurals})\b")
        commands = self.write("go.csv", "time,/arm/Physics/shoulder.target\n0,1\n")
        for words in (("sim", "arm.usda", "--duration", "0.002"),
                      ("sim", "arm.usda", "--duration", "0.002", "--commands", commands),
                      ("zip", "arm.usda", "-o", "arm.usdz"),
                      ("bench", "arm.usda", "--duration", "0.002", "--threads", "1"),
                      ("report", "arm.usda", "--duration", "0", "-o", "arm.html"),
                      ("bake", "arm.usda", "--duration", "0", "-o", "m.usda"),
                      *((verb, "arm.usda") for verb, more in READS.items()
                        if not more and verb not in ("bench", "sim", "benchmark", "compare"))):
            done = self.tenon(*words, code=None)
            self.assertNotRegex(done.stdout + done.stderr, rf"\b1 ({plurals})\b",
                                words)

    def test_absolute_names_stay_absolute(self):
        inside = self.folder / "far/away"
        inside.mkdir(parents=True)
        for argument in ("/etc/passwd", "/etc"):
            process = subprocess.run([TENON, "info", argument], cwd=inside, capture_output=True,
                                     text=True, check=False)
            self.assertTrue(process.stderr.startswith(argument), process.stderr)
        self.write("x.txt", "nothing")
        process = subprocess.run([TENON, "info", "../../x.txt"], cwd=inside, capture_output=True,
                                 text=True, check=False)
        self.assertTrue(process.stderr.startswith("../../x.txt:1:1"), process.stderr)

    def test_both_streams_in_one_log_keep_their_lines(self):
        body = """    def Cube "c%d" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    )
    {
        double3 xformOp:translate = (%d, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
"""
        self.write("s.usda", Filters.SCENE % "".join(body % (i, 3 * i) for i in range(80)))
        for options, lines in (([], 3), (["-v"], 80)):
            command = [TENON, "check", "s.usda", "s.usda", *options]
            parts = subprocess.run(command, cwd=self.folder, capture_output=True, check=False)
            log = self.folder / "log"
            with log.open("wb") as stream:
                subprocess.run(command, cwd=self.folder, stdout=stream, stderr=stream, check=False)
            whole = parts.stdout.split(b"\n") + parts.stderr.split(b"\n")
            self.assertGreater(len(whole), lines)
            self.assertEqual(sorted(line for line in log.read_bytes().split(b"\n") if line),
                             sorted(line for line in whole if line))

    def test_a_mesh_weighs_what_its_density_says(self):
        self.write("m.obj", TETRAHEDRON)
        self.arm(shape='<mesh filename="m.obj"/>')
        self.tenon("convert", "arm.urdf", "arm.usda")
        paths = [c["path"] for c in self.json("physics", "arm.usda")["colliders"]
                 if c["shape"] in ("convexHull", "mesh")]
        self.assertEqual(len(paths), 1)
        text = self.tenon("explain", "arm.usda", paths[0].rsplit("/", 1)[0], code=None).stdout + \
            self.tenon("explain", "arm.usda", paths[0]).stdout
        self.assertNotIn("mass 0 kg", text)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
