#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon colliders`: figures of an L-shaped solid by closed forms, other approximations, budgets.

    test_colliders.py ROOT TENON
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv[1])
TENON = os.path.abspath(sys.argv[2])
HAND = ROOT / "examples/inspire_hand"
A = 0.1  # [m], the L is two of it long and wide, its arms are one wide, and it is one high

HEAD = '''#usda 1.0
(
    defaultPrim = "W"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "W"
{
    def PhysicsScene "Scene"
    {
    }
'''


def ell(name, approximation="convexHull", body=True, move=(0, 0, 0)):
    """A closed L, of which the hull, the box and volumes are known."""
    outline = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
    points = [(x * A, y * A, z * A) for z in (0, 1) for x, y in outline]
    faces = [[5, 4, 3, 0], [3, 2, 1, 0], [6, 9, 10, 11], [6, 7, 8, 9]]
    faces += [[i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6] for i in range(6)]
    schemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"]
    schemas += ["PhysicsRigidBodyAPI"] if body else []
    return f'''    def Mesh "{name}" (prepend apiSchemas = {json.dumps(schemas)})
    {{
        uniform token subdivisionScheme = "none"
        uniform token physics:approximation = "{approximation}"
        point3f[] points = {points}
        int[] faceVertexCounts = {[len(face) for face in faces]}
        int[] faceVertexIndices = {[i for face in faces for i in face]}
        double3 xformOp:translate = {tuple(move)}
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
'''


def cube(name, x, kind="Cube", more=""):
    return f'''    def {kind} "{name}" (
        prepend apiSchemas = ["PhysicsCollisionAPI", "PhysicsRigidBodyAPI"]
    )
    {{
        double {"size" if kind == "Cube" else "radius"} = 1
        double3 xformOp:translate = ({x}, 9, 0)
        double3 xformOp:scale = (1, 0.5, 0.25)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
        {more}
    }}
'''


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.state = {**os.environ, "XDG_STATE_HOME": str(self.folder / "state")}

    def run_tenon(self, *arguments):
        return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.folder, env=self.state, timeout=300, check=False)

    def json(self, *arguments, code=0):
        done = self.run_tenon(*arguments, "--json")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def rows(self, *arguments):
        """-> by engine and name, the rows."""
        found = self.json("colliders", *arguments)
        return {(engine["engine"], row["collider"].rsplit("/", 1)[1]): row
                for engine in found["engines"] for row in engine["colliders"]}

    def write(self, *parts):
        (self.folder / "w.usda").write_text(HEAD + "".join(parts) + "}\n", encoding="utf-8")
        return "w.usda"

    def engines(self):
        return [one["name"] for one in self.json("doctor")["engines"] if one["available"]]


class Figures(Case):
    def check(self, row, used, outside, cover, cost, inside=0.0):
        self.assertEqual((row["used"], row["cost"]), (used, cost), row)
        self.assertLessEqual(row["gapError"], 0.005 * 3 * A)
        for key, wanted in (("outside", outside), ("inside", inside)):
            self.assertGreaterEqual(row[key] + row["gapError"] + 1e-6, wanted, row)
            self.assertLessEqual(row[key], wanted + 1e-6, row)
        self.assertAlmostEqual(row["cover"], cover, delta=1e-4)

    def test_the_hull_of_an_l_covers_half_a_square_more_on_every_engine(self):
        rows = self.rows(self.write(ell("L")), "--engine", "all")
        self.assertEqual({engine for engine, _ in rows}, set(self.engines()))
        for row in rows.values():
            self.check(row, "convexHull", 0.5 * A, 7 / 6, 10)
            self.assertAlmostEqual(row["meshVolume"], 3 * A**3, delta=1e-9)

    def test_other_approximations(self):
        asset = self.write(ell("L"))
        box = self.rows(asset, "--engine", "mujoco", "--try", "box")["mujoco", "L"]
        self.assertEqual((box["asked"], box["approximation"]), ("convexHull", "boundingCube"))
        self.check(box, "box", A, 4 / 3, 8)
        ball = self.rows(asset, "--engine", "mujoco", "--try", "boundingSphere")["mujoco", "L"]
        # Its middle is that of the square of 2 A; the notch sees it farthest on the diagonal.
        radius = (2 + 0.25) ** 0.5 * A
        self.assertAlmostEqual(ball["volume"], 4 / 3 * math.pi * radius**3, delta=1e-6)
        self.assertEqual(ball["cost"], 1)
        side = A + radius / 2**0.5
        self.assertAlmostEqual(ball["outside"], math.hypot(side - 2 * A, side - A),
                               delta=0.005 * 3 * A)
        self.assertAlmostEqual(ball["inside"], 0, delta=1e-6)

    def test_pieces_leave_no_gap(self):
        asset = self.write(ell("L"))
        row = self.rows(asset, "--engine", "mujoco", "--try", "decomposition")["mujoco", "L"]
        parts = {part["name"]: part["available"] for part in self.json("doctor")["libraries"]}
        if not parts.get("coacd"):
            self.assertEqual(row["used"], "convexHull")
            return
        self.assertEqual(row["used"], "convexDecomposition")
        self.assertLess(row["gap"], 0.02 * A)
        self.assertAlmostEqual(row["cover"], 1, delta=0.02)

    def test_what_stands_still_has_its_triangles(self):
        rows = self.rows(self.write(ell("L", "none", body=False)), "--engine", "all")
        for (engine, _), row in rows.items():
            if engine != "mujoco":
                self.assertEqual((row["used"], row["triangles"], row["cost"]), ("mesh", 20, 60))
                self.assertLess(row["gap"], 1e-6)

    def test_a_hull_of_an_ellipsoid_lies_inside_of_it(self):
        rows = self.rows(self.write(cube("E", 0, "Sphere")), "--engine", "all")
        for (engine, _), row in rows.items():
            if engine == "mujoco":
                self.assertEqual((row["used"], row["gap"]), ("ellipsoid", 0))
            else:
                self.assertEqual(row["used"], "convexHull")
                self.assertTrue(0 < row["inside"] < 0.04, row)
                self.assertTrue(0.9 < row["cover"] < 1, row)

    def test_penetration_at_rest(self):
        one, other = cube("A", 0), cube("B", 0.99)
        rows = self.rows(self.write(one, other), "--engine", "mujoco")
        for name, with_ in (("A", "/W/B"), ("B", "/W/A")):
            row = rows["mujoco", name]
            self.assertAlmostEqual(row["penetration"], 0.01, delta=1e-6)
            self.assertEqual(row["penetrated"], with_)
        self.json("pairs", "w.usda", "--filter", "A,B")
        rows = self.rows("w.usda", "--engine", "mujoco")
        self.assertEqual(rows["mujoco", "A"]["penetration"], 0)

    def test_text_and_patterns(self):
        asset = self.write(ell("L"), cube("A", 3))
        text = self.run_tenon("colliders", asset, "--engine", "mujoco").stdout
        self.assertRegex(text, r"L +convexHull +convexHull +1 +10 +16 +10 +\d+(\.\d+)? mm")
        self.assertIn("2 colliders on mujoco", text)
        self.assertEqual([name for _, name in self.rows(asset, "--colliders", "A")], ["A"])
        none = self.run_tenon("colliders", asset, "--colliders", "nobody")
        self.assertEqual(none.returncode, 2)
        self.assertIn("colliders.none", none.stderr)


class Budgets(Case):
    def chosen(self, asset, *arguments):
        row = self.rows(asset, "--engine", "mujoco", *arguments)["mujoco", "L"]
        return row["approximation"], row["changes"], row["overBudget"]

    def test_the_cheapest_within_the_gap(self):
        asset = self.write(ell("L", "convexDecomposition"))
        for gap, wanted in (("0.2", "boundingSphere"), ("0.102", "boundingCube"),
                            ("0.053", "convexHull")):
            self.assertEqual(self.chosen(asset, "--budget", "64", "--gap", gap),
                             (wanted, True, False))
        # Nothing costs 4 and keeps to 1 mm.
        self.assertEqual(self.chosen(asset, "--budget", "4", "--gap", "0.001"),
                         ("convexDecomposition", False, True))

    def test_it_is_written_with_save_alone(self):
        asset = self.write(ell("L", "convexDecomposition"))
        before = (self.folder / asset).read_text()
        told = self.run_tenon("colliders", asset, "--budget", "64", "--gap", "0.102")
        self.assertIn("1 change, not written: give --save", told.stdout)
        self.assertEqual((self.folder / asset).read_text(), before)
        made = self.json("colliders", asset, "--budget", "64", "--gap", "0.102", "--save")
        self.assertTrue(made["written"])
        self.assertEqual(self.chosen(asset), ("boundingCube", False, False))
        again = self.run_tenon("colliders", asset, "--budget", "64", "--gap", "0.102", "--save")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("nothing to change", again.stdout)
        self.run_tenon("undo", asset)
        self.assertEqual((self.folder / asset).read_text(), before)

    def test_a_mesh_that_moves_and_its_hull_are_the_same(self):
        asset = self.write(ell("L", "none"))
        self.assertEqual(self.chosen(asset, "--budget", "64", "--gap", "0.053"),
                         ("convexHull", False, False))

    def test_wrong_use(self):
        asset = self.write(ell("L"))
        for words, said in ((("--engine", "all", "--budget", "8"), "colliders.engines"),
                            (("--save",), "--budget"), (("--gap", "1"), "--budget"),
                            (("--try", "hull", "--budget", "8"), "--budget"),
                            (("--try", "round"), "--try")):
            done = self.run_tenon("colliders", asset, *words)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(said, done.stderr)


class TheHand(Case):
    def test_its_parts_in_a_structured_asset(self):
        shutil.copytree(HAND, self.folder / "hand")
        asset = "hand/inspire_hand.usda"
        rows = self.rows(asset, "--engine", "mujoco")
        self.assertTrue(all(row["gap"] is not None for row in rows.values()))
        words = ("--engine", "mujoco", "--colliders", "r_base_link", "--budget", "64", "--gap", "1")
        made = self.json("colliders", asset, *words, "--save")
        self.assertTrue(made["written"], made)
        self.assertFalse(any(row["changes"] for row in self.rows(asset, *words).values()))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
