# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Random actions in the vector environment of Gymnasium.

    python grasp.py grasp.usda
"""

import sys

from tenon_usd.gym import GraspEnv

envs = GraspEnv(sys.argv[1], num_envs=8)
envs.action_space.seed(0)
observations, infos = envs.reset(seed=0)
total = 0.0
for _ in range(50):
    observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())
    total += float(rewards.sum())
print("observations", observations.shape, "mean reward", round(total / 400, 2))
