# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Values of Python as text layers and the command write them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
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


def paths(value: Any) -> list[str]:
    """Of one path or prim, or a list of them; None for none."""
    if value is None:
        return []
    several = [value] if isinstance(value, str) or hasattr(value, "path") else list(value)
    return [str(getattr(one, "path", one)) for one in several]


def as_metadata(value: Any) -> str:
    """A value for metadata; of a dict the dictionary, whose entries have the types that OpenUSD's
    Python gives them: int, double, string, bool, asset, double3 and arrays of these."""
    return _dictionary(value) if isinstance(value, Mapping) else as_text(value)


def as_entry(value: Any) -> str:
    """The same of one entry of a dictionary, as a dictionary that has nothing else."""
    return _dictionary({"value": value})


def set_words(assignments: Iterable[str], words: Mapping[str, Any]) -> dict[str, list[str]]:
    """What Stage.set() was asked for, as `tenon set` has it."""
    made = {"assignments": [str(one) for one in assignments]}
    for name, value in words.items():
        if name not in _WORDS:
            raise TypeError(f"set() got an unexpected keyword argument '{name}'")
        made[name] = _WORDS[name](value)
    return made


def authoring_words(
    path: str, kinds: Iterable[str], options: Mapping[str, Any]
) -> tuple[list[str], dict[str, str], list[str]]:
    """What Stage.add() and remove() were asked for, as the command has it."""
    named = ",".join(kinds)
    properties = options.get("set", {})
    return (
        [f"{path}={named}" if named else str(path)],
        {_option(name): _word(one) for name, one in options.items() if name != "set"},
        [f"{name}={as_text(value)}" for name, value in properties.items()],
    )


def _option(name: str) -> str:
    """Of the command; words of Python have a '_' behind them: with_."""
    return name.removesuffix("_").replace("_", "-")


def _word(value: Any) -> str:
    """Of an option: numbers side by side, paths, texts."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return ",".join(_word(one) for one in value)
    if isinstance(value, os.PathLike):
        return str(os.fspath(value))
    return str(getattr(value, "path", value))


def _pairs_of(values: Mapping[str, Any]) -> list[str]:
    return [f"{_word(path)}={_word(value)}" for path, value in values.items()]


def _drives(values: Mapping[str, Mapping[str, Any]]) -> list[str]:
    return [
        f"{_word(path)}=" + ",".join(f"{name}:{_word(one)}" for name, one in gains.items())
        for path, gains in values.items()
    ]


def _schemas(values: Mapping[str, Any]) -> list[str]:
    return [
        f"{_word(path)}={schema}"
        for path, named in values.items()
        for schema in ([named] if isinstance(named, str) else named)
    ]


_WORDS: dict[str, Any] = {
    "mass": _pairs_of,
    "collider": _pairs_of,
    "material": _pairs_of,
    "mimic": _pairs_of,
    "drive": _drives,
    "apply": _schemas,
    "remove": _schemas,
    "filter": lambda pairs: [_word(pair) for pair in pairs],
    "clear": lambda names: [str(name) for name in names],
}

_KINDS = {"b": "bool", "i": "int", "u": "int", "f": "double", "U": "string"}
_ITEMS = {"int32": "int", "int64": "int64", "float32": "float", "float64": "double"}


def _dictionary(entries: Mapping[str, Any]) -> str:
    lines = [f"{_typed(value)[0]} {_item(str(key))} = {_typed(value)[1]}\n"
             for key, value in entries.items()]
    return "{\n" + "".join(lines) + "}"


def _typed(value: Any) -> tuple[str, str]:
    """The type of an entry and its value."""
    if isinstance(value, Mapping):
        return "dictionary", _dictionary(value)
    if hasattr(value, "dtype") and getattr(value, "ndim", 0) == 1:
        item = _ITEMS.get(value.dtype.name) or _KINDS.get(value.dtype.kind)
        if item is None:
            raise TypeError(f"an array of {value.dtype} cannot be an entry of a dictionary")
        return item + "[]", _array(value.tolist())
    if isinstance(value, list):
        types = {_typed(one)[0] for one in value} or {"string"}
        types = {"double"} if types == {"int", "double"} else types
        if len(types) > 1:
            raise TypeError("the items of a list in a dictionary are of one type")
        return types.pop() + "[]", _array(value)
    if isinstance(value, tuple):
        if len(value) not in (2, 3, 4):
            raise TypeError("a tuple in a dictionary has 2 to 4 numbers")
        return f"double{len(value)}", _row(value)
    if isinstance(value, bool):
        return "bool", _item(value)
    if isinstance(value, int):
        return ("int" if -(2**31) <= value < 2**31 else "int64"), _item(value)
    if isinstance(value, float):
        return "double", _item(value)
    if isinstance(value, str):
        return "string", _item(value)
    if hasattr(value, "path"):
        return "asset", _item(value)
    if hasattr(value, "item"):
        return _typed(value.item())
    raise TypeError(f"a value of type {type(value).__name__} cannot be an entry of a dictionary")


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
