# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Motions as files: command tables of `tenon sim --commands` (.csv, .npz), and messages of
trajectory_msgs/JointTrajectory for ROS (.yaml)."""

from __future__ import annotations

import io
import math
import os

import numpy as np

from .excite import Excitation, ExciteError
from .joints import AssetJoint
from .log import Finding

ENDINGS = (".csv", ".npz", ".yaml")


def check_name(path: str | os.PathLike[str]) -> None:
    """Raises ExciteError for an ending that is no format, and a folder that does not exist."""
    name = os.fspath(path)
    if os.path.splitext(name)[1] not in ENDINGS:
        raise ExciteError(Finding("excite.output", "is no kind of output", name,
                                  fix=f"end it in {', '.join(ENDINGS)}"))
    folder = os.path.dirname(os.path.abspath(name))
    if not os.path.isdir(folder):
        raise ExciteError(Finding("excite.output", "its folder does not exist", name,
                                  fix=f"make {folder} first"))


def write(motion: Excitation, path: str | os.PathLike[str]) -> None:
    """Writes a motion by the ending of `path`, whole or not at all. Raises ExciteError, OSError."""
    from ..sweep.chunks import write_whole  # brings in all of the sweeps

    check_name(path)
    name = os.path.abspath(os.fspath(path))
    ending = os.path.splitext(name)[1]
    contents = {".csv": as_csv, ".npz": as_npz, ".yaml": as_yaml}[ending](motion)
    write_whole(name, contents)


def _table(motion: Excitation) -> tuple[list[str], list[np.ndarray[tuple[int, ...],
                                                                   np.dtype[np.float64]]]]:
    """Columns in degrees and units of the stage: targets of positions where the drive has
    stiffness, of velocities where it has damping."""
    names, columns = [], []
    for k, joint in enumerate(motion.joints):
        unit = 180 / math.pi if joint.rotates else 1 / motion.meters_per_unit
        end = f".{joint.dof}" if joint.several else ""
        if joint.stiffness > 0:
            names.append(f"{joint.path}.target{end}")
            columns.append(motion.position[:, k] * unit)
        if joint.damping > 0 and motion.how.kind != "steps":
            names.append(f"{joint.path}.velocityTarget{end}")
            columns.append(motion.velocity[:, k] * unit)
    return names, columns


def as_csv(motion: Excitation) -> bytes:
    """What `tenon sim --commands` reads."""
    names, columns = _table(motion)
    lines = [",".join(["time", *(_quoted(name) for name in names)])]
    lines += [",".join([_short(time), *(_short(column[row]) for column in columns)])
              for row, time in enumerate(motion.times)]
    return ("\n".join(lines) + "\n").encode()


def _quoted(name: str) -> str:
    return f'"{name}"' if "," in name or '"' in name else name


def _short(value: float) -> str:
    """Ten digits: less than what any encoder tells."""
    return f"{value:.10g}"


def as_npz(motion: Excitation) -> bytes:
    """The same as an archive of NumPy."""
    names, columns = _table(motion)
    sink = io.BytesIO()
    np.savez(sink, time=motion.times, columns=np.array(names), values=np.stack(columns, axis=1))
    return sink.getvalue()


def as_yaml(motion: Excitation) -> bytes:
    """One trajectory_msgs/JointTrajectory [rad or m]; joints have the names of their prims."""
    lines = ["# trajectory_msgs/msg/JointTrajectory, in rad, m, and per second",
             "header: {stamp: {sec: 0, nanosec: 0}, frame_id: ''}",
             f"joint_names: [{', '.join(_text(joint) for joint in motion.joints)}]", "points:"]
    for row, time in enumerate(motion.times):
        nanoseconds = round(float(time) * 1e9)
        lines.append(f"- positions: {_list(motion.position[row])}")
        lines.append(f"  velocities: {_list(motion.velocity[row])}")
        if motion.how.kind != "steps":
            lines.append(f"  accelerations: {_list(motion.acceleration[row])}")
        lines.append("  time_from_start: {sec: "
                     f"{nanoseconds // 10**9}, nanosec: {nanoseconds % 10**9}}}")
    return ("\n".join(lines) + "\n").encode()


def _text(joint: AssetJoint) -> str:
    return "'" + joint.short.replace("'", "''") + "'"


def _list(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> str:
    # A dot, so that YAML takes each for a number with fractions.
    texts = [f"{value:.9f}" for value in values]
    return f"[{', '.join(texts)}]"
