# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Simulations: many environments of one asset, side by side.

Arrays are of float64, their first axis is the environment. Positions are in metres, angles in
radians, time in seconds, masses in kilograms; quaternions are w, x, y, z; axes are those of the
world. Nothing depends on the number of threads.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _tenon
from .errors import Error, InvalidError, UnstableError
from .options import OpenOptions, PathLike, arguments_of

if TYPE_CHECKING:
    from typing import Unpack

    from ._tenon import Diagnostic, PhysicsScene, Stage

Array = npt.NDArray[np.float64]
OUTPUTS = ("contacts", "efforts", "reactions", "accelerations", "work", "sensors")


class World:
    """Environments of one asset on one engine.

    World("grasp.usda", envs=64) makes 64 of them from one compiled model. `asset` is a file, or a
    stage of tenon_usd.open() with the edits that it has now, saved or not, opened as the stage was;
    `options` are for files alone. `engine` is a name as of
    tenon_usd.engines(); None: what the asset's variant asks for, else MuJoCo. `threads` are as many
    as the process may use where it is 0. `time_step` [s] is the asset's where it is 0. `outputs`
    name what can be read beside states: contacts, efforts, reactions, accelerations, work, sensors.
    `vary` are texts such as "bodyMass=0.8..1.2", "gravity=0.9..1.1" or
    "colliderFriction@/can=0.5..1.5": what each environment draws of them depends on `seed` and its
    number alone. `options` are those of tenon_usd.open(). Raises errors of tenon_usd.errors.
    """

    def __init__(
        self,
        asset: PathLike | Stage,
        engine: str | None = None,
        envs: int = 1,
        seed: int = 0,
        *,
        threads: int = 0,
        time_step: float = 0.0,
        outputs: Iterable[str] = (),
        vary: Iterable[str] = (),
        integrator: str = "",
        **options: Unpack[OpenOptions],
    ) -> None:
        how = _tenon.BatchOptions(
            engine or "", envs, threads, seed, time_step, list(outputs), list(vary), integrator
        )
        if isinstance(asset, _tenon.Stage):
            if options:
                raise TypeError(f"{', '.join(options)}: a stage was opened with its own options")
            self._batch = _tenon.make_batch_of(asset, how)
        else:
            self._batch = _tenon.make_batch(os.fspath(asset), arguments_of(options), how)
        drives = [drive for joint in self._batch.scene().joints for drive in joint.drives]
        self._first_targets = np.array([drive.target_position for drive in drives])
        self._first_velocities = np.array([drive.target_velocity for drive in drives])
        self._targets = np.tile(self._first_targets, (envs, 1))
        self._target_velocities = np.tile(self._first_velocities, (envs, 1))

    # ---- what there is

    @property
    def envs(self) -> int:
        """How many environments."""
        return self._batch.size

    @property
    def engine(self) -> str:
        """Name of the engine: "mujoco", "physx", "jolt"."""
        return self._batch.engine

    @property
    def engine_version(self) -> str:
        """Version of the engine's library."""
        return self._batch.engine_version

    @property
    def time_step(self) -> float:
        """What one step takes [s]."""
        return self._batch.time_step

    @property
    def dofs(self) -> int:
        """Degrees of freedom that the engine simulates in one environment."""
        return self._batch.dof_count

    @property
    def joint_names(self) -> list[str]:
        """A name for each joint coordinate, in the order of all arrays of joints.

        The path of the joint; with several degrees of freedom "/hand/joint:rotX", of a ball
        "/hand/joint:ball0" to "ball2".
        """
        return self._batch.coordinate_names()

    @property
    def drive_names(self) -> list[str]:
        """A name for each drive, in the order of all arrays of drives: the path of the joint."""
        return self._batch.drive_names()

    @property
    def body_names(self) -> list[str]:
        """Paths of the bodies, in the order of all arrays of bodies."""
        return self._batch.body_names()

    @property
    def scene(self) -> PhysicsScene:
        """What the engine received [SI, rad], before anything was varied: a copy."""
        return self._batch.scene()

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What opening, reading and building found."""
        return self._batch.diagnostics()

    @property
    def not_mapped(self) -> list[dict[str, Any]]:
        """What the engine cannot express: {"prim", "property", "why"}."""
        return self._batch.not_mapped()

    @property
    def drawn(self) -> list[list[list[float]]]:
        """What each environment drew for each text of `vary`: factors, or offsets [rad or m]."""
        return self._batch.drawn()

    # ---- time

    @property
    def time(self) -> Array:
        """Time since the start [s], shape (envs,)."""
        return self._batch.times()

    def step(self, count: int = 1) -> int:
        """Takes so many time steps in every environment; returns how many stand still.

        An environment that becomes unstable stands still from then on (failures() says why), until
        it is reset. With a single environment that raises UnstableError. Other threads of Python
        run meanwhile.
        """
        failed = self._batch.step(count)
        if failed and self.envs == 1:
            reason = self.failures()[0]
            raise UnstableError(str(reason), [reason] if reason else [])
        return failed

    def failures(self) -> list[Diagnostic | None]:
        """Why environments stand still; None for those that do not. Length envs."""
        return self._batch.failures()

    def reset(self, envs: int | Sequence[int] | npt.NDArray[Any] | None = None) -> None:
        """Back to the start, with what was drawn: all environments, some by number, or a mask."""
        which = self._which(envs)
        self._batch.reset(which)
        self._targets[which] = self._first_targets
        self._target_velocities[which] = self._first_velocities

    # ---- joints

    @property
    def joint_positions(self) -> Array:
        """Positions of the joints [rad or m], shape (envs, joints)."""
        return self._batch.joints()[0]

    @joint_positions.setter
    def joint_positions(self, values: npt.ArrayLike) -> None:
        self.set_joints(positions=values)

    @property
    def joint_velocities(self) -> Array:
        """Velocities of the joints [rad/s or m/s], shape (envs, joints)."""
        return self._batch.joints()[1]

    @joint_velocities.setter
    def joint_velocities(self, values: npt.ArrayLike) -> None:
        self.set_joints(velocities=values)

    def joints(self) -> tuple[Array, Array]:
        """Positions [rad or m] and velocities [rad/s or m/s], both of shape (envs, joints)."""
        return self._batch.joints()

    def set_joints(
        self, positions: npt.ArrayLike | None = None, velocities: npt.ArrayLike | None = None
    ) -> None:
        """Puts joints elsewhere [rad, m, rad/s, m/s]: (envs, joints), or what broadcasts to it.

        The bodies behind the joints move along. Raises UnsupportedError where the engine cannot.
        """
        now = self._batch.joints()
        shape = now[0].shape
        self._batch.set_joints(
            now[0] if positions is None else _spread(positions, shape),
            now[1] if velocities is None else _spread(velocities, shape),
        )

    # ---- drives

    @property
    def drive_targets(self) -> Array:
        """Position targets of the drives [rad or m], shape (envs, drives): a copy."""
        return self._targets.copy()

    @drive_targets.setter
    def drive_targets(self, values: npt.ArrayLike) -> None:
        self.set_drive_targets(values)

    def set_drive_targets(
        self, positions: npt.ArrayLike | None = None, velocities: npt.ArrayLike | None = None
    ) -> None:
        """Targets of the drives: positions [rad or m] and velocities [rad/s or m/s].

        Shape (envs, drives), or what broadcasts to it. They hold until they are set again or reset.
        Drives that exert no force are skipped. InvalidError where a number is not finite: no target
        changes then.
        """
        shape = self._targets.shape
        wanted = [None if v is None else _finite(v, shape) for v in (positions, velocities)]
        for held, new in zip((self._targets, self._target_velocities), wanted):
            if new is not None:
                held[:] = new
        self._batch.set_targets(self._targets, self._target_velocities)

    def set_efforts(self, efforts: npt.ArrayLike) -> None:
        """Forces and torques along the joints [N m or N], shape (envs, joints), on top of drives.

        They hold until they are set anew or reset.
        """
        self._batch.set_efforts(_spread(efforts, (self.envs, len(self.joint_names))))

    def drive_efforts(self) -> Array:
        """Mean forces of the drives in the last step [N m or N], shape (envs, drives).

        Needs outputs=["efforts"].
        """
        return self._batch.drive_efforts()

    # ---- bodies

    @property
    def body_poses(self) -> Array:
        """Poses of the bodies, shape (envs, bodies, 7): x, y, z [m], then w, x, y, z."""
        return self._batch.body_poses()

    @property
    def body_velocities(self) -> Array:
        """Velocities of the bodies, shape (envs, bodies, 6): linear, of the centre of mass [m/s],
        then angular [rad/s]."""
        return self._batch.body_states()[1]

    def set_body(
        self, body: str | int, poses: npt.ArrayLike, velocities: npt.ArrayLike | None = None
    ) -> None:
        """Puts a body that moves freely elsewhere: poses (envs, 7) [m], velocities (envs, 6)
        [m/s, rad/s], as body_poses and body_velocities have them, or what broadcasts to it."""
        self._batch.set_body(
            self._body(body),
            _spread(poses, (self.envs, 7)),
            np.zeros((self.envs, 6)) if velocities is None else _spread(velocities, (self.envs, 6)),
        )

    def move_kinematic(self, body: str | int, poses: npt.ArrayLike) -> None:
        """Moves a kinematic body within the next step to poses (envs, 7) [m]; there it stands."""
        self._batch.move_kinematic(self._body(body), _spread(poses, (self.envs, 7)))

    def set_wrench(self, body: str | int, wrenches: npt.ArrayLike) -> None:
        """Forces [N] and torques [N m] at the centre of mass of a body, shape (envs, 6).

        They hold until they are set anew or reset.
        """
        self._batch.set_wrench(self._body(body), _spread(wrenches, (self.envs, 6)))

    # ---- numbers of each environment

    @property
    def gravity(self) -> Array:
        """Gravity [m/s^2], shape (envs, 3)."""
        return self._batch.gravity()

    @gravity.setter
    def gravity(self, values: npt.ArrayLike) -> None:
        self._batch.set_gravity(_spread(values, (self.envs, 3)))

    def set_parameter(self, name: str, path: str, values: npt.ArrayLike, drive: int = 0) -> None:
        """A number of one object in every environment, shape (envs,) or one for all.

        `name` is "bodyMass" [kg], "colliderFriction", "driveStiffness" [N m/rad or N/m],
        "driveDamping" [N m s/rad or N s/m], "driveMaxForce" [N m or N], "jointDamping",
        "jointFriction" [N m or N] or "jointArmature" [kg m^2 or kg]; `path` the body, collider or
        joint; `drive` the number of the drive at the joint. It holds until it is set anew or reset.
        """
        paths = (
            self.body_names
            if name.startswith("body")
            else self._batch.collider_names()
            if name.startswith("collider")
            else self._batch.joint_paths()
        )
        self._batch.set_parameter(name, _index(paths, path), drive, _spread(values, (self.envs,)))

    @property
    def energy(self) -> Array:
        """Kinetic and potential energy [J], shape (envs, 2)."""
        return self._batch.energies()

    # ---- what happened

    def contacts(self, env: int = 0) -> dict[str, npt.NDArray[Any]]:
        """The points at which colliders touched in the last step: arrays of length count.

        "collider0", "collider1": indices into scene.colliders; "body0", "body1": into body_names,
        -1 for what stands still; "point" (count, 3) [m]; "normal" (count, 3), from collider0 to
        collider1; "depth" [m]; "normal_force" [N]; "force" (count, 3) [N], on collider1, friction
        included; "friction_torque" (count, 3) [N m]. Needs outputs=["contacts"].
        """
        return self._batch.contacts(env)

    @property
    def contact_counts(self) -> npt.NDArray[np.int64]:
        """How many points touch, shape (envs,)."""
        return self._batch.contact_counts()

    def sensors(self, env: int = 0) -> list[dict[str, Any]]:
        """What the sensors of the asset read last, one row each: "path", "kind", "time" [s].

        Of contacts "in_contact" and "normal_force" [N]; of IMUs "linear_acceleration" [m/s^2],
        "angular_velocity" [rad/s] and "orientation"; of force and torque "force" [N] and "torque"
        [N m]; of joints "position", "velocity", "effort"; of frames "position" [m], "orientation",
        "linear_velocity" [m/s] and "angular_velocity" [rad/s]; of rays "distances" [m], -1 where
        there is nothing. Needs outputs=["sensors"].
        """
        return self._batch.sensors(env)

    def events(self, env: int = 0) -> list[dict[str, Any]]:
        """Joints that broke and bodies that passed through others: {"time" [s], "prim", "what"}."""
        return self._batch.events(env)

    # ---- states

    def save(self) -> list[bytes]:
        """Everything that the future of each environment depends on. Length envs."""
        return [self._batch.save_state(i) for i in range(self.envs)]

    def restore(self, states: Sequence[bytes] | bytes) -> None:
        """Goes on where save() was called, bit for bit; one state stands for all environments.

        Raises CorruptError or UnsupportedError for bytes of another scene, engine or time step.
        """
        if isinstance(states, bytes):
            states = [states] * self.envs
        if len(states) != self.envs:
            raise ValueError(f"{len(states)} states for {self.envs} environments")
        for i, state in enumerate(states):
            self._batch.restore_state(i, state)

    # ---- models of MuJoCo

    def to_mjcf(self, path: PathLike | None = None, env: int = 0) -> str:
        """The model as MJCF text, for MuJoCo, MJX and mujoco_warp; written to `path` as well.

        Textures are written beside it. What MJCF has no word for raises nothing: see not_mapped.
        """
        name = "" if path is None else os.path.splitext(os.path.basename(os.fspath(path)))[0]
        text, images, _ = self._batch.to_mjcf(env, name + "_files" if name else "")
        if path is not None:
            _tenon.write_files(os.fspath(path), text.encode(), images)
        return text

    @property
    def model(self) -> Any:
        """A mujoco.MjModel of the user's own mujoco, made from to_mjcf(): a new one at each call.

        Raises MissingError where mujoco is not installed.
        """
        try:
            import mujoco  # type: ignore[import-not-found, import-untyped, unused-ignore]
        except ImportError as reason:
            from .errors import MissingError

            raise MissingError(f"mujoco cannot be imported: {reason}; pip install mujoco") from None
        text, images, _ = self._batch.to_mjcf(0, "")
        return mujoco.MjModel.from_xml_string(text, images)

    # ---- the rest

    def __repr__(self) -> str:
        return f"<World of {self.envs} environments on {self.engine}>"

    def _which(self, envs: int | Sequence[int] | npt.NDArray[Any] | None) -> list[int]:
        if envs is None:
            return list(range(self.envs))
        chosen = np.atleast_1d(np.asarray(envs))
        if chosen.dtype == bool:
            if chosen.shape != (self.envs,):
                raise ValueError(f"a mask of shape {chosen.shape} for {self.envs} environments")
            chosen = np.flatnonzero(chosen)
        return [int(i) for i in chosen]

    def _body(self, body: str | int) -> int:
        return body if isinstance(body, int) else _index(self.body_names, body)


def _spread(values: npt.ArrayLike, shape: tuple[int, ...]) -> Array:
    array = np.asarray(values, dtype=np.float64)
    return np.ascontiguousarray(np.broadcast_to(array, shape))


def _finite(values: npt.ArrayLike, shape: tuple[int, ...]) -> Array:
    array = _spread(values, shape)
    if not np.isfinite(array).all():
        raise InvalidError("targets must be finite numbers")
    return array


def _index(paths: list[str], path: str) -> int:
    try:
        return paths.index(path)
    except ValueError:
        raise LookupError(f"there is no {path!r}; there are {', '.join(paths[:20])}") from None


__all__ = ["OUTPUTS", "Error", "World"]
