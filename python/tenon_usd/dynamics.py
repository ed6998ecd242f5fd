# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Multibody algebra of a scene, without any engine: mass matrix, Jacobians, inertia and weight.

    scene = tenon_usd.physics("hand.usda")
    hand = tenon_usd.Dynamics(scene, "thumb.*=20deg")
    held, free = hand.effective_inertia()              # kg m^2 or kg, of each coordinate

Everything is in metres, kilograms, seconds and radians, along the axes of the world. Velocities and
forces are along the coordinates: the degrees of freedom of the joints, and six of each body that
floats. Arrays are of float64 and belong to the caller.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import SupportsFloat, SupportsIndex

import numpy as np
import numpy.typing as npt

from . import _tenon
from ._arrays import place, spread

Array = npt.NDArray[np.float64]
Pose = str | Mapping[str, SupportsFloat]


@dataclasses.dataclass(frozen=True)
class Coordinate:
    """One degree of freedom of a scene."""

    joint: str | None
    """Path of the joint; None: of the body itself, which floats."""
    body: str
    """Path of the body that it moves, with all that hangs on it."""
    dof: str
    """"transX" to "transZ", "rotX" to "rotZ"."""
    part: int
    """Its place among those of its joint. Of a floating body 0 to 2: the velocity of its centre of
    mass, 3 to 5: its angular velocity, both along the axes of the world."""


class Dynamics:
    """The algebra of a scene at one pose.

    `scene` is that of tenon_usd.physics(), Stage.physics() or World.scene; it is kept. `pose` moves
    joints away from where the asset starts: as text, "thumb=20deg,finger_.*=0.5rad", each a path, a
    name or a regular expression, ":rotX" behind it where the joint has several degrees of freedom,
    and a value in degrees or units of the stage, or with deg, rad, m, cm or mm; or as a dictionary
    of paths or names, {"thumb": 0.35}, in rad and m. Followers of mimics go where their leaders
    say, and what closes loops is moved until they close.

    Raises InvalidError for poses of another form, for numbers that are not finite and for followers
    of mimics, NotFoundError for names that no joint has. Threads may share one; calls let the
    others run.
    """

    def __init__(self, scene: _tenon.PhysicsScene, pose: Pose | None = None) -> None:
        if not isinstance(scene, _tenon.PhysicsScene):
            raise TypeError(
                f"scene is a {type(scene).__name__}; expected a PhysicsScene, as"
                " tenon_usd.physics() and Stage.physics() return"
            )
        self._posed = _tenon.make_posed_scene(scene, *_pose(pose))
        self._coordinates: list[Coordinate] | None = None

    def moved(self, pose: Pose | None) -> Dynamics:
        """The same scene at another pose, which counts from the start as that of a new Dynamics."""
        made = Dynamics.__new__(type(self))
        made._posed = self._posed.moved(*_pose(pose))
        made._coordinates = self._coordinates
        return made

    # ---- what there is

    @property
    def scene(self) -> _tenon.PhysicsScene:
        """The scene that it is of [SI, rad]."""
        return self._posed.scene

    @property
    def coordinates(self) -> list[Coordinate]:
        """All degrees of freedom, in the order of all arrays of coordinates. Length n.

        From the roots of the trees of joints outward, those of one joint in the order of their
        `part`. Joints that close loops have none: they are constraints on the others.
        """
        if self._coordinates is None:
            self._coordinates = [Coordinate(*row) for row in self._posed.coordinates()]
        return list(self._coordinates)

    def coordinate(self, joint: str, dof: str | None = None) -> int:
        """The place of a degree of freedom in all arrays of coordinates.

        `joint` is a path, "/hand/thumb", or a name. Where it has several degrees of freedom, `dof`
        says which, "rotX", or it stands behind a colon, as in World.joint_names. Raises
        NotFoundError for others, InvalidError where several are meant.
        """
        return self._posed.coordinate(joint, dof)

    @property
    def positions(self) -> Array:
        """Positions of the coordinates [rad or m], shape (n,).

        NaN for those of floating bodies; of a ball the parts of its rotation vector.
        """
        return self._posed.positions()

    @property
    def body_positions(self) -> Array:
        """Origins of the bodies [m, world], shape (bodies, 3), in the order of scene.bodies."""
        return self._posed.body_positions()

    @property
    def body_orientations(self) -> Array:
        """Orientations of the bodies [unit quaternions], shape (bodies, 4): w, x, y, z."""
        return self._posed.body_orientations()

    @property
    def mass(self) -> float:
        """Of all bodies that are not kinematic [kg]."""
        return self._posed.mass()

    @property
    def center_of_mass(self) -> Array:
        """Of all bodies that are not kinematic [m, world], shape (3,)."""
        return self._posed.center_of_mass()

    @property
    def loop_gap(self) -> float:
        """The largest distance [m] by which frames of joints that close loops are apart."""
        return self._posed.loop_gap()

    # ---- algebra

    def mass_matrix(self) -> Array:
        """The mass matrix M [kg, kg m, kg m^2], armature included, shape (n, n).

        Of the trees of joints alone: loops and mimics are constraints on it. Raises LimitError
        where n is more than 1,000.
        """
        return self._posed.mass_matrix()

    def gravity_forces(self) -> Array:
        """What gravity exerts along each coordinate [N or N m], shape (n,).

        What holds the scene still is the opposite.
        """
        return self._posed.gravity_forces()

    def bias_forces(self, velocities: npt.ArrayLike) -> Array:
        """Coriolis and centrifugal forces at these velocities [N or N m], shape (n,).

        `velocities` [rad/s or m/s] are (n,), or what broadcasts to it. With an acceleration a, M a
        + bias = forces + gravity_forces. Raises InvalidError for numbers that are not finite.
        """
        return self._posed.bias_forces(self._along("velocities", velocities))

    def jacobian(self, body: str | SupportsIndex, point: npt.ArrayLike | None = None) -> Array:
        """How coordinates move a point of a body [m or 1], shape (6, n).

        The product with velocities is the velocity of the point of the body that is at `point` [m,
        world], then the angular velocity of the body, both along the axes of the world. `body` is a
        path, a name or an index into scene.bodies; the point is its centre of mass where none is
        given. Raises NotFoundError for an unknown body, IndexError for an index out of range,
        InvalidError for a point that is not finite.
        """
        place = None if point is None else spread("point", point, (3,))
        return self._posed.jacobian(self._body(body), place)

    def effective_inertia(self) -> tuple[Array, Array]:
        """What a force along each coordinate has to accelerate [kg m^2 or kg]: two arrays (n,).

        First with all other joints held, then with the others free to move as they like; armature
        is in both. What rigid mimics and loops tie to the coordinate moves along, and floating
        bodies are free. 0 where nothing moves that has mass, infinite where it cannot move, NaN
        where joints tie more together than docs/limits.md says.
        """
        return self._posed.effective_inertia()

    def along_held(self, forces: npt.ArrayLike) -> Array:
        """What forces exert along each coordinate while all others are held [N or N m], shape (n,).

        It is what a drive has to balance. `forces` along the coordinates are (n,), or what
        broadcasts to it; what is tied to a coordinate adds its part. Not finite where the
        coordinate cannot move. Raises InvalidError for numbers that are not finite.
        """
        return self._posed.along_held(self._along("forces", forces))

    # ---- the rest

    def __repr__(self) -> str:
        return f"<Dynamics of {self._posed.body_count} bodies, {self._posed.count} coordinates>"

    def _along(self, what: str, values: npt.ArrayLike) -> Array:
        return spread(what, values, (self._posed.count,))

    def _body(self, body: str | SupportsIndex) -> int:
        if isinstance(body, str):
            return self._posed.body(body)
        return place("body", body, self._posed.body_count)


def _pose(pose: Pose | None) -> tuple[list[str], list[tuple[str, float]]]:
    """A pose as the library takes it: texts, and values by joint [rad, m]."""
    if pose is None:
        return [], []
    if isinstance(pose, str):
        return [pose], []
    if not isinstance(pose, Mapping):
        raise TypeError(f"pose is a {type(pose).__name__}; expected a str, a dict or None")
    values: list[tuple[str, float]] = []
    for joint, value in pose.items():
        if not isinstance(joint, str):
            raise TypeError(f"pose names a joint by {joint!r}; expected its path or name")
        # A check of a protocol takes longer than all the rest.
        if type(value) is not float and (
            isinstance(value, str) or not isinstance(value, SupportsFloat)
        ):
            raise TypeError(f"pose of {joint!r} is {value!r}; expected a number in rad or m")
        values.append((joint, float(value)))
    return [], values


__all__ = ["Coordinate", "Dynamics"]
