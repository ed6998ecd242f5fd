# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Tasks to learn, described by files: pip install tenon-usd[gym].

    from tenon_usd import tasks

    task = tasks.load("balance.toml")
    envs = tasks.TaskEnv(task, num_envs=64)     # a vector environment of Gymnasium

A file says which asset on which engine, what is observed, what actions do through which actuators,
what is rewarded, what ends an episode, and what is drawn for each (docs/tasks.md). Subclasses of
TaskEnv add what a file cannot say. "balance" and "reach" are tasks that the package has.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .task import (
    EXAMPLES, Goal, Observation, Push, Reward, Start, Task, TaskError, Termination, load)

if TYPE_CHECKING:
    from .env import TaskEnv, single_task

__all__ = ["EXAMPLES", "Goal", "Observation", "Push", "Reward", "Start", "Task", "TaskEnv",
           "TaskError", "Termination", "load", "single_task"]


def __getattr__(name: str) -> Any:
    # What needs Gymnasium is imported when it is asked for.
    if name in ("TaskEnv", "single_task"):
        from . import env

        return getattr(env, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
