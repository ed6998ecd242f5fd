# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A task as a value, read from TOML and checked: every key that there is not is a fault with its
line. docs/tasks.md describes the file."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from .._lists import no_such
from .._toml import Fault, FileError, Reader, is_number, read_toml, rows_of
from ..actuators import COMMANDS, Actuator, DCMotor, Delay, Number, PD, PID, Saturation, Stage
from ..draws import Choice, Distribution, LogUniform, Normal, Uniform
from ..errors import MissingFileError

#: The folder of the tasks that the package has.
EXAMPLES = Path(__file__).parent
MAX_BYTES = 1 << 20
MAX_ROWS = 1000
#: What a reward is made of (docs/tasks.md has the formulas).
TERMS = ("constant", "value", "distance", "square", "near", "within", "tolerance", "action",
         "action_change")
#: How a tolerance falls off, from 1 at its bounds to `at_margin` as far beyond them as its margin.
SHAPES = ("gaussian", "linear", "quadratic", "cosine", "hyperbolic", "long_tail", "reciprocal",
          "tanh_squared")
#: What a row [[reset]] puts: joints, all of them without a name, then bodies.
STARTS = ("jointPosition", "jointVelocity", "position.x", "position.y", "position.z", "yaw")
DRAWS: dict[str, Callable[[Any], Distribution]] = {
    "uniform": lambda values: Uniform(*map(float, values)),
    "log_uniform": lambda values: LogUniform(*map(float, values)),
    "normal": lambda values: Normal(*map(float, values)),
    "choice": lambda values: Choice(tuple(map(float, values))),
}
STAGES: dict[str, type[Any]] = {
    "delay": Delay, "pd": PD, "pid": PID, "dc_motor": DCMotor, "saturation": Saturation}


class TaskError(FileError):
    """A task that cannot be used: `path`, and a Fault for each thing that is wrong."""


@dataclasses.dataclass(frozen=True)
class Observation:
    """One row [[observation]]: the numbers that `of` names (tenon_usd.observations, "goal.NAME",
    "action"; a text or several), seen from `to`, times `scale`, with `noise` in the unit that comes
    of it."""

    of: str | tuple[str, ...]
    scale: float = 1.0
    noise: Distribution | None = None
    to: str | tuple[float, ...] = ()
    line: int = dataclasses.field(default=0, compare=False)


@dataclasses.dataclass(frozen=True)
class Reward:
    """One row [[reward]]: `offset` + `weight` times the `term` of the numbers `of`, seen from `to`;
    rows of the same `product` are multiplied with each other. `low` to `at_margin`: of a tolerance.
    """

    name: str
    term: str
    weight: float = 1.0
    of: tuple[str, ...] = ()
    to: str | tuple[float, ...] = ()
    width: float = 1.0
    line: int = dataclasses.field(default=0, compare=False)
    offset: float = 0.0
    product: str = ""
    low: float = 0.0
    high: float = 0.0
    margin: float = 0.0
    at_margin: float = 0.1
    shape: str = "gaussian"


@dataclasses.dataclass(frozen=True)
class Termination:
    """One row [[termination]]: the episode is over where a number of `of` is `above` or `below`
    one, or its distance from `to` is `beyond` or `within` one. `reward` is added to that step's."""

    name: str
    of: tuple[str, ...]
    above: float | None = None
    below: float | None = None
    beyond: float | None = None
    within: float | None = None
    to: str | tuple[float, ...] = ()
    reward: float = 0.0
    line: int = dataclasses.field(default=0, compare=False)


@dataclasses.dataclass(frozen=True)
class Goal:
    """One row [[goal]]: numbers that each episode draws, "goal.NAME" for the other rows."""

    name: str
    values: tuple[Number, ...]
    line: int = dataclasses.field(default=0, compare=False)


@dataclasses.dataclass(frozen=True)
class Start:
    """One row [[reset]]: "jointPosition@JOINT", "jointVelocity@JOINT" [rad, m, rad/s, m/s] or
    "position.x@BODY" [m] of a free body at the start of an episode, in place of the asset's;
    "yaw@BODY" [rad] turns it about z of the world."""

    of: str
    value: Number
    line: int = dataclasses.field(default=0, compare=False)


@dataclasses.dataclass(frozen=True)
class Push:
    """One row [[push]]: now and then a `force` [N], along the axes of the world, acts on the centre
    of mass of a body for `lasts` seconds, `every` seconds after the start or the one before."""

    body: str
    force: tuple[Number, ...]
    every: Number
    lasts: float = 0.1
    line: int = dataclasses.field(default=0, compare=False)


@dataclasses.dataclass(frozen=True)
class Task:
    """A task as a value. `asset` is a path relative to `folder`; `step`, `frame` and `episode` are
    in seconds, `step` None: the asset's own. `actions` empty: all drives of the asset."""

    name: str
    asset: str
    folder: str = ""
    engine: str | None = None
    physics: str | None = None
    step: float | None = None
    frame: float = 0.02
    episode: float = 4.0
    observations: tuple[Observation, ...] = ()
    actions: tuple[Actuator, ...] = ()
    rewards: tuple[Reward, ...] = ()
    terminations: tuple[Termination, ...] = ()
    draws: Mapping[str, Distribution] = dataclasses.field(default_factory=dict)
    starts: tuple[Start, ...] = ()
    goals: tuple[Goal, ...] = ()
    pushes: tuple[Push, ...] = ()
    source: str = "task"

    @property
    def asset_path(self) -> str:
        """The asset as this process may open it."""
        return os.path.join(self.folder, self.asset)


class _TaskReader(Reader):
    """What rows of tasks have in common."""

    def draw(self, table: Mapping[str, Any], what: str) -> Distribution | None:
        """One of uniform, log_uniform, normal, choice."""
        names = [name for name in DRAWS if name in table]
        if len(names) != 1:
            self.fault(f"one of {', '.join(DRAWS)} says what {what} is drawn from; here are "
                       f"{', '.join(names) or 'none'}")
            return None
        values = table[names[0]]
        if not isinstance(values, list) or not all(map(is_number, values)):
            self.fault(f"{names[0]} is {values!r}; expected a list of numbers", names[0])
            return None
        try:
            return DRAWS[names[0]](values)
        except (TypeError, ValueError) as error:
            self.fault(f"{names[0]} = {values!r}: {error}", names[0])
            return None

    def either(self, value: Any, key: str) -> Number:
        """A number, or a table that says what it is drawn from."""
        if is_number(value):
            return float(value)
        if isinstance(value, dict):
            self.unknown(value, DRAWS)
            return self.draw(value, key) or 0.0
        self.fault(f"{key} is {value!r}; expected a number or a table such as "
                   "{uniform = [0, 1]}", key)
        return 0.0

    def names(self, table: Mapping[str, Any], key: str,
              expected: str = 'a name such as "position@/World/can"') -> tuple[str, ...]:
        """A text or a list of them."""
        value = table.get(key)
        listed = [value] if isinstance(value, str) else value
        if not isinstance(listed, list) or not listed or not all(
                isinstance(each, str) and each.isprintable() and each for each in listed):
            said = f"`{key}` is missing" if value is None else f"{key} is {value!r}"
            self.fault(f"{said}; expected {expected}, or a list of them", key)
            return ()
        return tuple(listed)

    def place(self, table: Mapping[str, Any]) -> str | tuple[float, ...]:
        """What distances are measured to: a name, numbers, or nothing."""
        value = table.get("to", [])
        if isinstance(value, str) and value:
            return value
        listed = [value] if is_number(value) else value
        if not isinstance(listed, list) or not all(map(is_number, listed)):
            self.fault(f"to is {value!r}; expected a name or numbers", "to")
            return ()
        return tuple(map(float, listed))

    def maybe(self, table: Mapping[str, Any], key: str) -> float | None:
        """A number that may be absent."""
        if key not in table:
            return None
        return self.number(table, key, 0.0, -1e300, 1e300)


def _observation(reader: _TaskReader, row: Mapping[str, Any]) -> Observation | None:
    reader.unknown(row, ("of", "to", "scale", "noise"))
    of = reader.names(row, "of", 'a name such as "jointPosition"')
    if not of:
        return None
    noise = None
    if isinstance(table := row.get("noise", {}), dict):
        if table:
            reader.unknown(table, DRAWS)
            noise = reader.draw(table, "noise")
    else:
        reader.fault(f"noise is {table!r}; expected a table such as {{normal = [0, 0.01]}}",
                     "noise")
    scale = reader.number(row, "scale", 1.0, -1e300, 1e300)
    return Observation(of[0] if len(of) == 1 else of, scale, noise, reader.place(row), reader.line)


def _stage(reader: _TaskReader, table: Any) -> Stage | None:
    """{delay = 0.01}, {pd = {stiffness = 20, damping = 1}}, ..."""
    if not isinstance(table, dict) or len(table) != 1:
        reader.fault(f"a stage is {table!r}; expected a table with one of {', '.join(STAGES)}",
                     "stages")
        return None
    reader.unknown(table, STAGES)
    (name, value), = table.items()
    kind = STAGES.get(name)
    if kind is None:
        return None
    fields = [field.name for field in dataclasses.fields(kind)]
    if not isinstance(value, dict) or set(value) & set(DRAWS):
        value = {fields[0]: value}
    reader.unknown(value, fields)
    numbers = {key: reader.either(each, key) for key, each in value.items() if key in fields}
    try:
        made: Stage = kind(**numbers)
    except (TypeError, ValueError) as error:
        reader.fault(f"{name}: {error}", name)
        return None
    return made


def _action(reader: _TaskReader, row: Mapping[str, Any]) -> list[Actuator] | None:
    """One actuator for each name of `joints`."""
    reader.unknown(row, ("joints", "command", "low", "high", "stages"))
    joints = reader.names(row, "joints", "a path, its last element or a regular expression")
    command = reader.text(row, "command", "position") or ""
    listed = row.get("stages", [])
    if not isinstance(listed, list) or len(listed) > MAX_ROWS:
        reader.fault(f"stages is {listed!r}; expected a list of tables", "stages")
        return None
    stages = [_stage(reader, each) for each in listed]
    if command not in COMMANDS:
        reader.fault(f"command is {command!r}; there are {', '.join(COMMANDS)}", "command")
        return None
    low, high = reader.maybe(row, "low"), reader.maybe(row, "high")
    try:
        return [Actuator(each, *[stage for stage in stages if stage is not None], command=command,
                         low=low, high=high) for each in joints]
    except ValueError as error:
        # Where a stage is wrong, what the others lack is no fault of its own.
        if None not in stages:
            reader.fault(str(error))
        return None


def _reward(reader: _TaskReader, row: Mapping[str, Any]) -> Reward | None:
    bounds = ("low", "high", "margin", "at_margin", "shape")
    reader.unknown(row, ("name", "term", "weight", "of", "to", "width", "offset", "product",
                         *bounds))
    term = reader.text(row, "term")
    if term not in TERMS:
        reader.fault(f"term is {term!r}; there are {', '.join(TERMS)}", "term")
        return None
    alone = term in ("constant", "action", "action_change")
    of = () if alone and "of" not in row else reader.names(row, "of")
    if alone and of:
        reader.fault(f"{term} is of nothing else; leave `of` out", "of")
    for key in bounds:
        if key in row and term != "tolerance":
            reader.fault(f"{key} belongs to the term tolerance, not to {term}", key)
    name = reader.text(row, "name", term)
    made = Reward(name or term, term, reader.number(row, "weight", 1.0, -1e300, 1e300), of,
                  reader.place(row), reader.number(row, "width", 1.0, 1e-300, 1e300), reader.line,
                  reader.number(row, "offset", 0.0, -1e300, 1e300),
                  reader.text(row, "product") or "")
    return made if term != "tolerance" else _tolerance(reader, row, made)


def _tolerance(reader: _TaskReader, row: Mapping[str, Any], made: Reward) -> Reward | None:
    low = reader.number(row, "low", 0.0, -1e300, 1e300)
    high = reader.number(row, "high", max(low, 0.0), -1e300, 1e300)
    shape = reader.text(row, "shape", "gaussian") or ""
    # These reach 0 at a distance of their own; the others come near it alone.
    ends = shape in ("linear", "quadratic", "cosine")
    at_margin = reader.number(row, "at_margin", 0.1, 0.0 if ends else 1e-300, 1 - 1e-9)
    if low > high:
        reader.fault(f"low is {low:g} and high {high:g}", "low")
    if shape not in SHAPES:
        reader.fault(f"shape is {shape!r}; there are {', '.join(SHAPES)}", "shape")
        return None
    return dataclasses.replace(made, low=low, high=high, at_margin=at_margin, shape=shape,
                               margin=reader.number(row, "margin", 0.0, 0.0, 1e300))


def _termination(reader: _TaskReader, row: Mapping[str, Any]) -> Termination | None:
    tests = ("above", "below", "beyond", "within")
    reader.unknown(row, ("name", "of", *tests, "to", "reward"))
    of = reader.names(row, "of")
    if not any(test in row for test in tests):
        reader.fault(f"one of {', '.join(tests)} says when the episode is over")
        return None
    above, below, beyond, within = (reader.maybe(row, test) for test in tests)
    name = reader.text(row, "name", of[0] if of else "over")
    return Termination(name or "over", of, above, below, beyond, within, reader.place(row),
                       reader.number(row, "reward", 0.0, -1e300, 1e300), reader.line)


def _goal(reader: _TaskReader, row: Mapping[str, Any]) -> Goal | None:
    reader.unknown(row, ("name", "values"))
    name, values = reader.text(row, "name"), row.get("values")
    if name is None or not isinstance(values, list) or not 0 < len(values) <= MAX_ROWS:
        reader.fault('a goal has a name and values: name = "target", values = [0, 0, '
                     "{uniform = [0.1, 0.4]}]")
        return None
    return Goal(name, tuple(reader.either(each, "values") for each in values), reader.line)


def _start(reader: _TaskReader, row: Mapping[str, Any]) -> Start | None:
    reader.unknown(row, ("of", "value", *DRAWS))
    of = reader.text(row, "of")
    kind, _, body = (of or "").partition("@")
    if of is None or kind not in STARTS or not (body or kind in STARTS[:2]):
        reader.fault(f"`of` is {of!r}; expected jointPosition@JOINT, jointVelocity@JOINT, "
                     "position.x@BODY (y and z likewise) or yaw@BODY", "of")
        return None
    if "value" in row:
        value = (reader.number(row, "value", 0.0, -1e300, 1e300) if is_number(row["value"])
                 else reader.either(row["value"], "value"))
        return Start(of, value, reader.line)
    drawn = reader.draw(row, of)
    return None if drawn is None else Start(of, drawn, reader.line)


def _push(reader: _TaskReader, row: Mapping[str, Any]) -> Push | None:
    reader.unknown(row, ("body", "force", "every", "lasts"))
    body, force = reader.text(row, "body"), row.get("force")
    if body is None or not isinstance(force, list) or len(force) != 3 or "every" not in row:
        reader.fault('a push has a body, a force and every: body = "/World/can", force = [0, 0, '
                     "{uniform = [-5, 5]}], every = {uniform = [0.5, 2]}")
        return None
    return Push(body, tuple(reader.either(each, "force") for each in force),
                reader.either(row["every"], "every"), reader.number(row, "lasts", 0.1, 0, 1e6),
                reader.line)


def _draws(reader: _TaskReader, table: Mapping[str, Any]) -> dict[str, Distribution]:
    found: dict[str, Distribution] = {}
    for number, row in enumerate(rows_of(reader, table, "draw"), 1):
        reader.at("draw", number)
        reader.unknown(row, ("of", *DRAWS))
        of, drawn = reader.text(row, "of"), reader.draw(row, "it")
        if of is None:
            reader.fault("`of` says what is drawn, such as \"bodyMass@/World/can\"")
        elif of in found:
            reader.fault(f"{of} is drawn twice", "of")
        elif drawn is not None:
            found[of] = drawn
    return found


def _each(reader: _TaskReader, table: Mapping[str, Any], key: str,
          read: Callable[[_TaskReader, Mapping[str, Any]], Any]) -> tuple[Any, ...]:
    """The rows [[key]] as values; those with faults are skipped."""
    reader.at_top()
    rows = rows_of(reader, table, key)
    if len(rows) > MAX_ROWS:
        reader.fault(f"{len(rows)} tables [[{key}]]; at most {MAX_ROWS}", key)
        rows = []
    found = []
    for number, row in enumerate(rows, 1):
        reader.at(key, number)
        if (made := read(reader, row)) is not None:
            found.append(made)
    return tuple(found)


_KEYS = ("asset", "engine", "physics", "step", "frame", "episode", "observation", "action",
         "reward", "termination", "draw", "reset", "goal", "push")


def task_from_table(table: Mapping[str, Any], folder: str, path: str = "task",
                    text: str = "") -> Task:
    """The task that a table says, as TOML gives it. Errors: TaskError with all faults."""
    reader = _TaskReader(text)
    reader.unknown(table, _KEYS)
    asset = reader.text(table, "asset")
    if asset is None:
        reader.fault('an asset is missing: asset = "arm.usda"')
    step = float(reader.number(table, "step", 0.002, 1e-9, 1)) if "step" in table else None
    engine, physics = reader.text(table, "engine"), reader.text(table, "physics")
    frame = float(reader.number(table, "frame", 0.02, 1e-9, 1e3))
    episode = float(reader.number(table, "episode", 4.0, 1e-9, 1e6))
    task = Task(
        os.path.splitext(os.path.basename(path))[0], asset or "", folder, engine, physics, step,
        frame, episode, _each(reader, table, "observation", _observation),
        tuple(one for row in _each(reader, table, "action", _action) for one in row),
        _each(reader, table, "reward", _reward),
        _each(reader, table, "termination", _termination), _draws(reader, table),
        _each(reader, table, "reset", _start), _each(reader, table, "goal", _goal),
        _each(reader, table, "push", _push), path)
    for kind, rows in (("reward", task.rewards), ("termination", task.terminations),
                       ("goal", task.goals)):
        names = [row.name for row in rows]
        for row in rows:
            if names.count(row.name) > 1:
                reader.faults.append(Fault(kind, row.line, f"two are called {row.name!r}: give "
                                           "them names"))
    if reader.faults:
        raise TaskError(path, reader.faults)
    return task


def load(path: str | os.PathLike[str]) -> Task:
    """Reads a file of TOML, or one that the package has by its name: "balance", "reach".

    Errors: OSError, for other names as well; TaskError, with the line of each thing that is wrong.
    """
    name = os.fspath(path)
    if os.path.basename(name) == name and not name.endswith(".toml"):
        own = sorted(file.stem for file in EXAMPLES.glob("*.toml"))
        if name not in own:
            raise MissingFileError(f"task: {no_such(name, own)}; the name of a file ends in .toml")
        name = str(EXAMPLES / f"{name}.toml")
    text, table = read_toml(name, MAX_BYTES, TaskError)
    return task_from_table(table, os.path.dirname(os.path.abspath(name)), name, text)
