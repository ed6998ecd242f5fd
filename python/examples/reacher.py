# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""An environment of MuJoCo ported: MJCF becomes USD, a task file says what it is, and a class what
a file cannot say. Its targets lie around the arm: they are drawn as radius and angle.

    python reacher.py FOLDER
"""

import sys
from pathlib import Path

import numpy as np

import tenon_usd as tenon
from tenon_usd import tasks

HERE = Path(__file__).parent


class Reacher(tasks.TaskEnv):
    """The tip of an arm is rewarded for being near a target."""

    def draw(self, env: int, random: np.random.Generator) -> None:
        """Makes a place [m] of the radius and the angle that were drawn."""
        super().draw(env, random)
        radius, angle, _ = self.goals["target"][env]
        self.goals["target"][env] = radius * np.cos(angle), radius * np.sin(angle), 0


asset = Path(sys.argv[1]) / "reacher.usda"
# With the model's own world: its step, its gravity, and what contacts are.
tenon.convert(HERE / "reacher.xml", asset, scene=True)
envs = Reacher(HERE / "reacher.toml", num_envs=64, asset=asset)
observations, infos = envs.reset(seed=0)
envs.action_space.seed(0)
total = np.zeros(64)
for _ in range(50):
    observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())
    total += rewards
print("observations", observations.shape, "mean return", total.mean().round(2))
