# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Tables for pandas and Arrow: lists of scenes, masses, logs and results of sweeps.

    stage.physics().bodies.to_pandas()         # a row for each body
    stage.masses().to_arrow()
    tenon_usd.logs.read("run.npz").to_pandas()
    tenon_usd.sweep.read("runs").to_arrow()    # or to_xarray()

Each has the unit of every column: Arrow in the metadata of its fields ("unit", "meaning"), pandas
in DataFrame.attrs["units"]. pandas, xarray and pyarrow are the user's own; MissingError says how to
get one that is missing. Columns of scenes are made of the library's tables of fields: none is
listed here.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

Columns = Mapping[str, Mapping[str, Any]]
AXES = ("x", "y", "z")


def _extra(module: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as reason:
        from .errors import MissingError

        extra = {"pyarrow": "arrow"}.get(module, module)
        raise MissingError(
            f"{module} cannot be imported: {reason}; pip install 'tenon-usd[{extra}]'"
        ) from None


class Table:
    """Columns of one length, with their units.

    `columns` are arrays or lists; `units` and `meanings` are texts by the name of a column, and may
    leave some out.
    """

    def __init__(
        self,
        columns: Mapping[str, Any],
        units: Mapping[str, str] | None = None,
        meanings: Mapping[str, str] | None = None,
    ) -> None:
        self.columns: dict[str, Any] = dict(columns)
        self.units: dict[str, str] = {
            name: unit for name, unit in (units or {}).items() if name in self.columns
        }
        self.meanings: dict[str, str] = dict(meanings or {})

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def __repr__(self) -> str:
        return f"<Table of {len(self)} rows, {len(self.columns)} columns>"

    def to_arrow(self) -> Any:
        """A pyarrow.Table. Raises MissingError without pyarrow."""
        pa = _extra("pyarrow")
        arrays = [pa.array(values) for values in self.columns.values()]
        fields = [
            _field(pa, name, array.type, self.units.get(name, ""), self.meanings.get(name, ""))
            for name, array in zip(self.columns, arrays, strict=True)
        ]
        return pa.table(arrays, schema=pa.schema(fields))

    def to_xarray(self) -> Any:
        """An xarray.Dataset along "row"; attrs["units"] of each variable that has a unit. Raises
        MissingError without xarray."""
        xr = _extra("xarray")
        return xr.Dataset({name: ("row", np.asarray(values), _told(self, name))
                           for name, values in self.columns.items()})

    def to_pandas(self) -> Any:
        """A pandas.DataFrame; attrs["units"] has the unit of each column that has one. Raises
        MissingError without pandas."""
        pd = _extra("pandas")
        frame = pd.DataFrame(self.columns)
        frame.attrs["units"] = dict(self.units)
        return frame


def _told(table: Table, name: str) -> dict[str, str]:
    """What xarray is told of a column: "units" is its word for the unit."""
    told = {"units": table.units.get(name, ""), "long_name": table.meanings.get(name, "")}
    return {key: text for key, text in told.items() if text}


class Rows(list[dict[str, Any]]):
    """An answer's rows: a list of dictionaries, which is a table, too.

    Columns are the keys, those of inner dictionaries as "resolved.mass", numbers of vectors as
    "resolved.centerOfMass.x" and of matrices as "resolved.inertia.xy".
    """

    def table(self) -> Table:
        """The rows as columns, with their units where a field of a scene has the same name."""
        flat: list[dict[str, Any]] = [{} for _ in self]
        for row, found in zip(self, flat, strict=True):
            _flatten(row, "", found)
        # An absent vector leaves its parts out rather than a column for itself.
        names = [
            name
            for name in dict.fromkeys(name for found in flat for name in found)
            if not _is_whole(name, flat)
        ]
        columns = {name: _column([found.get(name) for found in flat]) for name in names}
        return Table(columns, {name: unit for name in names if (unit := _unit_of_key(name))})

    def to_arrow(self) -> Any:
        """A pyarrow.Table with the units in its fields. Raises MissingError without pyarrow."""
        return self.table().to_arrow()

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with the units in its attrs. Raises MissingError without pandas."""
        return self.table().to_pandas()


def _flatten(value: Any, name: str, found: dict[str, Any]) -> None:
    if isinstance(value, dict):
        for key, each in value.items():
            _flatten(each, f"{name}.{key}" if name else key, found)
    elif isinstance(value, list) and value and all(isinstance(v, (int, float)) for v in value):
        shape = (3, 3) if len(value) == 9 else (len(value),)
        for part, each in zip(_parts(name, shape), value, strict=True):
            found[part] = each
    else:
        found[name] = value


def _is_whole(name: str, rows: Iterable[Mapping[str, Any]]) -> bool:
    """It is null wherever it stands, and other rows have parts of it."""
    return all(row.get(name) is None for row in rows) and any(
        other.startswith(name + ".") for row in rows for other in row
    )


def _column(values: list[Any]) -> Any:
    if all(value is None or isinstance(value, (int, float)) for value in values) and any(
        isinstance(value, float) for value in values
    ):
        return np.array([np.nan if value is None else value for value in values], dtype=np.float64)
    return values


def _snake(name: str) -> str:
    return "".join("_" + c.lower() if c.isupper() else c for c in name)


def _unit_of_key(name: str) -> str:
    """The unit of "resolved.centerOfMass.x": that of the field `center_of_mass` of a scene."""
    from . import _tenon

    keys = {_snake(part) for part in name.split(".")}
    for kind in (_tenon.Body, _tenon.Collider, _tenon.Material):
        for field, column in kind.COLUMNS.items():
            if field in keys and column["number"]:
                return str(column["unit"])
    return ""


# ---- lists of scenes


def _field(pa: Any, name: str, kind: Any, unit: str, meaning: str, refers: str = "") -> Any:
    told = {"unit": unit, "meaning": meaning, "refers": refers}
    return pa.field(name, kind, metadata={key: text for key, text in told.items() if text})


def _inner(kind: str) -> tuple[str, str]:
    """"List[Drive]" -> "List", "Drive"; "Pose" -> "", "Pose"."""
    kind = kind.removesuffix(" | None")
    head, bracket, rest = kind.partition("[")
    return (head, rest[:-1]) if bracket else ("", kind)


def _columns_of(kind: str) -> Columns | None:
    from . import _tenon

    columns: Columns | None = getattr(getattr(_tenon, kind, None), "COLUMNS", None)
    return columns


def _arrow_type(pa: Any, column: Mapping[str, Any]) -> Any:
    """The type of values of a field; it depends on the table of fields alone, not on values."""
    head, inner = _inner(column["type"])
    if column["number"]:
        kind = pa.bool_() if column["number"] == "bool" else getattr(pa, column["number"])()
        for length in reversed(column["shape"]):
            kind = pa.list_(kind) if length < 0 else pa.list_(kind, length)
        return kind
    if head == "List":
        return pa.list_(_arrow_type(pa, {"type": inner, "number": ""}))
    if head == "tuple":
        parts = [_arrow_type(pa, {"type": part, "number": ""}) for part in inner.split(", ")]
        return pa.struct([(("first", "second")[i], part) for i, part in enumerate(parts)])
    columns = _columns_of(inner)
    if columns is not None:
        return pa.struct(_arrow_fields(pa, columns))
    return {"float": pa.float64(), "int": pa.int64(), "bool": pa.bool_()}.get(inner, pa.string())


def _arrow_fields(pa: Any, columns: Columns) -> list[Any]:
    return [
        _field(pa, name, _arrow_type(pa, c), c["unit"], c["meaning"], c["refers"])
        for name, c in columns.items()
    ]


def _plain(value: Any) -> Any:
    """Objects of scenes as dictionaries, arrays as lists."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, tuple):
        return {("first", "second")[i]: _plain(each) for i, each in enumerate(value)}
    columns = getattr(type(value), "COLUMNS", None)
    if columns is not None:
        return {name: _plain(getattr(value, name)) for name in columns}
    if hasattr(type(value), "columns"):
        return [_plain(each) for each in value]
    return value


def _arrow_array(pa: Any, values: Any, kind: Any, shape: Sequence[int]) -> Any:
    if not isinstance(values, np.ndarray):
        return pa.array([_plain(value) for value in values], kind)
    array = pa.array(np.ascontiguousarray(values).reshape(-1))
    for length in reversed(shape):
        array = pa.FixedSizeListArray.from_arrays(array, length)
    return array


def to_arrow(objects: Any) -> Any:
    """A list of a scene (scene.bodies) as a pyarrow.Table. Vectors are lists of fixed size,
    objects within objects are structs. Raises MissingError without pyarrow."""
    pa = _extra("pyarrow")
    columns: Columns = objects.columns
    schema = pa.schema(_arrow_fields(pa, columns))
    arrays = [
        _arrow_array(pa, objects.column(name), field.type, column["shape"])
        for (name, column), field in zip(columns.items(), schema, strict=True)
    ]
    return pa.table(arrays, schema=schema)


def _parts(name: str, shape: Sequence[int]) -> list[str]:
    """The columns that an array becomes: "position.x", "orientation.w", "inertia.xy"."""
    if tuple(shape) == (3,):
        return [f"{name}.{axis}" for axis in AXES]
    if tuple(shape) == (4,) and name.rpartition(".")[2].endswith("orientation"):
        return [f"{name}.{axis}" for axis in ("w", *AXES)]
    if tuple(shape) == (3, 3):
        return [f"{name}.{a}{b}" for a in AXES for b in AXES]
    return [f"{name}.{i}" for i in range(int(np.prod(shape)))]


def to_pandas(objects: Any) -> Any:
    """A list of a scene (scene.bodies) as a pandas.DataFrame, in the order of the list, so that
    indices of other objects lead to its rows. Raises MissingError without pandas."""
    columns: dict[str, Any] = {}
    units: dict[str, str] = {}
    meanings: dict[str, str] = {}
    for name, about in objects.columns.items():
        values, shape = objects.column(name), about["shape"]
        fixed = about["number"] and min(shape, default=1) > 0 and "None" not in about["type"]
        if shape and fixed:
            flat = np.asarray(values).reshape(len(objects), int(np.prod(shape)))
            parts = enumerate(_parts(name, shape))
            found: dict[str, Any] = {part: flat[:, i] for i, part in parts}
        else:
            found = {name: values if fixed else [_plain(value) for value in values]}
        columns.update(found)
        if about["unit"]:
            units.update(dict.fromkeys(found, about["unit"]))
        meanings.update(dict.fromkeys(found, about["meaning"]))
    return Table(columns, units, meanings).to_pandas()


__all__ = ["Rows", "Table", "to_arrow", "to_pandas"]
