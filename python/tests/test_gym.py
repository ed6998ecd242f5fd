# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The vector environment: the grasp as a task."""

import sys

import numpy as np
import support

try:
    from tenon_usd.gym import GraspEnv
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
