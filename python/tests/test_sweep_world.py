# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon sweep` with simulations: what rows of a plan mean, what comes of cases that fail."""

import contextlib
import csv
import io
import json
import math
import unittest

from support import GRASP, ROOT, FilesTestCase, main

from tenon_usd import World
from tenon_usd.sweep import PlanError, load_plan
from tenon_usd.sweep.command import main as sweep
from tenon_usd.sweep.simulate import digest_of, make_runner
from tenon_usd.sweep.work import Worker

BOX = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "Scene"
    {
        float physics:gravityMagnitude = 10
        vector3f physics:gravityDirection = (0, 0, -1)
    }
    def Cube "Box" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysicsCollisionAPI"]
    )
    {
        double size = 1
        float physics:mass = 2
        double3 xformOp:translate = (0, 0, 100)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsPrismaticJoint "Slide" (prepend apiSchemas = ["PhysicsDriveAPI:linear"])
    {
        uniform token physics:axis = "X"
        rel physics:body1 = </World/Cart>
        float drive:linear:physics:stiffness = 100
        float drive:linear:physics:damping = 20
        point3f physics:localPos0 = (5, 0, 0)
    }
    def Cube "Cart" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 1
        double3 xformOp:translate = (5, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
"""
HEAD = 'asset = "box.usda"\nengine = "mujoco"\n'


class Sweeps(FilesTestCase):
    def setUp(self):
        super().setUp()
        self.written("box.usda", BOX)

    def rows(self, text, **keys):
        """The rows of a plan, as one worker makes them."""
        plan = load_plan(str(self.written("plan.toml", HEAD + text)), **keys)
        digest_of(plan)
        worker = Worker(plan, make_runner)
        return [row for chunk in range(plan.chunk_count) for row in worker.rows(chunk)]

    def faults(self, text):
        plan = load_plan(str(self.written("plan.toml", HEAD + text)))
        with self.assertRaises(PlanError) as caught:
            digest_of(plan)
        return [(fault.row, fault.line, fault.message) for fault in caught.exception.faults]

    def command(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = sweep([str(word) for word in words])
        return code, out.getvalue(), err.getvalue()

    def test_gravity_moves_a_box_by_the_formula(self):
        rows = self.rows('duration = 1\n[[vary]]\nscale = "gravity"\ngrid = [0, 0.5, 1]\n[[metric]]'
                         '\nof = "position.z@/World/Box"\n[[metric]]\nof = "speed@/World/Box"\n')
        for row in rows:  # h = g t^2 / 2, v = g t
            fallen = 100 - row["final(position.z@/World/Box)"]
            self.assertAlmostEqual(fallen, 5 * row["gravity"], delta=0.011)
            self.assertAlmostEqual(row["final(speed@/World/Box)"], 10 * row["gravity"], places=6)

    def test_values_of_the_start_and_takes(self):
        rows = self.rows('duration = 1\n[[vary]]\nvalue = "bodyPosition.z@/World/Box"\n'
                         'grid = [50, 70]\n' + "".join(
                             f'[[metric]]\nname="{take}"\nof = "position.z@/World/Box"\n'
                             f'take = "{take}"\n' for take in ("first", "final", "min", "max",
                                                               "mean")))
        for row, start in zip(rows, (50, 70), strict=True):
            self.assertEqual((row["first"], row["max"]), (start, start))
            self.assertEqual(row["final"], row["min"])
            self.assertAlmostEqual(start - row["mean"], 10 / 6, delta=0.1)

    def test_mass_by_factor_and_number_and_property_are_the_same(self):
        metric = '[[metric]]\nname = "e"\nof = "kineticEnergy"\n'
        found = [self.rows("duration = 0.5\n[[vary]]\n" + row + metric)[0]["e"] for row in
                 ('scale = "bodyMass@/World/Box"\ngrid = [3]\n',
                  'value = "bodyMass@/World/Box"\ngrid = [6]\n',
                  'set = "/World/Box.physics:mass"\ngrid = [6]\n')]
        self.assertAlmostEqual(found[0], 6 * 25 / 2, delta=0.1)  # m v^2 / 2
        self.assertAlmostEqual(found[1], found[0], places=9)
        self.assertAlmostEqual(found[2], found[0], places=9)

    def test_targets_and_stiffness_of_a_drive(self):
        rows = self.rows('duration = 3\n[[vary]]\ntarget = "/World/Slide"\ngrid = [0.5, -0.25]\n'
                         '[[metric]]\nname = "x"\nof = "jointPosition@/World/Slide"\n')
        for row in rows:
            self.assertAlmostEqual(row["x"], row["/World/Slide"], delta=1e-4)

    def test_a_case_knows_nothing_of_those_before_it(self):
        text = ('duration = 0.3\nchunk = 4\n[[vary]]\nscale = "bodyMass"\ngrid = [1, 2, 4, 8]\n'
                '[[vary]]\ntarget = "/World/Slide"\ngrid = [0, 0.2]\n'
                '[[metric]]\nname = "x"\nof = "jointPosition@/World/Slide"\n')
        rows = self.rows(text)
        plan = load_plan(str(self.folder / "plan.toml"))
        for number in (5, 2, 7):  # each with a worker of its own
            worker = Worker(plan, make_runner)
            (outcome,) = worker.runner.run([worker.cases[number]])
            self.assertEqual(outcome.metrics, (rows[number]["x"],))

    def test_rows_that_name_nothing_are_faults_with_their_lines(self):
        faults = self.faults('[[vary]]\nscale = "bodyMass@/World/No"\ngrid = [1]\n[[vary]]\n'
                             'scale = "mass"\ngrid = [1]\n[[vary]]\ntarget = "/World/No"\n'
                             'grid = [1]\n[[vary]]\nset = "/World/No.physics:mass"\ngrid = [1]\n'
                             '[[metric]]\nof = "position@/World/Box"\n[[metric]]\nof = "spin"\n')
        self.assertEqual([row[:2] for row in faults if not row[0].startswith("vary 4")],
                         [("vary 1", 3), ("vary 2", 6), ("vary 3", 9), ("metric 1", 15),
                          ("metric 2", 17)])

    def test_an_asset_that_is_missing(self):
        code, _, told = self.command(self.written("p.toml", 'asset = "gone.usda"\n'), "-o",
                                     self.folder / "r")
        self.assertEqual(code, 2)
        self.assertIn("gone.usda", told)
        rows = self.rows('[[vary]]\nname = "file"\nasset = ["box.usda", "gone.usda"]\n'
                         '[[metric]]\nname = "e"\nof = "kineticEnergy"\n')
        self.assertEqual([row["status"] for row in rows], ["ok", "missing"])
        self.assertIn("gone.usda", rows[1]["error"])
        self.assertTrue(math.isnan(rows[1]["e"]))

    def test_unstable_cases_are_rows_and_the_others_are_as_without_them(self):
        text = ('duration = 0.5\n[[vary]]\nvalue = "driveStiffness@/World/Slide"\n'
                'grid = [100, 1e12, 50]\n'
                '[[vary]]\ntarget = "/World/Slide"\ngrid = [0.3]\n'
                '[[metric]]\nname = "x"\nof = "jointPosition@/World/Slide"\n')
        rows = self.rows(text)
        self.assertEqual([rows[0]["status"], rows[2]["status"]], ["ok", "ok"])
        if rows[1]["status"] != "ok":
            self.assertEqual(rows[1]["status"], "unstable")
            self.assertTrue(rows[1]["rule"])
        alone = self.rows(text.replace("100, 1e12, 50", "50"))
        self.assertEqual(alone[0]["x"], rows[2]["x"])

    def test_engines_vary(self):
        rows = self.rows('duration = 0.5\n[[vary]]\nengine = ["mujoco", "jolt", "physx"]\n'
                         '[[metric]]\nname = "z"\nof = "position.z@/World/Box"\n')
        self.assertEqual([row["status"] for row in rows], ["ok"] * 3, rows)
        for row in rows:
            self.assertAlmostEqual(row["z"], 100 - 1.25, delta=0.05)

    def test_forces_and_efforts(self):
        rows = self.rows('duration = 3\n[[vary]]\nvalue = "jointPosition@/World/Slide"\n'
                         'grid = [0.1]\n[[metric]]\nname = "n"\nof = "contactCount"\n[[metric]]\n'
                         'name = "f"\nof = "contactForce@/World/Box"\n[[metric]]\nname = "e"\n'
                         'of = "driveEffort@/World/Slide"\ntake = "min"\n')
        self.assertEqual((rows[0]["n"], rows[0]["f"]), (0, 0))
        # k x = -10 N at the start; within 20 ms, which lie between two readings, the cart comes
        # closer by 2 mm and the damper, 20 N s/m, takes what its speed of about 0.2 m/s asks.
        self.assertAlmostEqual(rows[0]["e"], -6.5, delta=0.5)

    def test_the_digest_is_that_of_the_files(self):
        path = self.written("plan.toml", HEAD)
        first = digest_of(load_plan(str(path)))
        self.assertEqual(digest_of(load_plan(str(path))), first)
        self.written("box.usda", BOX + "# another byte\n")
        self.assertNotEqual(digest_of(load_plan(str(path))), first)

    def test_the_example_on_threads_and_shards(self):
        plan = ROOT / "examples/sweep/grasp.toml"
        options = ("--duration", "0.5", "--format", "csv")
        code, out, err = self.command(plan, "-o", self.folder / "a", "-j", "2", "--json", *options)
        self.assertEqual(code, 0, err)
        self.assertEqual(json.loads(out)["statuses"], {"ok": 24})
        for shard in ("1/2", "0/2"):
            self.command(plan, "-o", self.folder / "b", "-j", "1", "--shard", shard, *options)
        whole = (self.folder / "a/result.csv").read_bytes()
        self.assertEqual((self.folder / "b/result.csv").read_bytes(), whole)
        rows = list(csv.DictReader(io.StringIO(whole.decode())))
        world = World(GRASP, "mujoco")
        world.set_parameter("bodyMass", "/World/can", float(rows[8]["mass"])
                            * world.scene.bodies[world.body_names.index("/World/can")].mass)
        world.step(250)
        can = world.body_poses[0, world.body_names.index("/World/can"), 2]
        self.assertEqual(float(rows[8]["height"]), can)


if __name__ == "__main__":
    main()
