# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Meshes of the stage as Newton's: points in the prim's own frame and units, triangles as fans.

Normals and texture coordinates are not read: viewers shade by faces.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..errors import InvalidError
from .importing import Importing
from .prims import PrimView

Integers = npt.NDArray[np.int32]


def fan(counts: Integers, indices: Integers) -> Integers:
    """Triangles (count, 3) of faces, each from its first corner."""
    per_face = counts - 2
    face = np.repeat(np.arange(len(counts)), per_face)
    starts = np.cumsum(counts) - counts
    step = np.arange(len(face)) - (np.cumsum(per_face) - per_face)[face]
    corners = np.stack([starts[face], starts[face] + step + 1, starts[face] + step + 2], axis=1)
    return np.asarray(indices[corners], dtype=np.int32)


def arrays_of(prim: PrimView) -> tuple[npt.NDArray[np.float32], Integers]:
    """Points (count, 3) and triangles (count, 3). Raises InvalidError for what is no mesh."""
    points, counts, indices = (
        prim.value(name) for name in ("points", "faceVertexCounts", "faceVertexIndices")
    )
    if points is None or counts is None or indices is None or not len(points):
        raise InvalidError(f"{prim.path}: a mesh without points or faces at the default time")
    counts = np.asarray(counts, dtype=np.int32)
    indices = np.asarray(indices, dtype=np.int32)
    if (counts < 3).any() or counts.sum() != len(indices):
        raise InvalidError(f"{prim.path}: faceVertexCounts do not fit faceVertexIndices")
    if len(indices) and (indices.min() < 0 or indices.max() >= len(points)):
        raise InvalidError(f"{prim.path}: faceVertexIndices has a number that is no point's")
    triangles = fan(counts, indices)
    if prim.value("orientation") == "leftHanded":
        triangles = np.ascontiguousarray(triangles[:, [0, 2, 1]])
    return np.asarray(points, dtype=np.float32), triangles


class Meshes:
    """Newton's meshes by prim, each made once."""

    def __init__(self, importing: Importing) -> None:
        self._importing = importing
        self._made: dict[tuple[str, bool], Any] = {}

    def mesh(self, prim: PrimView, inertia: bool, drawn: bool, **looks: Any) -> Any:
        """A newton.Mesh; `inertia`: with the mass properties that shapes of some density need;
        `drawn`: without points that no face has."""
        key = (prim.path, inertia)
        made = self._made.get(key)
        if made is None:
            points, triangles = arrays_of(prim)
            if drawn:
                used, renumbered = np.unique(triangles, return_inverse=True)
                if len(used) < len(points):
                    points = np.ascontiguousarray(points[used])
                    triangles = renumbered.reshape(-1, 3).astype(np.int32)
            made = self._importing.libraries.newton.Mesh(
                points, triangles.reshape(-1), compute_inertia=inertia, **looks
            )
            self._made[key] = made
        return made
