# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What OpenUSD's Pcp makes of a root layer, in the lines that tests/tools/composition_dump.cpp
prints with --nodes: {heading of a prim: lines}."""

import os
import re

from pxr import Pcp, Sdf, Tf

import random_scenes


def class_name(error):
    name = type(error).__name__.replace("Error", "", 1)
    return "compose." + re.sub(r"(?<!^)([A-Z])", r"-\1", name).lower()


def shown(offset):
    if offset.IsIdentity():
        return ""
    return f" (offset={offset.offset:.2f}, scale={offset.scale:.2f})"


def possible_paths():
    """Implied classes ask for payloads by paths that may be no prim's: all there are, up to a
    depth."""
    below = random_scenes.KIDS + ("_k", "q", "r")
    paths = level = [Sdf.Path("/" + name) for name in random_scenes.ROOTS + random_scenes.CLASSES]
    for _ in range(3):
        level = [path.AppendChild(name) for path in level for name in below]
        paths = paths + level
    return paths


POSSIBLE = possible_paths()


class Oracle:
    """`options`: session (file name), muted (file names), fallbacks {set: variants}, load
    {"none": True, "loaded": [prim path]}; `faults` collects what OpenUSD says of itself."""

    def __init__(self, root_path, options):
        self.root_path = root_path
        self.folder = os.path.dirname(root_path)
        self.options = options
        self.faults = []

    def is_rejected(self):
        """The root layer or the session's cannot be read."""
        try:
            Sdf.Layer.FindOrOpen(self.root_path)
            if "session" in self.options:
                Sdf.Layer.FindOrOpen(os.path.join(self.folder, self.options["session"]))
        except Tf.ErrorException:
            return True
        return False

    def composed(self):
        """With payloads by the load rules. Which prims there are is known when all is composed, so
        this asks again until no more turn up."""
        if self.is_rejected():
            return {"exit": ["rejected"]}
        wanted, before = {path for path in POSSIBLE if self.is_loaded(path)}, None
        while wanted != before:
            before = set(wanted)
            cache = self.new_cache(wanted)
            for path in self.walk(cache, lambda index: index.ComputePrimChildNames()[0]):
                if self.is_loaded(path):
                    wanted |= self.with_relocated(cache, path)
        return self.all_lines(cache)

    def composed_one(self, path):
        """The same of one prim, but for what it is an instance like."""
        if self.is_rejected():
            return {"exit": ["rejected"]}
        wanted = {path for path in POSSIBLE if self.is_loaded(path)}
        wanted |= {p for p in Sdf.Path(path).GetPrefixes() if self.is_loaded(p)}
        cache = self.new_cache(wanted)
        errors = sorted({"!! " + class_name(error) for error in cache.layerStack.localErrors})
        lines = self.prim_lines(cache, Sdf.Path(path), {})[1]
        return {"layers": self.layer_lines(cache) + errors, path: lines}

    def walk(self, cache, names_of):
        """Paths of all prims depth-first."""
        open_paths = [Sdf.Path("/")]
        while open_paths:
            path = open_paths.pop()
            yield path
            index, _ = self.asked_twice(cache.ComputePrimIndex, path)
            open_paths += [path.AppendChild(name) for name in reversed(names_of(index))]

    @staticmethod
    def with_relocated(cache, path):
        """A path as arcs see it: relocates may map it to where no prim is."""
        paths = {path}
        for source, target in cache.layerStack.relocatesSourceToTarget.items():
            if not target.isEmpty:
                paths |= {p.ReplacePrefix(source, target) for p in paths if p.HasPrefix(source)}
        return paths

    def is_loaded(self, path):
        load = self.options.get("load")
        if load is None or not path.IsPrimPath():
            return path.IsPrimPath()
        loaded = [Sdf.Path(p) for p in load.get("loaded", [])]
        return any(p.HasPrefix(path) or path.HasPrefix(p) for p in loaded)

    def new_cache(self, payloads):
        root = Sdf.Layer.FindOrOpen(self.root_path)
        session = None
        if "session" in self.options:
            session = Sdf.Layer.FindOrOpen(os.path.join(self.folder, self.options["session"]))
        cache = Pcp.Cache(Pcp.LayerStackIdentifier(root, session), usd=True)
        muted = [os.path.join(self.folder, name) for name in self.options.get("muted", [])]
        if muted:
            cache.RequestLayerMuting(muted, [])
        if "fallbacks" in self.options:
            cache.SetVariantFallbacks(self.options["fallbacks"])
        cache.RequestPayloads(sorted(payloads), [])
        self.asked_twice(cache.ComputeLayerStack, cache.GetLayerStackIdentifier())
        return cache

    def all_lines(self, cache):
        errors = sorted({"!! " + class_name(error) for error in cache.layerStack.localErrors})
        result, keys = {"layers": self.layer_lines(cache) + errors}, {}
        for path in self.walk(cache, lambda index: index.ComputePrimChildNames()[0]):
            heading, lines = self.prim_lines(cache, path, keys)
            result[heading] = lines
        return result

    def asked_twice(self, call, *arguments):
        """OpenUSD's own checks raise when the work is done; the second answer is a stored one."""
        try:
            return call(*arguments)
        except Tf.ErrorException as error:
            self.faults.append(re.sub(r"\s+", " ", str(error))[:200])
            return call(*arguments)

    def label(self, layer):
        return os.path.relpath(layer.realPath, self.folder)

    def layer_lines(self, cache):
        stack = cache.layerStack
        return [self.label(layer) + shown(offset)
                for layer, offset in zip(stack.layers, stack.layerOffsets)]

    def prim_lines(self, cache, path, keys):
        index, _ = self.asked_twice(cache.ComputePrimIndex, path)
        lines = list(self.node_lines(index.rootNode))
        lines += [f"spec {self.label(s.layer)} {s.path}" for s in index.primStack]
        lines += sorted({"!! " + class_name(error) for error in index.localErrors})
        sets = {path.GetVariantSelection()[0] for path in self.variant_paths(index.rootNode)}
        for name in sorted(sets):
            lines.append(f"selected {name}={index.GetSelectionAppliedForVariantSet(name)}")
        names, prohibited = index.ComputePrimChildNames()
        properties = index.ComputePrimPropertyNames()
        for heading, words in (("children", names), ("prohibited", sorted(prohibited)),
                               ("properties", properties)):
            if words:
                lines.append(f"{heading} {' '.join(words)}")
        lines += filter(None, (self.target_line(cache, index, path.AppendProperty(name))
                               for name in properties))
        if not index.IsInstanceable():
            return str(path), lines
        first = keys.setdefault(Pcp.InstanceKey(index), path)
        return f"{path} instance like {first}", lines

    def node_lines(self, node):
        offset = node.mapToRoot.timeOffset
        if node.CanContributeSpecs() and node.hasSpecs:
            layer = self.label(node.layerStack.identifier.rootLayer)
            yield f"{node.arcType.displayName} {layer} {node.path}" + shown(offset)
        for child in node.children:
            yield from self.node_lines(child)

    def variant_paths(self, node):
        if node.path.IsPrimVariantSelectionPath():
            yield node.path
        for child in node.children:
            yield from self.variant_paths(child)

    def target_line(self, cache, index, path):
        stack, _ = self.asked_twice(Pcp.BuildPrimPropertyIndex, path, cache, index)
        if not stack.propertyStack:
            return ""
        is_relationship = isinstance(stack.propertyStack[0], Sdf.RelationshipSpec)
        compute = cache.ComputeRelationshipTargetPaths if is_relationship else \
            cache.ComputeAttributeConnectionPaths
        paths, deleted, errors = self.asked_twice(compute, path)
        words = [str(p) for p in paths] + [f"-{p}" for p in deleted]
        words += sorted(class_name(e) for e in errors if "Target" in type(e).__name__)
        return f"targets {path.name} {' '.join(words)}" if words else ""
