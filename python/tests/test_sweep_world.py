# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon sweep` with simulations: what rows of a plan mean, what comes of cases that fail."""

import contextlib
import csv
import importlib
import io
import json
import math
import os
import subprocess
import sys
import unittest
import unittest.mock

import numpy as np
from support import GRASP, ROOT, FilesTestCase, main

from tenon_usd import World
from tenon_usd.errors import UnstableError
from tenon_usd.sweep import PlanError, load_plan, simulate
from tenon_usd.sweep.command import main as sweep
from tenon_usd.sweep.signals import OF_ALL, OF_BODIES, OF_JOINTS, find_signal, outputs_of
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
WITH_AXES = ("position", "velocity", "angularVelocity")


def signals_of(body, joint):
    """Every signal that there is."""
    return [*(f"{name}{axis}@{body}" for name in OF_BODIES
              for axis in ((".x", ".y", ".z") if name in WITH_AXES else ("",))),
            *(f"{name}@{joint}" for name in OF_JOINTS), *OF_ALL]


def read_from_world(world, signal):
    """A signal as users read it."""
    name, _, path = signal.partition("@")
    name, _, axis = name.partition(".")
    if name in OF_JOINTS:
        drives = name == "driveEffort"
        at = (world.drive_names if drives else world.joint_names).index(path)
        return (world.drive_efforts() if drives else
                world.joints()[name == "jointVelocity"])[0, at]
    if name == "contactCount":
        return world.contact_counts[0]
    if name == "contactForce":
        forces, sides = world.contacts()["normal_force"].tolist(), [world.contacts()["body0"],
                                                                    world.contacts()["body1"]]
        total = 0.0
        for at, force in enumerate(forces):
            if not path or world.body_names.index(path) in (sides[0][at], sides[1][at]):
                total += force
        return total
    if not path:
        kinetic, potential = world.energy[0]
        return {"energy": kinetic + potential, "kineticEnergy": kinetic}.get(name, potential)
    body = world.body_names.index(path)
    if name == "position":
        return world.body_poses[0, body, "xyz".index(axis)]
    part = world.body_velocities[0, body, 3:] if name.startswith("angular") else \
        world.body_velocities[0, body, :3]
    x, y, z = part.tolist()
    return part["xyz".index(axis)] if axis else math.sqrt(x * x + y * y + z * z)


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

    def test_readings_between_steps_are_those_of_a_world_that_is_read_step_by_step(self):
        signals = signals_of("/World/can", World(GRASP, "mujoco").drive_names[0])
        for engine in ("mujoco", "jolt", "physx"):
            worlds = [World(GRASP, engine, outputs=outputs_of(signals)) for _ in range(2)]
            readings = [find_signal(signal, worlds[0]) for signal in signals]
            first = worlds[0]._batch.read(readings)
            samples, failed = worlds[0]._batch.record(readings, 403, 10)
            self.assertEqual((samples.shape, failed), ((41, 1, len(signals)), 0))
            for number, row in enumerate([first, *samples]):
                found = dict(zip(signals, row[0].tolist(), strict=True))
                asked = {signal: float(read_from_world(worlds[1], signal)) for signal in signals}
                self.assertEqual(found, asked, (engine, number))
                if number < 41:
                    worlds[1].step(min(10, 403 - 10 * number))
            self.assertEqual(*(world.time[0] for world in worlds))
            self.assertGreater(samples[:, 0, signals.index("contactForce@/World/can")].max(), 0)

    def test_environments_are_read_in_their_order(self):
        worlds = [World(self.folder / "box.usda", "mujoco", envs=3, vary=["gravity=0.5..2"])
                  for _ in range(2)]
        readings = [find_signal(f"position.{axis}@/World/Box", worlds[0]) for axis in "xz"]
        samples, failed = worlds[0]._batch.record(readings, 40, 20)
        self.assertEqual((samples.shape, failed), ((2, 3, 2), 0))
        for sample in samples:
            worlds[1].step(20)
            np.testing.assert_array_equal(sample, worlds[1].body_poses[:, 0, [0, 2]])

    def test_readings_of_what_there_is_not(self):
        batch = World(self.folder / "box.usda", "mujoco")._batch
        for reading, error in ((("spin", 0, 0), ValueError), (("speed", 2, 0), IndexError),
                               (("speed", 0, 1), IndexError), (("position", 0, 3), IndexError),
                               (("jointPosition", 1, 0), IndexError),
                               (("driveEffort", 1, 0), IndexError), (("energy", 1, 0), IndexError)):
            with self.assertRaises(error):
                batch.read([reading])
        with self.assertRaises(ValueError):
            batch.record([], 1, 0)

    def test_what_is_measured_is_of_all_samples_however_many_are_read_at_once(self):
        takes = ("first", "final", "min", "max", "mean")
        text = ('duration = 0.503\nsample = 0.03\nstep = 0.001\n'
                '[[vary]]\ntarget = "/World/Slide"\ngrid = [0.3]\n') + "".join(
            f'[[metric]]\nname = "{take}"\nof = "jointVelocity@/World/Slide"\ntake = "{take}"\n'
            for take in takes)
        world = World(self.folder / "box.usda", "mujoco", time_step=0.001)
        world.set_drive_targets(positions=0.3)
        speeds = [world.joint_velocities[0, 0]]
        for count in [30] * 16 + [23]:
            world.step(count)
            speeds.append(world.joint_velocities[0, 0])
        total = 0.0
        for speed in speeds:
            total += speed
        wanted = [speeds[0], speeds[-1], min(speeds), max(speeds), total / len(speeds)]
        self.assertEqual(len(set(wanted)), 4)  # it starts as slow as it ever is
        for block in (1, 5, simulate.BLOCK):
            with unittest.mock.patch.object(simulate, "BLOCK", block):
                (row,) = self.rows(text)
            self.assertEqual([row[take] for take in takes], wanted, block)

    def test_unstable_cases_end_where_a_world_does(self):
        world = World(self.folder / "box.usda", "mujoco")

        def start():
            world.reset()
            world.set_parameter("driveStiffness", "/World/Slide", 1e12)
            world.set_drive_targets(positions=0.3)

        start()
        with self.assertRaises(UnstableError) as caught:
            world.step(250)
        for take in ("min", "final"):
            (row,) = self.rows('duration = 0.5\n'
                               '[[vary]]\nvalue = "driveStiffness@/World/Slide"\ngrid = [1e12]\n'
                               '[[vary]]\ntarget = "/World/Slide"\ngrid = [0.3]\n'
                               '[[metric]]\nname = "z"\nof = "speed@/World/Box"\n'
                               f'take = "{take}"\n')
            self.assertEqual((row["status"], row["time"], row["error"]),
                             ("unstable", world.time[0], str(caught.exception)))
            self.assertTrue(math.isnan(row["z"]))
        start()
        samples, failed = world._batch.record([find_signal("speed@/World/Box", world)], 250, 1)
        self.assertEqual((failed, samples.shape), (1, (250, 1, 1)))
        reached = round(row["time"] / world.time_step)
        self.assertFalse(np.isnan(samples[:reached - 1]).any())
        self.assertTrue(np.isnan(samples[reached:]).all())

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

    def test_joblib_and_dask_write_the_same_bytes(self):
        plan = self.folder / "few.toml"
        text = (ROOT / "examples/sweep/grasp.toml").read_text()
        plan.write_text(text.replace('"../inspire_hand/grasp.usda"', f'"{GRASP}"')
                        .replace("duration = 3.5", "duration = 0.1")
                        .replace("samples = 8", "samples = 2").replace("chunk = 8", "chunk = 2"))
        _, _, err = self.command(plan, "-o", self.folder / "threads", "-q")
        self.assertEqual(err, "")
        (whole,) = (self.folder / "threads").glob("result.*")
        for name in ("joblib", "dask"):
            with self.subTest(name):
                try:
                    importlib.import_module(name)
                except ImportError:
                    if os.environ.get("TENON_EXTRAS"):
                        raise
                    self.skipTest(f"{name} is not installed")
                done = subprocess.run(
                    [sys.executable, "-B", ROOT / f"examples/sweep/with_{name}.py", plan,
                     self.folder / name], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual((self.folder / name / whole.name).read_bytes(),
                                 whole.read_bytes())


if __name__ == "__main__":
    main()
