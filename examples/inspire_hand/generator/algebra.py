# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Vectors, 3x3 matrices (rows of column-vector rotations) and unit quaternions (w, x, y, z), as
plain tuples."""

import math


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def scale(a, s):
    return tuple(x * s for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(a):
    return scale(a, 1.0 / math.sqrt(dot(a, a)))


def transpose(m):
    return tuple(zip(*m))


def apply(m, v):
    return tuple(dot(row, v) for row in m)


def multiply(a, b):
    columns = transpose(b)
    return tuple(tuple(dot(row, c) for c in columns) for row in a)


def from_axes(x, y, z):
    """The rotation whose columns are the images of the three axes."""
    return transpose((x, y, z))


def rotation(axis, angle):
    """Right-handed rotation about 'x', 'y' or 'z' by an angle in radians."""
    c, s = math.cos(angle), math.sin(angle)
    return {
        "x": ((1, 0, 0), (0, c, -s), (0, s, c)),
        "y": ((c, 0, s), (0, 1, 0), (-s, 0, c)),
        "z": ((c, -s, 0), (s, c, 0), (0, 0, 1)),
    }[axis]


def from_rpy(roll, pitch, yaw):
    """Fixed-axis roll, pitch, yaw as URDF defines them: Rz(yaw) Ry(pitch) Rx(roll)."""
    return multiply(rotation("z", yaw), multiply(rotation("y", pitch), rotation("x", roll)))


def quaternion(m):
    """Unit quaternion of a rotation matrix; the largest component is computed first, and w (or
    else the first component that is not zero) is made positive, so that equal rotations are
    written with equal numbers.
    """
    candidates = (
        1 + m[0][0] + m[1][1] + m[2][2],
        1 + m[0][0] - m[1][1] - m[2][2],
        1 - m[0][0] + m[1][1] - m[2][2],
        1 - m[0][0] - m[1][1] + m[2][2],
    )
    k = max(range(4), key=lambda i: round(candidates[i], 9))
    r = 2 * math.sqrt(candidates[k])
    pairs = {
        0: (r * r / 4, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]),
        1: (m[2][1] - m[1][2], r * r / 4, m[1][0] + m[0][1], m[0][2] + m[2][0]),
        2: (m[0][2] - m[2][0], m[1][0] + m[0][1], r * r / 4, m[2][1] + m[1][2]),
        3: (m[1][0] - m[0][1], m[0][2] + m[2][0], m[2][1] + m[1][2], r * r / 4),
    }
    q = scale(pairs[k], 1 / r)
    leading = next(c for c in q if abs(c) > 1e-7)
    return q if leading > 0 else scale(q, -1)


def eigen(symmetric):
    """Principal moments (ascending) and the right-handed rotation of principal axes of a 3x3
    symmetric matrix.

    Cyclic Jacobi: every rotation zeroes one off-diagonal element, and three elements converge in
    a few sweeps.
    """
    a = [list(row) for row in symmetric]
    v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    for _ in range(30):
        for p, q in ((0, 1), (0, 2), (1, 2)):
            if a[p][q] == 0.0:
                continue
            theta = 0.5 * math.atan2(2 * a[p][q], a[q][q] - a[p][p])
            c, s = math.cos(theta), math.sin(theta)
            for k in range(3):
                a[k][p], a[k][q] = c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]
            for k in range(3):
                a[p][k], a[q][k] = c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]
            for k in range(3):
                v[k][p], v[k][q] = c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]
            a[p][q] = a[q][p] = 0.0
    order = sorted(range(3), key=lambda i: a[i][i])
    axes = [tuple(v[k][i] for k in range(3)) for i in order]
    if dot(cross(axes[0], axes[1]), axes[2]) < 0:
        axes[2] = scale(axes[2], -1)
    return tuple(a[i][i] for i in order), from_axes(*axes)
