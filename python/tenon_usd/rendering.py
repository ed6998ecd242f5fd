# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of worlds, drawn by MuJoCo's own package: pip install tenon-usd[render].

    from tenon_usd.rendering import Renderer

    picture = Renderer(world).draw(0)           # (480, 640, 3), uint8
    film = world.render_video(2.0)              # (frames, 480, 640, 3), by the world itself

Bodies are drawn where the world has them, whichever engine moves them; what they look like is what
World.to_mjcf() says. Without a display set MUJOCO_GL=egl or MUJOCO_GL=osmesa first, as MuJoCo asks.
"""

from __future__ import annotations

import importlib
import warnings
from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from ._arrays import seconds
from .errors import ExportWarning, MissingError
from .world import World

Picture = npt.NDArray[np.uint8]
Depth = npt.NDArray[np.float32]
Bodies = npt.NDArray[np.int32]
MAX_FRAMES = 10_000
INSTALL = "pip install 'tenon-usd[render]'"


def _imported(module: str, extra: str) -> Any:
    try:
        return importlib.import_module(module)
    except Exception as reason:  # PyOpenGL raises others where there is no display
        raise MissingError(f"{module} cannot be imported: {reason}; pip install "
                           f"'tenon-usd[{extra}]'") from None


class Renderer:
    """Draws environments of a world as they are.

    `width` and `height` are those of the picture [pixels]. The camera is the first of the asset,
    or one of its names; where it has none, one that sees what moves, from `azimuth` and `elevation`
    [degrees]. Raises MissingError where MuJoCo or OpenGL is not there, with what to install.
    """

    def __init__(self, world: World, *, width: int = 640, height: int = 480,
                 camera: str | None = None, azimuth: float = 135.0,
                 elevation: float = -20.0) -> None:
        mujoco: Any = _imported("mujoco", "render")
        self._mujoco, self.world = mujoco, world
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ExportWarning)
            self._model: Any = world.model
        size = self._model.vis.global_
        size.offwidth, size.offheight = max(size.offwidth, width), max(size.offheight, height)
        light = self._model.vis.headlight
        light.ambient[:], light.diffuse[:] = 0.35, 0.6
        self._data: Any = mujoco.MjData(self._model)
        mujoco.mj_forward(self._model, self._data)
        self._bodies = self._matched()
        self._camera = self._chosen(camera, azimuth, elevation)
        try:
            self._renderer: Any = mujoco.Renderer(self._model, height, width)
        except Exception as reason:
            raise MissingError(f"MuJoCo cannot draw here: {reason}; {INSTALL}, and without a "
                               "display set MUJOCO_GL=egl (libegl1) or MUJOCO_GL=osmesa "
                               "(libosmesa6)") from None

    def draw(self, env: SupportsIndex = 0) -> Picture:
        """Environment `env` now, shape (height, width, 3)."""
        picture: Picture = self._drawn(env)
        return picture

    def depth(self, env: SupportsIndex = 0) -> Depth:
        """Distance of each pixel's surface from the camera's plane [m], float32 (height, width)."""
        self._renderer.enable_depth_rendering()
        try:
            depth: Depth = self._drawn(env)
        finally:
            self._renderer.disable_depth_rendering()
        return depth

    def segmentation(self, env: SupportsIndex = 0) -> Bodies:
        """The bodies that are seen, as indices of World.body_names, shape (height, width); -1 for
        what is no body: the ground, the air."""
        self._renderer.enable_segmentation_rendering()
        try:
            seen = self._drawn(env)
        finally:
            self._renderer.disable_segmentation_rendering()
        body_of = np.full(self._model.nbody, -1, dtype=np.int32)
        for at, body in self._bodies:
            body_of[at] = body
        geoms = np.where(seen[..., 1] == int(self._mujoco.mjtObj.mjOBJ_GEOM), seen[..., 0], -1)
        bodies: Bodies = np.where(geoms >= 0, body_of[self._model.geom_bodyid[geoms]], -1)
        return bodies.astype(np.int32)

    def _drawn(self, env: SupportsIndex) -> Any:
        poses = self.world.body_poses[self.world._env(env)]
        data, mujoco = self._data, self._mujoco
        for at, body in self._bodies:
            data.xpos[at] = poses[body, :3]
            data.xquat[at] = poses[body, 3:]
            mujoco.mju_quat2Mat(data.xmat[at], data.xquat[at])
        for kind in ("geom", "site", "cam"):
            self._carry(kind)
        self._renderer.update_scene(self._data, camera=self._camera)
        return self._renderer.render()

    def close(self) -> None:
        """Gives the drawing context back."""
        self._renderer.close()

    def _carry(self, kind: str) -> None:
        """Shapes, sites and cameras go with their bodies."""
        model, data, mujoco = self._model, self._data, self._mujoco
        owner = getattr(model, f"{kind}_bodyid")
        places, turns = getattr(model, f"{kind}_pos"), getattr(model, f"{kind}_quat")
        to, to_matrix = getattr(data, f"{kind}_xpos"), getattr(data, f"{kind}_xmat")
        turned = np.zeros(4)
        for i, body in enumerate(owner):
            to[i] = data.xpos[body] + data.xmat[body].reshape(3, 3) @ places[i]
            mujoco.mju_mulQuat(turned, data.xquat[body], turns[i])
            mujoco.mju_quat2Mat(to_matrix[i], turned)

    def _matched(self) -> list[tuple[int, int]]:
        """Bodies of the model with those of the world: of one name, and nearest at the start."""
        found = []
        scene = self.world.scene
        starts = scene.bodies.column("position") if hasattr(scene.bodies[0], "position") else None
        names = [path.rpartition("/")[2] for path in self.world.body_names]
        taken: set[int] = set()
        for at in range(1, self._model.nbody):
            name = self._model.body(at).name
            fits = [i for i, each in enumerate(names)
                    if i not in taken and (name == each or name.startswith(each + "_"))]
            exact = [i for i in fits if name == names[i]]
            fits = exact or fits
            if not fits:
                continue
            if starts is not None and len(fits) > 1:
                here = self._data.xpos[at]
                fits.sort(key=lambda i: float(np.linalg.norm(starts[i] - here)))
            taken.add(fits[0])
            found.append((at, fits[0]))
        return found

    def _chosen(self, camera: str | None, azimuth: float, elevation: float) -> Any:
        model, mujoco = self._model, self._mujoco
        names = [model.camera(i).name for i in range(model.ncam)]
        if camera is not None:
            from .actuators import fitting

            return fitting(camera, names)[0]
        if names:
            return 0
        free = mujoco.MjvCamera()
        mujoco.mjv_defaultFreeCamera(model, free)
        free.azimuth, free.elevation = azimuth, elevation
        moving = [i for i in range(model.ngeom) if model.geom_bodyid[i]]
        if moving:
            places, sizes = self._data.geom_xpos[moving], model.geom_rbound[moving]
            free.lookat[:] = (places.min(axis=0) + places.max(axis=0)) / 2
            reach = np.linalg.norm(places - free.lookat, axis=1) + sizes
            free.distance = max(2.5 * float(reach.max()), 1e-3)
        return free


def still(world: World, env: SupportsIndex = 0, *, camera: str | None = None,
          size: tuple[int, int] = (640, 480), **options: Any) -> Picture:
    """One picture of an environment now, of `size` (width, height) [pixels]; `camera` and `options`
    are those of Renderer."""
    renderer = Renderer(world, camera=camera, width=size[0], height=size[1], **options)
    try:
        return renderer.draw(env)
    finally:
        renderer.close()


def video(world: World, duration: float, env: SupportsIndex = 0, *, fps: float = 30.0,
          camera: str | None = None, size: tuple[int, int] = (640, 480), **options: Any) -> Picture:
    """Steps a world for `duration` [s] from the state that it is in, and draws environment `env`
    `fps` times a second: shape (frames, height, width, 3). The rest as still()."""
    count = int(seconds("duration", duration) * fps + 1e-9) + 1
    if not (fps > 0 and count <= MAX_FRAMES):
        raise ValueError(f"duration {duration!r} with fps {fps!r}; expected fps above 0 and at "
                         f"most {MAX_FRAMES} frames")
    renderer = Renderer(world, camera=camera, width=size[0], height=size[1], **options)
    try:
        frames, done = [renderer.draw(env)], 0
        for frame in range(1, count):
            steps = round(frame / fps / world.time_step) - done
            if steps:
                world.step(steps)
            done += steps
            frames.append(renderer.draw(env))
        return np.stack(frames)
    finally:
        renderer.close()


class Window:
    """Shows pictures in a window of pygame. Raises MissingError without it."""

    def __init__(self, title: str) -> None:
        self._pygame: Any = _imported("pygame", "render")
        self._title = title
        self._screen: Any = None

    def show(self, picture: Picture) -> None:
        """A picture of shape (height, width, 3) in place of the one before."""
        game = self._pygame
        if self._screen is None:
            game.display.init()
            self._screen = game.display.set_mode((picture.shape[1], picture.shape[0]))
            game.display.set_caption(self._title)
        surface = game.surfarray.make_surface(np.swapaxes(picture, 0, 1))
        self._screen.blit(surface, (0, 0))
        game.event.pump()
        game.display.flip()

    def close(self) -> None:
        """Closes the window."""
        if self._screen is not None:
            self._pygame.display.quit()
            self._screen = None


__all__ = ["Renderer", "Window", "still", "video"]
