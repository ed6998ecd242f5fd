# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Environments of Gymnasium for tasks that files describe."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .._lists import no_such
from .._toml import Fault
from .._tenon import Stage as OpenedStage
from ..actuators import fitting
from ..errors import NotFoundError
from ..gym import Array, AssetVectorEnv, Mask, SingleEnv
from ..observations import Entry, Observer, outputs_of
from ..options import PathLike
from .pushes import Pushes, drawn
from .task import Reward, Task, TaskError, Termination, load

Float = npt.NDArray[np.float64]


class TaskEnv(AssetVectorEnv):
    """Environments of a task: a Task, or the file that describes it (tenon_usd.tasks.load).

    Subclasses override what AssetVectorEnv has for that: reward(), is_over(), draw(), started(),
    observe(), told(); values(NAME) has numbers by the names of the file, `goals` what was drawn.
    `asset` and `options` (those of AssetVectorEnv) go before what the file says. infos have each
    term of the reward, "reward.NAME", and each reason of an end, "over.NAME". Raises TaskError
    where a row of the file names what the asset does not have, with its line.
    """

    def __init__(self, task: Task | PathLike, num_envs: int = 1, *,
                 asset: PathLike | OpenedStage | None = None, **options: Any) -> None:
        self.task: Task = task if isinstance(task, Task) else load(task)
        read = self.task
        self.goals: dict[str, Float] = {
            goal.name: np.zeros((num_envs, len(goal.values))) for goal in read.goals}
        """What each environment drew for each goal, shape (envs, numbers)."""
        self._starts = [np.zeros((num_envs, 0)) for _ in read.starts]
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
        given["outputs"] = [*given.get("outputs", ()), *outputs_of(self._names())]
        super().__init__(read.asset_path if asset is None else asset, num_envs, **given)

    def _names(self) -> list[str]:
        """What the rows read of the world."""
        rows: list[str] = [row.of for row in self.task.observations]
        measured: list[Reward | Termination] = [*self.task.rewards, *self.task.terminations]
        for row in measured:
            rows += [*row.of, *([row.to] if isinstance(row.to, str) else [])]
        return [name for name in dict.fromkeys(rows) if not self._is_own(name)]

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
        self._starting: list[tuple[bool, list[int]]] = []
        for i, start in enumerate(task.starts, 1):
            try:
                kind, _, path = start.of.partition("@")
                joints = self.world.joint_names
                columns = fitting(path, joints) if path else list(range(len(joints)))
                self._starting.append((kind == "jointVelocity", columns))
            except (NotFoundError, ValueError) as error:
                faults.append(Fault(f"reset {i}", start.line, str(error)))
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
        self._read_now()
        self._entries = tuple(entry for row in task.observations for entry in self._of(row.of))
        self._scales = np.concatenate([np.full(self.values(row.of).shape[1], row.scale)
                                       for row in task.observations] or [np.zeros(0)])
        self._check_sizes()

    def _wrong_names(self) -> list[Fault]:
        """Names of numbers that there are not, with their rows."""
        lines = [(row.of, f"observation {i}", row.line)
                 for i, row in enumerate(self.task.observations, 1)]
        rows: list[tuple[str, Sequence[Reward | Termination]]] = [
            ("reward", self.task.rewards), ("termination", self.task.terminations)]
        for kind, each in rows:
            for i, row in enumerate(each, 1):
                mentioned = [*row.of, *([row.to] if isinstance(row.to, str) else [])]
                lines += [(name, f"{kind} {i}", row.line) for name in mentioned]
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
        rows: list[tuple[str, Sequence[Reward | Termination]]] = [
            ("reward", self.task.rewards), ("termination", self.task.terminations)]
        for kind, each in rows:
            for i, row in enumerate(each, 1):
                size = sum(self.values(name).shape[1] for name in row.of)
                to = self.values(row.to).shape[1] if isinstance(row.to, str) else len(row.to)
                if to not in (0, 1, size):
                    faults.append(Fault(f"{kind} {i}", row.line, f"`of` has {size} numbers, `to` "
                                        f"has {to}"))
        if faults:
            raise TaskError(self.task.source, faults)

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

    @property
    def observation_spec(self) -> tuple[Entry, ...]:
        """What each number of an observation is before its `scale`."""
        return self._entries

    # ---- numbers by name

    def values(self, name: str) -> Float:
        """The numbers that the file calls `name`, after the last step, shape (envs, numbers).

        A name of tenon_usd.observations that the file mentions, "goal.NAME", or "action".
        """
        if name == "action":
            return self.actions
        if name.startswith("goal."):
            return self._goal(name)
        if name not in self._parts:
            raise NotFoundError(no_such(name, list(self._parts)) + "; the file has to name it")
        return self._now[:, self._parts[name]]

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
        """The sum of the terms, shape (envs,)."""
        total = np.zeros(self.num_envs)
        for row in self.task.rewards:
            total += row.weight * self._terms[row.name]
        for reason in self.task.terminations:
            total += reason.reward * self._reasons[reason.name]
        return total

    def is_over(self) -> Mask:
        """Where any reason to end holds, shape (envs,)."""
        over = np.zeros(self.num_envs, dtype=bool)
        for reason in self._reasons.values():
            over |= reason
        return over

    def told(self) -> dict[str, Any]:
        """Terms of the reward times their weights, and reasons of an end, by name."""
        return {**{f"reward.{row.name}": row.weight * self._terms[row.name]
                   for row in self.task.rewards},
                **{f"over.{name}": held for name, held in self._reasons.items()}}

    def observe(self) -> Array:
        """Observations of all environments with their scales, without noise."""
        self._read_now()
        numbers = [self.values(row.of) for row in self.task.observations]
        whole = np.concatenate(numbers or [np.zeros((self.num_envs, 0))], axis=1)
        return np.asarray(whole * self._scales)

    def _observed(self) -> Array:
        observations = super()._observed()
        at = 0
        for row in self.task.observations:
            size = self.values(row.of).shape[1]
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
        for i, (start, (_, columns)) in enumerate(zip(self.task.starts, self._starting)):
            if self._starts[i].shape[1] != len(columns):
                self._starts[i] = np.zeros((self.num_envs, len(columns)))
            self._starts[i][env] = [drawn(start.value, random) for _ in columns]
        self.pushes.draw(env, random)

    def started(self, envs: Mask) -> None:
        """Joints where they start; actions as if there was none before."""
        if self.task.starts:
            positions, velocities = self.world.joints()
            for start, (of_velocity, columns) in zip(self._starts, self._starting):
                to = velocities if of_velocity else positions
                for i, column in enumerate(columns):
                    to[envs, column] = start[envs, i]
            self.world.set_joints(positions, velocities)
        self.pushes.started(envs)
        self.actions = np.where(envs[:, None], 0.0, self.actions)
        self._look()


def single_task(task: Task | PathLike, **options: Any) -> SingleEnv:
    """One environment of a task, for gymnasium.make(): observations (size,), actions (actions,)."""
    return SingleEnv(TaskEnv, task=task, **options)


__all__ = ["TaskEnv", "single_task"]
