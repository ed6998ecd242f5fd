# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What a folder of results holds, as a table with units, for pandas and Arrow."""

from __future__ import annotations

import json
import os
from typing import Any

from ..tables import Table
from .chunks import FolderError, Results, columns_of
from .plan import Metric, Plan, Vary

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


def _opened(folder: str) -> Results:
    path = os.path.join(folder, "plan.json")
    try:
        with open(path, encoding="utf-8") as file:
            note = json.load(file)
        told: dict[str, Any] = dict(note["plan"])
        vary = tuple(Vary(**{**row, "values": tuple(row["values"])}) for row in told.pop("vary"))
        metrics = tuple(Metric(**row) for row in told.pop("metrics"))
        plan = Plan(folder=folder, vary=vary, metrics=metrics, **told)
        digest = str(note["digest"])
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise FolderError(f"{folder} holds no results of a sweep: {path}: {error}") from error
    return Results(folder, plan, digest)


def read(folder: str | os.PathLike[str]) -> Table:
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
    return Table(columns, units_of(results.plan))
