#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares edits of arrays in value clips with OpenUSD, on random scenes: two clips over a weaker
layer with arrays or edits.

usage: array_edit_clips.py FLATTEN [--scenes N] [--seed N]

Both flatten the scene; defaults, times of samples and values at them must be equal. (Where a clip
is asked for one value OpenUSD leaves the weaker layer out in some cases, against what it flattens
to itself.) FLATTEN is tests/tools/flatten_files.cpp. Exit 77: no OpenUSD modules.
"""

import argparse
import os
import random
import sys
import tempfile

import array_edits
from array_edits import Sdf, Usd, suite

SCENES = 60
LABEL = "edits of arrays: in value clips, against OpenUSD"
ROOT = """def "A" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./c0.usda@, @./c1.usda@]
            double2[] active = [(0, 0), (5, 1)]
            string primPath = "/A"
            asset manifestAssetPath = @./manifest.usda@
        }
    }
    references = @./weak.usda@</A>
)
{
}
"""


def value(rng, kind):
    return array_edits.edit(rng, kind) if rng.random() < 0.6 else array_edits.array(rng, kind)


def samples(rng, kind):
    times = sorted(rng.sample((0, 1, 2, 2.5, 3, 4, 6, 7.5), rng.randint(1, 4)))
    return "{" + ", ".join(f"{time}: {value(rng, kind)}" for time in times) + "}"


def write_scene(seed, folder):
    """-> (root layer, [(attribute, kind)])"""
    rng = random.Random(seed)
    os.mkdir(folder)
    attributes = [(f"x{i}", kind)
                  for i, kind in enumerate(rng.sample(array_edits.COMPOSED, 3))]

    def write(name, text):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write("#usda 1.0\n" + text)

    def write_prim(name, specifier, suffix, said):
        body = "".join(f"    {kind}[] {attribute}{suffix}{said(kind)}\n"
                       for attribute, kind in attributes)
        write(name, f'{specifier} "A"\n{{\n{body}}}\n')

    for name in ("c0.usda", "c1.usda"):
        write_prim(name, "def", ".timeSamples = ", lambda kind: samples(rng, kind))
    write_prim("manifest.usda", "over", "", lambda kind: "")
    write_prim("weak.usda", "def", " = ", lambda kind: value(rng, kind))
    write("root.usda", ROOT)
    return os.path.join(folder, "root.usda"), attributes


def difference(root, ours, attributes):
    """What differs of what a scene flattens to; None."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.TransferContent(Usd.Stage.Open(root).Flatten(addSourceFileComment=False))
    stages = [Usd.Stage.Open(layer), Usd.Stage.Open(ours)]
    for name, kind in attributes:
        want, have = (stage.GetPrimAtPath("/A").GetAttribute(name) for stage in stages)
        if want.GetTimeSamples() != have.GetTimeSamples():
            return f"{name}: samples {want.GetTimeSamples()}, actual {have.GetTimeSamples()}"
        for time in (None, *want.GetTimeSamples()):
            texts = [array_edits.text_of(array_edits.value_over([], one, time), want.GetTypeName())
                     for one in (want, have)]
            if not array_edits.same_text(*texts):
                return f"{kind}[] {name} at {time}: expected {texts[0]}, actual {texts[1]}"
    return None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("flatten")
    parser.add_argument("--scenes", type=int, default=SCENES)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    results = suite.Results("array_edit_clips")
    seeds = range(arguments.seed, arguments.seed + arguments.scenes)
    with tempfile.TemporaryDirectory() as folder:
        scenes = [write_scene(seed, os.path.join(folder, str(seed))) for seed in seeds]
        into = tempfile.mkdtemp(dir=folder)
        array_edits.run(arguments.flatten, "stage", into, *[root for root, _ in scenes])
        for i, (seed, scene) in enumerate(zip(seeds, scenes)):
            ours = os.path.join(into, f"{i}.usda")
            results.add(LABEL, f"scene {seed}", difference(scene[0], ours, scene[1]))
    sys.exit(results.finish(is_whole=arguments.seed == 0 and arguments.scenes == SCENES))


if __name__ == "__main__":
    main()
