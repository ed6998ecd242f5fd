# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Inertia by second moments of mass, the integrals of x^2, y^2 and z^2 over a body about its centre
of mass, along principal axes. Whatever they are above 0, a body of some density has them:
Ixx = second moment y + second moment z, and so on (Wensing, Kim, Slotine 2018).
"""

from __future__ import annotations

import numpy as np

from .log import Array


def axes_of(inertia: Array) -> tuple[Array, Array]:
    """Principal axes as the columns of a rotation, and second moments of mass along them (3,)."""
    moments, axes = np.linalg.eigh(inertia)
    # As near to the body's own axes as they go, so that X, Y and Z are what they are called.
    order = _nearest(np.abs(axes))
    axes, moments = axes[:, order], moments[order]
    axes = axes * np.where(np.diag(axes) < 0, -1.0, 1.0)
    if np.linalg.det(axes) < 0:
        axes[:, int(np.argmin(np.abs(np.diag(axes))))] *= -1
    return axes, 0.5 * moments.sum() - moments


def _nearest(shares: Array) -> list[int]:
    """Which column is along which row, each once: the largest shares first."""
    made, left = [0, 0, 0], shares.copy()
    for _ in range(3):
        row, column = np.unravel_index(int(np.argmax(left)), left.shape)
        made[int(row)] = int(column)
        left[row, :], left[:, column] = -1, -1
    return made


def inertia_of_moments(axes: Array, moments: Array) -> Array:
    """The inertia (..., 3, 3) of second moments (..., 3) along the columns of `axes`."""
    principal = moments.sum(axis=-1, keepdims=True) - moments
    return np.asarray((axes * principal[..., None, :]) @ axes.T)
