# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A log as a value: what a run was, sample by sample. logs.py reads and writes it."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from .tables import Table

Array = npt.NDArray[np.float64]
AXES = (".x", ".y", ".z")
BODY: dict[str, tuple[str, ...]] = {
    "position": AXES, "orientation": (".w", *AXES), "linearVelocity": AXES,
    "angularVelocity": AXES}
CONTACT_VECTORS = ("point", "normal", "frictionForce", "frictionTorque")
CONTACT_NUMBERS = ("depth", "normalForce")
SIM_UNITS = {"length": "stage", "angle": "deg"}
SI_UNITS = {"length": "m", "angle": "rad"}
#: The quantity of a column, by the last of its words that is one; L is the unit of lengths, A that
#: of angles. A joint turns or slides, which its name does not tell.
QUANTITIES: dict[str, str] = {
    "position": "A or L", "velocity": "A/s or L/s", "acceleration": "A/s^2 or L/s^2",
    "distance": "L", "framePosition": "L", "frameLinearVelocity": "L/s",
    "frameAngularVelocity": "A/s",
    "sensorPosition": "A or L", "sensorVelocity": "A/s or L/s", "sensorEffort": "N m or N",
    "linearVelocity": "L/s", "angularVelocity": "A/s", "linearAcceleration": "L/s^2",
    "angularAcceleration": "A/s^2", "driveEffort": "N m or N", "reactionForce": "N",
    "reactionTorque": "N m", "force": "N", "torque": "N m", "normalForce": "N",
    "frictionForce": "N", "frictionTorque": "N m", "energy": "J", "work": "J", "point": "L",
    "depth": "L", "time": "s",
}


class LogError(ValueError):
    """A file that is no log, or an ending that is no format."""


@dataclasses.dataclass
class Log:
    """What a run was, sample by sample.

    `time` [s] has shape (samples,), each of `columns` too; their names are "PATH.position.x",
    "PATH.orientation.w", "PATH.linearVelocity.x", "PATH.angularVelocity.x" of bodies,
    "PATH.position" and "PATH.velocity" of joints, and those of outputs. `contacts` has a row for
    each contact: "time", "collider0", "collider1", "body0", "body1", "point.x" and so on; None
    where they were not logged. `units` are those of lengths ("m" or "stage") and angles ("rad",
    "deg"): logs of `tenon sim` have units of the stage and degrees. Forces are in N, energies in J.
    """

    time: Array
    columns: dict[str, Array]
    contacts: dict[str, npt.NDArray[Any]] | None = None
    units: dict[str, str] = dataclasses.field(default_factory=lambda: dict(SIM_UNITS))

    @property
    def bodies(self) -> list[str]:
        """Paths of what has an orientation and a position."""
        end = ".orientation.w"
        return [name[:-len(end)] for name in self.columns if name.endswith(end)
                and name[:-len(end)] + ".position.x" in self.columns]

    def body(self, path: str, what: str) -> Array:
        """"position", "orientation" (w, x, y, z), "linearVelocity" or "angularVelocity" of a body,
        shape (samples, 3) or (samples, 4)."""
        return np.stack([self.columns[f"{path}.{what}{axis}"] for axis in BODY[what]], axis=1)

    def others(self) -> dict[str, Array]:
        """The columns that are not of bodies: joints, and what was logged beside states."""
        of_bodies = {f"{path}.{what}{axis}" for path in self.bodies for what, axes in BODY.items()
                     for axis in axes}
        return {name: values for name, values in self.columns.items() if name not in of_bodies}

    def contacts_at(self, sample: int) -> npt.NDArray[np.intp]:
        """The rows of `contacts` of one sample."""
        if self.contacts is None:
            return np.zeros(0, dtype=np.intp)
        return np.flatnonzero(self.contacts["time"] == self.time[sample])

    def unit_of(self, column: str) -> str:
        """The unit of a column, "m/s" or "rad or m"; empty where it has none."""
        words = column.rpartition("/")[2].split(".")
        found = next((QUANTITIES[word] for word in reversed(words) if word in QUANTITIES), "")
        if words[-2:-1] == ["position"] and column.endswith(AXES):
            found = "L"  # of a body
        names = {"L": self.units["length"].replace("stage", "stage unit"),
                 "A": self.units["angle"]}
        return re.sub(r"\b[LA]\b", lambda unit: names[unit[0]], found)

    def table(self) -> Table:
        """The samples as columns: "time", then those of `columns`, with their units."""
        columns: dict[str, Any] = {"time": self.time, **self.columns}
        return Table(columns, {name: unit for name in columns if (unit := self.unit_of(name))})

    def to_arrow(self) -> Any:
        """A pyarrow.Table with a row for each sample and the units in its fields. Raises
        MissingError without pyarrow."""
        return self.table().to_arrow()

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with a row for each sample and the units in attrs["units"]. Raises
        MissingError without pandas."""
        return self.table().to_pandas()

    def contact_table(self) -> Table:
        """The contacts as columns, with their units; without rows where none were logged."""
        columns = self.contacts or {"time": np.zeros(0)}
        return Table(columns, {name: unit for name in columns if (unit := self.unit_of(name))})


def make_log(time: Any, columns: Mapping[str, Any], contacts: Any = None,
             units: Mapping[str, str] = SIM_UNITS) -> Log:
    """A log of columns of whatever numbers. Raises LogError where one has another length."""
    time = np.asarray(time, dtype=np.float64)
    found = {name: np.asarray(values, dtype=np.float64) for name, values in columns.items()}
    for name, values in found.items():
        if values.shape != time.shape:
            raise LogError(f"the column {name} has {values.shape}, not {time.shape} samples")
    return Log(time, found, contacts, dict(units))
