# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Values that Newton's schema resolvers find, and the attributes that they know."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .options import Libraries
from .prims import PrimView


def _names_of(resolver: Any) -> frozenset[str]:
    entries = [entry for kind in resolver.mapping.values() for entry in kind.values()]
    return frozenset(name for entry in entries for name in (entry.name, *entry.attribute_names))


def _beginnings_of(resolver: Any) -> tuple[str, ...]:
    spaces = (resolver.name, *resolver.extra_attr_namespaces)
    return tuple(space if space.endswith(":") else space + ":" for space in spaces)


class Resolvers:
    """Schema resolvers in the order of their precedence, called with prims that are no pxr's."""

    def __init__(self, libraries: Libraries, given: Sequence[Any] | None, builder: Any) -> None:
        usd = libraries.newton.usd
        self.kinds = usd.PrimType
        self.all = [usd.SchemaResolverNewton()] if given is None else list(given)
        for resolver in self.all:
            resolver.validate_custom_attributes(builder)
        self.mujoco = next((each for each in self.all if each.name == "mjc"), None)
        public = (usd.SchemaResolverNewton, usd.SchemaResolverPhysx, usd.SchemaResolverMjc)
        #: Of resolvers of Newton itself: all names that they read, and how others that they keep
        #: begin. What a prim has none of need not be asked for.
        self._reads = {
            each.name: (_names_of(each), _beginnings_of(each))
            for each in self.all
            if type(each) in public
        }
        self._silent: dict[tuple[str, str], bool] = {}
        #: By resolver, by prim path: names and values.
        self.attributes: dict[str, dict[str, dict[str, Any]]] = {
            each.name: {} for each in self.all
        }

    def collect(self, prim: PrimView) -> None:
        """Keeps what the resolvers know of a prim."""
        for resolver in self.all:
            self._collect(resolver, prim)

    def _collect(self, resolver: Any, prim: PrimView) -> None:
        kept = self.attributes[resolver.name]
        if prim.path not in kept:
            silent = self._is_silent(resolver, prim)
            kept[prim.path] = {} if silent else resolver.collect_prim_attrs(prim)

    def _is_silent(self, resolver: Any, prim: PrimView) -> bool:
        """Whether a prim authors nothing that a resolver reads or keeps."""
        reads = self._reads.get(resolver.name)
        if reads is None:
            return False
        key = resolver.name, prim.path
        known = self._silent.get(key)
        if known is None:
            names, beginnings = reads
            known = names.isdisjoint(prim.names) and not any(
                name.startswith(beginnings) for name in prim.names
            )
            self._silent[key] = known
        return known

    def asked(self, resolver: Any, prim: PrimView, kind: str, key: str) -> Any:
        """What one resolver finds on a prim; None where it finds nothing."""
        if self._is_silent(resolver, prim):
            return None
        return resolver.get_value(prim, self.kinds[kind], key)

    def found(self, prim: PrimView, kind: str, key: str) -> tuple[Any, Any]:
        """The authored value of the first resolver that has one, and that resolver, or None."""
        for resolver in self.all:
            value = self.asked(resolver, prim, kind, key)
            if value is not None:
                self._collect(resolver, prim)
                return value, resolver
        return None, None

    def value(self, prim: PrimView, kind: str, key: str, default: Any = None) -> Any:
        """The authored value, else `default`, else the fallback of the first resolver with one."""
        value, _ = self.found(prim, kind, key)
        if value is not None:
            return value
        if default is not None:
            return default
        for resolver in self.all:
            entry = resolver.mapping.get(self.kinds[kind], {}).get(key)
            if entry is not None and entry.default is not None:
                turned = entry.usd_value_transformer
                return entry.default if turned is None else turned(entry.default)
        return None

    def of_schemas(self, prim: PrimView, key: str) -> float | None:
        """A value of a joint that a resolver other than MuJoCo's finds."""
        for resolver in self.all:
            if resolver.name == "mjc":
                continue
            value = self.asked(resolver, prim, "JOINT", key)
            if value is not None:
                self._collect(resolver, prim)
                return float(value)
        return None
