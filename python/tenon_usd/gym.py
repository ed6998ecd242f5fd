# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Vector environments of Gymnasium on assets: pip install tenon-usd[gym].

    from tenon_usd.gym import GraspEnv

    envs = GraspEnv("grasp.usda", num_envs=64)
    observations, infos = envs.reset(seed=0)
    observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from ._tenon import Stage
from .options import PathLike
from .world import World

Array = npt.NDArray[Any]


class AssetVectorEnv(VectorEnv[Array, Array, Array]):
    """Environments of one asset: actions are targets of its drives, between the limits of joints.

    An action has one number in [-1, 1] for each drive: -1 is the lower limit of its joint [rad or
    m], 1 the upper one. An observation has the positions of the joints [rad or m], their velocities
    [rad/s or m/s], then of each of `bodies` the position [m] and orientation (w, x, y, z). One step
    takes `frame_time` [s]; an episode ends after `episode_time` [s]. `world_options` go to World.
    Subclasses say what is rewarded (reward) and what ends an episode early (is_over). Environments
    that ended are reset by the step after, as AutoresetMode.NEXT_STEP has it.
    """

    observation_space: spaces.Space[Array]
    action_space: spaces.Space[Array]
    single_observation_space: spaces.Space[Array]
    single_action_space: spaces.Space[Array]
    metadata: dict[str, Any] = {"autoreset_mode": AutoresetMode.NEXT_STEP, "render_modes": []}

    def __init__(
        self,
        asset: PathLike | Stage,
        num_envs: int = 1,
        *,
        bodies: Iterable[str] = (),
        frame_time: float = 0.02,
        episode_time: float = 4.0,
        seed: int = 0,
        **world_options: Any,
    ) -> None:
        self.world: World = World(asset, envs=num_envs, seed=seed, **world_options)
        self.num_envs = num_envs
        self.frame_steps: int = max(1, round(frame_time / self.world.time_step))
        self.episode_time = episode_time
        names = self.world.body_names
        self.bodies: list[int] = [names.index(body) for body in bodies]
        self._low, self._high = self._bounds()
        size = 2 * len(self.world.joint_names) + 7 * len(self.bodies)
        self.single_observation_space = spaces.Box(-np.inf, np.inf, (size,), np.float64)
        self.single_action_space = spaces.Box(-1.0, 1.0, (len(self._low),), np.float64)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._ended = np.zeros(num_envs, dtype=bool)

    def _bounds(self) -> tuple[Array, Array]:
        """Limits of the driven joints [rad or m], shape (drives,) each; unlimited: one turn."""
        rows = [
            (max(joint.lower, -2 * np.pi), min(joint.upper, 2 * np.pi))
            for joint in self.world.scene.joints
            for _ in joint.drives
        ]
        low, high = np.array(rows, dtype=np.float64).reshape(-1, 2).T
        return low, high

    # ---- what a task says

    def reward(self) -> Array:
        """What each environment is rewarded for the step that was just made, shape (envs,)."""
        return np.zeros(self.num_envs)

    def is_over(self) -> npt.NDArray[np.bool_]:
        """Which environments ended for a reason of the task, shape (envs,)."""
        return np.zeros(self.num_envs, dtype=bool)

    def started(self, envs: npt.NDArray[np.bool_]) -> None:
        """Called after environments were reset: a mask of shape (envs,)."""

    # ---- what Gymnasium asks

    def observe(self) -> Array:
        """Observations of all environments, shape (envs, size)."""
        positions, velocities = self.world.joints()
        poses = self.world.body_poses[:, self.bodies, :].reshape(self.num_envs, -1)
        return np.concatenate([positions, velocities, poses], axis=1)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """All environments at their start, or those of options["reset_mask"]; (envs, size)."""
        if isinstance(seed, int):
            self._np_random = np.random.default_rng(seed)
        mask = (options or {}).get("reset_mask", np.ones(self.num_envs, dtype=bool))
        self._restart(np.asarray(mask, dtype=bool))
        return self.observe(), {}

    def step(
        self, actions: Array
    ) -> tuple[Array, Array, Array, Array, dict[str, Any]]:
        """Actions of shape (envs, drives); observations, rewards, terminated, truncated, infos."""
        fresh = self._ended.copy()
        if fresh.any():
            self._restart(fresh)
        share = (np.clip(actions, -1.0, 1.0) + 1.0) / 2.0
        self.world.set_drive_targets(self._low + share * (self._high - self._low))
        if fresh.any():
            self._step_others(fresh)
        else:
            self.world._batch.step(self.frame_steps)
        unstable = np.array([failure is not None for failure in self.world.failures()])
        rewards = np.where(fresh | unstable, 0.0, self.reward())
        terminated = (self.is_over() | unstable) & ~fresh
        truncated = (self.world.time >= self.episode_time - 1e-9) & ~terminated & ~fresh
        self._ended = terminated | truncated
        return self.observe(), rewards, terminated, truncated, {"unstable": unstable}

    def close_extras(self, **kwargs: Any) -> None:
        """Nothing is held that has to be closed."""

    def _restart(self, mask: npt.NDArray[np.bool_]) -> None:
        self.world.reset(mask)
        self._ended[mask] = False
        self.started(mask)

    def _step_others(self, fresh: npt.NDArray[np.bool_]) -> None:
        """Those that were just reset show their first observation: they are put back after it."""
        self.world._batch.step(self.frame_steps)
        self.world.reset(fresh)
        self.started(fresh)


class GraspEnv(AssetVectorEnv):
    """The hand of examples/inspire_hand/grasp.usda holds a can while the table below it sinks.

    Each step rewards 1 less the share of 0.1 m that the can has fallen, and less 0.001 for each
    contact that is missing to two. An episode ends early when the can has fallen 0.1 m.
    """

    def __init__(
        self,
        asset: PathLike | Stage,
        num_envs: int = 1,
        *,
        can: str = "/World/can",
        **options: Any,
    ) -> None:
        super().__init__(asset, num_envs, bodies=[can], **options)
        self._start_height = self._height().copy()

    def _height(self) -> Array:
        heights: Array = self.world.body_poses[:, self.bodies[0], 2]
        return heights

    def fallen(self) -> Array:
        """How far each can has fallen [m], shape (envs,)."""
        fallen: Array = np.maximum(self._start_height - self._height(), 0.0)
        return fallen

    def started(self, envs: npt.NDArray[np.bool_]) -> None:
        """Remembers where the cans stand."""
        self._start_height = np.where(envs, self._height(), self._start_height)

    def reward(self) -> Array:
        """1 for each can that is held, shape (envs,)."""
        missing = np.maximum(2 - self.world.contact_counts, 0)
        return 1.0 - np.minimum(self.fallen() / 0.1, 1.0) - 0.001 * missing

    def is_over(self) -> npt.NDArray[np.bool_]:
        """Cans that have fallen 0.1 m, shape (envs,)."""
        over: npt.NDArray[np.bool_] = self.fallen() > 0.1
        return over
