# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds as batches of others, on a GPU where there is one: MuJoCo Warp, MJX and Newton.

    batch = world.to_warp(4096)                    # or to_mjx(), to_newton()
    batch.set_targets(targets)                     # (envs, drives), along world.drive_names
    batch.step(100)
    positions, velocities = batch.joints()         # (envs, joints), along world.joint_names

A batch begins where the world is: environment i of it has the state of environment i of the world,
or of i modulo their number where it has more. Arrays are along the names of the world, in SI and
radians, on the host; what runs on the GPU is in `model` and `data`, of the package's own types, and
`joint_index`, `velocity_index`, `body_index` and `control_index` say where its arrays have what.
What the world has and the package has not is an ExportWarning, and in `lost`.
"""

from __future__ import annotations

import importlib
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .errors import ExportWarning, MissingError, UnsupportedError

if TYPE_CHECKING:
    from .world import World

Array = npt.NDArray[np.float64]
Index = npt.NDArray[np.int64]
NONE = -1
"""In an index: the package has no such thing."""


def _imported(module: str, install: str) -> Any:
    try:
        return importlib.import_module(module)
    except ImportError as reason:
        raise MissingError(
            f"{module} cannot be imported: {reason}; pip install {install}") from None


def _last(path: str) -> str:
    return path.rpartition("/")[2]


class _Names:
    """Where a model of MuJoCo has what a world has: by names, and where several have one name by
    the body that it is on, or by the place of the body at the start."""

    def __init__(self, world: World, model: Any, data: Any) -> None:
        self.model, self.world = model, world
        self.bodies = self._bodies(data)
        self.joints = self._joints()
        self.qpos, self.qvel = (
            np.array([NONE if j == NONE else starts[j] for j in self.joints], int)
            for starts in (model.jnt_qposadr, model.jnt_dofadr)
        )
        self.controls = self._controls()

    def _bodies(self, data: Any) -> Index:
        world, model = self.world, self.model
        names = [model.body(at).name for at in range(model.nbody)]
        bodies = world.scene.bodies
        poses = bodies.column("position") if len(bodies) else np.zeros((0, 3))
        found = np.full(len(world.body_names), NONE)
        left = set(range(1, model.nbody))
        for exact in (True, False):
            for i, path in enumerate(world.body_names):
                stem = _last(path)
                fits = [at for at in left if names[at] == stem or not exact and
                        (names[at].startswith(stem + "_") or
                         np.allclose(data.xpos[at], poses[i], atol=1e-6))]
                if found[i] == NONE and fits:
                    fits.sort(key=lambda at: float(np.linalg.norm(data.xpos[at] - poses[i])))
                    found[i] = fits[0]
                    left.discard(fits[0])
        return found

    def _joints(self) -> list[int]:
        """The joint of the model for each coordinate of the world."""
        model, scene = self.model, self.world.scene
        sides = {joint.path: {NONE if side is None else int(self.bodies[side])
                              for side in (joint.body0, joint.body1)} - {NONE}
                 for joint in scene.joints}
        found, taken = [], set()
        for name in self.world.joint_names:
            path, _, dof = name.partition(":")
            stem = _last(path)
            wanted = f"{stem}_{dof}" if dof else stem
            fits = [j for j in range(model.njnt)
                    if j not in taken and model.jnt_type[j] in (2, 3)  # slides and hinges
                    and int(model.jnt_bodyid[j]) in sides.get(path, set())]
            named = [j for j in fits if model.joint(j).name == wanted] or \
                [j for j in fits if model.joint(j).name.startswith(wanted + "_")] or \
                (fits if len(fits) == 1 else [])
            found.append(named[0] if named else NONE)
            taken.update(named[:1])
        return found

    def _controls(self) -> Index:
        """Of each drive: the controls that take its target position and velocity."""
        model = self.model
        of_joint = {name: j for name, j in zip(self.world.joint_names, self.joints) if j != NONE}
        found = np.full((len(self.world.drive_names), 2), NONE)
        drives = [(joint.path, drive.dof) for joint in self.world.scene.joints
                  for drive in joint.drives]
        joints = [of_joint.get(path, of_joint.get(f"{path}:{dof}", NONE)) for path, dof in drives]
        for a in range(model.nu):
            j = self._driven(a)
            for i, joint in enumerate(joints):
                if j == joint != NONE and model.actuator_gaintype[a] == 0:
                    found[i, int(model.actuator_biasprm[a, 1] == 0)] = a
        return found

    def _driven(self, actuator: int) -> int:
        """The one joint that an actuator moves."""
        model, kind = self.model, int(self.model.actuator_trntype[actuator])
        target = int(model.actuator_trnid[actuator, 0])
        if kind == 0:  # a joint
            return target
        wraps = model.tendon_num[target] == 1 if kind == 3 else False
        return int(model.wrap_objid[model.tendon_adr[target]]) if wraps else NONE

    def lacks(self) -> list[str]:
        """What is not in the model, for people."""
        said = []
        for what, names, index in (
            ("body", self.world.body_names, self.bodies),
            ("joint", self.world.joint_names, self.qpos),
            ("drive", self.world.drive_names, self.controls.max(axis=1, initial=NONE)),
        ):
            missing = [name for name, at in zip(names, index) if at == NONE]
            if missing:
                more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
                said.append(f"the model has no {what} {missing[0]}{more}: states and targets of it "
                            "are not set")
        return said

    def start(self, envs: int) -> tuple[Array, Array, Array]:
        """Positions (envs, nq), velocities (envs, nv) and controls (envs, nu) of the model where
        the world is now."""
        model, world = self.model, self.world
        which = np.arange(envs) % world.envs
        qpos, qvel = np.tile(model.qpos0, (envs, 1)), np.zeros((envs, model.nv))
        positions, velocities = world.joints()
        has = self.qpos != NONE
        qpos[:, self.qpos[has]] = positions[which][:, has]
        qvel[:, self.qvel[has]] = velocities[which][:, has]
        self._free(qpos, qvel, which)
        return qpos, qvel, self.control(world.drive_targets[which],
                                        world._target_velocities[which])

    def _free(self, qpos: Array, qvel: Array, which: Index) -> None:
        """Bodies that nothing holds: MuJoCo turns them in their own frame."""
        poses, velocities = self.world.body_poses, self.world.body_velocities
        centers = self.world.scene.bodies.column("center_of_mass") if len(self.bodies) else []
        for i, at in enumerate(self.bodies):
            j = int(self.model.body_jntadr[at]) if at != NONE else NONE
            if j == NONE or self.model.jnt_type[j] != 0:
                continue
            q, v = int(self.model.jnt_qposadr[j]), int(self.model.jnt_dofadr[j])
            pose, velocity = poses[which, i], velocities[which, i]
            arm = _turned(pose[:, 3:], np.broadcast_to(centers[i], (len(which), 3)))
            qpos[:, q:q + 7] = pose
            qvel[:, v:v + 3] = velocity[:, :3] - np.cross(velocity[:, 3:], arm)
            qvel[:, v + 3:v + 6] = _turned(pose[:, 3:] * [1, -1, -1, -1], velocity[:, 3:])

    def control(self, positions: Array, velocities: Array) -> Array:
        """Targets of drives as controls, (envs, nu)."""
        ctrl = np.zeros((len(positions), self.model.nu))
        for targets, index in ((positions, self.controls[:, 0]), (velocities, self.controls[:, 1])):
            has = index != NONE
            ctrl[:, index[has]] = targets[:, has]
        return ctrl


def _turned(quaternions: Array, vectors: Array) -> Array:
    """Vectors (n, 3) turned by quaternions (n, 4), w first."""
    w, axis = quaternions[:, :1], quaternions[:, 1:]
    twice = 2 * np.cross(axis, vectors)
    turned: Array = vectors + w * twice + np.cross(axis, twice)
    return turned


class Batch:
    """Environments of another package, made of a world. `package` is its name, `model` and `data`
    are its own; `host` is the mujoco.MjModel that they are made of (None for Newton)."""

    package = ""

    def __init__(self, world: World, envs: int | None) -> None:
        self.envs = world.envs if envs is None else int(envs)
        if self.envs < 1:
            raise ValueError("envs must be positive")
        self.time_step = world.time_step
        self.joint_names, self.body_names = world.joint_names, world.body_names
        self.drive_names = world.drive_names
        self.steps = 0
        self.model: Any = None
        self.data: Any = None
        self.host: Any = None
        self.lost: list[str] = []
        self._make(world)
        told = self._lacks()
        if world.variations:
            told.append("all environments have the model of the first one: what others drew of "
                        f"{', '.join(world.variations)} is not in it")
        for message in told:
            warnings.warn(message, ExportWarning, stacklevel=4)
        self.lost += told

    def _make(self, world: World) -> None:
        raise NotImplementedError

    def _lacks(self) -> list[str]:
        return []

    @property
    def time(self) -> float:
        """Since the batch was made [s]."""
        return self.steps * self.time_step

    def __repr__(self) -> str:
        return (f"<{self.envs} environments of {self.package}: {len(self.body_names)} bodies, "
                f"{len(self.joint_names)} joints, {len(self.drive_names)} drives>")


class _MujocoBatch(Batch):
    """What MuJoCo Warp and MJX share: the model of MuJoCo that both are made of."""

    def _make(self, world: World) -> None:
        mujoco: Any = _imported("mujoco", "mujoco")
        self.host = world.model
        self.lost += [str(one) for one in world._lost]
        start = mujoco.MjData(self.host)
        mujoco.mj_forward(self.host, start)
        self._names = _Names(world, self.host, start)
        self.joint_index, self.velocity_index = self._names.qpos, self._names.qvel
        self.body_index, self.control_index = self._names.bodies, self._names.controls
        self._targets = [np.tile(part, (1, 1)) for part in self._first_targets(world)]
        self._put(start, *self._names.start(self.envs))

    def _first_targets(self, world: World) -> tuple[Array, Array]:
        which = np.arange(self.envs) % world.envs
        return world.drive_targets[which], world._target_velocities[which]

    def _put(self, start: Any, qpos: Array, qvel: Array, ctrl: Array) -> None:
        raise NotImplementedError

    def _lacks(self) -> list[str]:
        return self._names.lacks()

    def _arrays(self) -> tuple[Array, Array]:
        """(envs, nq) and (envs, nv)."""
        raise NotImplementedError

    def _set_control(self, ctrl: Array) -> None:
        raise NotImplementedError

    def joints(self) -> tuple[Array, Array]:
        """Positions [rad or m] and velocities [rad/s or m/s], both (envs, joints); NaN where the
        model has no such joint."""
        return tuple(  # type: ignore[return-value]
            np.where(index == NONE, np.nan, np.asarray(values, float)[:, index])
            for values, index in zip(self._arrays(), (self.joint_index, self.velocity_index))
        )

    def set_targets(self, positions: npt.ArrayLike | None = None,
                    velocities: npt.ArrayLike | None = None) -> None:
        """Targets of the drives [rad or m, rad/s or m/s]: (envs, drives), or what broadcasts. A
        drive that begins without a velocity target has no control for one: an ExportWarning."""
        for held, new in zip(self._targets, (positions, velocities)):
            if new is not None:
                held[...] = np.asarray(new, float)
        lost = np.any(self._targets[1] != 0, axis=0) & (self.control_index[:, 1] == NONE)
        if velocities is not None and lost.any():
            warnings.warn("no control takes the velocity target of "
                          f"{self.drive_names[int(np.argmax(lost))]}", ExportWarning, stacklevel=2)
        self._set_control(self._names.control(*self._targets))


class WarpBatch(_MujocoBatch):
    """Of mujoco_warp: `model` and `data` are mujoco_warp.Model and Data."""

    package = "mujoco_warp"

    def _put(self, start: Any, qpos: Array, qvel: Array, ctrl: Array) -> None:
        mjw, self._warp = _imported("mujoco_warp", "mujoco-warp"), _imported("warp", "warp-lang")
        self._mjw: Any = mjw
        try:
            self.model = mjw.put_model(self.host)
            self.data = mjw.put_data(self.host, start, nworld=self.envs)
        except NotImplementedError as reason:
            raise UnsupportedError(f"mujoco_warp does not take the model: {reason}") from None
        self.data.qpos.assign(qpos.astype(np.float32))
        self.data.qvel.assign(qvel.astype(np.float32))
        self._set_control(ctrl)
        self._graph: Any = None

    def _set_control(self, ctrl: Array) -> None:
        if ctrl.size:
            self.data.ctrl.assign(ctrl.astype(np.float32))

    def step(self, count: int = 1) -> None:
        """Steps all environments; on a GPU by a graph that the first call records."""
        left = int(count)
        if self._graph is None and left and self._warp.get_device().is_cuda:
            self._mjw.step(self.model, self.data)  # makes what the graph needs
            left -= 1
            with self._warp.ScopedCapture() as capture:
                self._mjw.step(self.model, self.data)
            self._graph = capture.graph
        for _ in range(left):
            if self._graph is None:
                self._mjw.step(self.model, self.data)
            else:
                self._warp.capture_launch(self._graph)
        self.steps += int(count)

    def _arrays(self) -> tuple[Array, Array]:
        return self.data.qpos.numpy(), self.data.qvel.numpy()

    def body_poses(self) -> Array:
        """Positions [m] and quaternions, w first: (envs, bodies, 7)."""
        self._mjw.kinematics(self.model, self.data)
        return _poses(self.data.xpos.numpy(), self.data.xquat.numpy(), self.body_index)


class MjxBatch(_MujocoBatch):
    """Of mujoco.mjx: `model` is an mjx.Model, `data` an mjx.Data whose arrays have the environments
    in front. The first step compiles, which takes minutes for models with many contacts."""

    package = "mujoco.mjx"

    def _put(self, start: Any, qpos: Array, qvel: Array, ctrl: Array) -> None:
        jax = self._jax = _imported("jax", "jax")
        self._mjx: Any = _imported("mujoco.mjx", "mujoco-mjx")
        mjx = self._mjx
        if not np.any(self.host.geom_contype) and not np.any(self.host.geom_conaffinity):
            # MJX 3.17 cannot index an empty list of elliptic contacts; without any, the cone is all
            # the same.
            self.host.opt.cone = 0
        try:
            self.model = mjx.put_model(self.host)
            one = mjx.put_data(self.host, start)
        except NotImplementedError as reason:
            raise UnsupportedError(f"mujoco.mjx does not take the model: {reason}") from None
        self.data = jax.vmap(lambda q, v, c: one.replace(qpos=q, qvel=v, ctrl=c))(
            *(jax.numpy.asarray(part, one.qpos.dtype) for part in (qpos, qvel, ctrl)))

        def steps(model: Any, data: Any, count: Any) -> Any:
            return jax.lax.fori_loop(
                0, count, lambda _, now: jax.vmap(mjx.step, in_axes=(None, 0))(model, now), data)

        self._steps = jax.jit(steps)
        self._placed = jax.jit(jax.vmap(mjx.kinematics, in_axes=(None, 0)))

    def _set_control(self, ctrl: Array) -> None:
        self.data = self.data.replace(ctrl=self._jax.numpy.asarray(ctrl, self.data.ctrl.dtype))

    def step(self, count: int = 1) -> None:
        """Steps all environments."""
        self.data = self._steps(self.model, self.data, int(count))
        self.steps += int(count)

    def _arrays(self) -> tuple[Array, Array]:
        return np.asarray(self.data.qpos), np.asarray(self.data.qvel)

    def body_poses(self) -> Array:
        """Positions [m] and quaternions, w first: (envs, bodies, 7)."""
        now = self._placed(self.model, self.data)
        return _poses(np.asarray(now.xpos), np.asarray(now.xquat), self.body_index)


def _poses(places: Any, turns: Any, index: Index) -> Array:
    poses = np.concatenate([places[:, index], turns[:, index]], axis=2, dtype=float)
    poses[:, index == NONE] = np.nan
    return poses


class NewtonBatch(Batch):
    """Of newton: `model` is a newton.Model with a world for each environment, `data` its State,
    `control` its Control, `solver` a SolverMuJoCo on MuJoCo Warp, which `step()` calls; any other
    solver of Newton takes the model as well. Made by tenon_usd.newton.add_usd."""

    package = "newton"

    def _make(self, world: World) -> None:
        newton = self._newton = _imported("newton", "newton")
        if world._masked:
            raise UnsupportedError("Newton reads the asset, which has what the world leaves out or "
                                   "holds: use to_warp(), or change the asset")
        from .newton import add_usd

        single = newton.ModelBuilder()
        result = add_usd(single, world._source())
        scene = newton.ModelBuilder()
        scene.replicate(single, self.envs)
        self.builder, self.model = single, scene.finalize()
        self.data, self._next = self.model.state(), self.model.state()
        self.control = self.model.control()
        self.solver: Any = newton.solvers.SolverMuJoCo(self.model)
        bodies, joints = result["path_body_map"], result["path_joint_map"]
        self.body_index = np.array([bodies.get(path, NONE) for path in self.body_names], int)
        self.joint_index, self.velocity_index = self._coordinates(world, joints)
        self.control_index = self._driven(world, joints)
        self._put(world)

    def _coordinates(self, world: World, joints: dict[str, int]) -> tuple[Index, Index]:
        """Where joint_q and joint_qd of one world have each coordinate: of joints with one."""
        count = len(world.joint_names)
        q, qd = np.full(count, NONE), np.full(count, NONE)
        starts, dofs = self.builder.joint_q_start, self.builder.joint_qd_start
        for i, name in enumerate(world.joint_names):
            at = joints.get(name, NONE)
            if at != NONE:
                q[i], qd[i] = starts[at], dofs[at]
        return q, qd

    def _driven(self, world: World, joints: dict[str, int]) -> Index:
        """Of each drive, where the targets of one world have it."""
        places = dict(zip(world.joint_names, self.velocity_index))
        return np.array([places.get(name, NONE) for name in world.drive_names], int)

    def _put(self, world: World) -> None:
        which = np.arange(self.envs) % world.envs
        positions, velocities = world.joints()
        q = self.data.joint_q.numpy().reshape(self.envs, -1)
        qd = self.data.joint_qd.numpy().reshape(self.envs, -1)
        has = self.joint_index != NONE
        q[:, self.joint_index[has]] = positions[which][:, has]
        qd[:, self.velocity_index[has]] = velocities[which][:, has]
        self._put_free(world, q, which)
        self.data.joint_q.assign(q.reshape(-1))
        self.data.joint_qd.assign(qd.reshape(-1))
        self._place()
        self.set_targets(world.drive_targets[which], world._target_velocities[which])

    def _put_free(self, world: World, q: Array, which: Index) -> None:
        """Bodies that nothing holds: their poses."""
        free = int(self._newton.JointType.FREE)
        joints = {int(child): at for at, child in enumerate(self.builder.joint_child)
                  if int(self.builder.joint_type[at]) == free}
        moving = False
        for i, body in enumerate(self.body_index):
            if int(body) in joints:
                start = self.builder.joint_q_start[joints[int(body)]]
                q[:, start:start + 7] = world.body_poses[which, i][:, [0, 1, 2, 4, 5, 6, 3]]
                moving = moving or bool(np.any(world.body_velocities[which, i]))
        if moving:
            self.lost.append("bodies that nothing holds begin without velocity")
            warnings.warn(self.lost[-1], ExportWarning, stacklevel=5)

    def _place(self) -> None:
        """Bodies where the joints are."""
        self._newton.eval_fk(self.model, self.data.joint_q, self.data.joint_qd, self.data)

    def _lacks(self) -> list[str]:
        said = []
        for what, names, index in (("body", self.body_names, self.body_index),
                                   ("joint", self.joint_names, self.joint_index),
                                   ("drive", self.drive_names, self.control_index)):
            missing = [name for name, at in zip(names, index) if at == NONE]
            if missing:
                more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
                said.append(f"the model has no {what} {missing[0]}{more} of one coordinate: states "
                            "and targets of it are not set")
        return said

    def set_targets(self, positions: npt.ArrayLike | None = None,
                    velocities: npt.ArrayLike | None = None) -> None:
        """Targets of the drives [rad or m, rad/s or m/s]: (envs, drives), or what broadcasts."""
        has = self.control_index != NONE
        for array, index, values in (
            (self.control.joint_target_q, self._target_index(), positions),
            (self.control.joint_target_qd, self.control_index, velocities),
        ):
            if values is not None and array is not None:
                rows = array.numpy().reshape(self.envs, -1)
                wanted = np.broadcast_to(np.asarray(values, float), (self.envs, len(has)))
                rows[:, index[has]] = wanted[:, has]
                array.assign(rows.reshape(-1))

    def _target_index(self) -> Index:
        """Of drives in joint_target_q, which is along coordinates."""
        places = dict(zip(self.joint_names, self.joint_index))
        return np.array([places.get(name, NONE) for name in self.drive_names], int)

    def step(self, count: int = 1) -> None:
        """Steps all environments with `solver`."""
        for _ in range(int(count)):
            self.data.clear_forces()
            self.solver.step(self.data, self._next, self.control, None, self.time_step)
            self.data, self._next = self._next, self.data
        self.steps += int(count)

    def joints(self) -> tuple[Array, Array]:
        """Positions [rad or m] and velocities [rad/s or m/s], both (envs, joints); NaN where the
        model has no such joint."""
        return tuple(  # type: ignore[return-value]
            np.where(index == NONE, np.nan, values.numpy().reshape(self.envs, -1)[:, index])
            for values, index in ((self.data.joint_q, self.joint_index),
                                  (self.data.joint_qd, self.velocity_index))
        )

    def body_poses(self) -> Array:
        """Positions [m] and quaternions, w first: (envs, bodies, 7)."""
        self._place()
        rows = self.data.body_q.numpy().reshape(self.envs, -1, 7)[:, self.body_index]
        poses = np.asarray(rows[:, :, [0, 1, 2, 6, 3, 4, 5]], float)
        poses[:, self.body_index == NONE] = np.nan
        return poses


__all__ = ["NONE", "Batch", "MjxBatch", "NewtonBatch", "WarpBatch"]
