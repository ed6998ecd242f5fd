# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Simulations: many environments of one asset, side by side.

Arrays are of float64, their first axis is the environment. Positions are in metres, angles in
radians, time in seconds, masses in kilograms; quaternions are w, x, y, z; axes are those of the
world. Nothing depends on the number of threads.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NoReturn, SupportsIndex

import numpy as np
import numpy.typing as npt

from . import _tenon
from ._arrays import (
    checked_poses, counted, environments, finite, index, locked, named, place, seconds, spread,
    texts)
from ._lists import html_of_world, no_such
from .errors import Error, ExportWarning, InvalidError, NotFoundError, UnstableError
from .options import OpenOptions, PathLike, arguments_of, path_of

if TYPE_CHECKING:
    from typing import Unpack

    from ._tenon import Diagnostic, PhysicsScene, Stage
    from .gpu import MjxBatch, NewtonBatch, WarpBatch
    from .rendering import Picture

Array = npt.NDArray[np.float64]
OUTPUTS = ("contacts", "efforts", "reactions", "accelerations", "work", "sensors")
#: The parts of World.work().
WORK = ("drives", "applied", "contacts", "constraints", "damping", "springs", "changes")
#: Numbers of objects that World.set_parameter() sets.
PARAMETERS = ("bodyMass", "colliderFriction", "driveStiffness", "driveDamping", "driveMaxForce",
              "jointDamping", "jointFriction", "jointArmature")


class World:
    """Environments of one asset on one engine.

    World("grasp.usda", envs=64) makes 64 of them from one compiled model. `asset` is a file, or a
    stage of tenon_usd.open() with the edits that it has now, saved or not, opened as the stage was;
    `options` are for files alone. `engine` is a name as of tenon_usd.engines(); None: what the
    asset's variant asks for, else MuJoCo. `threads` are as many as the process may use where it is
    0. `time_step` [s] where it is 0 is the asset's, divided until it is at most 4 ms, else 2 ms.
    `outputs` name what can be read beside states: contacts, efforts, reactions, accelerations,
    work, sensors. World.outputs has them. `vary` are texts such as "bodyMass=0.8..1.2",
    "gravity=0.9..1.1" or "colliderFriction@/can=0.5..1.5": what each environment draws of them
    depends on `seed` and its number alone. `deactivate` skips links with all that hangs on them,
    joints, or what is below a prim; `bypass` holds the sides of joints as they start, or skips
    single links; `anchor` fixes links to the world where they start: paths, names or regular
    expressions each, and diagnostics say what was masked. `integrator` is euler, implicitfast,
    implicit or rk4. `options` are those of tenon_usd.open(). Raises errors of tenon_usd.errors.

    Properties are read-only arrays of that moment: what is written into them would be lost, so that
    it raises. Whole properties are set (world.joint_positions = ...); methods give arrays that
    belong to the caller. Ctrl-C ends step() between two steps, all environments at the same one.
    A world is in one process and is not copied or pickled: see save() and restore().
    """

    # A property that is misspelt is no new attribute.
    __slots__ = ("_asset", "_batch", "_first_targets", "_first_velocities", "_lost", "_masked",
                 "_open_options", "_outputs", "_target_velocities", "_targets", "__weakref__")

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
        deactivate: Iterable[str] = (),
        bypass: Iterable[str] = (),
        anchor: Iterable[str] = (),
        **options: Unpack[OpenOptions],
    ) -> None:
        envs = counted("envs", envs)
        self._outputs = texts("outputs", outputs)
        for name in self._outputs:
            if name not in OUTPUTS:
                raise InvalidError(f"outputs: {no_such(name, OUTPUTS)}")
        masks = (texts("deactivate", deactivate), texts("bypass", bypass), texts("anchor", anchor))
        self._masked = any(masks)
        how = _tenon.BatchOptions(
            named("engine", engine), envs, counted("threads", threads), counted("seed", seed),
            seconds("time_step", time_step), self._outputs, texts("vary", vary),
            named("integrator", integrator), _tenon.Masks(*masks)
        )
        self._asset, self._open_options = asset, options
        if isinstance(asset, _tenon.Stage):
            if options:
                raise TypeError(f"{', '.join(options)}: a stage was opened with its own options")
            self._batch = _tenon.make_batch_of(asset, how)
        else:
            self._batch = _tenon.make_batch(path_of(asset), arguments_of(options), how)
        self._lost: list[Diagnostic] = []  # by the models of to_mjcf()
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
    def outputs(self) -> tuple[str, ...]:
        """What can be read beside states, as it was asked for."""
        return tuple(self._outputs)

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
    def joint_paths(self) -> list[str]:
        """Paths of the joints, those without degrees of freedom too, in the order of
        joint_reactions()."""
        return self._batch.joint_paths()

    @property
    def scene(self) -> PhysicsScene:
        """What the engine received [SI, rad], before anything was varied: a copy."""
        return self._batch.scene()

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What opening, reading and building found, and what to_mjcf() and model lost since."""
        return self._batch.diagnostics() + self._lost

    @property
    def not_mapped(self) -> list[dict[str, Any]]:
        """What the engine cannot express: {"prim", "property", "why"}."""
        return self._batch.not_mapped()

    @property
    def drawn(self) -> list[list[list[float]]]:
        """What each environment drew for each text of `vary`: factors, or offsets [rad or m]."""
        return self._batch.drawn()

    @property
    def variations(self) -> list[str]:
        """What `vary` names, without ranges: "bodyMass@/World/can"."""
        return self._batch.variations()

    def set_drawn(self, env: SupportsIndex, numbers: Sequence[Sequence[float]]) -> None:
        """What an environment draws from its next reset() on: numbers for each of `variations`, as
        `drawn` has them, factors or offsets [rad or m]. Fields of the scene ("joints.upper") are
        part of the model and keep theirs; InvalidError for others."""
        self._batch.set_drawn(self._env(env), [list(map(float, row)) for row in numbers])

    # ---- time

    @property
    def time(self) -> Array:
        """Time since the start [s], shape (envs,)."""
        return locked(self._batch.times())

    def step(self, count: int = 1) -> int:
        """Takes so many time steps in every environment; returns how many stand still.

        An environment that becomes unstable stands still from then on (failures() says why), until
        it is reset. With a single environment that raises UnstableError. Other threads of Python
        run meanwhile. Ctrl-C, and what handlers of other signals raise, ends it within about 0.1 s
        and one step: all environments have taken the same number of steps then, and go on as if
        that number had been asked for.
        """
        failed = self._batch.step(counted("count", count))
        if failed and self.envs == 1:
            reason = self.failures()[0]
            raise UnstableError(str(reason), [reason] if reason else [])
        return failed

    def failures(self) -> list[Diagnostic | None]:
        """Why environments stand still; None for those that do not. Length envs."""
        return self._batch.failures()

    def reset(self, envs: SupportsIndex | Sequence[int] | npt.NDArray[Any] | None = None) -> None:
        """Back to the start, with what was drawn: all environments, some by number (-1: the last),
        or a mask of shape (envs,) of bool."""
        which = environments(envs, self.envs)
        self._batch.reset(which)
        self._targets[which] = self._first_targets
        self._target_velocities[which] = self._first_velocities

    # ---- joints

    @property
    def joint_positions(self) -> Array:
        """Positions of the joints [rad or m], shape (envs, joints): read-only."""
        return locked(self._batch.joints()[0])

    @joint_positions.setter
    def joint_positions(self, values: npt.ArrayLike) -> None:
        self.set_joints(positions=self._joint_numbers("joint_positions", values))

    @property
    def joint_velocities(self) -> Array:
        """Velocities of the joints [rad/s or m/s], shape (envs, joints): read-only."""
        return locked(self._batch.joints()[1])

    @joint_velocities.setter
    def joint_velocities(self, values: npt.ArrayLike) -> None:
        self.set_joints(velocities=self._joint_numbers("joint_velocities", values))

    def joints(self) -> tuple[Array, Array]:
        """Positions [rad or m] and velocities [rad/s or m/s], both of shape (envs, joints): arrays
        of the caller's own, which set_joints() takes back."""
        return self._batch.joints()

    def set_joints(
        self, positions: npt.ArrayLike | None = None, velocities: npt.ArrayLike | None = None
    ) -> None:
        """Puts joints elsewhere [rad, m, rad/s, m/s]: (envs, joints), or what broadcasts to it.

        The bodies behind the joints move along. Raises UnsupportedError where the engine cannot.
        """
        now = self._batch.joints()
        self._batch.set_joints(
            now[0] if positions is None else self._joint_numbers("positions", positions),
            now[1] if velocities is None else self._joint_numbers("velocities", velocities),
        )

    def _joint_numbers(self, what: str, values: npt.ArrayLike) -> Array:
        return spread(what, values, (self.envs, len(self.joint_names)))

    # ---- drives

    @property
    def drive_targets(self) -> Array:
        """Position targets of the drives [rad or m], shape (envs, drives): read-only."""
        return locked(self._targets.copy())

    @drive_targets.setter
    def drive_targets(self, values: npt.ArrayLike) -> None:
        self.set_drive_targets(finite("drive_targets", values, self._targets.shape))

    def set_drive_targets(
        self, positions: npt.ArrayLike | None = None, velocities: npt.ArrayLike | None = None
    ) -> None:
        """Targets of the drives: positions [rad or m] and velocities [rad/s or m/s].

        Shape (envs, drives), or what broadcasts to it. They hold until they are set again or reset.
        Drives that exert no force are skipped. InvalidError where a number is not finite: no target
        changes then.
        """
        shape = self._targets.shape
        wanted = [None if values is None else finite(what, values, shape) for what, values in
                  (("positions", positions), ("velocities", velocities))]
        for held, new in zip((self._targets, self._target_velocities), wanted):
            if new is not None:
                held[:] = new
        self._batch.set_targets(self._targets, self._target_velocities)

    def set_efforts(self, efforts: npt.ArrayLike) -> None:
        """Forces and torques along the joints [N m or N], shape (envs, joints), on top of drives.

        They hold until they are set anew or reset.
        """
        self._batch.set_efforts(spread("efforts", efforts, (self.envs, len(self.joint_names))))

    def drive_efforts(self) -> Array:
        """Mean forces of the drives in the last step [N m or N], shape (envs, drives).

        Needs outputs=["efforts"].
        """
        return self._batch.drive_efforts()

    # ---- bodies

    @property
    def body_poses(self) -> Array:
        """Poses of the bodies, shape (envs, bodies, 7): x, y, z [m], then w, x, y, z: read-only."""
        return locked(self._batch.body_poses())

    @property
    def body_velocities(self) -> Array:
        """Velocities of the bodies, shape (envs, bodies, 6): linear, of the centre of mass [m/s],
        then angular [rad/s]: read-only."""
        return locked(self._batch.body_states()[1])

    def set_body(
        self,
        body: str | SupportsIndex,
        poses: npt.ArrayLike,
        velocities: npt.ArrayLike | None = None,
    ) -> None:
        """Puts a body that moves freely elsewhere: poses (envs, 7) [m], velocities (envs, 6)
        [m/s, rad/s], as body_poses and body_velocities have them, or what broadcasts to it.

        `body` is a path, its last element or an index into body_names. Quaternions are made unit
        ones. InvalidError for a quaternion of 0 and for what is not finite.
        """
        self._batch.set_body(
            self._body(body),
            checked_poses(poses, self.envs),
            np.zeros((self.envs, 6)) if velocities is None else
            spread("velocities", velocities, (self.envs, 6)),
        )

    def move_kinematic(self, body: str | SupportsIndex, poses: npt.ArrayLike) -> None:
        """Moves a kinematic body within the next step to poses (envs, 7) [m]; there it stands."""
        self._batch.move_kinematic(self._body(body), checked_poses(poses, self.envs))

    def set_wrench(self, body: str | SupportsIndex, wrenches: npt.ArrayLike) -> None:
        """Forces [N] and torques [N m] at the centre of mass of a body, shape (envs, 6).

        They hold until they are set anew or reset.
        """
        self._batch.set_wrench(self._body(body), spread("wrenches", wrenches, (self.envs, 6)))

    # ---- numbers of each environment

    @property
    def gravity(self) -> Array:
        """Gravity [m/s^2], shape (envs, 3): read-only."""
        return locked(self._batch.gravity())

    @gravity.setter
    def gravity(self, values: npt.ArrayLike) -> None:
        self._batch.set_gravity(spread("gravity", values, (self.envs, 3)))

    def set_parameter(self, name: str, path: str, values: npt.ArrayLike, drive: int = 0) -> None:
        """A number of one object in every environment, shape (envs,) or one for all.

        `name` is "bodyMass" [kg], "colliderFriction", "driveStiffness" [N m/rad or N/m],
        "driveDamping" [N m s/rad or N s/m], "driveMaxForce" [N m or N], "jointDamping",
        "jointFriction" [N m or N] or "jointArmature" [kg m^2 or kg]; `path` the body, collider or
        joint; `drive` the number of the drive at the joint. It holds until it is set anew or reset.
        """
        if named("name", name) not in PARAMETERS:
            raise NotFoundError(f"name: {no_such(name, PARAMETERS)}")
        paths = (
            self.body_names
            if name.startswith("body")
            else self._batch.collider_names()
            if name.startswith("collider")
            else self._batch.joint_paths()
        )
        self._batch.set_parameter(
            name, index("path", paths, path), counted("drive", drive),
            spread("values", values, (self.envs,))
        )

    @property
    def energy(self) -> Array:
        """Kinetic and potential energy [J], shape (envs, 2): read-only."""
        return locked(self._batch.energies())

    # ---- outputs of the last step

    def joint_reactions(self) -> Array:
        """What body 0 exerts on body 1 through each joint of joint_paths, drives, limits and
        friction included, shape (envs, joint paths, 6): force [N], then torque about the origin of
        frame 1 [N m], world axes. Needs outputs=["reactions"]."""
        return self._batch.joint_reactions()

    def body_accelerations(self) -> Array:
        """Change of body_velocities by time, gravity included, shape (envs, bodies, 6): linear
        [m/s^2], then angular [rad/s^2]. Needs outputs=["accelerations"]."""
        return self._batch.body_accelerations()

    def joint_accelerations(self) -> Array:
        """Change of joint_velocities by time [rad/s^2 or m/s^2], shape (envs, joints). Needs
        outputs=["accelerations"]."""
        return self._batch.joint_accelerations()

    def work(self) -> dict[str, Array]:
        """Work since the start [J] by what does it, each of shape (envs,): "drives", "applied"
        (efforts and wrenches that were set), "contacts" (friction included), "constraints",
        "damping", "springs" and "changes" (what was set or animated). The energy at the start and
        their sum is the energy now, less the error of the integrator. Needs outputs=["work"]."""
        parts = self._batch.work()
        return {name: parts[:, i] for i, name in enumerate(WORK)}

    # ---- what happened

    def contacts(self, env: SupportsIndex = 0) -> dict[str, npt.NDArray[Any]]:
        """The points at which colliders touched in the last step: arrays of length count.

        "collider0", "collider1": indices into scene.colliders; "body0", "body1": into body_names,
        -1 for what stands still; "point" (count, 3) [m]; "normal" (count, 3), from collider0 to
        collider1; "depth" [m]; "normal_force" [N]; "force" (count, 3) [N], on collider1, friction
        included; "friction_torque" (count, 3) [N m]. Needs outputs=["contacts"].
        """
        return self._batch.contacts(self._env(env))

    @property
    def contact_counts(self) -> npt.NDArray[np.int64]:
        """How many points touch, shape (envs,): read-only."""
        return locked(self._batch.contact_counts())

    def sensors(self, env: SupportsIndex = 0) -> list[dict[str, Any]]:
        """What the sensors of the asset read last, one row each: "path", "kind", "time" [s].

        Of contacts "in_contact" and "normal_force" [N]; of IMUs "linear_acceleration" [m/s^2],
        "angular_velocity" [rad/s] and "orientation"; of force and torque "force" [N] and "torque"
        [N m]; of joints "position", "velocity", "effort"; of frames "position" [m], "orientation",
        "linear_velocity" [m/s] and "angular_velocity" [rad/s]; of rays "distances" [m], -1 where
        there is nothing. Needs outputs=["sensors"].
        """
        return self._batch.sensors(self._env(env))

    def events(self, env: SupportsIndex = 0) -> list[dict[str, Any]]:
        """Joints that broke and bodies that passed through others: {"time" [s], "prim", "what"}."""
        return self._batch.events(self._env(env))

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
        if isinstance(states, (str, bytearray)) or not all(
                isinstance(state, bytes) for state in states):
            raise TypeError("states are bytes of save(), or a list of them, one for each "
                            "environment")
        if len(states) != self.envs:
            raise ValueError(f"{len(states)} states for {self.envs} environments")
        for i, state in enumerate(states):
            self._batch.restore_state(i, state)

    # ---- models of MuJoCo

    def to_mjcf(self, path: PathLike | None = None, env: SupportsIndex = 0) -> str:
        """The model as MJCF text, for MuJoCo, MJX and mujoco_warp; written to `path` as well.

        Textures are written beside it. What this world has and the model has not, such as limits of
        velocity, is an ExportWarning, and each finding is in `diagnostics`.
        """
        name = "" if path is None else os.path.splitext(os.path.basename(os.fspath(path)))[0]
        text, images = self._export(self._env(env), name + "_files" if name else "")
        if path is not None:
            _tenon.write_files(os.fspath(path), text.encode(), images)
        return text

    @property
    def model(self) -> Any:
        """A mujoco.MjModel of the user's own mujoco, made from to_mjcf(): a new one at each call.

        Raises MissingError where mujoco is not installed."""
        try:
            import mujoco  # type: ignore[import-not-found, import-untyped, unused-ignore]
        except ImportError as reason:
            from .errors import MissingError

            raise MissingError(f"mujoco cannot be imported: {reason}; pip install mujoco") from None
        text, images = self._export(0, "")
        return mujoco.MjModel.from_xml_string(text, images)

    def _export(self, env: int, folder: str) -> tuple[str, dict[str, bytes]]:
        """The model of an environment, and what it loses said once."""
        text, images, found = self._batch.to_mjcf(env, folder)
        known = {(one.rule, one.prim, one.message) for one in self.diagnostics}
        lost = [one for one in found if (one.rule, one.prim, one.message) not in known]
        self._lost += lost
        told = [one for one in lost if one.severity in ("warning", "error")]
        if told:
            more = f" (and {len(told) - 1} more in World.diagnostics)" if len(told) > 1 else ""
            warnings.warn(f"{told[0]}{more}", ExportWarning, stacklevel=3)
        return text, images

    # ---- into other packages

    def to_warp(self, envs: int | None = None) -> WarpBatch:
        """A batch of MuJoCo Warp that begins where this world is, on the GPU where there is one;
        `envs` environments, else as many as here. See tenon_usd.gpu.
        What it loses is an ExportWarning and in its `lost`. Raises MissingError without
        mujoco_warp, UnsupportedError for models that it does not take.
        """
        from .gpu import WarpBatch

        return WarpBatch(self, envs)

    def to_mjx(self, envs: int | None = None) -> MjxBatch:
        """The same of MJX: mujoco.mjx and JAX."""
        from .gpu import MjxBatch

        return MjxBatch(self, envs)

    def to_newton(self, envs: int | None = None) -> NewtonBatch:
        """The same of Newton, by tenon_usd.newton.add_usd, which reads the asset as it is at this
        moment, with its SolverMuJoCo; UnsupportedError for a world that leaves links out or holds
        them (`deactivate`, `bypass`, `anchor`)."""
        from .gpu import NewtonBatch

        return NewtonBatch(self, envs)

    def render(self, camera: str | None = None, size: tuple[int, int] = (640, 480),
               env: SupportsIndex = 0, **options: Any) -> Picture:
        """An environment now: shape (height, width, 3), `size` is (width, height). `options` are
        those of tenon_usd.rendering.Renderer, which has depth and bodies too."""
        from .rendering import still

        return still(self, env, camera=camera, size=size, **options)

    def render_video(self, duration: float, env: SupportsIndex = 0, **options: Any) -> Picture:
        """Steps for `duration` [s] and draws, as tenon_usd.rendering.video."""
        from .rendering import video

        return video(self, duration, env, **options)

    def _source(self) -> Stage:
        """The stage that the world was made of."""
        return self._asset if isinstance(self._asset, _tenon.Stage) else _tenon.open_stage(
            path_of(self._asset), arguments_of(self._open_options))

    def __repr__(self) -> str:
        return (
            f"<World of {self.envs} environments on {self.engine}: {len(self.body_names)} bodies, "
            f"{len(self.joint_names)} joints, {len(self.drive_names)} drives, "
            f"step {self.time_step:g} s>"
        )

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        return html_of_world(self)

    def __copy__(self) -> NoReturn:
        raise TypeError(_NO_COPY)

    def __deepcopy__(self, memo: dict[int, Any]) -> NoReturn:
        raise TypeError(_NO_COPY)

    def __reduce__(self) -> NoReturn:
        raise TypeError(_NO_COPY)

    def _env(self, env: SupportsIndex) -> int:
        return place("environment", env, self.envs)

    def _body(self, body: str | SupportsIndex) -> int:
        names = self.body_names
        return index("body", names, body) if isinstance(body, str) else place(
            "body", body, len(names))


_NO_COPY = (
    "a World cannot be copied or pickled: its engine is in this process alone; make another World "
    "of the asset and restore(save()) the state, in another process from the bytes of save()"
)


__all__ = ["OUTPUTS", "PARAMETERS", "WORK", "Error", "World"]
