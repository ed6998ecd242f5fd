# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Poses as plain tuples, and where prims are in the world.

A pose is ((x, y, z), (x, y, z, w)), which Warp takes for a transform: parent <- child, unscaled.
Matrices are as USD has them: rows are the axes, the last one the position.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
Pose = tuple[Vector, Quaternion]
Matrix = npt.NDArray[np.float64]

IDENTITY: Pose = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
#: Numbers below this are zero where frames are compared [m, or of a unit quaternion].
NEAR = 1e-6


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def conjugate(q: Quaternion) -> Quaternion:
    return (-q[0], -q[1], -q[2], q[3])


def rotate(q: Quaternion, v: Vector) -> Vector:
    x, y, z, w = q
    vx, vy, vz = v
    tx, ty, tz = 2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)
    return (
        vx + w * tx + y * tz - z * ty,
        vy + w * ty + z * tx - x * tz,
        vz + w * tz + x * ty - y * tx,
    )


def compose(a: Pose, b: Pose) -> Pose:
    """The pose of b's frame where b is seen from a's."""
    turned = rotate(a[1], b[0])
    position = (a[0][0] + turned[0], a[0][1] + turned[1], a[0][2] + turned[2])
    return position, multiply(a[1], b[1])


def inverse(pose: Pose) -> Pose:
    back = conjugate(pose[1])
    x, y, z = rotate(back, pose[0])
    return (-x, -y, -z), back


def is_identity(pose: Pose) -> bool:
    return max(map(abs, pose[0])) <= NEAR and abs(pose[1][3]) > 1 - NEAR


def vector_of(values: Any) -> Vector:
    x, y, z = values
    return float(x), float(y), float(z)


def pose_of(position: Any, orientation: Any) -> Pose:
    """Of a position and an orientation of the description, w first."""
    w, x, y, z = orientation
    return vector_of(position), (float(x), float(y), float(z), float(w))


def pose_of_transform(transform: Any) -> Pose:
    """Of a warp.transform: seven numbers, w last."""
    x, y, z, qx, qy, qz, qw = (float(number) for number in transform)
    return (x, y, z), (qx, qy, qz, qw)


def matrix_of(pose: Pose) -> Matrix:
    """The matrix with the axes of the pose in its rows."""
    made = np.identity(4)
    for row, axis in enumerate(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))):
        made[row, :3] = rotate(pose[1], axis)
    made[3, :3] = pose[0]
    return made


def decompose(matrix: Matrix) -> tuple[Pose, Vector]:
    """Position and turn, and the lengths of the axes, of a matrix that mirrors nothing."""
    lengths = np.sqrt((matrix[:3, :3] ** 2).sum(axis=1))
    axes = matrix[:3, :3] / np.where(lengths > 0.0, lengths, 1.0)[:, None]
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = axes.tolist()
    # Of the four the largest one is found by a root, the others by it.
    squares = (1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz, 1 + xx + yy + zz)
    most = squares.index(max(squares))
    double = 2 * math.sqrt(max(squares[most], 1e-30))
    rows = (
        (squares[0], xy + yx, zx + xz, yz - zy),
        (xy + yx, squares[1], yz + zy, zx - xz),
        (zx + xz, yz + zy, squares[2], xy - yx),
        (yz - zy, zx - xz, xy - yx, squares[3]),
    )
    x, y, z, w = (each / double for each in rows[most])
    length = math.sqrt(x * x + y * y + z * z + w * w) or 1.0
    turn = (x / length, y / length, z / length, w / length)
    return (vector_of(matrix[3, :3].tolist()), turn), vector_of(lengths.tolist())


def _turned(axis: int, degrees: float) -> Matrix:
    made = np.identity(4)
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    made[i, i] = made[j, j] = c
    made[i, j], made[j, i] = s, -s
    return made


def _rotated(order: str, value: Any) -> Matrix:
    """"XYZ": first about x; one letter: about that axis alone. Degrees."""
    if len(order) == 1:
        return _turned("XYZ".index(order), float(value))
    made = np.identity(4)
    for letter in order:
        axis = "XYZ".index(letter)
        made = made @ _turned(axis, float(value[axis]))
    return made


def step_matrix(kind: str, value: Any) -> Matrix:
    """The matrix of one xformOp: its kind ("translate", "rotateXYZ") and its value."""
    made = np.identity(4)
    if kind.startswith("translate"):
        if len(kind) > len("translate"):
            made[3, "XYZ".index(kind[-1])] = float(value)
        else:
            made[3, :3] = value
    elif kind.startswith("scale"):
        if len(kind) > len("scale"):
            axis = "XYZ".index(kind[-1])
            made[axis, axis] = float(value)
        else:
            made[0, 0], made[1, 1], made[2, 2] = value
    elif kind.startswith("rotate"):
        made = _rotated(kind[len("rotate") :], value)
    elif kind == "orient":
        w, x, y, z = (float(number) for number in value)
        length = math.sqrt(w * w + x * x + y * y + z * z) or 1.0
        made = matrix_of(((0.0, 0.0, 0.0), (x / length, y / length, z / length, w / length)))
    elif kind == "transform":
        made = np.array(value, dtype=np.float64).reshape(4, 4)
    return made
