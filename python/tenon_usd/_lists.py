# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What lists and objects of scenes are called, and how they look: by path, in print, in notebooks
(src/physics.cpp)."""

from __future__ import annotations

import difflib
import html
from collections.abc import Iterable, Sequence
from typing import Any

#: Rows and names that are shown; more is what tables are for.
SHOWN_ROWS = 100
SHOWN_NAMES = 6


def _paths(objects: Any) -> list[str]:
    if "path" not in objects.columns:
        raise TypeError("these objects have no path; take them by number")
    paths: list[str] = objects.column("path")
    return paths


def index(objects: Any, name: str) -> int:
    """The number of a path, or of the last element of one where no other has it."""
    paths = _paths(objects)
    if name in paths:
        return paths.index(name)
    named = [i for i, path in enumerate(paths) if path.rpartition("/")[2] == name]
    if len(named) == 1:
        return named[0]
    if named:
        raise KeyError(f"{name!r} is the name of several: " + ", ".join(paths[i] for i in named))
    raise KeyError(no_such(name, paths))


def no_such(name: str, names: Sequence[str]) -> str:
    """What is said of a name that is not there: the closest ones, or what there is."""
    short = {each.rpartition("/")[2]: each for each in reversed(names)}
    close = difflib.get_close_matches(name, names, 1) or [
        short[each] for each in difflib.get_close_matches(name.rpartition("/")[2], short, 1)]
    if close:
        return f"there is no {name!r}; did you mean {close[0]!r}?"
    there = ", ".join(names[:20]) + (", ..." if len(names) > 20 else "")
    return f"there is no {name!r}; " + (f"there are {there}" if names else "there are none")


def contains(objects: Any, name: object) -> bool:
    """Whether there is an object of this path; objects themselves have no equals."""
    return isinstance(name, str) and "path" in objects.columns and name in _paths(objects)


def _word(count: int, word: str) -> str:
    return f"{count} {word.replace('_', ' ')}"


def _lists_of(scene: Any) -> list[tuple[str, int]]:
    found = [(name, getattr(scene, name)) for name in type(scene).FIELDS]
    return [(name, len(each)) for name, each in found if hasattr(type(each), "columns")]


def _short(value: Any) -> str:
    if hasattr(value, "tolist"):
        value = tuple(value.tolist()) if value.ndim == 1 else value.tolist()
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, tuple):
        return "(" + ", ".join(_short(each) for each in value) + ")"
    return repr(value)


def describe(one: Any) -> str:
    """An object by its path, or by its first numbers and words where it has none."""
    kind = type(one)
    if kind.__name__ == "PhysicsScene":
        counts = ", ".join(_word(count, name) for name, count in _lists_of(one) if count)
        return f"<PhysicsScene: {counts}>"
    if "path" in kind.COLUMNS:
        return f"<{kind.__name__} {one.path}>"
    told: list[str] = []
    for name, column in kind.COLUMNS.items():
        small = column["type"] in ("str", "float", "int", "bool") or list(column["shape"]) in (
            [3], [4])
        if small and len(told) < SHOWN_NAMES:
            told.append(f"{name}={_short(getattr(one, name))}")
    return f"<{kind.__name__} {' '.join(told)}>"


def describe_list(objects: Any) -> str:
    """What it is a list of, and the first of them."""
    count = len(objects)
    if not count:
        return "<List of 0>"
    kind = type(objects[0]).__name__
    named = "path" in objects.columns
    first = [objects[i].path if named else repr(objects[i])
             for i in range(min(count, SHOWN_NAMES if named else 2))]
    return f"<List of {count} {kind}: {', '.join(first)}{', ...' if len(first) < count else ''}>"


# ---- notebooks


def table(head: Sequence[str], rows: Iterable[Sequence[Any]], caption: str) -> str:
    """A table of HTML; everything in it is text."""

    def cells(kind: str, values: Sequence[Any]) -> str:
        return "".join(f"<{kind}>{html.escape(str(value))}</{kind}>" for value in values)

    body = "".join(f"<tr>{cells('td', row)}</tr>" for row in rows)
    return (f"<table><caption>{html.escape(caption)}</caption><thead><tr>{cells('th', head)}</tr>"
            f"</thead><tbody>{body}</tbody></table>")


def html_of_list(objects: Any) -> str:
    """A row for each of the first objects."""
    columns = {name: column for name, column in objects.columns.items()
               if column["type"] in ("str", "float", "int", "bool") or list(column["shape"]) == [3]}
    head = [f"{name} [{column['unit']}]" if column["unit"] else name
            for name, column in columns.items()]
    rows = [["" if value is None else value if isinstance(value, str) else _short(value)
             for value in (getattr(one, name) for name in columns)]
            for one in objects[:SHOWN_ROWS]]
    left = len(objects) - len(rows)
    return table(head, rows, describe_list(objects)[1:-1] if not left else
                 f"the first {len(rows)} of {len(objects)}")


def html_of_scene(scene: Any) -> str:
    """How many of everything."""
    rows = [(name.replace("_", " "), n) for name, n in _lists_of(scene) if n]
    return table(["list", "count"], rows, "PhysicsScene [SI, rad]")


def html_of_findings(findings: Sequence[Any], caption: str = "findings") -> str:
    """A row for each finding: what is wrong, where, and what to do."""
    head = ["severity", "rule", "place", "prim", "message", "fix"]
    rows = [(one.severity, one.rule, f"{one.file}:{one.line}" if one.line else one.file, one.prim,
             one.message, one.fix) for one in findings]
    return table(head, rows, caption)


def html_of_stage(stage: Any) -> str:
    """What was opened, and what opening found."""
    root = stage.default_prim
    rows = [("file", stage.path), ("default prim", root.path if root else "none"),
            ("up axis", stage.metadata("upAxis")),
            ("metres per unit", stage.metadata("metersPerUnit")),
            ("prims", len(stage.prims)), ("layers", len(stage.layers))]
    found = stage.diagnostics
    return table(["", ""], rows, "Stage") + (html_of_findings(found) if found else "")


def html_of_world(world: Any) -> str:
    """What a world consists of, and how far it is."""
    rows = [("environments", world.envs), ("engine", f"{world.engine} {world.engine_version}"),
            ("time step [s]", f"{world.time_step:g}"),
            ("time [s]", f"{world.time.min():g} to {world.time.max():g}"),
            ("bodies", len(world.body_names)), ("joint coordinates", len(world.joint_names)),
            ("drives", len(world.drive_names)), ("outputs", ", ".join(world.outputs) or "none"),
            ("stand still", sum(failure is not None for failure in world.failures()))]
    return table(["", ""], rows, "World")
