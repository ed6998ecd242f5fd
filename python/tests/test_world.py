# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Simulations from Python: arrays in and out, states, contacts, the same bits for all threads."""

import threading
import warnings

import numpy as np
import support

import tenon_usd as tenon

HAND = {"physics": "physics"}


FAST = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def Cube "arm" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
    {
        double size = 0.2
        double3 xformOp:translate = (1, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsRevoluteJoint "hinge" (prepend apiSchemas = ["PhysxJointAPI"])
    {
        rel physics:body1 = </World/arm>
        uniform token physics:axis = "Y"
        point3f physics:localPos1 = (-1, 0, 0)
        float physxJoint:maxJointVelocity = 60
    }
}
"""


class Assets(support.FilesTestCase):
    """What a world is made of beside a file."""

    MASS = "physics:mass"
    THUMB = "/inspire_hand/right_thumb_1"

    def motion(self, *arguments, **options):
        world = tenon.World(*arguments, **options)
        world.step(50)
        return world.scene.json(), world.body_poses

    def assert_same(self, one, other):
        self.assertEqual(one[0], other[0])
        np.testing.assert_array_equal(one[1], other[1])

    def test_an_edited_stage_is_simulated_as_it_will_be_saved(self):
        path = self.copied_hand()
        before = self.motion(path, **HAND)
        stage = tenon.open(path, **HAND)
        self.assert_same(self.motion(stage), before)
        stage[self.THUMB].set(self.MASS, 2.0)
        edited = self.motion(stage)
        self.assertNotEqual(edited[0], before[0])
        self.assert_same(self.motion(path, **HAND), before)  # no file was touched
        world = tenon.World(stage, envs=2)
        stage.undo()
        self.assert_same(self.motion(stage), before)
        masses = [body.mass for body in world.scene.bodies if body.path == self.THUMB]
        self.assertEqual(masses, [2.0])  # of the stage as it was then
        world.step(50)
        np.testing.assert_array_equal(world.body_poses[1], edited[1][0])
        self.assertIn('mass="2"', world.to_mjcf())
        stage.redo()
        stage.save()
        self.assert_same(self.motion(path, **HAND), edited)
        with self.assertRaisesRegex(TypeError, "physics"):
            tenon.World(stage, physics="mujoco")

    def test_layers_in_memory(self):
        text = (support.SCENES / "box_on_box.usda").read_text()
        path = self.written("box.usda", text)
        before = self.motion(path)
        path.unlink()
        self.assert_same(self.motion(path, contents={path: text}), before)
        self.assertFalse(path.exists())
        over = (f'#usda 1.0\n(\n    subLayers = [@{path}@]\n    defaultPrim = "World"\n'
                '    upAxis = "Z"\n    metersPerUnit = 0.01\n)\n')
        stage = tenon.open("over.usda", contents={"over.usda": over, path: text.encode()})
        np.testing.assert_array_equal(self.motion(stage)[1], before[1])
        with self.assertRaises(tenon.MissingFileError):
            tenon.open(path)
        with self.assertRaises(tenon.ParseError):
            tenon.open(path, contents={path: "#usda 1.0\ndef"})


class Masks(support.FilesTestCase):
    """Parts that a world skips or holds."""

    FINGER = "right_index_1_joint"

    def told(self, world, rule):
        return [finding.prim for finding in world.diagnostics if finding.rule == rule]

    def test_a_link_is_fixed_to_the_world(self):
        path = self.folder / "arm.usda"
        path.write_text(FAST)
        free, held = tenon.World(path), tenon.World(path, anchor=["arm"])
        for world in (free, held):
            world.step(100)
        self.assertLess(free.body_poses[0, 0, 2], -0.01)
        self.assertAlmostEqual(held.body_poses[0, 0, 2], 0, 9)
        self.assertEqual(held.joint_names, [])
        self.assertEqual(self.told(held, "mask.anchored"), ["/World/arm"])

    def test_joints_are_skipped_and_held(self):
        whole = tenon.World(support.HAND, **HAND)
        held = tenon.World(support.HAND, bypass=[self.FINGER], **HAND)
        [path] = self.told(held, "mask.bypassed")
        self.assertIn(path, whole.joint_names)
        self.assertNotIn(path, held.joint_names)
        self.assertEqual(len(whole.body_names), len(held.body_names))
        gone = tenon.World(support.HAND, deactivate=["right_thumb_1"], **HAND)
        self.assertGreater(len(self.told(gone, "mask.deactivated")), 3)
        gone.step(5)
        self.assertTrue(np.isfinite(gone.body_poses).all())

    def test_what_is_wrong(self):
        with self.assertRaises(tenon.NotFoundError) as raised:
            tenon.World(support.HAND, anchor=["right_thumb_11"], **HAND)
        self.assertEqual(raised.exception.rule, "mask.unknown")
        with self.assertRaises(TypeError):
            tenon.World(support.HAND, anchor="right_thumb_1", **HAND)


class Stepping(support.FilesTestCase):
    def test_a_box_falls_as_it_should(self):
        path = self.written("fall.usda", '''#usda 1.0
(
    defaultPrim = "W"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "W"
{
    def PhysicsScene "scene"
    {
    }
    def Cube "box" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    )
    {
        double size = 0.1
        double3 xformOp:translate = (0, 0, 10)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
''')
        world = tenon.World(path, envs=3, time_step=0.001)
        self.assertEqual(world.body_names, ["/W/box"])
        self.assertEqual(world.dofs, 6)
        self.assertEqual(world.step(1000), 0)
        np.testing.assert_allclose(world.time, 1.0)
        fall = 0.5 * 9.81
        np.testing.assert_allclose(world.body_poses[:, 0, 2], 10 - fall, atol=0.01)
        np.testing.assert_allclose(world.body_velocities[:, 0, 2], -9.81, atol=0.01)
        world.reset([1])
        np.testing.assert_array_equal(world.time == 0, [False, True, False])
        world.reset(np.array([True, False, False]))
        self.assertEqual(world.body_poses[0, 0, 2], 10)
        world.gravity = [[0, 0, -1], [0, 0, -2], [0, 0, 0]]
        np.testing.assert_array_equal(world.gravity[:, 2], [-1, -2, 0])
        world.set_body("/W/box", [1, 2, 3, 1, 0, 0, 0], [0, 0, 0, 0, 0, 1])
        np.testing.assert_allclose(world.body_poses[2, 0], [1, 2, 3, 1, 0, 0, 0])
        with self.assertRaises(LookupError):
            world.set_body("/W/none", [0, 0, 0, 1, 0, 0, 0])
        with self.assertRaises(ValueError):
            world.set_body("/W/box", [0, 0, 0])

    def test_drives_reach_their_targets(self):
        world = tenon.World(support.HAND, envs=4, outputs=["efforts"], **HAND)
        joints, drives = len(world.joint_names), len(world.drive_names)
        self.assertEqual(world.joint_positions.shape, (4, joints))
        self.assertEqual(world.drive_targets.shape, (4, drives))
        world.drive_targets = np.linspace(0, 0.3, 4)[:, None]
        world.step(500)
        at = [world.joint_names.index(name) for name in world.drive_names]
        reached = world.joint_positions[:, at].mean(axis=1)
        self.assertTrue(np.all(np.diff(reached) > 0.05), reached)
        self.assertEqual(world.drive_efforts().shape, (4, drives))
        with self.assertRaises(ValueError):
            world.drive_targets = np.zeros(drives + 1)
        held = world.drive_targets
        for wrong in (np.nan, np.inf):
            targets = np.full(drives, 0.1)
            targets[-1] = wrong
            for name in ("positions", "velocities"):
                with self.assertRaises(tenon.InvalidError):
                    world.set_drive_targets(**{name: targets})
        np.testing.assert_array_equal(world.drive_targets, held)

    def test_outputs_have_to_be_asked_for(self):
        world = tenon.World(support.GRASP)
        with self.assertRaises(tenon.InvalidError):
            world.contacts()
        with self.assertRaises(tenon.InvalidError):
            tenon.World(support.GRASP, outputs=["nothing"])
        world = tenon.World(support.GRASP, outputs=["contacts"])
        world.step(20)
        contacts = world.contacts()
        count = len(contacts["depth"])
        self.assertEqual(count, world.contact_counts[0])
        self.assertGreater(count, 0)
        self.assertEqual(contacts["force"].shape, (count, 3))
        names = world.body_names
        self.assertIn("/World/can", {names[i] for i in contacts["body1"].tolist() if i >= 0}
                      | {names[i] for i in contacts["body0"].tolist() if i >= 0})

    def test_states_continue_bit_for_bit(self):
        world = tenon.World(support.GRASP, envs=2)
        world.step(50)
        states = world.save()
        world.step(50)
        wanted = world.body_poses
        world.restore(states)
        world.step(50)
        np.testing.assert_array_equal(world.body_poses, wanted)
        with self.assertRaises(tenon.CorruptError):
            world.restore(b"no state")
        with self.assertRaises(ValueError):
            world.restore(states[:1])

    def test_nothing_depends_on_threads(self):
        def run(threads):
            world = tenon.World(support.GRASP, envs=5, seed=3, threads=threads,
                                vary=["bodyMass=0.5..1.5", "gravity=0.9..1.1"])
            world.step(60)
            return world.body_poses

        one = run(1)
        np.testing.assert_array_equal(one, run(2))
        np.testing.assert_array_equal(one, run(5))
        self.assertGreater(np.ptp(one, axis=0).max(), 0)

    def test_many_step_bit_for_bit_as_one_alone(self):
        # Many lend each other what they step with; outputs that are asked for keep it.
        for outputs in ([], ["contacts"]):
            many = tenon.World(support.GRASP, "mujoco", 3, outputs=outputs)
            alone = tenon.World(support.GRASP, "mujoco", 1, outputs=outputs)
            for step in range(80):
                for world in (many, alone):
                    world.drive_targets = 0.005 * step
                    world.step()
                self.assertEqual(many.contact_counts[1], alone.contact_counts[0])
                if step % 20 == 0:
                    np.testing.assert_array_equal(many.body_poses[1], alone.body_poses[0])
            self.assertGreater(alone.contact_counts[0], 0)
            np.testing.assert_array_equal(many.body_velocities[2], alone.body_velocities[0])
            self.assertEqual(many.save()[0], alone.save()[0])

    def test_what_is_drawn_survives_a_reset(self):
        world = tenon.World(support.GRASP, envs=3, vary=["gravity=0.5..1.5"])
        gravity = world.gravity
        self.assertEqual(len({row[2] for row in gravity.tolist()}), 3)
        world.step(5)
        world.reset()
        np.testing.assert_array_equal(world.gravity, gravity)

    def test_parameters_of_each_environment(self):
        world = tenon.World(support.HAND, envs=3, **HAND)
        joint = world.drive_names[0]
        world.set_parameter("driveStiffness", joint, [0.0, 1.0, 4.0])
        world.drive_targets = 0.3
        world.step(20)
        moved = world.joint_positions[:, world.joint_names.index(joint)]
        self.assertLess(moved[0], moved[1])
        self.assertLess(moved[1], moved[2])
        with self.assertRaises(tenon.NotFoundError):
            world.set_parameter("nothing", joint, 1)

    def test_two_threads_of_python_share_a_world(self):
        world = tenon.World(support.HAND, envs=2, **HAND)
        threads = [threading.Thread(target=lambda: [world.step(2) for _ in range(25)])
                   for _ in range(3)]
        for thread in threads:
            thread.start()
        for _ in range(20):
            self.assertTrue(np.isfinite(world.joint_positions).all())
        for thread in threads:
            thread.join()
        np.testing.assert_allclose(world.time, 150 * world.time_step)

    def test_an_unstable_environment_stands_still(self):
        world = tenon.World(support.HAND, envs=2, **HAND)
        efforts = np.zeros((2, len(world.joint_names)))
        efforts[1] = 1e13
        world.set_efforts(efforts)
        self.assertEqual(world.step(200), 1)
        self.assertEqual([failure is None for failure in world.failures()], [True, False])
        world.reset([1])
        self.assertEqual(world.step(10), 0)
        alone = tenon.World(support.HAND, **HAND)
        alone.set_efforts(1e13)
        with self.assertRaises(tenon.UnstableError):
            alone.step(200)

    def test_faulty_arguments(self):
        with self.assertRaises(tenon.MissingFileError):
            tenon.World(self.folder / "none.usda")
        with self.assertRaises(tenon.LimitError):
            tenon.World(support.HAND, envs=0)
        with self.assertRaises(tenon.LimitError):
            tenon.World(support.HAND, envs=10**15)
        with self.assertRaises(tenon.NotFoundError):
            tenon.World(support.HAND, engine="nothing")
        with self.assertRaises(tenon.InvalidError):
            tenon.World(support.HAND, vary=["nothing"])


class Bodies(support.FilesTestCase):
    def test_a_body_that_is_put_where_it_is_moves_on_as_it_was(self):
        # Engines begin the contacts of a body that is set again.
        for engine in ("mujoco", "physx", "jolt"):
            with self.subTest(engine):
                left, put = (tenon.World(support.GRASP, engine, threads=1) for _ in range(2))
                can = left.body_names.index("/World/can")
                for world in (left, put):
                    world.drive_targets = 0.4
                    world.step(40)
                put.set_body(can, put.body_poses[:, can], put.body_velocities[:, can])
                for world in (left, put):
                    world.step(40)
                np.testing.assert_array_equal(put.body_poses, left.body_poses)

    def test_what_varies_is_named_by_the_last_element_of_its_path(self):
        by_path, by_name = (
            tenon.World(support.GRASP, "mujoco", 2, vary=[f"bodyPosition@{can}=0..0.01"], threads=1)
            for can in ("/World/can", "can"))
        np.testing.assert_array_equal(by_path.body_poses, by_name.body_poses)
        self.assertEqual(by_name.variations, ["bodyPosition@can"])


class Engines(support.FilesTestCase):
    def test_every_engine_of_the_wheel_runs_the_grasp(self):
        available = [row["name"] for row in tenon.engines() if row["available"]]
        self.assertEqual(available, ["jolt", "mujoco", "physx"])
        for engine in available:
            world = tenon.World(support.GRASP, engine=engine, envs=2)
            world.step(20)
            self.assertEqual(world.engine, engine)
            self.assertTrue(np.isfinite(world.body_poses).all(), engine)

    def test_models_for_mujoco(self):
        world = tenon.World(support.GRASP)
        text = world.to_mjcf()
        self.assertTrue(text.startswith("<mujoco"))
        world.to_mjcf(self.folder / "grasp.xml")
        self.assertEqual((self.folder / "grasp.xml").read_text()[:7], "<mujoco")
        try:
            import mujoco
        except ImportError:
            with self.assertRaises(tenon.MissingError):
                world.model
            return
        model = world.model
        self.assertIsInstance(model, mujoco.MjModel)
        self.assertEqual(model.nv, world.dofs)

    def test_what_models_for_mujoco_lose_is_told(self):
        """A limit of velocity acts in this world, and no model of MuJoCo has any."""
        path = self.folder / "arm.usda"
        path.write_text(FAST)
        world = tenon.World(path, engine="mujoco")
        self.assertNotIn("mujoco.not-mapped", [found.rule for found in world.diagnostics])
        with self.assertWarnsRegex(tenon.ExportWarning, "limits of velocity"):
            world.to_mjcf()
        [lost] = [found for found in world.diagnostics if found.rule == "mujoco.not-mapped"]
        self.assertEqual((lost.prim, lost.severity), ("/World/hinge", "warning"))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            world.to_mjcf()  # it is told once
            tenon.World(support.GRASP)


if __name__ == "__main__":
    support.main()
