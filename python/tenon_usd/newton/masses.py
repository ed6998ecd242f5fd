# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Mass properties of bodies.

A body on which nothing about mass is applied, nor on a collider of it, has what its shapes add up
to: the builder's own sums, of its default density or that of a material. All others have those of
the description; where one of them needs a density that nothing gives, the builder's default has to
be that of UsdPhysics.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..errors import UnsupportedError
from .importing import Importing
from .prims import RIGID_BODY

MASS = "PhysicsMassAPI"
#: Of UsdPhysics where nothing else is given [kg/m^3].
DENSITY = 1000.0


class Masses:
    """Which bodies have the masses of the description."""

    def __init__(self, importing: Importing) -> None:
        self._importing = importing
        self.described = {
            path for path in importing.body_numbers if self._is_described(importing, path)
        }

    def _is_described(self, importing: Importing, path: str) -> bool:
        body = importing.prims.get(path)
        if body is None:
            return True
        if body.HasAPI(MASS) or body.HasAPI("NewtonMassAPI"):
            return True
        waiting = list(body.GetChildren())
        while waiting:
            prim = waiting.pop()
            if prim.HasAPI(RIGID_BODY):
                continue
            if prim.HasAPI(MASS) and prim.HasAPI("PhysicsCollisionAPI"):
                return True
            waiting.extend(prim.GetChildren())
        return False

    def density(self, path: str, of_material: float) -> float:
        """That a collider of a body is to have in the builder [kg/m^3]: none where the body's mass
        is not the sum of its shapes."""
        return 0.0 if path in self.described else of_material

    def refuse_shell(self, path: str, collider: str) -> None:
        """Raises UnsupportedError where a collider that is a shell is to give a described body a
        part of its mass: the description weighs solids."""
        if path not in self.described:
            return
        body, prim = self._importing.scene.bodies[path], self._importing.prims[path]
        given = [prim.authored(name) for name in ("newton:inertia", "physics:diagonalInertia")]
        whole = any(each is not None and any(each) for each in given)
        if body.mass_source != "authored" or not whole:
            raise UnsupportedError(
                f"{collider}: a shell (newton:massModel, mjc:shellinertia) of a body whose mass or "
                f"inertia it has to give; author both on {path}, or take PhysicsMassAPI away there"
            )

    def give(self) -> None:
        """Gives described bodies their masses."""
        for path in self.described:
            number = self._importing.bodies.get(path, -1)
            if number >= 0:
                self._give(path, number)

    def _give(self, path: str, number: int) -> None:
        importing = self._importing
        body = importing.scene.bodies[importing.body_numbers[path]]
        default = importing.builder.default_shape_cfg.density
        if body.mass_source != "authored" and not math.isclose(default, DENSITY):
            raise UnsupportedError(
                f"{path}: its mass needs a density, and default_shape_cfg.density of the builder "
                f"is {default:g}, not {DENSITY:g} of UsdPhysics; set that, or author physics:mass"
            )
        set_mass(importing, number, body.mass, body.center_of_mass, body.inertia)


def set_mass(importing: Importing, number: int, mass: float, center: Any, inertia: Any) -> None:
    """Mass [kg], centre of mass [m] and inertia about it [kg m^2] of a body of the builder."""
    builder, warp = importing.builder, importing.libraries.warp
    builder.body_mass[number] = mass
    builder.body_inv_mass[number] = 1.0 / mass if mass > 0.0 else 0.0
    builder.body_com[number] = warp.vec3(*(float(each) for each in center))
    matrix = warp.mat33(np.asarray(inertia, dtype=np.float32))
    builder.body_inertia[number] = matrix
    singular = not np.linalg.det(np.asarray(inertia, dtype=np.float64)) > 0.0
    builder.body_inv_inertia[number] = warp.mat33(0.0) if singular else warp.inverse(matrix)
