# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The vector environment: the grasp as a task."""

import sys

import numpy as np
import support

try:
    import gymnasium
    from gymnasium.utils.env_checker import check_env

    import tenon_usd
    from tenon_usd.draws import Choice, LogUniform, Normal, Uniform
    from tenon_usd.gym import AssetVectorEnv, GraspEnv
except ImportError as reason:
    print(f"skipped: {reason}")
    sys.exit(77)


class Grasp(support.FilesTestCase):
    def test_a_hand_that_closes_holds_the_can(self):
        envs = GraspEnv(support.GRASP, num_envs=3)
        observations, _ = envs.reset(seed=0)
        self.assertEqual(observations.shape, (3, envs.single_observation_space.shape[0]))
        self.assertTrue(envs.observation_space.contains(observations))
        opened = grasping(envs, 0)
        total = np.zeros(3)
        ended = np.zeros(3, dtype=bool)
        for frame in range(190):
            closing = grasping(envs, 0.02 * frame)
            actions = np.array([closing, closing, opened])
            observations, rewards, terminated, truncated, infos = envs.step(actions)
            total += np.where(ended, 0, rewards)
            ended |= terminated | truncated
            self.assertFalse(infos["unstable"].any())
        self.assertEqual(ended.tolist(), [False, False, True])
        self.assertGreater(total[0], total[2] + 10)
        self.assertEqual(total[0], total[1])

    def test_a_follower_with_a_drive_for_its_effort_gets_no_action(self):
        asset = self.folder / "r.usda"
        link = ('<link name="{0}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" '
                'ixy="0" ixz="0" iyz="0"/></inertial></link>')
        joint = ('<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{2}"/>'
                 '<limit lower="-1" upper="1" effort="9" velocity="9"/>{3}</joint>')
        robot = self.folder / "r.urdf"
        robot.write_text('<robot name="r">' + "".join(map(link.format, "abcd")) +
                         joint.format("lead", "a", "b", "") +
                         joint.format("follow", "b", "c", '<mimic joint="lead"/>') +
                         joint.format("last", "c", "d", "") + "</robot>")
        tenon_usd.convert(robot, asset, gains=(50, 5), fix_base=True)
        envs = AssetVectorEnv(asset, num_envs=2)
        self.assertEqual(len(envs.world.drive_names), 3)
        self.assertEqual(envs.single_action_space.shape, (2,))
        envs.reset(seed=0)
        envs.step(np.array([[1.0, -1.0], [0.5, 0.0]]))
        targets = dict(zip(envs.world.drive_names, envs.world.drive_targets.T.tolist()))
        targets = {name.rpartition("/")[2]: row for name, row in targets.items()}
        for name, row in (("last", [1, 0.5]), ("follow", [0, 0]), ("lead", [-1, 0])):
            np.testing.assert_allclose(targets[name], row, atol=1e-6)

    def test_an_episode_ends_and_begins_again(self):
        envs = GraspEnv(support.GRASP, num_envs=2, episode_time=0.1)
        first, _ = envs.reset(seed=0)
        actions = np.zeros(envs.action_space.shape)
        for _ in range(4):
            _, _, _, truncated, _ = envs.step(actions)
            self.assertFalse(truncated.any())
        _, _, terminated, truncated, _ = envs.step(actions)
        self.assertTrue(truncated.all())
        self.assertFalse(terminated.any())
        again, rewards, _, truncated, _ = envs.step(actions)
        np.testing.assert_array_equal(again, first)
        self.assertFalse(truncated.any())
        self.assertEqual(rewards.tolist(), [0, 0])
        some, _ = envs.reset(options={"reset_mask": np.array([True, False])})
        self.assertEqual(some.shape, first.shape)

    def test_an_action_that_is_no_number_is_refused(self):
        envs = GraspEnv(support.GRASP, num_envs=2)
        envs.reset(seed=0)
        with self.assertRaises(ValueError):
            envs.step(np.full(envs.action_space.shape, np.nan))


CAN = "bodyMass@/World/can"


class Draws(support.FilesTestCase):
    def envs(self, vary, **options):
        return GraspEnv(support.GRASP, num_envs=3, vary=vary, episode_time=0.04, **options)

    def masses(self, envs):
        """What each environment drew."""
        return [numbers[0][0] for numbers in envs.world.drawn]

    def test_a_seed_says_what_is_drawn_and_each_episode_draws_anew(self):
        envs = self.envs([CAN + "=0.5..2"])
        seen = {}
        for seed in (1, 2, 1):
            envs.reset(seed=seed)
            drawn = [self.masses(envs)]
            envs.reset()
            drawn.append(self.masses(envs))
            for _ in range(4):  # an episode, its end, and the next one by itself
                envs.step(np.zeros(envs.action_space.shape))
            drawn.append(self.masses(envs))
            self.assertEqual(seen.setdefault(seed, drawn), drawn)
        numbers = sum(seen[1] + seen[2], [])
        self.assertTrue(all(0.5 <= number <= 2 for number in numbers), numbers)
        # Seeds go on by one from environment to environment; all else is drawn once.
        self.assertEqual(len(set(numbers)), len(numbers) - 6)
        self.assertEqual(seen[1][0][1:], seen[2][0][:2])

    def test_what_was_drawn_is_what_moves(self):
        # Potential energy is m g z: three times the can has that of two cans more.
        heavy, light = (self.envs({CAN: Choice([factor])}) for factor in (3.0, 1.0))
        for envs in (heavy, light):
            envs.reset(seed=0)
        can = light.world.scene.bodies["/World/can"]
        height = light.world.body_poses[0, can_of(light), 2] + can.center_of_mass[2]
        np.testing.assert_allclose(heavy.world.energy[:, 1] - light.world.energy[:, 1],
                                   2 * can.mass * 9.81 * height, rtol=1e-6)

    def test_environments_do_not_depend_on_those_beside_them(self):
        vary = {CAN: LogUniform(0.5, 2), "gravity": Normal(1, 0.05)}
        three, one = self.envs(vary), GraspEnv(support.GRASP, num_envs=1, vary=vary)
        three.reset(seed=[None, 77, None])
        one.reset(seed=77)
        self.assertEqual(three.world.drawn[1], one.world.drawn[0])
        three.reset(options={"reset_mask": np.array([False, True, False])})
        one.reset()
        self.assertEqual(three.world.drawn[1], one.world.drawn[0])

    def test_noise_is_of_the_observation_and_of_the_seed(self):
        envs, exact = self.envs((), noise=Uniform(-0.01, 0.01)), self.envs(())
        first, _ = envs.reset(seed=5)
        again, _ = envs.reset(seed=5)
        other, _ = envs.reset()
        clean, _ = exact.reset(seed=5)
        np.testing.assert_array_equal(first, again)
        self.assertTrue((first != other).all())
        self.assertLess(np.abs(first - clean).max(), 0.01)
        np.testing.assert_array_equal(envs.observe(), clean)

    def test_distributions_are_what_they_say(self):
        random = np.random.default_rng(3)
        count = 20000
        for distribution, mean, low, high in (
                (Uniform(1, 3), 2, 1, 3), (LogUniform(1, 4), 3 / np.log(4), 1, 4),
                (Normal(2, 0.1), 2, 1, 3), (Normal(0, 9, -1, 1), 0, -1, 1),
                (Choice([1, 2, 6]), 3, 1, 6)):
            drawn = distribution.sample(random, (count,))
            self.assertAlmostEqual(drawn.mean(), mean, delta=0.06, msg=distribution)
            self.assertTrue((drawn >= low).all() and (drawn <= high).all(), distribution)
        for wrong in (lambda: Uniform(2, 1), lambda: LogUniform(0, 1), lambda: Normal(0, -1),
                      lambda: Choice([]), lambda: Uniform(0, np.inf)):
            with self.assertRaises(ValueError):
                wrong()
        for vary, kind in ((["bodyMass=heavy"], ValueError), ("bodyMass=1..2", TypeError),
                           ({"joints.upper": Normal(1, 0.1)}, ValueError)):
            with self.assertRaises(kind):
                self.envs(vary)

    def test_what_is_part_of_the_model_is_drawn_once(self):
        envs = self.envs(["joints.upper=0.9..1.1"])
        drawn = envs.world.drawn
        envs.reset(seed=3)
        self.assertEqual(envs.world.drawn, drawn)
        with self.assertRaises(ValueError):
            envs.world.set_drawn(0, [[1.05]])

    def test_gymnasium_makes_them_by_name(self):
        name = "tenon_usd.gym:tenon/Grasp-v0"
        envs = gymnasium.make_vec(name, num_envs=3, asset=support.GRASP)
        self.assertIsInstance(envs.unwrapped, GraspEnv)
        self.assertEqual(envs.reset(seed=0)[0].shape[0], 3)
        env = gymnasium.make(name, asset=support.GRASP, vary=[CAN + "=0.5..2"], episode_time=0.1)
        check_env(env.unwrapped, skip_render_check=True)
        first, _ = env.reset(seed=4)
        self.assertEqual(first.shape, env.observation_space.shape)
        done = False
        while not done:
            _, reward, terminated, truncated, _ = env.step(np.zeros(env.action_space.shape))
            done = terminated or truncated
        self.assertIsInstance(reward, float)
        self.assertEqual(env.spec.id, "tenon/Grasp-v0")


def can_of(envs):
    return envs.world.body_names.index("/World/can")


def grasping(envs, time):
    """What the asset's own drives aim at, as an action."""
    scene = envs.world.scene
    tracks = {track.joint: track for track in scene.drive_tracks
              if track.value == "targetPosition"}
    targets = [np.interp(time, tracks[i].times, tracks[i].values) if i in tracks
               else drive.target_position
               for i, joint in enumerate(scene.joints) for drive in joint.drives]
    return 2 * (np.array(targets) - envs._low) / (envs._high - envs._low) - 1


if __name__ == "__main__":
    support.main()
