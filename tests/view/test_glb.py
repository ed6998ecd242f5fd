#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon bake -o motion.glb: a reader of our own holds the file to glTF, and what it says to what
tenon physics and the log of the same run say.

usage: test_glb.py TENON
"""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from glb_file import Glb

TENON = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2]
GRASP = ROOT / "examples/inspire_hand/grasp.usda"
RUN = ["--physics", "mujoco", "--duration", "0.5", "--fps", "20"]

PLAIN = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def Sphere "ball" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
        double radius = 0.5
    }
    def Mesh "sheet"
    {
        uniform bool doubleSided = 1
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0, 0, -1), (1, 0, -1), (0, 1, -1)]
    }
}
"""


def tenon(*arguments):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False, timeout=120)


class MotionGlb(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.kept = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.kept.name)
        done = tenon("bake", GRASP, *RUN, "-o", cls.folder / "m.glb")
        assert done.returncode == 0, done.stderr
        cls.glb = Glb((cls.folder / "m.glb").read_bytes())
        cls.said = cls.glb.json["scenes"][0]["extras"]["tenon"]

    @classmethod
    def tearDownClass(cls):
        cls.kept.cleanup()

    def test_the_file_holds_to_gltf(self):
        self.glb.check()
        self.assertNotIn("extensionsUsed", self.glb.json)

    def test_bodies_joints_and_colliders_are_those_of_tenon_physics(self):
        scene = json.loads(tenon("physics", GRASP, "--physics", "mujoco", "--json").stdout)
        for kind in ("bodies", "joints", "colliders"):
            self.assertEqual([one["path"] for one in self.said[kind]],
                             [one["path"] for one in scene[kind]] if kind != "colliders" else [])
        for body, other in zip(self.said["bodies"], scene["bodies"]):
            self.assertAlmostEqual(body["mass"], other["mass"], places=9)

    def test_bodies_move_as_in_the_log(self):
        log = self.folder / "log.csv"
        self.assertEqual(tenon("sim", GRASP, *RUN, "-o", log).returncode, 0)
        rows = list(csv.DictReader(log.read_text(encoding="utf-8").splitlines()))
        times, places = self.glb.channel(self.glb.node_of("/World/can"), "translation")
        self.assertEqual(len(times), len(rows))
        for row, time, place in zip(rows, times, places):
            self.assertAlmostEqual(float(row["time"]), time, places=5)
            for axis, value in zip("xyz", place):
                self.assertAlmostEqual(float(row[f"/World/can.position.{axis}"]), value, places=5)

    def test_what_stands_still_has_no_channel(self):
        self.assertIsNone(self.glb.channel(self.glb.node_of("/World/table"), "rotation"))

    def test_simplify_draws_fewer_triangles_and_compress_takes_fewer_bytes(self):
        def triangles(path):
            gltf = Glb(path.read_bytes()).json
            corners = [gltf["accessors"][part["indices"]]["count"]
                       for node in gltf["nodes"] if "mesh" in node
                       for part in gltf["meshes"][node["mesh"]]["primitives"]]
            return sum(corners) // 3
        few, small = self.folder / "few.glb", self.folder / "small.glb"
        self.assertEqual(tenon("bake", GRASP, *RUN, "--simplify", "1500", "-o", few).returncode, 0)
        self.assertEqual(tenon("bake", GRASP, *RUN, "--compress", "-o", small).returncode, 0)
        self.assertGreater(triangles(self.folder / "m.glb"), 2500)
        self.assertLess(triangles(few), 2200)
        self.assertEqual(triangles(small), triangles(self.folder / "m.glb"))
        self.assertLess(small.stat().st_size, (self.folder / "m.glb").stat().st_size * 0.7)
        Glb(few.read_bytes()).check()

    def test_the_same_run_gives_the_same_bytes(self):
        again = self.folder / "again.glb"
        self.assertEqual(tenon("bake", GRASP, *RUN, "-o", again).returncode, 0)
        self.assertEqual(again.read_bytes(), (self.folder / "m.glb").read_bytes())

    def test_what_has_neither_material_nor_colour_is_grey_and_no_metal(self):
        scene, glb = self.folder / "plain.usda", self.folder / "plain.glb"
        scene.write_text(PLAIN, encoding="utf-8")
        done = tenon("bake", scene, "--duration", "0.1", "-o", glb)
        self.assertEqual(done.returncode, 0, done.stderr)
        gltf = Glb(glb.read_bytes()).json
        looks = {}
        for node in gltf["nodes"]:
            if "mesh" in node:
                part, = gltf["meshes"][node["mesh"]]["primitives"]
                surface = gltf["materials"][part["material"]]["pbrMetallicRoughness"]
                looks[node["name"]] = surface
        self.assertEqual(set(looks), {"/World/ball", "/World/sheet"})
        for name, surface in looks.items():
            self.assertEqual(surface, {"baseColorFactor": [0.18, 0.18, 0.18, 1.0],
                                       "metallicFactor": 0.0, "roughnessFactor": 0.5}, name)

    def test_options_of_glb_are_refused_for_layers(self):
        done = tenon("bake", GRASP, *RUN, "--compress", "-o", self.folder / "m.usda")
        self.assertEqual(done.returncode, 2)
        self.assertFalse((self.folder / "m.usda").exists())


if __name__ == "__main__":
    unittest.main()
