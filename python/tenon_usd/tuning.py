# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Colliders and gains of drives: measured, chosen for a goal, tested, and written where asked for.

Rows of answers are lists of dictionaries and tables, too (tenon_usd.tables.Rows).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from . import _tenon
from .options import OpenOptions, PathLike, arguments_of, check_positive, list_of, path_of

if TYPE_CHECKING:
    from typing import Unpack


def _tables(answers: Sequence[dict[str, Any]], key: str) -> None:
    from .tables import Rows  # needs NumPy

    for answer in answers:
        answer[key] = Rows(answer[key])


def colliders(
    path: PathLike,
    engine: str = "",
    *,
    colliders: Sequence[str] = (),
    approximation: str = "",
    budget: int | None = None,
    gap: float | None = None,
    save: bool = False,
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """How well the colliders of an asset fit their meshes, what they cost, and other choices.

    `engine` is a name of engines(), "all", or that of the selected variant where it is empty.
    `colliders` are names, paths or regular expressions for the whole of either. `approximation`
    gives the figures of another one for all meshes ("convexDecomposition"); `budget` chooses for
    each mesh the cheapest approximation that costs no more and stays within `gap` [m] of it, 2 % of
    its size where it is None, and `save` writes what was chosen. Returns {"engines": [{"engine",
    "colliders": rows}], "budget", "request"}, lengths in metres, and "edits" and "written" with
    `save`.
    """
    if (gap is not None or save) and budget is None:
        raise ValueError("gap and save are about a budget; give budget, too")
    if budget is not None and approximation:
        raise ValueError("give either budget or approximation")
    check_positive(budget=budget)
    answer = _tenon.colliders(
        path_of(path), arguments_of(options), engine, list_of("colliders", colliders),
        approximation, budget or 0, gap, save
    )
    _tables(answer["engines"], "colliders")
    return answer


def tune(
    path: PathLike,
    *,
    joints: Sequence[str] = (),
    frequency: float | None = None,
    damping_ratio: float | None = None,
    gains: PathLike = "",
    search: bool = False,
    overshoot: float = 0.01,
    settle: float = 0.2,
    masses: Sequence[float] = (),
    at: str = "",
    poses: int = 0,
    engine: str = "",
    time_step: float | None = None,
    test: str = "",
    sequence: Sequence[str] = (),
    period: float | None = None,
    amplitude: float | None = None,
    duration: float | None = None,
    adversarial: bool = False,
    seed: int = 1,
    save: bool = False,
    force: bool = False,
    **options: Unpack[OpenOptions],
) -> dict[str, Any]:
    """Gains of drives as frequency and damping ratio: shown, set, searched for and tested.

    `joints` are names, paths or regular expressions for the whole of either; all where it is empty.
    `frequency` [Hz] and `damping_ratio`, or `gains`, a file in TOML, say what the drives are to be.
    `search` finds the softest gains with which a step overshoots by at most `overshoot` (a part of
    the step) and settles within `settle` [s], with each of the `masses` [kg] at the prim `at`,
    and at `poses` drawn poses. `test` is "snap", "step", "sine", "stress" or "steps": `sequence`
    are patterns of joints that move together, `period` and `duration` are in seconds, `amplitude`
    is a part of the range. `engine` is a name of engines(), or "all". `save` writes the gains in
    every form that engines have of them; those that miss the goal of a search are not written.
    `force` allows what is unstable with the time step [s]. Returns {"drives": rows, "engines":
    [{"engine", "results": rows}], "search": {"drives": rows, ..}, ..}, in SI and radians, and
    "edits" and "written" with `save`. docs/tuning.md has the meaning of all.
    """
    wished = frequency is not None or damping_ratio is not None or path_of(gains) != ""
    if search and wished:
        raise ValueError("give either search, or frequency, damping_ratio and gains")
    if save and not (search or wished):
        raise ValueError("there is nothing to save: give frequency, gains or search")
    if bool(masses) != bool(at):
        raise ValueError("a mass needs a place, and a place a mass: give masses and at")
    check_positive(frequency=frequency, settle=settle, time_step=time_step, period=period,
                    amplitude=amplitude, duration=duration)
    numbers = {"frequency": frequency, "damping_ratio": damping_ratio, "overshoot": overshoot,
               "settle": settle, "poses": poses, "seed": seed, "time_step": time_step,
               "period": period, "amplitude": amplitude, "duration": duration}
    answer = _tenon.tune(
        path_of(path),
        arguments_of(options),
        {name: float(value) for name, value in numbers.items() if value is not None},
        {"gains": path_of(gains), "engine": engine, "test": test, "at": at},
        {"joints": list_of("joints", joints), "sequence": list_of("sequence", sequence)},
        {"search": search, "adversarial": adversarial, "save": save, "force": force},
        [float(mass) for mass in masses],
    )
    _tables([answer, *([answer["search"]] if search else [])], "drives")
    if test:
        _tables(answer["engines"], "results")
    return answer
