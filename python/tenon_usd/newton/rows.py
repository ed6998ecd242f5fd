# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Custom frequencies of solvers: a row for each prim that they ask for, such as actuators and
tendons of MuJoCo; and actuators of MuJoCo that are drives of joints."""

from __future__ import annotations

from typing import Any

from .importing import Importing, warn
from .options import Result
from .prims import PrimView

ACTUATORS = "mujoco:actuator"
#: Newton's enumerations of MuJoCo's actuators: gain fixed, bias affine, no dynamics.
AFFINE, PLAIN = 1, 0
CLOSE = 1e-8


def add_rows(importing: Importing, result: Result) -> None:
    """Adds rows of all custom frequencies that prims are asked for."""
    builder = importing.builder
    asked = []
    for key, frequency in builder.custom_frequencies.items():
        attributes = [each for each in builder.custom_attributes.values() if each.frequency == key]
        if frequency.usd_prim_filter is not None and attributes:
            asked.append((key, frequency, attributes))
    if not any(key == ACTUATORS for key, _, _ in asked):
        _tell_actuators(importing)
    for prim in importing.prims if asked else ():
        if importing.prims.is_ignored(prim.path):
            continue
        for key, frequency, attributes in asked:
            try:
                _add(importing, prim, frequency, attributes, result)
            except Exception as reason:
                raise RuntimeError(f"{prim.path}: custom frequency {key!r}: {reason}") from reason


def _tell_actuators(importing: Importing) -> None:
    for prim in importing.prims:
        if prim.type_name in ("MjcActuator", "MjcTendon"):
            warn(
                prim.path,
                f"a {prim.type_name}: for SolverMuJoCo, whose register_custom_attributes(builder) "
                "has to be called before",
            )
            return


def _add(
    importing: Importing, prim: PrimView, frequency: Any, attributes: list[Any], result: Result
) -> None:
    builder = importing.builder
    context = {"prim": prim, "result": result, "builder": builder}
    if not frequency.usd_prim_filter(prim, context):
        return
    if frequency.usd_entry_expander is not None:
        rows = list(frequency.usd_entry_expander(prim, context))
        builder.add_custom_values_batch(
            [{each.key: row.get(each.key) for each in attributes} for row in rows]
        )
        return
    values = importing.libraries.newton.usd.get_custom_attribute_values(
        prim, attributes, context={"result": result, "builder": builder}
    )
    builder.add_custom_values(**{each.key: values.get(each.key) for each in attributes})


class _Rows:
    """The rows of MuJoCo's actuators."""

    def __init__(self, builder: Any) -> None:
        self._attributes = builder.custom_attributes

    def __len__(self) -> int:
        found = self._attributes.get("mujoco:actuator_target_label")
        return len(found.values) if found is not None and found.values is not None else 0

    def get(self, name: str, row: int) -> Any:
        attribute = self._attributes[f"mujoco:{name}"]
        value = attribute.values[row] if row < len(attribute.values) else None
        return attribute.default if value is None else value

    def set(self, name: str, row: int, value: Any) -> None:
        attribute = self._attributes.get(f"mujoco:{name}")
        if attribute is not None:
            while len(attribute.values) <= row:
                attribute.values.append(None)
            attribute.values[row] = value


def _is(a: float, b: float) -> bool:
    return abs(a - b) <= CLOSE + 1e-5 * abs(b)


def _gains(rows: _Rows, row: int) -> tuple[float, float, bool] | None:
    """Stiffness, damping, and whether it drives the position, of what is such a drive."""
    if (
        int(rows.get("actuator_biastype", row)) != AFFINE
        or int(rows.get("actuator_dyntype", row)) != PLAIN
        or int(rows.get("actuator_gaintype", row)) != PLAIN
    ):
        return None
    gear = [float(each) for each in rows.get("actuator_gear", row)]
    if not _is(gear[0], 1.0) or any(not _is(each, 0.0) for each in gear[1:]):
        return None
    gain = float(list(rows.get("actuator_gainprm", row))[0])
    bias = [float(each) for each in list(rows.get("actuator_biasprm", row))[:3]]
    if gain <= 0.0 or not _is(bias[0], 0.0):
        return None
    if _is(bias[1], -gain) and bias[2] <= 0.0:
        return gain, -bias[2], True
    if _is(bias[1], 0.0) and _is(bias[2], -gain):
        return 0.0, gain, False
    return None


def drive_joints(importing: Importing) -> None:
    """Actuators of MuJoCo that are drives of one degree of freedom become Newton's."""
    builder, newton = importing.builder, importing.libraries.newton
    rows = _Rows(builder)
    if not len(rows):
        return
    modes, solver = newton.JointTargetMode, newton.solvers.SolverMuJoCo
    for row in range(len(rows)):
        joint = importing.joints.get(rows.get("actuator_target_label", row) or "")
        gains = None if joint is None else _gains(rows, row)
        if joint is None or gains is None:
            continue
        path = rows.get("actuator_target_label", row)
        dof = builder.joint_qd_start[joint] + importing.merged_dofs.get(path, 0)
        stiffness, damping, position = gains
        mode = int(builder.joint_target_mode[dof])
        none, both = int(modes.NONE), int(modes.POSITION_VELOCITY)
        own = int(modes.POSITION if position else modes.VELOCITY)
        other = int(modes.VELOCITY if position else modes.POSITION)
        if position:
            builder.joint_target_ke[dof] = stiffness
        if not position or mode == none:
            builder.joint_target_kd[dof] = damping
        if mode in (none, other):
            builder.joint_target_mode[dof] = own if mode == none else both
        rows.set("ctrl_source", row, int(solver.CtrlSource.JOINT_TARGET))
        rows.set("actuator_trnid", row, importing.libraries.warp.vec2i(dof, 0))
        kind = solver.CtrlType.POSITION if position else solver.CtrlType.VELOCITY
        rows.set("ctrl_type", row, int(kind))
