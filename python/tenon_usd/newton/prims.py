# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Composed prims as Newton's schema resolvers and custom attributes read them.

Newton hands prims to functions of solvers and of users: resolvers, transformers of custom
attributes, filters of custom frequencies. PrimView has the methods of pxr.Usd.Prim that those call,
so that they run without pxr; another method raises AttributeError, which names it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from .. import _tenon
from ..errors import NotFoundError
from .poses import Matrix, step_matrix

#: What a rigid body's subtree is told by.
RIGID_BODY = "PhysicsRigidBodyAPI"


class PathView(str):
    """A path with the methods of pxr.Sdf.Path that readers of prims call."""

    __slots__ = ()

    @property
    def pathString(self) -> str:  # noqa: N802: the name of pxr
        return str(self)

    @property
    def name(self) -> str:
        return self.rpartition("/")[2]

    def IsAbsolutePath(self) -> bool:  # noqa: N802
        return self.startswith("/")

    def GetParentPath(self) -> PathView:  # noqa: N802
        return PathView(self.rpartition("/")[0] or "/")

    def AppendPath(self, path: str) -> PathView:  # noqa: N802
        return PathView(self.rstrip("/") + "/" + path)


class _PropertyView:
    """What attributes and relationships have in common."""

    __slots__ = ("_name", "_prim")

    def __init__(self, prim: PrimView, name: str) -> None:
        self._prim, self._name = prim, name

    def __bool__(self) -> bool:
        return self._prim.has(self._name)

    IsValid = __bool__

    def GetName(self) -> str:  # noqa: N802
        return self._name


class AttributeView(_PropertyView):
    """An attribute, with the methods of pxr.Usd.Attribute."""

    __slots__ = ()

    def GetPath(self) -> PathView:  # noqa: N802
        return PathView(f"{self._prim.path}.{self._name}")

    def GetPrim(self) -> PrimView:  # noqa: N802
        return self._prim

    def HasAuthoredValue(self) -> bool:  # noqa: N802
        return self._prim.authored(self._name) is not None

    def HasValue(self) -> bool:  # noqa: N802
        return self._prim.value(self._name) is not None

    def Get(self, time: Any = None) -> Any:  # noqa: N802
        return self._prim.value(self._name)


class RelationshipView(_PropertyView):
    """A relationship, with the methods of pxr.Usd.Relationship."""

    __slots__ = ()

    def HasAuthoredTargets(self) -> bool:  # noqa: N802
        return self._name in self._prim.names

    def GetTargets(self) -> list[PathView]:  # noqa: N802
        return self._prim.targets(self._name)


class PrimView:
    """A composed prim; methods with capital letters are those of pxr.Usd.Prim."""

    __slots__ = ("_apis", "_names", "_prim", "prims", "path", "type_name")

    def __init__(self, prims: Prims, path: str, type_name: str) -> None:
        self.prims, self.path, self.type_name = prims, path, type_name
        self._prim: _tenon.Prim | None = None
        self._names: frozenset[str] | None = None
        self._apis: list[str] | None = None

    @property
    def prim(self) -> _tenon.Prim:
        if self._prim is None:
            self._prim = self.prims.stage.prim(self.path)
        return self._prim

    @property
    def names(self) -> frozenset[str]:
        """Of authored properties."""
        if self._names is None:
            self._names = frozenset(self.prim.authored)
        return self._names

    @property
    def apis(self) -> list[str]:
        """Of applied API schemas."""
        if self._apis is None:
            self._apis = list(self.prim.apis)
        return self._apis

    def has(self, name: str) -> bool:
        return name in self.names or name in self.prim.properties

    def value(self, name: str) -> Any:
        """The resolved value, the fallback of the schema included; None where there is none."""
        try:
            return self.prim.get(name)
        except NotFoundError:
            return None

    def authored(self, name: str) -> Any:
        """The value where it is authored; None where it is not, or blocked."""
        return self.prim.get(name) if name in self.names else None

    def targets(self, name: str) -> list[PathView]:
        """What a relationship names; none where it is not there."""
        found = self.authored(name)
        return [PathView(each) for each in found] if isinstance(found, list) else []

    def __bool__(self) -> bool:
        return True

    def IsValid(self) -> bool:  # noqa: N802
        return True

    def GetPath(self) -> PathView:  # noqa: N802
        return PathView(self.path)

    def GetName(self) -> str:  # noqa: N802
        return self.path.rpartition("/")[2]

    def GetTypeName(self) -> str:  # noqa: N802
        return self.type_name

    def GetStage(self) -> Prims:  # noqa: N802
        return self.prims

    def GetParent(self) -> PrimView | None:  # noqa: N802
        return self.prims.get(self.path.rpartition("/")[0])

    def GetChildren(self) -> list[PrimView]:  # noqa: N802
        return self.prims.children(self.path)

    def GetAttribute(self, name: str) -> AttributeView:  # noqa: N802
        return AttributeView(self, name)

    def HasAttribute(self, name: str) -> bool:  # noqa: N802
        return self.has(name)

    def GetAuthoredAttributes(self) -> list[AttributeView]:  # noqa: N802
        return [AttributeView(self, name) for name in sorted(self.names) if not self._relates(name)]

    def GetAuthoredPropertiesInNamespace(  # noqa: N802
        self, namespace: str
    ) -> list[AttributeView | RelationshipView]:
        found: list[AttributeView | RelationshipView] = []
        for name in sorted(self.names):
            if name.startswith(namespace.rstrip(":") + ":"):
                kind = RelationshipView if self._relates(name) else AttributeView
                found.append(kind(self, name))
        return found

    def _relates(self, name: str) -> bool:
        value = self.authored(name)
        return isinstance(value, list) and bool(value) and str(value[0]).startswith("/")

    def GetRelationship(self, name: str) -> RelationshipView:  # noqa: N802
        return RelationshipView(self, name)

    def HasRelationship(self, name: str) -> bool:  # noqa: N802
        return self.has(name)

    def HasAPI(self, schema: str) -> bool:  # noqa: N802
        return schema in self.apis

    def GetAppliedSchemas(self) -> list[str]:  # noqa: N802
        return self.apis

    def IsA(self, schema: str) -> bool:  # noqa: N802
        return self.prim.is_a(schema)

    def GetMetadata(self, name: str) -> Any:  # noqa: N802
        return None if name == "apiSchemas" else self.prim.metadata(name)


def path_key(path: str) -> list[str]:
    """What paths are sorted by: their elements."""
    return path.split("/")


def is_below(path: str, above: str) -> bool:
    return above == "/" or path == above or path.startswith(above + "/")


class Prims:
    """The defined prims of a stage, depth first, those of instances included; none that is
    inactive, a class or only an over, and none below such a one."""

    def __init__(self, stage: _tenon.Stage, root: str, ignored: Sequence[str]) -> None:
        self.stage = stage
        self.root = root
        self._ignored = [re.compile(pattern) for pattern in ignored]
        self._views: dict[str, PrimView] = {}
        self._children: dict[str, list[PrimView]] = {}
        self._worlds: dict[str, Matrix] = {"": np.identity(4), "/": np.identity(4)}
        self.ordinals: dict[str, int] = {}
        for row in stage.tree():
            self._add(row["path"], row["specifier"], row["type"] or "", row["active"])
        if root != "/" and root not in self._views:
            raise NotFoundError(f"root_path {root}: there is no such prim")

    def _add(self, path: str, specifier: str, type_name: str, active: bool) -> None:
        above = path.rpartition("/")[0]
        if not active or specifier != "def" or (above and above not in self._views):
            return
        view = PrimView(self, path, type_name)
        self._views[path] = view
        self._children.setdefault(above or "/", []).append(view)
        self.ordinals[path] = len(self.ordinals)

    def get(self, path: str) -> PrimView | None:
        return self._views.get(path)

    GetPrimAtPath = get

    def __getitem__(self, path: str) -> PrimView:
        return self._views[path]

    def __iter__(self) -> Iterator[PrimView]:
        """Those at and below the root path."""
        if self.root == "/":
            yield from self._views.values()
        else:
            for path, view in self._views.items():
                if is_below(path, self.root):
                    yield view

    def children(self, path: str) -> list[PrimView]:
        return self._children.get(path, [])

    def is_ignored(self, path: str) -> bool:
        """Whether a pattern of ignore_paths matches at the beginning of the path."""
        return any(pattern.match(path) for pattern in self._ignored)

    def is_wanted(self, path: str) -> bool:
        return is_below(path, self.root) and not self.is_ignored(path)

    def world(self, path: str) -> Matrix:
        """world <- prim in units of the stage; of prims without a place that of the one above."""
        found = self._worlds.get(path)
        if found is None:
            found = self._worlds[path] = self._place(path)
        return found

    def _place(self, path: str) -> Matrix:
        above = path.rpartition("/")[0]
        view = self._views.get(path)
        steps = view.authored("xformOpOrder") if view is not None else None
        if view is None or steps is None or not len(steps):
            return self.world(above)
        local = np.identity(4)
        for step in steps:
            if step == "!resetXformStack!":
                local, above = np.identity(4), ""
                continue
            backwards = step.startswith("!invert!")
            name = step.removeprefix("!invert!")
            value = view.value(name)
            if value is None:
                continue
            made = step_matrix(name.split(":")[1], value)
            local = (np.linalg.inv(made) if backwards else made) @ local
        return local @ self.world(above)

    def is_mirrored(self, path: str) -> bool:
        return bool(np.linalg.det(self.world(path)[:3, :3]) < 0)

    def mirrored_scale(self, path: str) -> tuple[float, float, float]:
        """Lengths of the axes of a prim in the world, all negative where it is mirrored."""
        lengths = np.sqrt((self.world(path)[:3, :3] ** 2).sum(axis=1))
        x, y, z = (-lengths if self.is_mirrored(path) else lengths).tolist()
        return x, y, z

    def scale(self, path: str) -> tuple[float, float, float]:
        """Lengths of the axes of a prim in the world, with the signs of authored scales."""
        lengths = np.sqrt((self.world(path)[:3, :3] ** 2).sum(axis=1))
        sign = self._signs(path) if self.is_mirrored(path) else np.ones(3)
        x, y, z = (lengths * sign).tolist()
        return x, y, z

    def _signs(self, path: str) -> Any:
        signs = np.ones(3)
        while path:
            view = self._views.get(path)
            for step in (view.authored("xformOpOrder") if view else None) or ():
                name = step.removeprefix("!invert!")
                if view is not None and name.startswith("xformOp:scale"):
                    signs = signs * np.sign(step_matrix("scale", view.value(name)).diagonal()[:3])
                elif name == "!resetXformStack!":
                    path = ""
            path = path.rpartition("/")[0]
        return signs
