# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Vector environments of Gymnasium on assets: pip install tenon-usd[gym].

    from tenon_usd.gym import GraspEnv

    envs = GraspEnv("grasp.usda", num_envs=64)
    observations, infos = envs.reset(seed=0)
    observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())

By name, with Gymnasium's own functions, which import this module:

    gymnasium.make_vec("tenon_usd.gym:tenon/Grasp-v0", num_envs=64, asset="grasp.usda")
    gymnasium.make("tenon_usd.gym:tenon/Grasp-v0", asset="grasp.usda")
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from . import draws
from ._tenon import Stage
from .draws import Distribution, Vary
from .options import PathLike
from .world import World

Array = npt.NDArray[Any]


class AssetVectorEnv(VectorEnv[Array, Array, Array]):
    """Environments of one asset: actions are targets of its drives, between the limits of joints.

    An action has one number in [-1, 1] for each drive of a joint that follows no other: -1 is the
    lower limit of the joint [rad or m], 1 the upper one. An observation has the positions of the
    joints [rad or m], their velocities [rad/s or m/s], then of each of `bodies` the position [m]
    and orientation (w, x, y, z). One step takes `frame_time` [s]; an episode ends after
    `episode_time` [s]. `world_options` go to World. Subclasses say what is rewarded (reward) and
    what ends an episode early (is_over). Environments that ended are reset by the step after, as
    AutoresetMode.NEXT_STEP has it.

    Each environment draws anew whenever an episode begins: `vary` are distributions by the names of
    World's `vary` (tenon_usd.draws), or texts of it, and `noise` is added to each number of an
    observation. What environment i draws depends on its own generator alone: reset(seed=s) starts
    it from s + i, or from the i-th of a list, and the episodes that follow go on from there; `seed`
    is that of the time before. Fields of the scene are part of the model: drawn once. Nothing is
    drawn as a picture: `render_mode` is None and metadata["render_modes"] is empty.
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
        vary: Vary = (),
        noise: Distribution | None = None,
        render_mode: str | None = None,
        **world_options: Any,
    ) -> None:
        if render_mode is not None:
            raise ValueError(f"render_mode {render_mode!r}: there is none but None; "
                             "tenon record makes films of simulations")
        self.render_mode = None
        self._vary = draws.distributions(vary)
        self.noise = noise
        self.world: World = World(asset, envs=num_envs, seed=seed, vary=draws.texts(self._vary),
                                  **world_options)
        self.num_envs = num_envs
        self._seed_all(seed)
        self.frame_steps: int = max(1, round(frame_time / self.world.time_step))
        self.episode_time = episode_time
        names = self.world.body_names
        self.bodies: list[int] = [names.index(body) for body in bodies]
        self._low, self._high = self._bounds()
        self._targets = np.tile(self.world._first_targets, (num_envs, 1))
        size = 2 * len(self.world.joint_names) + 7 * len(self.bodies)
        self.single_observation_space = spaces.Box(-np.inf, np.inf, (size,), np.float64)
        self.single_action_space = spaces.Box(-1.0, 1.0, (len(self._low),), np.float64)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._ended = np.zeros(num_envs, dtype=bool)
        self._restart(np.ones(num_envs, dtype=bool))

    def _seed_all(self, seed: int | list[int | None]) -> None:
        seeds = [seed + i for i in range(self.num_envs)] if isinstance(seed, int) else list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"{len(seeds)} seeds for {self.num_envs} environments")
        if not hasattr(self, "_randoms"):
            self._randoms = [np.random.default_rng() for _ in seeds]
        for i, one in enumerate(seeds):
            if one is not None:
                self._randoms[i] = np.random.default_rng(one)

    def _draw(self, env: int) -> None:
        """For the next reset of one environment."""
        numbers = []
        for (name, distribution), held in zip(self._vary.items(), self.world.drawn[env]):
            if not draws.is_of_model(name):
                shape = (len(held),)
                held = distribution.sample(self._randoms[env], shape).tolist()
            numbers.append(held)
        self.world.set_drawn(env, numbers)

    def _bounds(self) -> tuple[Array, Array]:
        """Limits of the driven joints [rad or m], shape (actions,) each; unlimited: one turn.

        A drive of a joint that follows another one says what effort it takes, and gets no action.
        """
        joints = [joint for joint in self.world.scene.joints for _ in joint.drives]
        self._acted = [i for i, joint in enumerate(joints) if not len(joint.mimics)]
        rows = [
            (max(joints[i].lower, -2 * np.pi), min(joints[i].upper, 2 * np.pi))
            for i in self._acted
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
        """Observations of all environments, shape (envs, size), without noise."""
        positions, velocities = self.world.joints()
        poses = self.world.body_poses[:, self.bodies, :].reshape(self.num_envs, -1)
        return np.concatenate([positions, velocities, poses], axis=1)

    def _observed(self) -> Array:
        observations = self.observe()
        if self.noise is not None:
            for row, random in zip(observations, self._randoms):
                row += self.noise.sample(random, row.shape)
        return observations

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """All environments at their start, or those of options["reset_mask"]; (envs, size).

        Each draws what varies. `seed` makes that repeatable: the one of environment i is seed + i,
        or the i-th of a list (None: it goes on).
        """
        if seed is not None:
            self._seed_all(seed)
        if isinstance(seed, int):
            self._np_random = np.random.default_rng(seed)
        mask = (options or {}).get("reset_mask", np.ones(self.num_envs, dtype=bool))
        self._restart(np.asarray(mask, dtype=bool))
        return self._observed(), {}

    def step(
        self, actions: Array
    ) -> tuple[Array, Array, Array, Array, dict[str, Any]]:
        """Actions of shape (envs, actions); observations, rewards, terminated, truncated, infos."""
        fresh = self._ended.copy()
        if fresh.any():
            self._restart(fresh)
        share = (np.clip(actions, -1.0, 1.0) + 1.0) / 2.0
        self._targets[:, self._acted] = self._low + share * (self._high - self._low)
        self.world.set_drive_targets(self._targets)
        if fresh.any():
            self._step_others(fresh)
        else:
            self.world._batch.step(self.frame_steps)
        unstable = np.array([failure is not None for failure in self.world.failures()])
        rewards = np.where(fresh | unstable, 0.0, self.reward())
        terminated = (self.is_over() | unstable) & ~fresh
        truncated = (self.world.time >= self.episode_time - 1e-9) & ~terminated & ~fresh
        self._ended = terminated | truncated
        return self._observed(), rewards, terminated, truncated, {"unstable": unstable}

    def close_extras(self, **kwargs: Any) -> None:
        """Nothing is held that has to be closed."""

    def _restart(self, mask: npt.NDArray[np.bool_]) -> None:
        if self._vary:
            for env in np.flatnonzero(mask):
                self._draw(int(env))
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
        self._start_height: Array = np.zeros(num_envs)
        super().__init__(asset, num_envs, bodies=[can], **options)

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


class SingleEnv(gymnasium.Env[Array, Array]):
    """One environment of a vector of one, for gymnasium.make(): observations (size,), actions
    (drives,) in the units of `kind`, a class of this module; `options` are those of the class.

    An episode that ended goes on with reset().
    """

    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, kind: type[AssetVectorEnv] = AssetVectorEnv, **options: Any) -> None:
        self.envs: AssetVectorEnv = kind(num_envs=1, **options)
        self.observation_space = self.envs.single_observation_space
        self.action_space = self.envs.single_action_space
        self.render_mode = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """The start of an episode, drawn again; observation of shape (size,)."""
        super().reset(seed=seed)
        observations, _ = self.envs.reset(seed=seed)
        return observations[0], {}

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """An action (drives,); observation (size,), reward, terminated, truncated, info."""
        observations, rewards, terminated, truncated, infos = self.envs.step(
            np.asarray(action)[None])
        return (observations[0], float(rewards[0]), bool(terminated[0]), bool(truncated[0]),
                {"unstable": bool(infos["unstable"][0])})


def _grasp(**options: Any) -> SingleEnv:
    return SingleEnv(GraspEnv, **options)


_KINDS: tuple[tuple[str, Any, Any], ...] = (
    ("tenon/Asset-v0", SingleEnv, AssetVectorEnv), ("tenon/Grasp-v0", _grasp, GraspEnv))
for _name, _single, _vector in _KINDS:
    if _name not in gymnasium.registry:
        gymnasium.register(_name, entry_point=_single, vector_entry_point=_vector)
