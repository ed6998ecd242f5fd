# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Which shapes do not touch: links of one articulation, collision groups, filtered pairs."""

from __future__ import annotations

import itertools
from collections.abc import Iterable

from .importing import Importing
from .prims import is_below
from .shapes import Colliders

PAIRS = "physics:filteredPairs"


class Filters:
    """Pairs of colliding shapes that the builder keeps apart, each told once."""

    def __init__(self, importing: Importing) -> None:
        self._builder = importing.builder
        self._collides = int(importing.libraries.newton.ShapeFlags.COLLIDE_SHAPES)
        self._known = {self._sorted(*pair) for pair in self._builder.shape_collision_filter_pairs}

    def _sorted(self, a: int, b: int) -> tuple[int, int]:
        return (a, b) if a < b else (b, a)

    def collides(self, shape: int) -> bool:
        return bool(self._builder.shape_flags[shape] & self._collides)

    def add(self, a: int, b: int) -> None:
        pair = self._sorted(a, b)
        if a != b and pair not in self._known and self.collides(a) and self.collides(b):
            self._known.add(pair)
            self._builder.add_shape_collision_filter_pair(*pair)

    def add_all(self, some: Iterable[int], others: Iterable[int]) -> None:
        for a, b in itertools.product(list(some), list(others)):
            self.add(a, b)


def add_filters(importing: Importing, colliders: Colliders, first_joint: int) -> None:
    """Adds all pairs of an import; `first_joint`: the first joint that it made."""
    filters = Filters(importing)
    _keep_links_apart(importing, filters, first_joint)
    _keep_groups_apart(importing, filters, colliders)
    _keep_pairs_apart(importing, filters, colliders)


def _keep_links_apart(importing: Importing, filters: Filters, first_joint: int) -> None:
    builder = importing.builder
    imported = set(builder.joint_articulation[first_joint:]) - {-1}
    for articulation in sorted(imported):
        default = importing.options.enable_self_collisions
        if importing.self_collisions.get(articulation, default):
            continue
        start = builder.articulation_start[articulation]
        end = builder.articulation_end[articulation]
        links = {*builder.joint_child[start:end], *builder.joint_parent[start:end]} - {-1}
        for a, b in itertools.combinations(sorted(links), 2):
            filters.add_all(builder.body_shapes[a], builder.body_shapes[b])


def _keep_groups_apart(importing: Importing, filters: Filters, colliders: Colliders) -> None:
    table = importing.scene.filter
    count = len(table.group_paths)
    if not count:
        return
    off = table.group_pair_off.reshape(count, count)
    alone = table.ungrouped_off
    members: dict[tuple[int, ...], list[int]] = {}
    groups = table.groups_of_collider
    for path, number in colliders.numbers.items():
        own = tuple(groups[number].tolist()) if number < len(groups) else ()
        members.setdefault(own, []).append(importing.shapes[path])
    for (one, shapes), (other, others) in itertools.combinations_with_replacement(
        sorted(members.items()), 2
    ):
        if one and other:
            apart = any(off[a, b] for a in one for b in other)
        else:
            apart = any(alone[group] for group in (*one, *other))
        if apart:
            filters.add_all(shapes, others)


def _keep_pairs_apart(importing: Importing, filters: Filters, colliders: Colliders) -> None:
    sources = dict.fromkeys([*colliders.numbers, *importing.bodies])
    sources.update(dict.fromkeys(
        each.path for each in importing.scene.articulations
        if importing.prims.is_wanted(each.path)
    ))
    for path in sources:
        prim = importing.prims.get(path)
        for target in prim.targets(PAIRS) if prim is not None else ():
            filters.add_all(_shapes_of(importing, path), _shapes_of(importing, target))


def _shapes_of(importing: Importing, path: str) -> list[int]:
    """Of a collider, of a body, of the links of an articulation, or of all below a prim."""
    if path in importing.shapes:
        return [importing.shapes[path]]
    shapes = importing.builder.body_shapes
    if path in importing.bodies:
        return list(shapes.get(importing.bodies[path], ()))
    for articulation in importing.scene.articulations:
        if articulation.path == path:
            links = [importing.body_paths[link] for link in articulation.links]
            return [shape for link in links if link in importing.bodies
                    for shape in shapes.get(importing.bodies[link], ())]
    return [shape for each, shape in importing.shapes.items() if is_below(each, path)]
