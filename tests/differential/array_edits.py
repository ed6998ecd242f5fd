# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares edits of arrays (`int[] x = edit [append 1]`) with OpenUSD, on random layers.

usage: array_edits.py RETEXT RECRATE VALUE_AT FLATTEN [--scenes N] [--seed N] [--keep FOLDER]

text     both write the same text of a layer
binary   OpenUSD reads our binary layer, and we read OpenUSD's, as the text layer
values   edits over weaker edits, arrays, samples, blocks and fallbacks, at the default time, at
         samples and between them. OpenUSD's nan where it extrapolates, before the first sample that
         is no block, counts as equal to what we hold there; arrays of assets and path expressions,
         which OpenUSD does not edit, are compared as layers only.
         A block under edits holds until the next sample of its layer. So it does in OpenUSD at the
         time of the block; behind it OpenUSD passes over it (before an edit), or extrapolates what
         is left. There OpenUSD is asked again, with the block written at that time as well.
         A block alone, without an edit, is no matter of this test.
flat     what we flatten a scene to gives, in OpenUSD, the values of the scene: at the default time
         and at each sample. (OpenUSD's own flattening drops edits that meet a block.)
RETEXT, RECRATE, VALUE_AT and FLATTEN are built from tests/tools. Exit 77: no OpenUSD modules.
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
BATCH = 50
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


def opinion(rng, kind, strength):
    """A value; stronger layers rather edit."""
    chance = rng.random()
    if chance < 0.06:
        return "None"
    return edit(rng, kind) if chance < 0.35 + 0.55 * strength else array(rng, kind)


def attribute(rng, name, kind, strength):
    lines = []
    head = f"    {kind}[] {name}"
    if rng.random() < 0.6:
        lines.append(f"{head} = {opinion(rng, kind, strength)}\n")
    if rng.random() < 0.5:
        times = sorted(rng.sample((0, 1, 2, 2.5, 3, 4, 6, 7.5), rng.randint(1, 4)))
        samples = "".join(f"        {t}: {opinion(rng, kind, strength)},\n" for t in times)
        lines.append(f"{head}.timeSamples = {{\n{samples}    }}\n")
    return "".join(lines)


class Scene:
    """A root layer with sublayers, strongest first."""

    def __init__(self, seed, folder):
        rng = random.Random(seed)
        self.folder = folder
        os.mkdir(folder)
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


def layer_differences(scenes, programs, folder):
    """[what differs of the layers of a scene, as text and as binary ones] for each of `scenes`."""
    retext, recrate, *_ = programs
    files, crates, expected, owners = [], [], [], []
    for owner, scene in enumerate(scenes):
        for path in scene.layers:
            layer = Sdf.Layer.FindOrOpen(path)
            files.append(path)
            expected.append(layer.ExportToString())
            crates.append(path + ".usdc")
            layer.Export(crates[-1])
            owners.append(owner)
    found = [[] for _ in scenes]
    for what, given in (("text", files), ("OpenUSD's binary layer", crates)):
        into = tempfile.mkdtemp(dir=folder)
        run(retext, "--into", into, *given)
        for i, text in enumerate(expected):
            path = os.path.join(into, str(i))
            actual = read(path) if os.path.exists(path) else ""
            if actual != text:
                lines = [(a, b) for a, b in zip(text.split("\n"), actual.split("\n")) if a != b]
                name = os.path.basename(files[i])
                found[owners[i]].append(f"{what} {name}: expected {lines[:1] or text[-200:]}")
    into = tempfile.mkdtemp(dir=folder)
    run(recrate, "crate", into, *files)
    for i, text in enumerate(expected):
        path = os.path.join(into, f"{i}.usdc")
        layer = Sdf.Layer.OpenAsAnonymous(path) if os.path.exists(path) else None
        if layer is None or layer.ExportToString() != text:
            name = os.path.basename(files[i])
            found[owners[i]].append(f"our binary layer {name}: OpenUSD reads it otherwise")
    return found


def questions(attribute_object):
    times = attribute_object.GetTimeSamples()
    between = [(a + b) / 2 for a, b in zip(times, times[1:])]
    outside = [times[0] - 1, times[-1] + 1] if times else [5.0]
    return [None, *times, *between, *outside]


def asked_values(scene, stage):
    """[(attribute, kind, times)] of what OpenUSD gives values to."""
    for name, kind in scene.attributes:
        attribute_object = stage.GetPrimAtPath("/A").GetAttribute(name)
        if attribute_object and not attribute_object.GetResolveInfo().ValueIsBlocked():
            yield attribute_object, kind, questions(attribute_object)


def value_differences(scenes, value_at):
    """[what differs of the values of a scene] for each of `scenes`."""
    stages = [Usd.Stage.Open(scene.root) for scene in scenes]
    asked = [list(asked_values(scene, stage)) for scene, stage in zip(scenes, stages)]
    words = []
    for scene, attributes in zip(scenes, asked):
        words.append("@" + scene.root)
        for attribute_object, _, times in attributes:
            words.append(str(attribute_object.GetPath()))
            words += ["default" if time is None else repr(float(time)) for time in times]
    words[0] = words[0][1:]
    answers = iter(re.split(r"^\w+\t", run(value_at, *words), flags=re.MULTILINE)[1:])
    return [[text for question in attributes for text in wrong_answers(*question, answers)]
            for attributes in asked]


def blocks_in_force(attribute_object, time):
    """[(layer, path, time of the layer)] of the layers where a block holds at a time."""
    blocks = []
    if time is None:
        return blocks
    for spec, offset in attribute_object.GetPropertyStackWithLayerOffsets(time):
        samples = spec.layer.ListTimeSamplesForPath(spec.path)
        inner = offset.GetInverse() * time
        earlier = [sample for sample in samples if sample <= inner]
        held = max(earlier, default=min(samples, default=0))
        if isinstance(spec.layer.QueryTimeSample(spec.path, held), Sdf.ValueBlock):
            blocks.append((spec.layer, spec.path, inner))
    return blocks


def value_over(blocks, attribute_object, time):
    """What OpenUSD gives when the blocks stand at the time itself; None: the default time."""
    added = [(layer, path, inner) for layer, path, inner in blocks
             if inner not in layer.ListTimeSamplesForPath(path)]
    for layer, path, inner in added:
        layer.SetTimeSample(path, inner, Sdf.ValueBlock())
    value = attribute_object.Get() if time is None else attribute_object.Get(time)
    for layer, path, inner in added:
        layer.EraseTimeSample(path, inner)
    return value


def wrong_answers(attribute_object, kind, times, answers):
    first = min(attribute_object.GetTimeSamples(), default=None)
    for time in times:
        answer = next(answers, "").strip()
        blocks = blocks_in_force(attribute_object, time)
        expected = text_of(value_over(blocks, attribute_object, time),
                           attribute_object.GetTypeName())
        extrapolated = "nan" in expected and (blocks or time < first)
        if not (same_text(expected, answer) or extrapolated):
            name = attribute_object.GetName()
            yield f"{kind}[] {name} at {time}: expected {expected}, actual {answer}"


def flat_differences(scenes, flatten, folder):
    """[what differs of the flattened scenes] for each of `scenes`."""
    into = tempfile.mkdtemp(dir=folder)
    run(flatten, "stage", into, *[scene.root for scene in scenes])
    found = []
    for i, scene in enumerate(scenes):
        stage = Usd.Stage.Open(scene.root)
        attributes = list(asked_values(scene, stage))
        flat_stage = Usd.Stage.Open(os.path.join(into, f"{i}.usda"))
        flat = flat_stage.GetPrimAtPath("/A")
        found.append([text for attribute_object, kind, _ in attributes for text in
                      wrong_when_flat(attribute_object, kind, flat)])
    return found


def wrong_when_flat(attribute_object, kind, flat):
    name, type_name = attribute_object.GetName(), attribute_object.GetTypeName()
    actual = flat.GetAttribute(name)
    expected = attribute_object.GetTimeSamples()
    if actual.GetTimeSamples() != expected:
        yield f"{kind}[] {name}: samples {expected}, flattened {actual.GetTimeSamples()}"
        return
    for time in (None, *expected):
        blocks = blocks_in_force(attribute_object, time)
        want = text_of(value_over(blocks, attribute_object, time), type_name)
        have = text_of(value_over([], actual, time), type_name)
        if not same_text(want, have) and "nan" not in want:
            yield f"{kind}[] {name} at {time}: expected {want}, flattened {have}"


def judge(seeds, arguments, results):
    """Of some seeds at once: a program built with sanitizers takes long to start."""
    with tempfile.TemporaryDirectory() as folder:
        scenes = [Scene(seed, os.path.join(folder, str(seed))) for seed in seeds]
        layers = layer_differences(scenes, arguments.programs, folder)
        values = value_differences(scenes, arguments.programs[2])
        flat = flat_differences(scenes, arguments.programs[3], folder)
        for seed, scene, *found in zip(seeds, scenes, layers, values, flat):
            for what, texts in zip(("layers", "values", "flattened"), found):
                results.add(f"edits of arrays: {what}, against OpenUSD", f"{what} of seed {seed}",
                            texts[0] if texts else None)
            if arguments.keep and any(found):
                shutil.copytree(scene.folder, os.path.join(arguments.keep, str(seed)),
                                dirs_exist_ok=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("programs", nargs=4)
    parser.add_argument("--scenes", type=int, default=SCENES)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    results = suite.Results("array_edits", os.path.join(HERE, "array_edit_misses.txt"))
    seeds = range(arguments.seed, arguments.seed + arguments.scenes)
    for start in range(0, len(seeds), BATCH):
        judge(seeds[start:start + BATCH], arguments, results)
    whole = arguments.seed == 0 and arguments.scenes == SCENES
    sys.exit(results.finish(is_whole=whole))


if __name__ == "__main__":
    main()
