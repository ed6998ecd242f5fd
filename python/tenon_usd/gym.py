# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Vector environments of Gymnasium on assets: pip install tenon-usd[gym].

    from tenon_usd.gym import GraspEnv

    envs = GraspEnv("grasp.usda", num_envs=64)
    observations, infos = envs.reset(seed=0)
    observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())

By name, with Gymnasium's own functions, which import this module (NAMES has all names):

    gymnasium.make_vec("tenon_usd.gym:tenon/Grasp-v0", num_envs=64, asset="grasp.usda")
    gymnasium.make("tenon_usd.gym:tenon/Grasp-v0", asset="grasp.usda")

Tasks that a file describes are in tenon_usd.tasks.
"""

from __future__ import annotations

import inspect
import math
import warnings
from collections.abc import Iterable, Mapping
from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from . import draws
from ._arrays import counted, index, seconds, texts
from ._lists import no_such
from ._tenon import Stage
from .actuators import Actuator, Actuators, fitting
from .draws import Distribution, Vary
from .errors import InvalidError
from .observations import Entry, Observer, outputs_of
from .options import OpenOptions, PathLike
from .rendering import Picture, Renderer, Window
from .world import World

Array = npt.NDArray[Any]
Mask = npt.NDArray[np.bool_]
RENDER_MODES = ("human", "rgb_array")


def _time(what: str, number: float) -> float:
    time = seconds(what, number)
    if time == 0:
        raise InvalidError(f"{what} must be above 0 seconds")
    return time


def _check_options(options: Iterable[str]) -> None:
    """Raises TypeError, with the one that was meant, for one that nothing takes."""
    known = {*inspect.signature(AssetVectorEnv).parameters, *inspect.signature(World).parameters,
             *OpenOptions.__annotations__} - {"options", "world_options"}
    for name in options:
        if name not in known:
            raise TypeError(f"got an unexpected keyword argument; {no_such(name, sorted(known))}")


def _steps_of(frame_time: float, time_step: float) -> int:
    """Whole time steps of a frame; a warning where they are not what was asked for."""
    frame_time = _time("frame_time", frame_time)
    steps = max(1, round(frame_time / time_step))
    if not math.isclose(steps * time_step, frame_time, rel_tol=1e-6):
        warnings.warn(f"a frame of {frame_time:g} s is no whole number of time steps of "
                      f"{time_step:g} s: it takes {steps * time_step:g} s; "
                      f"time_step={frame_time:g} or a part of it makes it exact", stacklevel=3)
    return steps


def _check_actions(actions: Array, space: spaces.Space[Array]) -> None:
    if np.shape(actions) != space.shape:
        raise ValueError(f"actions have the shape {np.shape(actions)}; expected {space.shape}")


class AssetVectorEnv(VectorEnv[Array, Array, Array]):
    """Environments of one asset.

    An action has one number in [-1, 1] for each drive of a joint that follows no other: -1 is the
    lower limit of the joint [rad or m], 1 the upper one; then one for each joint of `actuators`
    (tenon_usd.actuators), between the least and the largest command; these joints' own drives get
    none. `drives` are paths of joints, last elements of them, or regular expressions: other drives
    get no action and keep their targets; None: all. `action_spec` says what -1 and 1 are. An
    observation has what `observations` name (tenon_usd.observations); None: the positions of the
    joints [rad or m], their velocities [rad/s or m/s], then of each of `bodies` the position [m]
    and orientation (w, x, y, z).
    `observation_spec` says what each number is. One step takes `frame_time` [s], in whole time
    steps of the world (a warning where that is another time); an episode ends after `episode_time`
    [s]. `world_options` go to World. Subclasses say what is rewarded (reward) and what ends an
    episode early (is_over); one that observes more overrides observe() and observation_spec.

    `autoreset_mode` is one of Gymnasium's: NEXT_STEP resets environments that ended in the step
    after; SAME_STEP at once, with the last observation in infos["final_obs"] and what else was told
    in infos["final_info"]; DISABLED leaves it to reset(options={"reset_mask": mask}).

    Each environment draws anew whenever an episode begins: `vary` are distributions by the names of
    World's `vary` (tenon_usd.draws), or texts of it, numbers of actuators may be distributions, and
    `noise` is added to each number of an observation. What environment i draws depends on its own
    generator alone: reset(seed=s) starts it from s + i, or from the i-th of a list, and the
    episodes that follow go on from there; `seed` is that of the time before. Fields of the scene
    are part of the model: drawn once.

    `render_mode` "rgb_array" lets render() give pictures, "human" shows environment 0 in a window
    after each step; `render_options` go to tenon_usd.rendering.Renderer. Both raise MissingError
    where what they need is not installed.
    """

    observation_space: spaces.Space[Array]
    action_space: spaces.Space[Array]
    single_observation_space: spaces.Space[Array]
    single_action_space: spaces.Space[Array]
    metadata: dict[str, Any] = {"autoreset_mode": AutoresetMode.NEXT_STEP,
                                "render_modes": list(RENDER_MODES)}

    def __init__(
        self,
        asset: PathLike | Stage,
        num_envs: int = 1,
        *,
        bodies: Iterable[str] = (),
        observations: Iterable[str] | None = None,
        actuators: Iterable[Actuator] = (),
        drives: Iterable[str] | None = None,
        frame_time: float = 0.02,
        episode_time: float = 4.0,
        seed: int = 0,
        vary: Vary = (),
        noise: Distribution | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        render_mode: str | None = None,
        render_options: Mapping[str, Any] | None = None,
        **world_options: Any,
    ) -> None:
        if render_mode is not None and render_mode not in RENDER_MODES:
            raise ValueError(f"render_mode {render_mode!r}: there are None, "
                             + ", ".join(map(repr, RENDER_MODES)))
        _check_options(world_options)
        num_envs = counted("num_envs", num_envs)
        self._vary = draws.distributions(vary)
        if noise is not None:
            draws.check("noise", noise)
        self.noise = noise
        named = None if observations is None else texts("observations", observations)
        outputs = [*world_options.pop("outputs", ()), *outputs_of(named or ())]
        self.world: World = World(asset, envs=num_envs, seed=seed, vary=draws.texts(self._vary),
                                  outputs=list(dict.fromkeys(outputs)), **world_options)
        self.num_envs = num_envs
        self._seed_all(seed)
        self.frame_steps: int = _steps_of(frame_time, self.world.time_step)
        self.episode_time: float = _time("episode_time", episode_time)
        self._mode = AutoresetMode(autoreset_mode)
        self.render_mode = render_mode
        self.metadata = {**type(self).metadata, "autoreset_mode": self._mode,
                         "render_fps": round(1 / (self.frame_steps * self.world.time_step))}
        names = self.world.body_names
        self.bodies: list[int] = [index("bodies", names, body) for body in texts("bodies", bodies)]
        chosen = list(actuators)
        self.actuators: Actuators | None = Actuators(self.world, chosen) if chosen else None
        self._low, self._high = self._bounds(None if drives is None else texts("drives", drives))
        self._targets = np.tile(self.world._first_targets, (num_envs, 1))
        self._observer = Observer(self.world, self._default_names() if named is None else named)
        self._renderer: Renderer | None = None
        self._window: Window | None = None
        self._ended = np.zeros(num_envs, dtype=bool)
        self._make_spaces()
        if render_mode is not None:
            self._renderer = Renderer(self.world, **(render_options or {}))
        if render_mode == "human":
            self._window = Window("tenon")
        self._restart(np.ones(num_envs, dtype=bool))

    def _make_spaces(self) -> None:
        size, actions = len(self.observation_spec), len(self._low)
        self.single_observation_space = spaces.Box(-np.inf, np.inf, (size,), np.float64)
        self.single_action_space = spaces.Box(-1.0, 1.0, (actions,), np.float64)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)

    def _default_names(self) -> list[str]:
        names = ["jointPosition", "jointVelocity"] if self.world.joint_names else []
        for body in self.bodies:
            path = self.world.body_names[body]
            names += [f"position@{path}", f"orientation@{path}"]
        return names

    @property
    def observation_spec(self) -> tuple[Entry, ...]:
        """What each number of an observation is: name, unit, and the range by the asset."""
        return self._observer.entries

    @property
    def action_spec(self) -> tuple[Entry, ...]:
        """What each number of an action commands: `low` is what -1 means, `high` what 1 does."""
        return self._action_entries

    def _seed_all(self, seed: Any) -> None:
        seeds: list[int | None]
        if isinstance(seed, Iterable) and not isinstance(seed, str):
            seeds = [None if one is None else counted("seed", one) for one in seed]
        else:
            first = counted("seed", seed)
            seeds = [first + i for i in range(self.num_envs)]
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
        if numbers:
            self.world.set_drawn(env, numbers)
        if self.actuators is not None:
            self.actuators.draw(env, self._randoms[env])
        self.draw(env, self._randoms[env])

    def _bounds(self, drives: list[str] | None) -> tuple[Array, Array]:
        """What -1 and 1 mean, shape (actions,) each: limits of the driven joints [rad or m], of
        unlimited ones a turn, then the ranges of actuators.

        A drive of a joint that follows another one says what effort it takes, and gets no action.
        """
        joints = [joint for joint in self.world.scene.joints for _ in joint.drives]
        names = self.world.drive_names
        actuated = self.actuators.names if self.actuators is not None else []
        meant = range(len(names)) if drives is None else sorted(
            {i for drive in drives for i in fitting(drive, names)})
        self._acted = [i for i in meant
                       if not len(joints[i].mimics) and names[i] not in actuated]
        entries = []
        for i in self._acted:
            straight = joints[i].type == "prismatic"
            entries.append(Entry(f"target@{names[i]}", "m" if straight else "rad",
                                 float(max(joints[i].lower, -2 * math.pi)),
                                 float(min(joints[i].upper, 2 * math.pi))))
        if self.actuators is not None:
            them = self.actuators
            entries += [Entry(f"command@{name}", unit, float(low), float(high))
                        for name, unit, low, high in zip(them.names, them.units, them.low,
                                                         them.high)]
        self._action_entries = tuple(entries)
        low, high = np.array([(entry.low, entry.high) for entry in entries],
                             dtype=np.float64).reshape(-1, 2).T
        return low, high

    # ---- what a task says

    def reward(self) -> Array:
        """What each environment is rewarded for the step that was just made, shape (envs,)."""
        return np.zeros(self.num_envs)

    def is_over(self) -> Mask:
        """Which environments ended for a reason of the task, shape (envs,)."""
        return np.zeros(self.num_envs, dtype=bool)

    def draw(self, env: int, random: np.random.Generator) -> None:
        """Called before environment `env` is reset: what else it draws for its next episode."""

    def started(self, envs: Mask) -> None:
        """Called after environments were reset: a mask of shape (envs,)."""

    def told(self) -> dict[str, Any]:
        """What else a step tells in its infos: arrays of shape (envs,) by name."""
        return {}

    # ---- what Gymnasium asks

    def observe(self) -> Array:
        """Observations of all environments, shape (envs, size), without noise."""
        return self._observer.read()

    def _observed(self) -> Array:
        observations = np.asarray(self.observe())
        if observations.shape != self.observation_space.shape:
            raise ValueError(f"observe() gave the shape {observations.shape}; observation_spec has "
                             f"{len(self.observation_spec)} numbers for each of {self.num_envs} "
                             "environments: override it, too")
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
        if seed is not None and not isinstance(seed, Iterable):
            self._np_random = np.random.default_rng(seed)
        mask = np.asarray((options or {}).get("reset_mask", np.ones(self.num_envs, dtype=bool)))
        if mask.dtype != bool or mask.shape != (self.num_envs,):
            raise ValueError(f"reset_mask is a mask of bool of the shape ({self.num_envs},), not "
                             f"of {mask.dtype} and {mask.shape}")
        self._restart(mask)
        self._show()
        return self._observed(), {}

    def step(
        self, actions: Array
    ) -> tuple[Array, Array, Array, Array, dict[str, Any]]:
        """Actions of shape (envs, actions); observations, rewards, terminated, truncated, infos."""
        _check_actions(actions, self.action_space)
        fresh = self._ended.copy()
        if fresh.any():
            if self._mode == AutoresetMode.DISABLED:
                raise ValueError(f"environments {np.flatnonzero(fresh).tolist()} ended: "
                                 'reset(options={"reset_mask": terminated | truncated}) first')
            self._restart(fresh)
        self._act(actions)
        if fresh.any():
            # Those that were just reset show their first observation: they are put back after it.
            self._back(fresh)
        unstable = np.array([failure is not None for failure in self.world.failures()])
        rewards = np.where(fresh | unstable, 0.0, self._of_each("reward()", self.reward()))
        terminated = (self._of_each("is_over()", self.is_over()) | unstable) & ~fresh
        truncated = (self.world.time >= self.episode_time - 1e-9) & ~terminated & ~fresh
        self._ended = terminated | truncated
        infos = {"unstable": unstable, **self.told()}
        observations = self._observed()
        if self._mode == AutoresetMode.SAME_STEP and self._ended.any():
            observations = self._begun_again(observations, infos)
        self._show()
        return observations, rewards, terminated, truncated, infos

    def _of_each(self, what: str, values: Array) -> Array:
        """What a subclass says of each environment, shape (envs,)."""
        if np.shape(values) != (self.num_envs,):
            raise ValueError(f"{what} gave the shape {np.shape(values)}; expected "
                             f"({self.num_envs},)")
        return values

    def _act(self, actions: Array) -> None:
        """One frame with these actions. Raises InvalidError where one is no finite number."""
        share = (np.clip(actions, -1.0, 1.0) + 1.0) / 2.0
        commands = self._low + share * (self._high - self._low)
        driven = len(self._acted)
        self._targets[:, self._acted] = commands[:, :driven]
        if self.actuators is None:
            self.world.set_drive_targets(self._targets)
            self.world._batch.step(self.frame_steps)
        else:
            self.actuators.set_commands(commands[:, driven:])
            self.actuators.set_other_targets(self._targets)
            self.actuators.step(self.frame_steps)

    def _begun_again(self, last: Array, infos: dict[str, Any]) -> Array:
        """The first observations of environments that ended; what was last goes to infos."""
        ended = self._ended.copy()
        final = {name: np.where(ended, values, np.zeros_like(values))
                 for name, values in infos.items()}
        infos["final_obs"] = np.where(ended[:, None], last, 0.0)
        infos["final_info"] = {**final, **{f"_{name}": ended.copy() for name in final}}
        infos["_final_obs"] = infos["_final_info"] = ended
        self._restart(ended)
        return np.where(ended[:, None], self._observed(), last)

    def render(self) -> tuple[Picture, ...] | None:  # type: ignore[override, unused-ignore]
        """A picture of each environment, shape (height, width, 3), with "rgb_array"; else None."""
        if self.render_mode != "rgb_array" or self._renderer is None:
            return None
        return tuple(self._renderer.draw(env) for env in range(self.num_envs))

    def _show(self) -> None:
        if self._window is not None and self._renderer is not None:
            self._window.show(self._renderer.draw(0))

    def close_extras(self, **kwargs: Any) -> None:
        """Closes the window and what draws."""
        if self._window is not None:
            self._window.close()
        if self._renderer is not None:
            self._renderer.close()
        self._window = self._renderer = None

    def _restart(self, mask: Mask) -> None:
        for env in np.flatnonzero(mask):
            self._draw(int(env))
        self._back(mask)
        self._ended[mask] = False

    def _back(self, mask: Mask) -> None:
        """Environments at the start, with what was drawn."""
        self.world.reset(mask)
        if self.actuators is not None:
            self.actuators.restarted(mask)
        self.started(mask)


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

    def started(self, envs: Mask) -> None:
        """Remembers where the cans stand."""
        self._start_height = np.where(envs, self._height(), self._start_height)

    def reward(self) -> Array:
        """1 for each can that is held, shape (envs,)."""
        missing = np.maximum(2 - self.world.contact_counts, 0)
        return 1.0 - np.minimum(self.fallen() / 0.1, 1.0) - 0.001 * missing

    def is_over(self) -> Mask:
        """Cans that have fallen 0.1 m, shape (envs,)."""
        over: Mask = self.fallen() > 0.1
        return over


class SingleEnv(gymnasium.Env[Array, Array]):
    """One environment of a vector of one, for gymnasium.make(): observations (size,), actions
    (actions,) in the units of `kind`, a class of this module; `options` are those of the class.

    An episode that ended goes on with reset().
    """

    metadata: dict[str, Any] = {"render_modes": list(RENDER_MODES)}

    def __init__(self, kind: type[AssetVectorEnv] = AssetVectorEnv, **options: Any) -> None:
        self.envs: AssetVectorEnv = kind(num_envs=1, **options)
        self.observation_space = self.envs.single_observation_space
        self.action_space = self.envs.single_action_space
        self.render_mode = self.envs.render_mode
        self.metadata = {**type(self).metadata, "render_fps": self.envs.metadata["render_fps"]}

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Array, dict[str, Any]]:
        """The start of an episode, drawn again; observation of shape (size,)."""
        super().reset(seed=seed)
        observations, _ = self.envs.reset(seed=seed)
        return observations[0], {}

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        """An action (actions,); observation (size,), reward, terminated, truncated, info."""
        _check_actions(action, self.action_space)
        observations, rewards, terminated, truncated, infos = self.envs.step(
            np.asarray(action)[None])
        return (observations[0], float(rewards[0]), bool(terminated[0]), bool(truncated[0]),
                {name: values[0].item() for name, values in infos.items()})

    def render(self) -> Picture | None:  # type: ignore[override, unused-ignore]
        """A picture of shape (height, width, 3) with "rgb_array"; else None."""
        pictures = self.envs.render()
        return pictures[0] if pictures else None

    def close(self) -> None:
        """Closes the window and what draws."""
        self.envs.close()


def _single_grasp(**options: Any) -> SingleEnv:
    return SingleEnv(GraspEnv, **options)


#: Names that Gymnasium knows from this module's import on: what makes one, what makes many, and
#: their options.
NAMES: dict[str, tuple[Any, Any, dict[str, Any]]] = {
    "tenon/Asset-v0": (SingleEnv, AssetVectorEnv, {}),
    "tenon/Grasp-v0": (_single_grasp, GraspEnv, {}),
    "tenon/Task-v0": ("tenon_usd.tasks.env:single_task", "tenon_usd.tasks.env:TaskEnv", {}),
    "tenon/Balance-v0": ("tenon_usd.tasks.env:single_task", "tenon_usd.tasks.env:TaskEnv",
                         {"task": "balance"}),
    "tenon/Reach-v0": ("tenon_usd.tasks.env:single_task", "tenon_usd.tasks.env:TaskEnv",
                       {"task": "reach"}),
}
for _name, (_single, _vector, _options) in NAMES.items():
    if _name not in gymnasium.registry:
        gymnasium.register(_name, entry_point=_single, vector_entry_point=_vector, kwargs=_options)
