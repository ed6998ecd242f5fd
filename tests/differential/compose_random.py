#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares composition with OpenUSD's on small random scenes of several layers: sublayers with
offsets, references, payloads, inherits, specializes, variants, list edits, relocates, instances,
relationship targets. Needs Python with OpenUSD's modules.

usage: compose_random.py DUMP [--scenes N] [--seed S] [--keep FOLDER] [-v]

DUMP is the program tests/tools/composition_dump.cpp. Per prim these must agree: contributing nodes
in order of strength with arc, site and time offset; names of children and properties; prohibited
names; whether it is an instance; targets; classes of findings. Scenes that OpenUSD does not
finish in time are left out. --keep writes scenes that differ there. Exit 77: no OpenUSD.
"""

import argparse
import os
import random
import re
import signal
import subprocess
import sys
import tempfile

try:
    from pxr import Pcp, Sdf
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

NAMES = ("A", "B", "C", "D", "E")
CHILDREN = ("x", "y", "z")
SECONDS = 20
RELOCATION = ("invalid-authored-relocation", "invalid-conflicting-relocation",
              "invalid-same-target-relocations")


class Scene:
    """Text of layers that refer to each other, made from a seed."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.layer_count = self.random.randint(2, 4)

    def chance(self, probability):
        return self.random.random() < probability

    def texts(self):
        return {f"l{i}.usda": self.layer(i) for i in range(self.layer_count)}

    def offset(self):
        if self.chance(0.7):
            return ""
        offset, scale = self.random.choice((1, 2.5, -3)), self.random.choice((1, 2, 0.5))
        return f" (offset = {offset}; scale = {scale})"

    def layer(self, i):
        metadata = []
        if self.chance(0.4) and i + 1 < self.layer_count:
            metadata.append(f"    subLayers = [@./l{i + 1}.usda@{self.offset()}]")
        if self.chance(0.3):
            metadata.append(f"    timeCodesPerSecond = {self.random.choice((24, 48, 12))}")
        if self.chance(0.3):
            metadata.append('    defaultPrim = "A"')
        if self.chance(0.25):
            metadata.append("    relocates = {" + self.relocates() + "}")
        body = "".join(self.prim(i, name, 0) for name in self.random.sample(NAMES, 4))
        return "#usda 1.0\n(\n" + "\n".join(metadata) + "\n)\n" + body

    def relocates(self):
        parent = self.random.choice(NAMES)
        pairs = []
        for source in self.random.sample(CHILDREN, self.random.randint(1, 2)):
            target = self.random.choice(("q" + source, "x/q" + source, "r" + source))
            if not target.startswith(source + "/"):
                pairs.append(f"</{parent}/{source}>: </{parent}/{target}>")
        return ", ".join(pairs)

    def path(self, above=""):
        """A prim path; root names after `above` in the alphabet keep cycles rare."""
        later = [name for name in NAMES if name > above] or list(NAMES)
        if self.chance(0.07):
            later = list(NAMES)
        path = "/" + self.random.choice(later)
        while self.chance(0.3) and path.count("/") < 3:
            path += "/" + self.random.choice(CHILDREN)
        return path

    def asset(self, i, root):
        if self.chance(0.3) or i + 1 >= self.layer_count:
            return f"<{self.path(root)}>{self.offset()}"
        layer = self.random.randint(i + 1, self.layer_count - 1)
        prim = "" if self.chance(0.1) else f"<{self.path()}>"
        return f"@./l{layer}.usda@{prim}{self.offset()}"

    def edit(self):
        return self.random.choice(("prepend ", "append ", "prepend ", "", "delete "))

    def arcs(self, i, root):
        lines = []
        if self.chance(0.3):
            items = sorted({self.asset(i, root) for _ in range(self.random.randint(1, 2))})
            lines.append(f"{self.edit()}references = [{', '.join(items)}]")
        if self.chance(0.12):
            lines.append(f"{self.edit()}payload = {self.asset(i, root)}")
        if self.chance(0.2):
            lines.append(f"{self.edit()}inherits = <{self.path(root)}>")
        if self.chance(0.15):
            lines.append(f"{self.edit()}specializes = <{self.path(root)}>")
        if self.chance(0.1):
            lines.append("instanceable = true")
        if self.chance(0.15):
            lines.append('variants = { string v = "' + self.random.choice("ab") + '" }')
        return lines

    def properties(self):
        lines = []
        if self.chance(0.4):
            target = self.path() if self.chance(0.8) else self.path() + ".attr"
            lines.append(f"{self.edit()}rel to = <{target}>")
        if self.chance(0.4):
            lines.append("custom double attr = 1")
        if self.chance(0.15):
            lines.append(f"{self.edit()}double attr.connect = <{self.path()}.attr>")
        return lines

    def prim(self, i, name, depth, root=None):
        root = root or name
        indent = "    " * depth
        arcs = self.arcs(i, root)
        has_variants = self.chance(0.2)
        if has_variants:
            arcs.append('prepend variantSets = "v"')
        specifier = self.random.choice(("def", "over", "class", "def"))
        text = f'{indent}{specifier} "{name}" (\n'
        text += "".join(f"{indent}    {line}\n" for line in arcs) + f"{indent})\n{indent}{{\n"
        text += "".join(f"{indent}    {line}\n" for line in self.properties())
        text += self.children(i, depth, root)
        if has_variants:
            text += f'{indent}    variantSet "v" = {{\n'
            for variant in "ab":
                text += f'{indent}    "{variant}" (\n'
                text += "".join(f"{indent}        {line}\n" for line in self.arcs(i, root))
                text += f"{indent}    ) {{\n{self.children(i, depth + 1, root)}{indent}    }}\n"
            text += f"{indent}    }}\n"
        return text + f"{indent}}}\n"

    def children(self, i, depth, root):
        if depth >= 2:
            return ""
        names = self.random.sample(CHILDREN, self.random.randint(0, 2))
        return "".join(self.prim(i, name, depth + 1, root) for name in names)


def class_name(error):
    name = type(error).__name__.replace("Error", "", 1)
    return "compose." + re.sub(r"(?<!^)([A-Z])", r"-\1", name).lower()


def label(layer, folder):
    return os.path.relpath(layer.realPath, folder)


def node_lines(index, folder):
    def walk(node):
        offset = node.mapToRoot.timeOffset
        if node.CanContributeSpecs() and node.hasSpecs:
            layer = label(node.layerStack.identifier.rootLayer, folder)
            shown = f"{node.arcType.displayName} {layer} {node.path}"
            if not offset.IsIdentity():
                shown += f" (offset={offset.offset:.2f}, scale={offset.scale:.2f})"
            yield shown
        for child in node.children:
            yield from walk(child)
    return list(walk(index.rootNode))


def target_line(cache, index, path):
    stack, _ = Pcp.BuildPrimPropertyIndex(path, cache, index)
    if not stack.propertyStack:
        return ""
    if isinstance(stack.propertyStack[0], Sdf.RelationshipSpec):
        paths, deleted, errors = cache.ComputeRelationshipTargetPaths(path)
    else:
        paths, deleted, errors = cache.ComputeAttributeConnectionPaths(path)
    words = [str(p) for p in paths] + [f"-{p}" for p in deleted]
    words += [class_name(e) for e in errors if "Target" in type(e).__name__]
    return f"targets {path.name} {' '.join(words)}" if words else ""


def prim_lines(cache, path, folder):
    """-> ((heading, lines) of one prim, names of its children)."""
    index, _ = cache.ComputePrimIndex(path)
    lines = node_lines(index, folder)
    lines += sorted({"!! " + class_name(error) for error in index.localErrors})
    names, prohibited = index.ComputePrimChildNames()
    properties = index.ComputePrimPropertyNames()
    for heading, words in (("children", names), ("prohibited", sorted(prohibited)),
                           ("properties", properties)):
        if words:
            lines.append(f"{heading} {' '.join(words)}")
    lines += filter(None, (target_line(cache, index, path.AppendProperty(name))
                           for name in properties))
    return (str(path) + (" instanceable" if index.IsInstanceable() else ""), lines), names


def expected(root_path):
    """What OpenUSD makes of a scene with all payloads: {prim: lines}."""
    root = Sdf.Layer.FindOrOpen(root_path)
    folder = os.path.dirname(root_path)
    loaded, before = set(), None
    while loaded != before:  # an ancestral payload may belong to a prim that comes later
        before = set(loaded)
        cache = Pcp.Cache(Pcp.LayerStackIdentifier(root), usd=True)
        cache.RequestPayloads([p for p in sorted(loaded) if p.IsPrimPath()], [])
        result = {}
        open_paths = [Sdf.Path("/")]
        while open_paths:
            path = open_paths.pop()
            loaded.add(path)
            (heading, result_lines), names = prim_lines(cache, path, folder)
            result[heading] = result_lines
            open_paths += [path.AppendChild(name) for name in reversed(names)]
    return result


def composed(dump, root_path):
    """The same from DUMP."""
    process = subprocess.run([dump, root_path, "--nodes"], capture_output=True, text=True,
                             timeout=6 * SECONDS, check=False)
    if process.returncode != 0:
        return {"exit": [str(process.returncode), process.stderr[-500:]]}
    result, lines = {}, None
    for line in process.stdout.split("\n"):
        if line.startswith("== "):
            lines = result.setdefault(line[3:], [])
        elif line.startswith("!! "):
            if line not in lines:
                lines.append(line)
        elif line and not re.search(r" (inert|culled|no-specs)\b", line):
            lines.append(re.sub(r" ancestral\b", "", line.strip()))
    return {prim: in_order(lines) for prim, lines in result.items()}


def in_order(lines):
    """Findings sorted behind the nodes."""
    nodes = [line for line in lines if not line.startswith(("!! ", "children ", "prohibited ",
                                                            "properties ", "targets "))]
    findings = sorted(line for line in lines if line.startswith("!! "))
    return nodes + findings + [line for line in lines if line not in nodes + findings]


def in_child(root_path):
    """`expected` in a process of its own, None when it takes too long or fails."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reader)
        signal.alarm(SECONDS)
        with os.fdopen(writer, "w") as file:
            file.write(repr(expected(root_path)))
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader) as file:
        text = file.read()
    _, status = os.waitpid(child, 0)
    return eval(text, {"__builtins__": {}}) if status == 0 else None


def difference(want, have):
    for prim in list(want) + [prim for prim in have if prim not in want]:
        if want.get(prim) != have.get(prim):
            return f"{prim}\n  OpenUSD: " + "\n           ".join(want.get(prim, ["absent"])) + \
                "\n  tenon:   " + "\n           ".join(have.get(prim, ["absent"]))
    return ""


def check_scene(arguments, seed):
    """-> "" (equal), what differs, or None (left out)."""
    folder = arguments.keep or tempfile.mkdtemp()
    folder = os.path.join(folder, f"scene{seed}")
    os.makedirs(folder, exist_ok=True)
    texts = Scene(seed).texts()
    for name, text in texts.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    root = os.path.join(folder, "l0.usda")
    want = in_child(root)
    result = None if want is None else difference(want, composed(arguments.dump, root))
    if not result:
        for name in texts:
            os.remove(os.path.join(folder, name))
        os.rmdir(folder)
    return result


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("dump")
    parser.add_argument("--scenes", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep")
    parser.add_argument("-v", action="store_true")
    arguments = parser.parse_args()
    equal, left_out, different = 0, 0, 0
    for seed in range(arguments.seed, arguments.seed + arguments.scenes):
        result = check_scene(arguments, seed)
        if result is None:
            left_out += 1
        elif result:
            different += 1
            print(f"scene {seed} differs at {result if arguments.v else result.split(chr(10))[0]}")
        else:
            equal += 1
    print(f"{equal} scenes equal, {different} differ, {left_out} left out")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
