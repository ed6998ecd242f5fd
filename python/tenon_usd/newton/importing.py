# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What the passes of one import share."""

from __future__ import annotations

import dataclasses
import warnings
from typing import Any

import numpy as np

from .. import _tenon
from .options import ImportedWarning, Libraries, Numbers, Options
from .poses import (
    IDENTITY,
    Matrix,
    Pose,
    Vector,
    compose,
    decompose,
    inverse,
    pose_of,
    vector_of,
)
from .prims import Prims, PrimView
from .resolvers import Resolvers


def warn(path: str, words: str) -> None:
    """Tells what Newton's model cannot hold."""
    warnings.warn(f"{path}: {words}", ImportedWarning, stacklevel=2)


@dataclasses.dataclass
class Importing:
    """One import: where it goes to, what it reads, and what it made so far."""

    builder: Any
    libraries: Libraries
    options: Options
    prims: Prims
    scene: _tenon.PhysicsScene
    resolvers: Resolvers
    #: builder's world <- stage: the turn between up axes and `xform`.
    incoming: Pose = IDENTITY
    #: Of the turn alone.
    turn: Pose = IDENTITY
    gains_scale: float = 1.0
    scene_prim: PrimView | None = None
    bodies: Numbers = dataclasses.field(default_factory=dict)
    joints: Numbers = dataclasses.field(default_factory=dict)
    shapes: Numbers = dataclasses.field(default_factory=dict)
    shape_scales: dict[str, Any] = dataclasses.field(default_factory=dict)
    #: Of joints that became a part of one with several degrees of freedom: the first of theirs.
    merged_dofs: Numbers = dataclasses.field(default_factory=dict)
    #: Articulations of the builder -> whether links of theirs touch each other.
    self_collisions: dict[int, bool] = dataclasses.field(default_factory=dict)
    #: Bodies whose visuals or sites are seen.
    seen_bodies: set[int] = dataclasses.field(default_factory=set)

    def __post_init__(self) -> None:
        #: Numbers of the description by path, of what is to be imported.
        self.body_numbers = self._wanted(self.scene.bodies)
        self.joint_numbers = self._wanted(self.scene.joints)
        self.body_paths: list[str] = [body.path for body in self.scene.bodies]
        self._custom: dict[str, list[Any]] = {}

    def _wanted(self, objects: Any) -> Numbers:
        wanted = self.prims.is_wanted
        return {each.path: n for n, each in enumerate(objects) if wanted(each.path)}

    def body_pose(self, number: int) -> Pose:
        """Of a body of the description in the stage's world, unscaled [m]."""
        body = self.scene.bodies[number]
        return pose_of(body.position, body.orientation)

    def place(self, pose: Pose, root: Pose | None) -> Pose:
        """A pose of the stage's world in the builder's; `root`: seen from that pose."""
        return compose(self.incoming, pose if root is None else compose(inverse(root), pose))

    def prim_pose(self, path: str, mirrored: bool = False) -> Pose:
        """Of a prim in the stage's world, unscaled [m]; `mirrored`: of one that is mirrored, with
        all three axes turned round, which mirrored_scale() goes with."""
        place = self.prims.world(path)
        if mirrored and self.prims.is_mirrored(path):
            place = place * np.array([[-1.0], [-1.0], [-1.0], [1.0]])
        (position, turn), _ = self.decompose(place)
        m = self.scene.meters_per_unit
        return (position[0] * m, position[1] * m, position[2] * m), turn

    def decompose(self, place: Matrix) -> tuple[Pose, Vector]:
        """Pose and scale of a matrix; of one that mirrors as Warp has them."""
        if np.linalg.det(place[:3, :3]) > 0:
            return decompose(place)
        warp = self.libraries.warp
        position, turn, scale = warp.transform_decompose(warp.mat44(place.T))
        x, y, z, w = (float(number) for number in turn)
        return (vector_of(position), (x, y, z, w)), vector_of(scale)

    def transform(self, pose: Pose) -> Any:
        return self.libraries.warp.transform(*pose)

    def custom_values(self, prim: PrimView, *frequencies: str) -> dict[str, Any]:
        """Values of the builder's custom attributes on a prim."""
        attributes = self._attributes(frequencies)
        if not attributes:
            return {}
        values: dict[str, Any] = self.libraries.newton.usd.get_custom_attribute_values(
            prim,
            attributes,
            context={"builder": self.builder, "physics_scene_prim": self.scene_prim},
        )
        return values

    def _attributes(self, frequencies: tuple[str, ...]) -> list[Any]:
        key = ",".join(frequencies)
        if key not in self._custom:
            known = self.libraries.newton.Model.AttributeFrequency
            self._custom[key] = self.builder.get_custom_attributes_by_frequency(
                [getattr(known, each, each) for each in frequencies]
            )
        return self._custom[key]
