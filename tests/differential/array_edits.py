# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares edits of arrays (`int[] x = edit [append 1]`) with OpenUSD, on random layers.

usage: array_edits.py RETEXT RECRATE VALUE_AT [--scenes N] [--seed N] [--keep FOLDER]

text     both write the same text of a layer
binary   OpenUSD reads our binary layer, and we read OpenUSD's, as the text layer
values   edits over weaker edits, arrays, samples, blocks and fallbacks, at the default time, at
         samples and between them. OpenUSD's nan before the first sample counts as equal to what we
         hold there, the first value; arrays of assets and path expressions, which OpenUSD does not
         edit, are compared as layers only.
         Samples of weaker layers are no blocks: OpenUSD ends at them when it is asked at their time
         and passes over them at other times, here they hold like other samples.
         A block alone, without an edit, is no matter of this test.
RETEXT, RECRATE and VALUE_AT are built from tests/tools. Exit 77: no OpenUSD modules.
"""

import argparse
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "conformance"))
import suite  # noqa: E402  pylint: disable=wrong-import-position

os.environ["PXR_USDC_EMIT_DEPRECATION_WARNINGS"] = "0"  # read when OpenUSD is loaded
try:
    from pxr import Sdf, Usd
except ImportError:
    suite.skip("no OpenUSD modules in this Python")

SCENES = 200
NUMBER = re.compile(r"-?(?:\d+\.?\d*(?:e[+-]?\d+)?|inf|nan)")
TUPLES = {"float3": 3, "int2": 2, "quatd": 4, "color3f": 3, "half4": 4}
COMPOSED = ("int", "float", "double", "half", "token", "string", "bool", "uchar", "int64", "uint64",
            "matrix2d", "timecode", "duration", *TUPLES)
LAYERS_ONLY = ("asset", "pathExpression")
EXTENT = ("extent", "float3")  # has a fallback in spheres


def literal(rng, kind):
    if kind in TUPLES:
        return "(" + ", ".join(str(rng.randint(-3, 9)) for _ in range(TUPLES[kind])) + ")"
    if kind == "matrix2d":
        return f"((1, {rng.randint(0, 5)}), (0, {rng.randint(-5, 5)}.5))"
    if kind in ("token", "string"):
        return rng.choice(('"a"', '"b c"', "'q\"'", '""', '"""l\n"""'))
    if kind == "asset":
        return rng.choice(("@a.png@", "@@", "@./b.usd@", "@@@c@d@@@"))
    if kind == "pathExpression":
        return rng.choice(('"/A//*"', '"/B + /C"', '"//x"'))
    if kind == "bool":
        return rng.choice(("true", "false", "0", "1"))
    if kind in ("uchar", "uint64"):
        return str(rng.randint(0, 200))
    if kind in ("float", "double", "half", "timecode", "duration"):
        return rng.choice((str(rng.randint(-9, 9)), "0.5", "1.25", "-2.5e3", "7"))
    return str(rng.randint(-9, 99))


def statement(rng, kind):
    index = f"[{rng.choice((0, 0, 1, 2, 3, 5, -1, -1, -2, -4, 9))}]"
    given = index if rng.random() < 0.3 else literal(rng, kind)
    other = f"[{rng.randint(-3, 4)}]"
    size = rng.randint(0, 7)
    fill = f" fill {literal(rng, kind)}" if rng.random() < 0.6 else ""
    return rng.choice((f"write {given} to {other}", f"insert {given} at {other}",
                       f"prepend {given}", f"append {given}", f"append {given}", f"erase {index}",
                       f"minsize {size}{fill}", f"resize {size}{fill}", f"maxsize {size}"))


def edit(rng, kind):
    between = rng.choice(("; ", ";", "\n    ", " ; # c\n"))
    count = rng.choice((0, 1, 1, 2, 2, 3, 5, 12))
    return "edit [" + between.join(statement(rng, kind) for _ in range(count)) + "]"


def array(rng, kind):
    return "[" + ", ".join(literal(rng, kind) for _ in range(rng.randint(0, 5))) + "]"


def opinion(rng, kind, strength, may_block):
    """A value; stronger layers rather edit."""
    chance = rng.random()
    if chance < 0.06 and may_block:
        return "None"
    return edit(rng, kind) if chance < 0.35 + 0.55 * strength else array(rng, kind)


def attribute(rng, name, kind, strength):
    lines = []
    head = f"    {kind}[] {name}"
    if rng.random() < 0.6:
        lines.append(f"{head} = {opinion(rng, kind, strength, True)}\n")
    if rng.random() < 0.5:
        times = sorted(rng.sample((0, 1, 2, 2.5, 3, 4, 6, 7.5), rng.randint(1, 4)))
        samples = "".join(f"        {t}: {opinion(rng, kind, strength, strength == 1)},\n"
                          for t in times)
        lines.append(f"{head}.timeSamples = {{\n{samples}    }}\n")
    return "".join(lines)


class Scene:
    """A root layer with sublayers, strongest first."""

    def __init__(self, seed, folder):
        rng = random.Random(seed)
        self.folder = folder
        self.attributes = [(f"x{i}", kind) for i, kind in enumerate(rng.sample(COMPOSED, 4))]
        self.attributes.append(EXTENT)
        only = rng.choice(LAYERS_ONLY)
        count = rng.randint(1, 4)
        self.layers = []
        for i in range(count):
            strength = 1 - i / count
            body = "".join(attribute(rng, name, kind, strength) for name, kind in self.attributes)
            body += f"    {only}[] only = {edit(rng, only)}\n"
            self.layers.append(self.write(f"l{i}.usda",
                                          f'def Sphere "A"\n{{\n{body}}}\n'))
        offsets = [rng.choice(("", "", " (offset = 10; scale = 2)", " (scale = 0.5)"))
                   for _ in range(count)]
        listed = ",\n".join(f"        @./l{i}.usda@{offset}" for i, offset in enumerate(offsets))
        self.root = self.write("root.usda", f"(\n    subLayers = [\n{listed}\n    ]\n)\n")

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write("#usda 1.0\n" + text)
        return path


def text_of(value, type_name):
    """As text layers print it; "" for none."""
    if value is None:
        return ""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    spec = Sdf.AttributeSpec(Sdf.CreatePrimInLayer(layer, "/A"), "x", type_name)
    spec.default = value
    text = layer.ExportToString()
    return text[text.index(" x = ") + 5:].rsplit("}", 1)[0].strip()


def same_text(expected, actual):
    """Equal but for the last digits of numbers."""
    if NUMBER.sub("#", expected) != NUMBER.sub("#", actual):
        return False
    pairs = zip(NUMBER.findall(expected), NUMBER.findall(actual))
    return all(a == b or abs(float(a) - float(b)) <= 2e-3 * max(1, abs(float(a)))
               for a, b in pairs)


def read(path):
    with open(path, "rb") as file:
        return file.read().decode("utf-8", "surrogateescape")


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"{program} ended with {done.returncode}: {done.stderr[-2000:]}")
    return done.stdout


def layer_differences(scene, programs):
    """Of the layers as text and as binary ones."""
    retext, recrate, _ = programs
    into = os.path.join(scene.folder, "out")
    crates = []
    expected = []
    for path in scene.layers:
        layer = Sdf.Layer.FindOrOpen(path)
        expected.append(layer.ExportToString())
        crates.append(path + ".usdc")
        layer.Export(crates[-1])
    for what, files in (("text", scene.layers), ("OpenUSD's binary layer", crates)):
        os.makedirs(into, exist_ok=True)
        run(retext, "--into", into, *files)
        for i, text in enumerate(expected):
            path = os.path.join(into, str(i))
            actual = read(path) if os.path.exists(path) else ""
            if actual != text:
                lines = [(a, b) for a, b in zip(text.split("\n"), actual.split("\n")) if a != b]
                yield f"{what} {i}: expected {lines[:1] or text[-200:]}"
        shutil.rmtree(into)
    os.makedirs(into)
    run(recrate, "crate", into, *scene.layers)
    for i, text in enumerate(expected):
        path = os.path.join(into, f"{i}.usdc")
        layer = Sdf.Layer.OpenAsAnonymous(path) if os.path.exists(path) else None
        if layer is None or layer.ExportToString() != text:
            yield f"our binary layer {i}: OpenUSD reads it otherwise"


def questions(attribute_object):
    times = attribute_object.GetTimeSamples()
    between = [(a + b) / 2 for a, b in zip(times, times[1:])]
    outside = [times[0] - 1, times[-1] + 1] if times else [5.0]
    return [None, *times, *between, *outside]


def value_differences(scene, value_at):
    stage = Usd.Stage.Open(scene.root)
    for name, kind in scene.attributes:
        asked = stage.GetPrimAtPath("/A").GetAttribute(name)
        if not asked or asked.GetResolveInfo().ValueIsBlocked():
            continue
        times = questions(asked)
        words = ["default" if time is None else repr(float(time)) for time in times]
        out = run(value_at, scene.root, f"/A.{name}", *words)
        actual = re.split(r"^\w+\t", out, flags=re.MULTILINE)[1:]
        first = min((time for time in asked.GetTimeSamples()), default=None)
        for time, answer in zip(times, actual):
            value = asked.Get() if time is None else asked.Get(time)
            expected = text_of(value, asked.GetTypeName())
            early = time is not None and first is not None and time < first
            if not (same_text(expected, answer.strip()) or early and "nan" in expected):
                yield f"{kind}[] {name} at {time}: expected {expected}, actual {answer.strip()}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", nargs=3)
    parser.add_argument("--scenes", type=int, default=SCENES)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    results = suite.Results("array_edits", os.path.join(HERE, "array_edit_misses.txt"))
    for seed in range(arguments.seed, arguments.seed + arguments.scenes):
        with tempfile.TemporaryDirectory() as folder:
            scene = Scene(seed, folder)
            found = list(layer_differences(scene, arguments.programs))
            results.add("edits of arrays: layers, against OpenUSD", f"layers of seed {seed}",
                        found[0] if found else None)
            values = list(value_differences(scene, arguments.programs[2]))
            results.add("edits of arrays: values, against OpenUSD", f"values of seed {seed}",
                        values[0] if values else None)
            if arguments.keep and (found or values):
                shutil.copytree(folder, os.path.join(arguments.keep, str(seed)),
                                dirs_exist_ok=True)
    whole = arguments.seed == 0 and arguments.scenes == SCENES
    sys.exit(results.finish(is_whole=whole))


if __name__ == "__main__":
    main()
