# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What a folder of results holds, as a table with units, for pandas and Arrow."""

from __future__ import annotations

import json
import os
from typing import Any

import numpy as np

from ..errors import check_file
from ..tables import Table, _extra, _told
from .chunks import FolderError, Results, columns_of
from .plan import MAX_CASES, MAX_CHUNK, Metric, Plan, Vary

#: Units of signals and of numbers that vary, by their names in plans.
UNITS = {
    "position": "m", "velocity": "m/s", "speed": "m/s", "angularVelocity": "rad/s",
    "angularSpeed": "rad/s", "contactForce": "N", "jointPosition": "rad or m",
    "jointVelocity": "rad/s or m/s", "driveEffort": "N m or N", "energy": "J",
    "kineticEnergy": "J", "potentialEnergy": "J", "contactCount": "", "bodyMass": "kg",
    "colliderFriction": "", "driveStiffness": "N m/rad or N/m",
    "driveDamping": "N m s/rad or N s/m", "driveMaxForce": "N m or N",
    "jointDamping": "N m s/rad or N s/m", "jointFriction": "N m or N",
    "jointArmature": "kg m^2 or kg", "gravity": "m/s^2", "bodyPosition": "m",
}


def _unit(text: str) -> str:
    """"position.z@/World/can" -> "m"."""
    return UNITS.get(text.partition("@")[0].partition(".")[0], "")


def units_of(plan: Plan) -> dict[str, str]:
    """The unit of each column of results that has one. Properties that a row sets are in their own
    unit, which a plan does not tell."""
    units = {"time": "s"}
    for row in plan.vary:
        if row.kind == "value":
            units[row.name] = _unit(row.target)
        elif row.kind == "target":
            units[row.name] = UNITS["jointPosition"]
    units.update({metric.name: _unit(metric.of) for metric in plan.metrics})
    return {name: unit for name, unit in units.items() if unit}


class SweepTable(Table):
    """The results of a sweep: a row for each case."""

    def __init__(self, plan: Plan, columns: dict[str, Any]) -> None:
        super().__init__(columns, units_of(plan))
        self.plan = plan

    def to_xarray(self) -> Any:
        """An xarray.Dataset: each grid of the plan is a dimension with its values, and "sample"
        another where there are several; what is drawn is along "sample" alone. Cases that are not
        there are NaN, or empty texts. Raises MissingError without xarray."""
        xr = _extra("xarray")
        grids = [vary for vary in self.plan.vary if vary.draw == "grid"]
        shape = [len(vary.values) for vary in grids]
        names = [vary.name for vary in grids]
        if self.plan.samples > 1 or not grids:
            shape.append(self.plan.samples)
            names.append("sample")
        drawn = {vary.name for vary in self.plan.vary if vary.draw != "grid"}
        cases = np.asarray(self.columns["case"], dtype=np.int64)
        found: dict[str, Any] = {}
        for name, values in self.columns.items():
            if name == "case" or name in names:
                continue
            array = np.asarray(values)
            if name in drawn:
                whole = np.full(self.plan.samples, np.nan)
                whole[cases % self.plan.samples] = array
                dims = ["sample"] if "sample" in names else []
                found[name] = (dims, whole if dims else whole[0], _told(self, name))
                continue
            empty: Any = np.nan if array.dtype.kind == "f" else ""
            whole = np.full(self.plan.case_count, empty, dtype=array.dtype)
            whole[cases] = array
            found[name] = (names, whole.reshape(shape), _told(self, name))
        coordinates = {vary.name: (vary.name, list(vary.values), _told(self, vary.name))
                       for vary in grids}
        return xr.Dataset(found, coordinates, {"asset": self.plan.asset,
                                               "engine": self.plan.engine or ""})


def _opened(folder: str) -> Results:
    path = os.path.join(folder, "plan.json")
    try:
        check_file(path)
        with open(path, encoding="utf-8") as file:
            note = json.load(file)
        told: dict[str, Any] = dict(note["plan"])
        vary = tuple(Vary(**{**row, "values": tuple(row["values"])}) for row in told.pop("vary"))
        metrics = tuple(Metric(**row) for row in told.pop("metrics"))
        plan = Plan(folder=folder, vary=vary, metrics=metrics, **told)
        digest = str(note["digest"])
        if not 1 <= plan.chunk <= MAX_CHUNK or plan.case_count > MAX_CASES:
            raise ValueError(f"{plan.case_count} cases in chunks of {plan.chunk}")
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise FolderError(f"{folder} holds no results of a sweep: {path}: {error}") from error
    return Results(folder, plan, digest)


def read(folder: str | os.PathLike[str]) -> SweepTable:
    """The results of `tenon sweep -o FOLDER`: a row for each case that is there, in their order.

    The merged file where there is one, else the chunks that are. Raises FolderError where the
    folder is none of a sweep, ExtraMissing where its format needs a package.
    """
    results = _opened(os.fspath(folder))
    rows = results.read_result()
    if rows is None:
        chunks = map(results.read_chunk, range(results.plan.chunk_count))
        rows = [row for chunk in chunks for row in chunk or ()]
    columns = {name: [row[name] for row in rows] for name, _ in columns_of(results.plan)}
    return SweepTable(results.plan, columns)
