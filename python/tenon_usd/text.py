# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Values of Python as text layers write them."""

from __future__ import annotations

from typing import Any


def as_text(value: Any) -> str:
    """A value for an attribute as text layers write it.

    None blocks; bool, int, float and str stand for themselves; a tuple is a vector, a quaternion
    (w, x, y, z) or, of tuples, a matrix; a list or an array of NumPy is an array, whose rows are
    vectors. Units are those of the stage.
    """
    if value is None:
        return "None"
    if hasattr(value, "tolist"):
        value = value.tolist()
        if isinstance(value, list):
            return _array(value)
    if isinstance(value, list):
        return _array(value)
    if isinstance(value, tuple):
        return "(" + ", ".join(_item(part) for part in value) + ")"
    if isinstance(value, str):
        # Else it would be taken for what it looks like.
        return _item(value) if value == "None" or value[:1] in ("'", '"') else value
    return _item(value)


def as_targets(value: Any) -> str:
    """Paths for a relationship: one str or prim, or a list of them; None for none."""
    if value is None:
        return "None"
    paths = [value] if isinstance(value, str) or hasattr(value, "path") else list(value)
    return ", ".join(f"<{getattr(path, 'path', path)}>" for path in paths)


def _array(items: list[Any]) -> str:
    return "[" + ", ".join(_row(item) for item in items) + "]"


def _row(item: Any) -> str:
    if isinstance(item, (list, tuple)):
        return "(" + ", ".join(_row(part) for part in item) + ")"
    return _item(item)


def _item(item: Any) -> str:
    if isinstance(item, bool):
        return "true" if item else "false"
    if isinstance(item, int):
        return str(item)
    if isinstance(item, float):
        return repr(item)
    if isinstance(item, (tuple, list)):
        return _row(item)
    if isinstance(item, str):
        escaped = item.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
        return f'"{escaped}"'
    if hasattr(item, "path"):
        return f"@{item.path}@"
    if hasattr(item, "item"):
        return _item(item.item())
    raise TypeError(f"a value of type {type(item).__name__} cannot be written to a layer")
