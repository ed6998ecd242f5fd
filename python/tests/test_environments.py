# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Environments as Gymnasium has them: names, specs, autoreset modes, actuators, pictures."""

import os
import sys
import types
import unittest
import warnings
from unittest import mock

import numpy as np
import support

try:
    import gymnasium
    from gymnasium.utils.env_checker import check_env
    from gymnasium.vector import AutoresetMode

    import tenon_usd
    from tenon_usd.actuators import Actuator, DCMotor, Delay, PD
    from tenon_usd.draws import Uniform
    from tenon_usd.gym import NAMES, AssetVectorEnv, GraspEnv
    from tenon_usd.observations import Observer
    from tenon_usd.rendering import Renderer
except ImportError as reason:
    print(f"skipped: {reason}")
    sys.exit(77)

INDEX = "/inspire_hand/Physics/right_index_1_joint"
PENDULUM = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def Xform "World" (
    prepend apiSchemas = ["PhysicsArticulationRootAPI"]
)
{
    def PhysicsScene "scene"
    {
        vector3f physics:gravityDirection = (0, 0, -1)
        float physics:gravityMagnitude = 9.81
    }
    def Xform "bob" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 1
        point3f physics:centerOfMass = (0, 0, -1)
        float3 physics:diagonalInertia = (0.01, 0.01, 0.01)

        def Sphere "ball"
        {
            double radius = 0.2
            double3 xformOp:translate = (0, 0, -1)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }

        def IsaacImuSensor "imu"
        {
        }

        def Xform "tip"
        {
            custom token tenon:sensor = "frame"
            double3 xformOp:translate = (0, 0, -1)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
    }
    def PhysicsRevoluteJoint "hinge" (
        prepend apiSchemas = ["PhysicsDriveAPI:angular"]
    )
    {
        custom token tenon:sensor = "joint"
        uniform token physics:axis = "Y"
        rel physics:body1 = </World/bob>
        float physics:lowerLimit = -90
        float physics:upperLimit = 45
        float drive:angular:physics:stiffness = 1
        float drive:angular:physics:damping = 0.1
    }
}
"""


class Environments(support.FilesTestCase):
    def pendulum(self, num_envs=3, **options):
        return AssetVectorEnv(self.written("pendulum.usda", PENDULUM), num_envs, **options)


class Wrong(Environments):
    def test_messages_name_the_argument_what_is_expected_and_what_came(self):
        envs = self.pendulum()
        make = self.pendulum
        for call, kind, told in (
                (lambda: envs.step(np.zeros(3)), ValueError, r"\(3,\); expected \(3, 1\)"),
                (lambda: envs.step(np.zeros((3, 2))), ValueError, r"\(3, 2\); expected \(3, 1\)"),
                (lambda: envs.reset(seed=-1), ValueError, "seed must be 0 or more, not -1"),
                (lambda: envs.reset(seed="a"), TypeError, "seed is a whole number, not 'a'"),
                (lambda: envs.reset(seed=[1]), ValueError, "1 seeds for 3 environments"),
                (lambda: envs.reset(options={"reset_mask": np.array([0, 1, 2])}), ValueError,
                 "reset_mask is a mask of bool .*int64"),
                (lambda: make(-1), ValueError, "num_envs must be 0 or more, not -1"),
                (lambda: make(2.0), TypeError, "num_envs is a whole number, not 2.0"),
                (lambda: make(0), tenon_usd.LimitError, "0 environments"),
                (lambda: make(frame_time=0), tenon_usd.InvalidError, "frame_time must be above 0"),
                (lambda: make(frame_time=np.nan), tenon_usd.InvalidError, "frame_time .*nan"),
                (lambda: make(episode_time=-1), tenon_usd.InvalidError, "episode_time .*-1"),
                (lambda: make(bodies=["bab"]), tenon_usd.NotFoundError, "bodies: .*World/bob"),
                (lambda: make(observations="energy"), TypeError, "observations is a list"),
                (lambda: make(vary={"bodyMass": 3}), TypeError, "bodyMass is drawn from a distr"),
                (lambda: make(noise=0.1), TypeError, "noise is drawn from a distribution"),
                (lambda: make(frame_tim=1), TypeError, "did you mean 'frame_time'"),
                (lambda: make(phsyics="a"), TypeError, "did you mean 'physics'")):
            with self.assertRaisesRegex(kind, told, msg=told):
                call()
        one = gymnasium.make("tenon_usd.gym:tenon/Balance-v0").unwrapped
        one.reset(seed=3)
        with self.assertRaisesRegex(ValueError, r"\(\); expected \(1,\)"):
            one.step(0.5)

    def test_seeds_may_be_numbers_of_numpy(self):
        envs = self.pendulum(vary={"jointPosition": Uniform(-0.1, 0.1)})
        first, _ = envs.reset(seed=np.int64(3))
        again, _ = envs.reset(seed=np.array([3, 4, 5]))
        np.testing.assert_array_equal(first, again)

    def test_a_frame_is_told_where_it_is_no_whole_number_of_steps(self):
        with self.assertWarnsRegex(UserWarning, "0.015 s is no whole .* 0.01 s: it takes 0.02 s"):
            envs = self.pendulum(frame_time=0.015, time_step=0.01)
        self.assertEqual(envs.frame_steps, 2)
        with warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)
            self.pendulum(frame_time=0.02, time_step=0.01)


class Specs(Environments):
    def test_numbers_say_what_they_are(self):
        envs = self.pendulum(bodies=["/World/bob"])
        told = [(each.name, each.unit) for each in envs.observation_spec]
        self.assertEqual(told, [
            ("jointPosition@/World/hinge", "rad"), ("jointVelocity@/World/hinge", "rad/s"),
            *((f"position.{axis}@/World/bob", "m") for axis in "xyz"),
            *((f"orientation.{part}@/World/bob", "") for part in "wxyz")])
        first = envs.observation_spec[0]
        np.testing.assert_allclose((first.low, first.high), (-np.pi / 2, np.pi / 4))
        (action,) = envs.action_spec
        self.assertEqual((action.name, action.unit), ("target@/World/hinge", "rad"))
        np.testing.assert_allclose((action.low, action.high), (-np.pi / 2, np.pi / 4))
        envs.reset(seed=0)
        envs.step(np.array([[-1.0], [0.0], [1.0]]))
        np.testing.assert_allclose(envs.world.drive_targets[:, 0],
                                   [-np.pi / 2, -np.pi / 8, np.pi / 4])

    def test_sensors_are_observed_by_name(self):
        envs = self.pendulum(observations=["sensor", "position.z@bob", "orientation@.*ob",
                                           "energy"])
        self.assertEqual(envs.world.outputs, ("sensors",))
        names = [entry.name for entry in envs.observation_spec]
        units = {entry.name: entry.unit for entry in envs.observation_spec}
        self.assertEqual(units["sensor.linear_acceleration.z@/World/bob/imu"], "m/s^2")
        self.assertEqual(units["sensor.position.0@/World/hinge"], "rad or m")
        self.assertEqual(units["energy"], "J")
        envs.reset(seed=0)
        positions = np.array([[0.1], [0.2], [0.3]])
        envs.world.set_joints(positions)
        envs.world.step(1)
        seen = dict(zip(names, envs.observe().T))
        self.assertEqual(len(names), len(seen))
        # Of a turn by a about y the bob, 1 m below, is at (-sin a, 0, -cos a).
        angles = envs.world.joint_positions[:, 0]
        np.testing.assert_allclose(seen["sensor.position.x@/World/bob/tip"], -np.sin(angles),
                                   atol=1e-9)
        np.testing.assert_allclose(seen["sensor.position.z@/World/bob/tip"], -np.cos(angles),
                                   atol=1e-9)
        np.testing.assert_allclose(seen["sensor.position.0@/World/hinge"], angles, atol=1e-12)
        np.testing.assert_allclose(seen["orientation.w@/World/bob"], np.cos(angles / 2))
        np.testing.assert_allclose(seen["energy"], envs.world.energy.sum(axis=1))

    def test_observations_have_their_size_before_any_step(self):
        envs = self.pendulum(observations=["sensor"])
        first, _ = envs.reset(seed=0)
        after = envs.step(np.zeros((3, 1)))[0]
        self.assertEqual(first.shape, after.shape)
        self.assertTrue(envs.observation_space.contains(first))

    def test_a_name_that_there_is_not(self):
        world = self.pendulum(1, outputs=["sensors"]).world
        for name, told in (("jointPositon", "jointPosition"), ("position@bib", "bob"),
                           ("energy@bob", "energy"), ("position.w@bob", "x, y and z"),
                           ("sensor@imo", "imu")):
            with self.assertRaisesRegex(tenon_usd.NotFoundError, told):
                Observer(world, [name])

    def test_actuators_take_the_place_of_drives(self):
        motor = Actuator("hinge", Delay(Uniform(0, 0.01)), PD(20, 6), DCMotor(20, 30))
        envs = self.pendulum(actuators=[motor])
        (action,) = envs.action_spec
        self.assertEqual((action.name, action.unit), ("command@/World/hinge", "rad"))
        envs.reset(seed=3)
        drawn = envs.actuators.numbers["/World/hinge.Delay.time"]
        self.assertEqual(len(set(drawn)), 3)
        envs.reset()
        self.assertTrue((envs.actuators.numbers["/World/hinge.Delay.time"] != drawn).all())
        envs.reset(seed=3)
        np.testing.assert_array_equal(envs.actuators.numbers["/World/hinge.Delay.time"], drawn)
        for _ in range(150):
            observations = envs.step(np.ones((3, 1)))[0]
        # k (c - a) = m g l sin a at rest.
        angle = observations[0, 0]
        self.assertAlmostEqual(20 * (np.pi / 4 - angle), 9.81 * np.sin(angle), delta=0.02)
        with self.assertRaises(ValueError):
            envs.step(np.full((3, 1), np.nan))

    def test_drives_can_be_left_out(self):
        envs = AssetVectorEnv(support.HAND, drives=["right_(index|thumb)_1_joint"])
        self.assertEqual([entry.name.rpartition("/")[2] for entry in envs.action_spec],
                         ["right_index_1_joint", "right_thumb_1_joint"])
        self.assertEqual(envs.single_action_space.shape, (2,))


class Autoreset(Environments):
    """Episodes of two frames; environment 1 begins a frame later than 0."""

    def envs(self, mode):
        envs = self.pendulum(2, episode_time=0.04, autoreset_mode=mode)
        self.assertEqual(envs.metadata["autoreset_mode"], AutoresetMode(mode))
        self.assertEqual(AssetVectorEnv.metadata["autoreset_mode"], AutoresetMode.NEXT_STEP)
        self.first, _ = envs.reset(seed=0)
        envs.step(np.ones((2, 1)))
        envs.reset(options={"reset_mask": np.array([False, True])})
        return envs

    def test_in_the_step_after(self):
        envs = self.envs(AutoresetMode.NEXT_STEP)
        last, _, _, truncated, infos = envs.step(np.ones((2, 1)))
        self.assertEqual(truncated.tolist(), [True, False])
        self.assertNotIn("final_obs", infos)
        self.assertFalse((last[0] == self.first[0]).all())
        again, rewards, _, truncated, _ = envs.step(np.ones((2, 1)))
        np.testing.assert_array_equal(again[0], self.first[0])
        self.assertEqual(truncated.tolist(), [False, True])

    def test_in_the_same_step(self):
        next_step, envs = self.envs("NextStep"), self.envs("SameStep")
        last = next_step.step(np.ones((2, 1)))[0]
        seen, _, _, truncated, infos = envs.step(np.ones((2, 1)))
        self.assertEqual(truncated.tolist(), [True, False])
        np.testing.assert_array_equal(seen[0], self.first[0])
        np.testing.assert_array_equal(seen[1], last[1])
        np.testing.assert_array_equal(infos["final_obs"][0], last[0])
        self.assertEqual(infos["_final_obs"].tolist(), [True, False])
        self.assertEqual(infos["final_info"]["_unstable"].tolist(), [True, False])
        seen, _, _, truncated, infos = envs.step(np.ones((2, 1)))
        self.assertEqual(truncated.tolist(), [False, True])
        self.assertEqual(infos["_final_obs"].tolist(), [False, True])

    def test_by_the_caller_alone(self):
        envs = self.envs("Disabled")
        _, _, terminated, truncated, _ = envs.step(np.ones((2, 1)))
        with self.assertRaisesRegex(ValueError, r"environments \[0\] ended: reset"):
            envs.step(np.ones((2, 1)))
        envs.reset(options={"reset_mask": terminated | truncated})
        truncated = envs.step(np.ones((2, 1)))[3]
        self.assertEqual(truncated.tolist(), [False, True])

    def test_a_mode_that_there_is_not(self):
        with self.assertRaises(ValueError):
            self.pendulum(autoreset_mode="Sometimes")

    def test_what_gymnasium_has_on_top(self):
        envs = gymnasium.wrappers.vector.RecordEpisodeStatistics(
            self.pendulum(2, episode_time=0.04))
        envs.reset(seed=0)
        for _ in range(2):
            infos = envs.step(np.ones((2, 1)))[-1]
        self.assertEqual(infos["episode"]["l"].tolist(), [2, 2])


class Names(Environments):
    def test_every_name_makes_one_and_many(self):
        needs = {"tenon/Asset-v0": {"asset": support.HAND},
                 "tenon/Grasp-v0": {"asset": support.GRASP}, "tenon/Task-v0": {"task": "reach"}}
        self.assertEqual(set(NAMES), {each for each in gymnasium.registry if "tenon/" in each})
        for name in NAMES:
            with self.subTest(name), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                options = needs.get(name, {})
                env = gymnasium.make(name, **options)
                check_env(env.unwrapped, skip_render_check=True)
                envs = gymnasium.make_vec(name, num_envs=2, vector_kwargs={}, **options)
                self.assertEqual(envs.reset(seed=1)[0].shape, (2, *env.observation_space.shape))


class Stub:
    """What a window needs of pygame."""

    def __init__(self):
        self.shown = []
        self.module = types.SimpleNamespace(
            display=mock.MagicMock(), event=mock.MagicMock(),
            surfarray=types.SimpleNamespace(make_surface=self.shown.append))


class Pictures(Environments):
    def renderer(self, world, **options):
        """None where this machine has no OpenGL; then the reason says what to install."""
        with mock.patch.dict(os.environ):
            try:
                return Renderer(world, **options)
            except tenon_usd.MissingError as reason:
                self.assertIn("pip install 'tenon-usd[render]'", str(reason))
                self.assertRegex(str(reason), "MUJOCO_GL=egl|cannot be imported")
                return None

    def test_bodies_are_drawn_where_the_world_has_them(self):
        for engine in ("mujoco", "jolt", "physx"):
            world = self.pendulum(2, engine=engine).world
            renderer = self.renderer(world, width=64, height=48, azimuth=90, elevation=0)
            if renderer is None:
                self.skipTest("no OpenGL for MuJoCo here (MUJOCO_GL)")
            world.set_joints([[0.0], [-0.1]])
            hangs, swung = (renderer.draw(env).astype(int) for env in (0, 1))
            self.assertEqual(hangs.shape, (48, 64, 3))
            self.assertGreater(np.abs(hangs - swung).max(), 50)
            np.testing.assert_array_equal(renderer.draw(0), hangs)
            # Turned by -0.1 rad about y the bob is at +x, which azimuth 90 has on the right.
            bright = [np.argwhere(each.sum(axis=2) > each.sum(axis=2).max() / 2).mean(axis=0)
                      for each in (hangs, swung)]
            self.assertGreater(bright[1][1], bright[0][1] + 5)
            renderer.close()

    def test_depth_bodies_and_films(self):
        world = self.pendulum(1).world
        renderer = self.renderer(world, width=64, height=48, azimuth=90, elevation=0)
        if renderer is None:
            self.skipTest("no OpenGL for MuJoCo here (MUJOCO_GL)")
        picture = renderer.draw()
        bodies, depth = renderer.segmentation(), renderer.depth()
        np.testing.assert_array_equal(renderer.draw(), picture)  # as before
        self.assertEqual((bodies.dtype, depth.dtype), (np.int32, np.float32))
        self.assertEqual(set(np.unique(bodies)), {-1, 0})
        ball = bodies == 0
        # Seen along its distance, the ball is 0.4 m deep and the nearest that there is.
        self.assertLess(np.ptp(depth[ball]), 0.25)
        self.assertGreater(np.ptp(depth[ball]), 0.1)
        self.assertLess(depth[ball].max(), depth[~ball].min())
        renderer.close()
        options = {"size": (64, 48), "azimuth": 90, "elevation": 0}
        np.testing.assert_array_equal(world.render(**options), picture)
        world.set_joints([[0.5]])
        begin = float(world.time[0])
        film = world.render_video(0.5, fps=10, **options)
        self.assertEqual(film.shape, (6, 48, 64, 3))
        self.assertAlmostEqual(float(world.time[0]), begin + 0.5, 6)
        self.assertTrue(all(np.abs(film[i].astype(int) - film[i + 1]).max() > 50 for i in range(5)))
        for wrong in ({"duration": -1}, {"duration": 1, "fps": 0}, {"duration": 1e6}):
            with self.assertRaises(ValueError, msg=wrong):
                world.render_video(**wrong)

    def test_modes(self):
        self.assertEqual(GraspEnv.metadata["render_modes"], ["human", "rgb_array"])
        self.assertIsNone(self.pendulum().render())
        with self.assertRaisesRegex(ValueError, "'rgb'.*'rgb_array'"):
            self.pendulum(render_mode="rgb")
        if self.renderer(self.pendulum(1).world) is None:
            with self.assertRaisesRegex(tenon_usd.MissingError, "tenon-usd\\[render\\]"):
                self.pendulum(render_mode="rgb_array")
            self.skipTest("no OpenGL for MuJoCo here (MUJOCO_GL)")
        size = {"width": 32, "height": 24}
        envs = self.pendulum(2, render_mode="rgb_array", render_options=size)
        envs.reset(seed=0)
        self.assertEqual([each.shape for each in envs.render()], [(24, 32, 3)] * 2)
        env = gymnasium.make("tenon/Balance-v0", render_mode="rgb_array", render_options=size)
        env.reset(seed=0)
        self.assertEqual(env.render().shape, (24, 32, 3))
        self.assertEqual(env.metadata["render_fps"], 50)
        env.close()

    def test_a_window_shows_each_step(self):
        stub = Stub()
        drawn = types.SimpleNamespace(draw=lambda env: np.zeros((4, 6, 3), np.uint8),
                                      close=lambda: None)
        with mock.patch.dict(sys.modules, {"pygame": stub.module}), mock.patch(
                "tenon_usd.gym.Renderer", lambda world, **options: drawn):
            envs = self.pendulum(render_mode="human")
            envs.reset(seed=0)
            envs.step(np.zeros((3, 1)))
            self.assertEqual([each.shape for each in stub.shown], [(6, 4, 3)] * 2)
            stub.module.display.set_mode.assert_called_once_with((6, 4))
            envs.close()
            stub.module.display.quit.assert_called_once_with()

    def test_without_pygame_it_says_what_to_install(self):
        drawn = types.SimpleNamespace(draw=None, close=lambda: None)
        with mock.patch.dict(sys.modules, {"pygame": None}), mock.patch(
                "tenon_usd.gym.Renderer", lambda world, **options: drawn):
            with self.assertRaisesRegex(tenon_usd.MissingError, "pygame.*tenon-usd\\[render\\]"):
                self.pendulum(render_mode="human")


if __name__ == "__main__":
    os.environ.setdefault("MUJOCO_GL", "egl")
    unittest.main(verbosity=1)
