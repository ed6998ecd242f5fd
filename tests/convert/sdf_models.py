#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Models of SDF: where their bodies and joints are, by closed forms, and what is told.

    sdf_models.py ROOT TENON
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
CORPUS = ROOT / "tests/convert/sdf"
FLOAT = 1e-7
HALF = math.sqrt(0.5)
MASS = ("<inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia>"
        "</inertial>")
BOX = "<geometry><box><size>0.1 0.2 0.3</size></box></geometry>"


def link(name, more="", mass=MASS):
    return f'<link name="{name}">{mass}{more}</link>'


def joint(name, kind, parent, child, more="<axis><xyz>0 0 1</xyz></axis>"):
    return (f'<joint name="{name}" type="{kind}"><parent>{parent}</parent><child>{child}</child>'
            f"{more}</joint>")


class Models(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.asset = self.folder / "m.usda"

    def run_tenon(self, *words):
        done = subprocess.run([TENON, *map(str, words), "--json"], capture_output=True, text=True,
                              check=False)
        return done.returncode, json.loads(done.stdout)

    def convert(self, file, *options):
        """The exit code and the answer; then `self.scene` is what an engine receives."""
        code, answer = self.run_tenon("convert", file, self.asset, "--force", *options)
        if code in (0, 1):
            _, self.scene = self.run_tenon("physics", self.asset)
        return code, answer

    def text(self, body, *options, version="1.9"):
        file = self.folder / "model.sdf"
        file.write_text(f'<sdf version="{version}">\n<model name="m">\n{body}\n</model>\n</sdf>\n',
                        encoding="utf-8")
        return self.convert(file, *options)

    def told(self, answer, rule):
        return [(found.get("line"), found["message"]) for found in answer["diagnostics"]
                if found["rule"] == rule]

    def failure(self, answer):
        """The error that ended it."""
        return answer["diagnostics"][-1]

    def named(self, kind, name):
        [found] = [x for x in self.scene[kind] if x["path"].endswith("/" + name)]
        return found

    def near(self, numbers, wanted, delta=FLOAT):
        self.assertEqual(len(numbers), len(wanted))
        for number, want in zip(numbers, wanted):
            self.assertAlmostEqual(number, want, delta=delta)

    def turned(self, quaternion, wanted):
        """The same rotation (w, x, y, z)."""
        self.assertAlmostEqual(abs(sum(a * b for a, b in zip(quaternion, wanted))), 1, delta=FLOAT)

    def axis_of(self, name):
        """The axis of a joint in the frame of its child."""
        found = self.named("joints", name)
        w, x, y, z = found["frame1"]["orientation"]
        return {"X": (1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)),
                "Y": (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
                "Z": (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))}[
                    found["axis"].upper()]


class Frames(Models):
    """tests/convert/sdf/arm.sdf, whose model is turned by 90 degrees about z and 0.5 m up."""

    def setUp(self):
        super().setUp()
        code, self.answer = self.convert(CORPUS / "arm.sdf")
        self.assertEqual(code, 0, self.answer)

    def test_bodies_are_where_the_pose_graph_has_them(self):
        # Model to world: (x, y, z) -> (-y, x, z + 0.5). The upper arm is at (0.05, 0, 0.3) with its
        # x down, so the elbow, 0.4 along it, is at (0.05, 0, -0.1).
        for name, wanted in (("base", (0, 0, 0.5)), ("upper", (0, 0.05, 0.8)),
                             ("slider", (0, 0.05, 0.4)), ("hand", (-0.0, 0.1, 0.4))):
            self.near(self.named("bodies", name)["position"], wanted, 1e-6)

    def test_rotations_are_multiplied_in_their_order(self):
        # About z by 90 degrees, then about y by 90.
        self.turned(self.named("bodies", "upper")["orientation"], (0.5, -0.5, 0.5, 0.5))

    def test_inertials_lie_in_their_link(self):
        self.near(self.named("bodies", "upper")["centerOfMass"], (0.2, 0, 0))

    def test_an_axis_is_turned_into_the_joint(self):
        # z of the model is -x of the upper arm; x of the elbow is -y of the slider.
        self.near(self.axis_of("turn"), (-1, 0, 0))
        self.near(self.axis_of("slide"), (0, -1, 0))

    def test_numbers_of_joints(self):
        turn = self.named("joints", "turn")
        self.near((turn["lower"], turn["upper"], turn["damping"], turn["friction"],
                   turn["velocityLimit"]), (-1.5, 2, 0.7, 0.2, 4), 1e-6)
        self.near(self.named("joints", "slide")["frame1"]["position"], (0.1, 0, 0))

    def test_the_world_is_the_root(self):
        mount = self.named("joints", "mount")
        self.assertIsNone(mount["body0"])
        self.near(mount["frame0"]["position"], (0, 0, 0.5))

    def test_frames_are_sites(self):
        _, tree = self.run_tenon("tree", self.asset)
        self.assertIn("shoulder", json.dumps(tree))
        self.assertIn("elbow", json.dumps(tree))


class Nested(Models):
    """tests/convert/sdf/gripper: includes, a merged one, a nested model."""

    def setUp(self):
        super().setUp()
        shutil.copytree(CORPUS, self.folder / "models")
        self.file = self.folder / "models/gripper/model.sdf"

    def test_includes_are_placed_by_their_frames(self):
        code, answer = self.convert(self.file)
        self.assertEqual(code, 0, answer)
        # root_frame, 2 cm below the finger, lies at the mount.
        self.near(self.named("bodies", "left__near")["position"], (0, 0.05, 0.12))
        self.turned(self.named("bodies", "left__near")["orientation"], (HALF, 0, 0, HALF))
        self.near(self.named("bodies", "left__far")["position"], (0, 0.05, 0.16))
        self.near(self.named("bodies", "near")["position"], (0, -0.05, 0.12))
        self.near(self.named("bodies", "far")["position"], (0, -0.05, 0.16))
        self.near(self.named("joints", "camera_base")["frame1"]["position"], (0.01, 0, 0))
        self.assertTrue(self.named("joints", "left__knuckle"))

    def test_the_newest_version_of_a_model_is_read(self):
        code, answer = self.convert(self.file)
        self.assertEqual(code, 0, answer)
        self.assertFalse([b for b in self.scene["bodies"] if b["path"].endswith("tip")])

    def test_meshes_are_found_by_the_model(self):
        code, answer = self.convert(self.file)
        self.assertEqual(code, 0, answer)
        self.assertEqual(answer["meshes"], 1)

    def test_a_model_elsewhere_is_named_with_what_to_type(self):
        shutil.move(self.folder / "models/finger", self.folder / "elsewhere")
        code, answer = self.convert(self.file)
        self.assertEqual(code, 2, answer)  # its links are missing
        code, answer = self.convert(self.file, "--package", f"finger={self.folder / 'elsewhere'}")
        self.assertEqual(code, 2, answer)  # ../finger is nowhere
        self.file.write_text(self.file.read_text(encoding="utf-8").replace("../finger", "finger"),
                             encoding="utf-8")
        code, answer = self.convert(self.file, "--package", f"finger={self.folder / 'elsewhere'}")
        self.assertEqual(code, 0, answer)

    def test_no_file_outside_is_included(self):
        secret = self.folder / "secret"
        secret.mkdir()
        (secret / "key.sdf").write_text('<sdf version="1.9"><model name="k">' + link("k") +
                                        "</model></sdf>", encoding="utf-8")
        inner = self.folder / "inner"
        inner.mkdir()
        file = inner / "model.sdf"
        for uri in ("../secret/key.sdf", str(secret / "key.sdf"), f"file://{secret}/key.sdf",
                    "model://secret/key.sdf"):
            file.write_text(f'<sdf version="1.9"><model name="m">{link("a")}<include><uri>{uri}'
                            "</uri></include></model></sdf>", encoding="utf-8")
            code, answer = self.convert(file)
            self.assertEqual(code, 1, (uri, answer))
            self.assertTrue(self.told(answer, "read.outside"), (uri, answer))
            self.assertEqual(len(self.scene["bodies"]), 1)

    def test_a_model_that_includes_itself_ends(self):
        folder = self.folder / "models/again"
        folder.mkdir()
        (folder / "model.config").write_text('<model><sdf version="1.9">model.sdf</sdf></model>',
                                             encoding="utf-8")
        (folder / "model.sdf").write_text(
            f'<sdf version="1.9"><model name="again">{link("a")}<include><uri>model://again</uri>'
            "<name>b</name></include></model></sdf>", encoding="utf-8")
        code, answer = self.convert(folder / "model.sdf")
        self.assertEqual((code, self.failure(answer)["rule"]), (2, "sdf.limit"))


class Joints(Models):
    def test_two_axes_become_two_joints(self):
        code, answer = self.convert(CORPUS / "joints.sdf")
        self.assertEqual(code, 0, answer)
        self.near(self.axis_of("universal_1"), (1, 0, 0))
        self.near(self.axis_of("universal_2"), (0, 1, 0))
        self.assertEqual(self.told(answer, "sdf.two-joints")[0][0], 10)
        between = self.named("bodies", "universal_between")
        self.assertAlmostEqual(between["mass"], 1e-6, delta=1e-12)
        self.near(between["position"], (1, 0, 0))

    def test_a_screw_slides_as_it_turns(self):
        self.convert(CORPUS / "joints.sdf")
        [mimic] = self.named("joints", "screw_slide")["mimics"]
        self.assertAlmostEqual(mimic["multiplier"], 0.01 / (2 * math.pi), delta=1e-9)

    def test_the_pitch_of_older_versions_counts_the_other_way(self):
        self.text(link("a") + link("b") +
                  joint("s", "screw", "a", "b", "<axis><xyz>0 0 1</xyz></axis>"
                        "<thread_pitch>100</thread_pitch>"), version="1.6")
        [mimic] = self.named("joints", "s_slide")["mimics"]
        self.assertAlmostEqual(mimic["multiplier"], -1 / 100, delta=1e-9)

    def test_axes_of_version_1_4_are_those_of_the_model(self):
        code, answer = self.convert(CORPUS / "finger/old.sdf")
        self.assertEqual(code, 0, answer)
        self.near(self.axis_of("bend"), (0, -1, 0))

    def test_a_joint_beside_the_tree_closes_a_loop(self):
        code, answer = self.convert(CORPUS / "bar.sdf")
        self.assertEqual(code, 0, answer)
        loop = self.named("joints", "dc")
        self.assertTrue(loop["excludeFromArticulation"])
        self.assertEqual(loop["type"], "revolute")
        self.near(loop["frame0"]["position"], (1, 0, 0))
        self.near(loop["frame1"]["position"], (0, 0, 0))

    def test_a_second_parent_that_hangs_on_nothing_becomes_a_child(self):
        code, answer = self.text(link("a") + link("b") + link("c", "<pose>0 0 1 0 0 0</pose>") +
                                 joint("ac", "fixed", "a", "c", "") +
                                 joint("bc", "revolute", "b", "c"))
        self.assertEqual(code, 0, answer)
        turned = self.named("joints", "bc")
        self.assertFalse(turned["excludeFromArticulation"])
        self.assertTrue(turned["body0"].endswith("/c"))
        self.near(self.axis_of("bc"), (0, 0, -1))

    def test_a_mimic_follows(self):
        mimic = ('<axis><xyz>0 0 1</xyz><mimic joint="ab"><multiplier>2</multiplier>'
                 "<offset>0.5</offset><reference>0.1</reference></mimic></axis>")
        code, answer = self.text(link("a") + link("b") + link("c") +
                                 joint("ab", "revolute", "a", "b") +
                                 joint("bc", "revolute", "b", "c", mimic), version="1.11")
        self.assertEqual(code, 0, answer)
        [found] = self.named("joints", "bc")["mimics"]
        self.near((found["multiplier"], found["offset"]), (2, 0.3), 1e-6)

    def test_a_gearbox_is_named(self):
        code, answer = self.text(link("a") + "\n" + link("b") + "\n" +
                                 joint("ab", "revolute", "a", "b") + "\n" +
                                 joint("g", "gearbox", "a", "b"))
        self.assertEqual(code, 1)
        self.assertEqual(self.told(answer, "sdf.joint-type")[0][0], 6)

    def test_a_rotor_of_drake_is_armature(self):
        self.text(link("a") + link("b") +
                  joint("ab", "revolute", "a", "b", "<axis><xyz>0 0 1</xyz></axis>"
                        "<drake:rotor_inertia>0.001</drake:rotor_inertia>"
                        "<drake:gear_ratio>10</drake:gear_ratio>"))
        self.assertAlmostEqual(self.named("joints", "ab")["armature"], 0.1, delta=1e-6)

    def test_no_limit_is_none(self):
        self.text(link("a") + link("b") +
                  joint("ab", "revolute", "a", "b", "<axis><xyz>0 0 1</xyz><limit><lower>-1e16"
                        "</lower><upper>inf</upper><effort>-1</effort></limit></axis>"))
        found = self.named("joints", "ab")
        self.assertEqual((found["lower"], found["upper"]), (None, None))


class Roots(Models):
    def test_a_free_robot_is_put_where_the_model_has_it(self):
        code, _ = self.text("<pose>0 0 0.4 0 0 0</pose>" + link("a") +
                            link("b", "<pose>1 0 0 0 0 0</pose>") +
                            joint("ab", "fixed", "a", "b", ""))
        self.assertEqual(code, 0)
        self.near(self.named("bodies", "a")["position"], (0, 0, 0.4))
        self.near(self.named("bodies", "b")["position"], (1, 0, 0.4))
        self.text("<pose>0 0 0.4 0 0 0</pose>" + link("a"), "--fix-base")
        self.near(self.named("joints", "fixed_base")["frame0"]["position"], (0, 0, 0.4))

    def test_several_free_links_are_side_by_side(self):
        code, answer = self.text(link("a") + link("b", "<pose>1 0 0 0 0 0</pose>"))
        self.assertEqual(code, 0, answer)
        self.assertEqual(len(self.scene["bodies"]), 2)
        self.assertEqual(self.scene["joints"], [])

    def test_a_static_model_has_no_bodies(self):
        code, answer = self.text("<static>true</static>" + link("a", f'<collision name="c">{BOX}'
                                 "</collision>") + link("b") + joint("ab", "revolute", "a", "b"))
        self.assertEqual(code, 0, answer)
        self.assertEqual((self.scene["bodies"], len(self.scene["colliders"])), ([], 1))

    def test_a_world_of_several_models_asks_which(self):
        file = self.folder / "w.sdf"
        file.write_text('<sdf version="1.9"><world name="w"><light name="sun" type="directional"/>'
                        f'<model name="one">{link("a")}</model>'
                        f'<model name="two">{link("b")}</model></world></sdf>', encoding="utf-8")
        code, answer = self.convert(file)
        self.assertEqual((code, self.failure(answer)["rule"]), (2, "sdf.model"))
        self.assertIn('"one", "two"', self.failure(answer)["message"])
        self.assertIn("--model one", self.failure(answer)["fix"])
        code, answer = self.convert(file, "--model", "two")
        self.assertEqual(code, 0, answer)
        self.assertTrue(self.named("bodies", "b"))
        self.assertEqual(self.convert(file, "--model", "three")[0], 2)

    def test_self_collide_is_that_of_the_model(self):
        for word in ("true", "false"):
            self.text(f"<self_collide>{word}</self_collide>" + link("a") + link("b") +
                      joint("ab", "revolute", "a", "b"))
            self.assertIn(f"enabledSelfCollisions = {int(word == 'true')}",
                          self.asset.read_text(encoding="utf-8"))

    def test_gravity_may_be_off(self):
        self.text(link("a", "<gravity>false</gravity>"))
        self.assertEqual(self.named("bodies", "a")["gravityScale"], 0)


class Shapes(Models):
    def test_sizes_surface_and_poses(self):
        shapes = ("<box><size>2 4 6</size></box>", "<sphere><radius>2</radius></sphere>",
                  "<cylinder><radius>1</radius><length>4</length></cylinder>",
                  "<capsule><radius>1</radius><length>4</length></capsule>",
                  "<plane><normal>1 0 0</normal></plane>")
        body = "".join(f'<collision name="c{i}"><pose>0 0 {i} 0 0 0</pose><geometry>{shape}'
                       "</geometry><surface><friction><ode><mu>0.25</mu><mu2>0.25</mu2></ode>"
                       "</friction><bounce><restitution_coefficient>0.5</restitution_coefficient>"
                       "</bounce></surface></collision>" for i, shape in enumerate(shapes))
        code, answer = self.text("<static>1</static>" + link("a", body))
        self.assertEqual(code, 0, answer)
        self.assertEqual(len(self.scene["colliders"]), 5)
        plane = self.named("colliders", "c4")
        self.turned(plane["orientation"], (HALF, 0, HALF, 0))
        self.assertIn("dynamicFriction = 0.25", self.asset.read_text(encoding="utf-8"))
        self.assertIn("restitution = 0.5", self.asset.read_text(encoding="utf-8"))

    def test_a_polyline_is_a_solid(self):
        corners = "".join(f"<point>{x} {y}</point>" for x, y in
                          ((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)))
        code, answer = self.text(link("a", '<visual name="v"><geometry><polyline>' + corners +
                                      "<height>0.5</height></polyline></geometry></visual>"))
        self.assertEqual(code, 0, answer)
        # 6 corners: 4 triangles below, 4 above, 12 around.
        text = self.asset.read_text(encoding="utf-8")
        self.assertIn("int[] faceVertexCounts = [" + ", ".join(["3"] * 20) + "]", text)

    def test_other_shapes_are_named(self):
        code, answer = self.text(link("a", '\n<visual name="v"><geometry><heightmap/></geometry>'
                                           "</visual>"))
        self.assertEqual(code, 1)
        [(line, message)] = self.told(answer, "sdf.shape")
        self.assertEqual(line, 4)
        self.assertIn("<heightmap> is unsupported", message)

    def test_a_link_without_inertial_weighs_what_sdf_says(self):
        code, answer = self.text(link("a", mass=""))
        self.assertEqual(code, 0, answer)
        self.assertTrue(self.told(answer, "sdf.default-inertial"))
        self.assertEqual(self.named("bodies", "a")["mass"], 1)

    def test_a_part_of_a_mesh(self):
        (self.folder / "m.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="utf-8")
        shape = ('<visual name="v"><geometry><mesh><uri>m.obj</uri><submesh><name>no</name>'
                 "</submesh></mesh></geometry></visual>")
        code, answer = self.text(link("a", shape))
        self.assertEqual(code, 1)
        self.assertTrue(self.told(answer, "convert.mesh-part"))

    def test_colours(self):
        def visual(material):
            return f'<visual name="v">{BOX}<material>{material}</material></visual>'
        self.text(link("a", visual("<diffuse>1 0 0 1</diffuse>")))
        self.assertIn("diffuseColor = (1, 0, 0)", self.asset.read_text(encoding="utf-8"))
        self.text(link("a", visual("<script><name>Gazebo/Blue</name></script>")))
        self.assertIn("diffuseColor = (0, 0, 1)", self.asset.read_text(encoding="utf-8"))


class Told(Models):
    def test_plugins_sensors_and_lights_are_named_one_by_one(self):
        code, answer = self.text(
            link("a", '<sensor name="eye" type="camera"/><light name="lamp" type="spot"/>') +
            '<plugin name="p" filename="libp.so"/>')
        self.assertEqual(code, 0, answer)
        told = " ".join(message for _, message in self.told(answer, "sdf.extension"))
        for word in ('the sensor "eye" (camera)', 'the light "lamp"', 'the plugin "p" (libp.so)'):
            self.assertIn(word, told)

    def test_faults_have_a_line(self):
        for body, rule, line in (
                (link("a") + "\n" + link("a"), "sdf.duplicate-name", 4),
                (link("a") + "\n" + joint("j", "fixed", "a", "no"), "sdf.frame-missing", 4),
                ('<frame name="f" attached_to="g"/>\n<frame name="g" attached_to="f"/>' +
                 link("a"), "sdf.cycle", 3),
                (link("a", '<pose relative_to="b"/>') + link("b", '<pose relative_to="a"/>'),
                 "sdf.cycle", 3),
                (link("a") + "\n" + link("b", "<pose>1 2</pose>"), "sdf.number", 4),
                (link("a") + "\n" + link("b") + joint("j", "gear", "a", "b"), "sdf.joint-type", 4),
                (link("a", "<gravity>maybe</gravity>"), "sdf.flag", 3),
                (link("a", "<pose>0 0 0 0 0 inf</pose>"), "sdf.pose", 3),
                (link("a") + "<link>", "sdf.xml", 4)):
            code, answer = self.text(body)
            self.assertEqual((code, self.failure(answer)["rule"], self.failure(answer)["line"]),
                             (2, rule, line), answer)

    def test_other_verbs_say_what_it_is(self):
        code, answer = self.run_tenon("info", CORPUS / "arm.sdf")
        self.assertEqual(code, 2)
        self.assertIn("an SDF model", json.dumps(answer))
        self.assertIn("tenon convert", json.dumps(answer))

    def test_what_is_no_option_of_the_format_is_refused(self):
        code, answer = self.convert(ROOT / "examples/cpp/robots/arm.urdf", "--model", "arm")
        self.assertEqual((code, self.failure(answer)["rule"]), (2, "convert.option"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
