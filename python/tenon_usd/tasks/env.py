# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Environments of Gymnasium for tasks that files describe."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .._arrays import counted
from .._lists import no_such
from .._toml import Fault
from .._tenon import Stage as OpenedStage
from ..errors import NotFoundError
from ..gym import Array, AssetVectorEnv, Mask, SingleEnv
from ..observations import Entry, Observer, outputs_of
from ..options import PathLike
from .pushes import Pushes, drawn
from .starts import Starts
from .task import Observation, Reward, Task, TaskError, Termination, load

Float = npt.NDArray[np.float64]


class TaskEnv(AssetVectorEnv):
    """Environments of a task: a Task, or the file that describes it (tenon_usd.tasks.load).

    Subclasses override what AssetVectorEnv has for that: reward(), is_over(), draw(), started(),
    observe() with observation_spec, told(); values(NAME) has numbers of the world by name, `goals`
    what was drawn, which draw() may change.
    `asset` and `options` (those of AssetVectorEnv) go before what the file says. infos have each
    term of the reward, "reward.NAME", and each reason of an end, "over.NAME". Raises TaskError
    where a row of the file names what the asset does not have, with its line.
    """

    def __init__(self, task: Task | PathLike, num_envs: int = 1, *,
                 asset: PathLike | OpenedStage | None = None, **options: Any) -> None:
        self.task: Task = task if isinstance(task, Task) else load(task)
        read = self.task
        num_envs = counted("num_envs", num_envs)
        self.goals: dict[str, Float] = {
            goal.name: np.zeros((num_envs, len(goal.values))) for goal in read.goals}
        """What each environment drew for each goal, shape (envs, numbers)."""
        self.actions: Float = np.zeros((num_envs, 0))
        """The last actions, shape (envs, actions), as step() was given them."""
        self._changes = self.actions
        given: dict[str, Any] = {"frame_time": read.frame, "episode_time": read.episode,
                                 "vary": read.draws, "actuators": read.actions, "observations": []}
        if read.actions:
            given["drives"] = ()
        for key, value in (("engine", read.engine), ("physics", read.physics),
                           ("time_step", read.step)):
            if value is not None:
                given[key] = value
        given |= options
        if type(self).reward is TaskEnv.reward and not (
                read.rewards or any(each.reward for each in read.terminations)):
            warnings.warn(f"{read.source} has no [[reward]]: every step gives 0", stacklevel=2)
        given["outputs"] = [*given.get("outputs", ()), *outputs_of(self._names())]
        super().__init__(read.asset_path if asset is None else asset, num_envs, **given)

    def _names(self) -> list[str]:
        """What the rows read of the world."""
        rows = [name for *_, names in self._rows() for name in names]
        return [name for name in dict.fromkeys(rows) if not self._is_own(name)]

    def _rows(self) -> list[tuple[str, Observation | Reward | Termination, list[str]]]:
        """What measures: its place in the file, and the names that it mentions."""
        kinds: list[tuple[str, Sequence[Observation | Reward | Termination]]] = [
            ("observation", self.task.observations), ("reward", self.task.rewards),
            ("termination", self.task.terminations)]
        found = []
        for kind, rows in kinds:
            for i, row in enumerate(rows, 1):
                of = list(_listed(row.of))
                to = [row.to] if isinstance(row.to, str) else []
                found.append((f"{kind} {i}", row, of + to))
        return found

    def _is_own(self, name: str) -> bool:
        return name == "action" or name.startswith("goal.")

    def _make_spaces(self) -> None:
        self.actions = np.zeros((self.num_envs, len(self._low)))
        self._changes = np.zeros_like(self.actions)
        self._find_names()
        super()._make_spaces()

    def _find_names(self) -> None:
        """Where each name of the file is read. Raises TaskError."""
        task, faults = self.task, self._wrong_names()
        self.starts: Starts = Starts(self.world, task.starts)
        faults += self.starts.faults
        try:
            self.pushes: Pushes = Pushes(self.world, task.pushes)
        except (NotFoundError, ValueError) as error:
            faults.append(Fault("push", task.pushes[0].line, str(error)))
        if faults:
            raise TaskError(task.source, faults)
        names = self._names()
        self._signals = Observer(self.world, names)
        ends = np.cumsum([0, *self._signals.counts])
        self._parts = {name: slice(ends[i], ends[i + 1]) for i, name in enumerate(names)}
        self._others: dict[str, Observer] = {}
        self._read_now()
        self._entries = tuple(entry for row in task.observations for entry in self._seen(row))
        self._scales = np.concatenate([np.full(self._size(row.of), row.scale)
                                       for row in task.observations] or [np.zeros(0)])
        self._check_sizes()

    def _wrong_names(self) -> list[Fault]:
        """Names of numbers that there are not, with their rows."""
        lines = [(name, place, row.line) for place, row, names in self._rows() for name in names]
        faults: list[Fault] = []
        for name, place, line in lines:
            try:
                if name.startswith("goal."):
                    self._goal(name)
                elif name != "action":
                    Observer(self.world, [name])
            except (NotFoundError, ValueError) as error:
                faults.append(Fault(place, line, str(error)))
        return faults

    def _check_sizes(self) -> None:
        """Distances are between as many numbers. Raises TaskError."""
        faults = []
        for place, row, _ in self._rows():
            size = self._size(row.of)
            to = self.values(row.to).shape[1] if isinstance(row.to, str) else len(row.to)
            if to not in (0, 1, size):
                faults.append(Fault(place, row.line, f"`of` has {size} numbers, `to` has {to}"))
        if faults:
            raise TaskError(self.task.source, faults)

    def _size(self, of: str | tuple[str, ...]) -> int:
        return sum(self.values(name).shape[1] for name in _listed(of))

    def _goal(self, name: str) -> Float:
        goal = name.removeprefix("goal.")
        if goal not in self.goals:
            raise NotFoundError(no_such(goal, list(self.goals)))
        return self.goals[goal]

    def _of(self, name: str) -> list[Entry]:
        if name == "action":
            return [Entry(f"action.{i}", "", -1.0, 1.0) for i in range(self.actions.shape[1])]
        if name.startswith("goal."):
            return [Entry(f"{name}.{i}") for i in range(self._goal(name).shape[1])]
        return list(self._signals.entries[self._parts[name]])

    def _seen(self, row: Observation) -> list[Entry]:
        """The numbers of a row; without ranges where they are seen from elsewhere."""
        entries, to = [entry for name in _listed(row.of) for entry in self._of(name)], row.to
        if isinstance(to, str):
            return [Entry(f"{entry.name} - {to}", entry.unit) for entry in entries]
        if not to:
            return entries
        return [Entry(f"{entry.name} - {to[i % len(to)]:g}", entry.unit)
                for i, entry in enumerate(entries)]

    @property
    def observation_spec(self) -> tuple[Entry, ...]:
        """What each number of an observation is before its `scale`."""
        return self._entries

    # ---- numbers by name

    def values(self, name: str) -> Float:
        """The numbers that are called `name`, after the last step, shape (envs, numbers).

        A name of tenon_usd.observations, whether the file mentions it or not, "goal.NAME", or
        "action". Raises NotFoundError; InvalidError for driveEffort, contactForce and sensor where
        neither the file nor `outputs` asks for what they need.
        """
        if name == "action":
            return self.actions
        if name.startswith("goal."):
            return self._goal(name)
        if name in self._parts:
            return self._now[:, self._parts[name]]
        if name not in self._others:
            self._others[name] = Observer(self.world, [name])
        return self._others[name].read()

    def _read_now(self) -> None:
        self._now = self._signals.read()

    def _offset(self, of: tuple[str, ...], to: str | tuple[float, ...]) -> Float:
        """How far numbers are from others, shape (envs, numbers)."""
        numbers = np.concatenate([self.values(name) for name in of], axis=1)
        if isinstance(to, str):
            return np.asarray(numbers - self.values(to))
        return np.asarray(numbers - np.array(to)) if to else numbers

    # ---- what the rows say

    def term(self, row: Reward) -> Float:
        """One term of the reward, without its weight, shape (envs,)."""
        if row.term == "constant":
            return np.ones(self.num_envs)
        if row.term in ("action", "action_change"):
            actions = self.actions if row.term == "action" else self._changes
            return np.asarray((actions**2).sum(axis=1))
        offset = self._offset(row.of, row.to)
        square = (offset**2).sum(axis=1)
        made = {
            "value": lambda: offset.sum(axis=1),
            "distance": lambda: np.sqrt(square),
            "square": lambda: square,
            "near": lambda: np.exp(-square / row.width**2),
            "within": lambda: (np.sqrt(square) < row.width).astype(np.float64),
            "tolerance": lambda: tolerance(offset, row).mean(axis=1),
        }[row.term]()
        return np.asarray(made)

    def test(self, row: Termination) -> Mask:
        """Where a reason to end holds, shape (envs,)."""
        offset = self._offset(row.of, row.to)
        numbers = np.concatenate([self.values(name) for name in row.of], axis=1)
        distance = np.sqrt((offset**2).sum(axis=1))
        over = np.zeros(self.num_envs, dtype=bool)
        if row.above is not None:
            over |= (numbers > row.above).any(axis=1)
        if row.below is not None:
            over |= (numbers < row.below).any(axis=1)
        if row.beyond is not None:
            over |= distance > row.beyond
        if row.within is not None:
            over |= distance < row.within
        return over

    def reward(self) -> Array:
        """The sum of the terms and of their products, shape (envs,)."""
        total = np.zeros(self.num_envs)
        products: dict[str, Array] = {}
        for row in self.task.rewards:
            if row.product:
                products[row.product] = products.get(row.product, 1.0) * self._weighed(row)
            else:
                total += self._weighed(row)
        for made in products.values():
            total += made
        for reason in self.task.terminations:
            total += reason.reward * self._reasons[reason.name]
        return total

    def _weighed(self, row: Reward) -> Array:
        return row.offset + row.weight * self._terms[row.name]

    def is_over(self) -> Mask:
        """Where any reason to end holds, shape (envs,)."""
        over = np.zeros(self.num_envs, dtype=bool)
        for reason in self._reasons.values():
            over |= reason
        return over

    def told(self) -> dict[str, Any]:
        """Terms of the reward times their weights, and reasons of an end, by name."""
        return {**{f"reward.{row.name}": self._weighed(row) for row in self.task.rewards},
                **{f"over.{name}": held for name, held in self._reasons.items()}}

    def observe(self) -> Array:
        """Observations of all environments with their scales, without noise."""
        self._read_now()
        numbers = [self._offset(_listed(row.of), row.to) for row in self.task.observations]
        whole = np.concatenate(numbers or [np.zeros((self.num_envs, 0))], axis=1)
        return np.asarray(whole * self._scales)

    def _observed(self) -> Array:
        observations = super()._observed()
        at = 0
        for row in self.task.observations:
            size = self._size(row.of)
            if row.noise is not None:
                for one, random in zip(observations[:, at:at + size], self._randoms):
                    one += row.noise.sample(random, one.shape)
            at += size
        return observations

    def _act(self, actions: Array) -> None:
        held = np.clip(np.asarray(actions, dtype=np.float64), -1.0, 1.0)
        self.pushes.act(self._randoms)
        super()._act(held)
        self._changes = held - self.actions
        self.actions = held
        self._look()

    def _look(self) -> None:
        self._read_now()
        self._terms = {row.name: self.term(row) for row in self.task.rewards}
        self._reasons = {row.name: self.test(row) for row in self.task.terminations}

    def draw(self, env: int, random: np.random.Generator) -> None:
        """Goals, starts and the first pushes of one environment."""
        for goal in self.task.goals:
            self.goals[goal.name][env] = [drawn(value, random) for value in goal.values]
        self.starts.draw(env, random)
        self.pushes.draw(env, random)

    def started(self, envs: Mask) -> None:
        """Joints and bodies where they start; actions as if there was none before."""
        if self.task.starts:
            self.starts.started(envs)
        self.pushes.started(envs)
        self.actions = np.where(envs[:, None], 0.0, self.actions)
        self._look()


def _listed(of: str | tuple[str, ...]) -> tuple[str, ...]:
    return (of,) if isinstance(of, str) else of


def tolerance(numbers: Float, row: Reward) -> Float:
    """1 where a number is from `low` to `high`, less the further it is beyond: `at_margin` where
    that is the margin. The same shape as `numbers`."""
    beyond = np.maximum(np.maximum(row.low - numbers, numbers - row.high), 0.0)
    if row.margin == 0:
        return np.asarray((beyond == 0).astype(np.float64))
    far, v = beyond / row.margin, row.at_margin
    with np.errstate(over="ignore"):
        return np.asarray({
            "gaussian": lambda: v ** (far ** 2),
            "linear": lambda: np.maximum(1 - far * (1 - v), 0),
            "quadratic": lambda: np.maximum(1 - far ** 2 * (1 - v), 0),
            "cosine": lambda: 0.5 + 0.5 * np.cos(np.minimum(
                far * math.acos(2 * v - 1), math.pi)),
            "hyperbolic": lambda: 1 / np.cosh(far * math.acosh(1 / v)),
            "long_tail": lambda: 1 / (1 + far ** 2 * (1 / v - 1)),
            "reciprocal": lambda: 1 / (1 + far * (1 / v - 1)),
            "tanh_squared": lambda: 1 - np.tanh(far * math.atanh(math.sqrt(1 - v))) ** 2,
        }[row.shape]())


def single_task(task: Task | PathLike, **options: Any) -> SingleEnv:
    """One environment of a task, for gymnasium.make(): observations (size,), actions (actions,)."""
    return SingleEnv(TaskEnv, task=task, **options)


__all__ = ["TaskEnv", "single_task"]
