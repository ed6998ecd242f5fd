# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds as batches of other packages: names, states and targets, by MuJoCo's own package in the
place of MuJoCo Warp and MJX, whose models are made of the same; and what is told of losses. The
packages themselves: the judgement to_gpu."""

import importlib.util
import unittest
import warnings

import numpy as np
import support

import tenon_usd as tenon
from tenon_usd import gpu

ARM = support.ROOT / "examples/cpp/robots/arm.urdf"
FALLING = '''#usda 1.0
(
    defaultPrim = "W"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "W"
{
    def PhysicsScene "S"
    {
    }
    def Cube "box" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        point3f physics:centerOfMass = (0.1, 0.2, 0)
        float3 physics:diagonalInertia = (1, 2, 3)
        float physics:mass = 2
        vector3f physics:velocity = (1, 2, 3)
        vector3f physics:angularVelocity = (90, 45, 30)
        quatf xformOp:orient = (0.8, 0.6, 0, 0)
        double3 xformOp:translate = (1, 2, 3)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]
    }
}
'''


class PlainBatch(gpu._MujocoBatch):
    """One MjData for each environment."""

    package = "mujoco"

    def _put(self, start, qpos, qvel, ctrl):
        import mujoco

        self._mujoco, self.model = mujoco, self.host
        self.data = [mujoco.MjData(self.host) for _ in range(self.envs)]
        for data, q, v in zip(self.data, qpos, qvel):
            data.qpos, data.qvel = q, v
        self._set_control(ctrl)

    def _set_control(self, ctrl):
        for data, row in zip(self.data, ctrl):
            data.ctrl = row

    def step(self, count=1):
        for data in self.data:
            self._mujoco.mj_step(self.model, data, count)

    def _arrays(self):
        return np.array([d.qpos for d in self.data]), np.array([d.qvel for d in self.data])

    def body_poses(self):
        for data in self.data:
            self._mujoco.mj_kinematics(self.model, data)
        return gpu._poses(np.array([d.xpos for d in self.data]),
                          np.array([d.xquat for d in self.data]), self.body_index)


@unittest.skipUnless(importlib.util.find_spec("mujoco"), "no mujoco")
class Batches(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        self.enterContext(warnings.catch_warnings())
        warnings.simplefilter("ignore", tenon.ExportWarning)

    def compared(self, world, batch, steps, close):
        batch.step(steps)
        world.step(steps)
        for found, wanted in zip(batch.joints(), world.joints()):
            np.testing.assert_allclose(found, wanted, atol=close)
        np.testing.assert_allclose(batch.body_poses()[:, :, :3], world.body_poses[:, :, :3],
                                   atol=close)

    def test_an_arm_begins_where_the_world_is_and_follows_its_targets(self):
        asset = self.folder / "arm.usda"
        tenon.convert(ARM, asset, gains=(2, 0.5))  # slower than its limits of velocity
        world = tenon.World(asset, "mujoco", 3)
        count = len(world.joint_names)
        world.joint_positions = np.linspace(-0.1, 0.1, 3 * count).reshape(3, count)
        batch = PlainBatch(world, None)
        np.testing.assert_allclose(batch.joints()[0], world.joint_positions)
        targets = np.linspace(0.3, -0.2, 3 * len(world.drive_names)).reshape(3, -1)
        world.drive_targets = targets
        batch.set_targets(targets)
        before = batch.joints()[0]
        self.compared(world, batch, 20, 1e-5)
        self.assertGreater(np.abs(batch.joints()[0] - before).min(), 1e-4)
        with self.assertWarnsRegex(tenon.ExportWarning, "velocity"):
            batch.set_targets(velocities=0.1)

    def test_the_hand_has_all_names(self):
        world = tenon.World(support.GRASP, "mujoco", 2)
        batch = PlainBatch(world, 4)
        for index in (batch.body_index, batch.joint_index, batch.control_index[:, 0]):
            self.assertNotIn(gpu.NONE, index)
            self.assertEqual(len(set(index.tolist())), len(index))
        names = [batch.host.body(at).name for at in batch.body_index]
        self.assertEqual(names, [path.rpartition("/")[2] for path in world.body_names])
        self.assertEqual(batch.joints()[0].shape, (4, len(world.joint_names)))
        self.assertTrue(any("limits of velocity" in one for one in batch.lost))

    def test_bodies_that_nothing_holds(self):
        world = tenon.World(self.written("falling.usda", FALLING), "mujoco", 2)
        world.step(10)
        self.compared(world, PlainBatch(world, None), 100, 1e-3)

    def test_what_is_lost_is_told(self):
        world = tenon.World(support.GRASP, "mujoco", 2, vary=["bodyMass=0.5..2"])
        with self.assertWarnsRegex(tenon.ExportWarning, "bodyMass"):
            batch = PlainBatch(world, None)
        self.assertIn("bodyMass", batch.lost[-1])
        batch._names.qpos[0] = gpu.NONE
        self.assertIn(world.joint_names[0], batch._lacks()[0])
        self.assertTrue(np.isnan(batch.joints()[0][:, 0]).all())

    def test_what_is_not_installed(self):
        world = tenon.World(support.GRASP, "mujoco")
        for call, module in ((world.to_warp, "mujoco_warp"), (world.to_mjx, "jax"),
                             (world.to_newton, "newton")):
            if importlib.util.find_spec(module) is None:
                with self.assertRaisesRegex(tenon.MissingError, module):
                    call()


if __name__ == "__main__":
    support.main()
