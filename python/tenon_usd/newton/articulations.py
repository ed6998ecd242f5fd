# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Articulations: their bodies and joints in the order of the tree, and what floats."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

from ..errors import UnsupportedError
from .bodies import add_body
from .importing import Importing, warn
from .joints import MERGED_TYPES, add_joint, add_merged, ends, world_frame
from .poses import Pose, compose, inverse
from .prims import PrimView, is_below, path_key

#: Joints that become equality constraints of MuJoCo and are no joints of a tree.
EQUALITIES = ("MjcEqualityConnectAPI", "MjcEqualityWeldAPI")


def is_equality(prim: PrimView) -> bool:
    return any(prim.HasAPI(name) for name in EQUALITIES)


@dataclasses.dataclass
class Tree:
    """The joints of one articulation: groups between the same two bodies, by their first path."""

    groups: dict[str, list[str]] = dataclasses.field(default_factory=dict)
    #: Parent and child of each group, numbers of links, -1 for the world.
    edges: list[tuple[int, int]] = dataclasses.field(default_factory=list)
    #: Joints that close loops.
    loops: list[str] = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Handled:
    """What articulations have taken, and the joints to add when all bodies are there."""

    bodies: set[str] = dataclasses.field(default_factory=set)
    joints: set[str] = dataclasses.field(default_factory=set)
    #: Path of a joint that closes a loop -> what the builder's world is to it.
    loops: dict[str, Pose] = dataclasses.field(default_factory=dict)


def add_articulations(importing: Importing) -> Handled:
    """Adds all articulations of the description that are wanted, as the stage has them."""
    handled = Handled()
    ordinals = importing.prims.ordinals
    by_path: dict[str, list[Any]] = {}
    for articulation in importing.scene.articulations:
        if importing.prims.is_wanted(articulation.path):
            by_path.setdefault(articulation.path, []).append(articulation)
    for path in sorted(by_path, key=lambda each: ordinals.get(each, 0)):
        for articulations in _together(importing, by_path[path]):
            _add(importing, path, articulations, handled)
    return handled


def _together(importing: Importing, articulations: list[Any]) -> list[list[Any]]:
    """Trees of one root prim: one articulation where all stand on the world, else one each."""
    if all(each.fixed_base for each in articulations):
        return [articulations]
    return [[each] for each in articulations]


def _add(importing: Importing, path: str, articulations: list[Any], handled: Handled) -> None:
    prim = importing.prims[path]
    importing.resolvers.collect(prim)
    above = prim.GetParent()
    if above is not None:
        importing.resolvers.collect(above)
    links = _links(importing, articulations, handled)
    if not links:
        return
    options = importing.options
    root = importing.prim_pose(path) if options.override_root_xform else None
    if not options.bodies_follow_joint_ordering:
        for link in links:
            add_body(importing, link, root)
    tree = _tree_of(importing, articulations, links)
    custom = importing.custom_values(prim, "ARTICULATION")
    made: set[int] = set()
    if tree.edges:
        made |= _add_tree(importing, path, links, tree, root, custom, handled)
    else:
        for link in links:
            made |= _add_alone(importing, link, root, custom)
    _keep_loops(importing, tree, root, handled)
    touch = importing.resolvers.value(
        prim, "ARTICULATION", "self_collision_enabled", options.enable_self_collisions
    )
    importing.self_collisions.update(dict.fromkeys(made, bool(touch)))


def _links(importing: Importing, articulations: list[Any], handled: Handled) -> list[str]:
    """Paths of the links that are to be imported and that no other articulation has."""
    paths = importing.body_paths
    links = sorted({paths[link] for each in articulations for link in each.links}, key=path_key)
    links = [path for path in links if path in importing.body_numbers]
    links = [path for path in links if path not in handled.bodies]
    for path in links:
        importing.resolvers.collect(importing.prims[path])
    handled.bodies.update(links)
    return links


def _keep_loops(
    importing: Importing, tree: Tree, root: Pose | None, handled: Handled
) -> None:
    place = importing.incoming
    if root is not None:
        place = compose(place, inverse(root))
    for path in sorted(tree.loops, key=path_key):
        handled.loops[path] = place
    handled.joints.update(tree.loops)


def _tree_of(importing: Importing, articulations: list[Any], links: Sequence[str]) -> Tree:
    """The joints of an articulation, by path. A joint that would close a loop is one that Newton
    adds beside the tree."""
    numbers = {path: at for at, path in enumerate(links)}
    joints = importing.scene.joints
    loops = {at for each in articulations for at in each.loop_joints.tolist()}
    all_joints = loops | {at for each in articulations for at in each.joints.tolist()}
    wanted = []
    for at in sorted(all_joints, key=lambda n: path_key(joints[n].path)):
        joint = joints[at]
        if joint.path not in importing.joint_numbers or is_equality(importing.prims[joint.path]):
            continue
        if any(importing.body_paths[body] not in importing.body_numbers
               for body in (joint.body0, joint.body1) if body is not None):
            continue
        parent, child, _ = ends(importing, joint, numbers)
        if child != -1 or joint.exclude_from_articulation:
            wanted.append((at, joint, (parent, child)))
        else:
            warn(joint.path, "a joint between nothing that moves; it is skipped")
    inside = {pair for at, joint, pair in wanted if at not in loops}
    tree = Tree()
    firsts: dict[tuple[int, int], str] = {}
    for _, joint, pair in wanted:
        if joint.exclude_from_articulation or pair not in inside:
            tree.loops.append(joint.path)
        elif pair in firsts:
            tree.groups[firsts[pair]].append(joint.path)
        else:
            firsts[pair] = joint.path
            tree.groups[joint.path] = [joint.path]
            tree.edges.append(pair)
    return tree


def _ordered(tree: Tree, ordering: str | None, path: str) -> list[int]:
    """Numbers of edges, parents first: depth or breadth first, else as they are."""
    if ordering is None:
        return list(range(len(tree.edges)))
    below: dict[int, list[int]] = {}
    for edge, (parent, _) in enumerate(tree.edges):
        below.setdefault(parent, []).append(edge)
    children = {child for _, child in tree.edges}
    roots = sorted({parent for parent, _ in tree.edges} - children)
    if len(roots) != 1:
        raise UnsupportedError(
            f"{path}: its joints make {len(roots)} trees; a joint's physics:body0 is the parent "
            "and physics:body1 the child"
        )
    order: list[int] = []
    waiting = list(roots)
    while waiting:
        if ordering == "dfs":
            edges = below.get(waiting.pop(), [])
        else:
            edges = below.get(waiting.pop(0), [])
        order.extend(edges)
        waiting.extend(tree.edges[edge][1] for edge in edges)
    return _depth_first(tree, roots[0], below) if ordering == "dfs" else order


def _depth_first(tree: Tree, root: int, below: dict[int, list[int]]) -> list[int]:
    order: list[int] = []
    waiting = list(reversed(below.get(root, [])))
    while waiting:
        edge = waiting.pop()
        order.append(edge)
        waiting.extend(reversed(below.get(tree.edges[edge][1], [])))
    return order


def _base(importing: Importing, child: int, parent_xform: Any = None) -> int:
    """The joint that ties a root to the world, or to the body that the import hangs on."""
    options = importing.options
    if options.parent_body != -1:
        parent_xform = importing.transform(importing.incoming)
    number: int = importing.builder._add_base_joint(
        child,
        floating=options.floating,
        base_joint=options.base_joint,
        parent=options.parent_body,
        parent_xform=parent_xform,
    )
    return number


def _close(importing: Importing, joints: list[int], label: str, custom: dict[str, Any]) -> int:
    """Makes an articulation of joints, or a part of the one of the parent body; its number."""
    builder = importing.builder
    builder._finalize_imported_articulation(
        joint_indices=joints,
        parent_body=importing.options.parent_body,
        articulation_label=label,
        custom_attributes=custom,
    )
    number: int = builder.joint_articulation[joints[0]]
    return number


def _add_alone(
    importing: Importing, path: str, root: Pose | None, custom: dict[str, Any]
) -> set[int]:
    """A link without any joint."""
    number = importing.bodies.get(path)
    if number is None:
        number = add_body(importing, path, root)
    if number < 0:
        return set()
    return {_close(importing, [_base(importing, number)], path, custom)}


def _add_tree(
    importing: Importing,
    path: str,
    links: Sequence[str],
    tree: Tree,
    root: Pose | None,
    custom: dict[str, Any],
    handled: Handled,
) -> set[int]:
    order = _ordered(tree, importing.options.joint_ordering, path)
    for edge in order:
        for link in tree.edges[edge]:
            if link >= 0 and links[link] not in importing.bodies:
                add_body(importing, links[link], root)
    names = list(tree.groups)
    joints: list[int] = []
    first = tree.edges[order[0]][0]
    if first != -1:
        joints.append(_base(importing, importing.bodies[links[first]]))
    for at, edge in enumerate(order):
        group = tree.groups[names[edge]]
        handled.joints.update(group)
        to_world = at == 0 and first == -1
        if to_world and (importing.options.base_joint or importing.options.floating is not None):
            child = importing.bodies[links[tree.edges[edge][1]]]
            joints.append(_base(importing, child, importing.builder.body_q[child]))
            continue
        number = _add_group(importing, group, links, root, to_world)
        if number is not None:
            joints.append(number)
    if not joints:
        return set()
    return {_close(importing, joints, path, custom)}


def _add_group(
    importing: Importing, group: Sequence[str], links: Sequence[str], root: Pose | None, top: bool
) -> int | None:
    world = place = None
    if top:
        numbers = {path: at for at, path in enumerate(links)}
        joint = importing.scene.joints[importing.joint_numbers[group[0]]]
        world = world_frame(importing, joint, numbers, own=False)
        place = importing.incoming
        if root is not None:
            place = compose(place, inverse(root))
    if len(group) > 1:
        return add_merged(importing, group, world, place)
    return add_joint(importing, group[0], world, place)


def add_others(importing: Importing, handled: Handled) -> None:
    """Bodies and joints that no articulation has, as the stage has them."""
    ordinals = importing.prims.ordinals
    for path in sorted(importing.body_numbers, key=lambda each: ordinals.get(each, 0)):
        if path not in handled.bodies:
            add_body(importing, path)
    pairs: dict[tuple[int | None, int | None], list[str]] = {}
    for path in sorted(importing.joint_numbers, key=lambda each: joint_key(importing, each)):
        joint = importing.scene.joints[importing.joint_numbers[path]]
        if path in handled.joints or is_equality(importing.prims[path]) or (
            not joint.enabled and importing.options.only_load_enabled_joints
        ):
            continue
        if ends(importing, joint, importing.bodies)[1] == -1:
            continue
        pairs.setdefault((joint.body0, joint.body1), []).append(path)
    for group in pairs.values():
        kinds = {importing.scene.joints[importing.joint_numbers[path]].type for path in group}
        if len(group) > 1 and kinds <= set(MERGED_TYPES):
            _add_other(importing, group)
        else:
            for path in group:
                _add_other(importing, [path])


#: The order in which joints of each type come.
_TYPES = ("fixed", "revolute", "prismatic", "spherical", "d6", "distance")


def joint_key(importing: Importing, path: str) -> tuple[int, int]:
    joint = importing.scene.joints[importing.joint_numbers[path]]
    return _TYPES.index(joint.type), importing.prims.ordinals.get(path, 0)


def _add_other(importing: Importing, group: Sequence[str]) -> None:
    joint = importing.scene.joints[importing.joint_numbers[group[0]]]
    parent, _, _ = ends(importing, joint, importing.bodies)
    world = place = None
    if parent == -1:
        world, place = world_frame(importing, joint, importing.bodies, own=True), importing.incoming
    if len(group) > 1:
        add_merged(importing, group, world, place)
    else:
        add_joint(importing, group[0], world, place)


def add_loops(importing: Importing, handled: Handled) -> None:
    """Joints that close loops, when all bodies are there."""
    for path, place in handled.loops.items():
        joint = importing.scene.joints[importing.joint_numbers[path]]
        parent, child, _ = ends(importing, joint, importing.bodies)
        if child != -1:
            add_joint(importing, path, None, place if parent == -1 else None)


def add_bases(importing: Importing) -> None:
    """Base joints of bodies that are no joint's child, and articulations of them."""
    builder, options = importing.builder, importing.options
    bodies = list(importing.bodies.values())
    if not any(importing.prims.is_wanted(each.path) for each in importing.scene.articulations):
        tied = {*builder.joint_parent, *builder.joint_child}
        if importing.joints:
            bodies = [body for body in bodies if body not in tied]
    children = set(builder.joint_child)
    roots = [each.path for each in importing.scene.articulations]
    for body in bodies:
        if body in children or builder.body_mass[body] <= 0:
            continue
        joint = _base(importing, body)
        path = builder.body_label[body]
        above = [root for root in roots if is_below(path, root)]
        label = max(above, key=len) if above and options.parent_body == -1 else path
        _close(importing, [joint], label, {})
