#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Random (prim, property, time): what `tenon where` and `tenon explain` name as the opinion that
gives the value is the one that gives it.

usage: value_traces.py TENON TRACE [--seeds FIRST COUNT] [--show N]

Scenes of tests/differential/value_scenes.py, and MixedScene, which has it all: sublayers and
references with offsets, variants, clips, splines, blocks, edits of arrays, fallbacks of schemas.
TRACE is tests/tools/trace_values.cpp: the value, its trace, and the value that the winning opinions
give alone, all others taken out of the layers. All four must tell the same.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "differential"))
import value_scenes  # noqa: E402  pylint: disable=wrong-import-position

SEEDS = (0, 96)  # first, count
TRIPLES = 12  # of each scene
TIMES = (-3, 0, 1, 2.5, 5, 7, 10, 12.5, 14, 21, 30, 110)


class MixedScene(value_scenes.ClipScene):
    """Everything at once, on a prim whose schema has fallbacks."""

    KINDS = ("double", "double", "float", "float3", "int", "double[]", "int[]", "token")

    def value(self, kind, size=None):
        if kind.endswith("[]") and self.chance(0.4):
            return f"edit [append {self.scalar(kind[:-2])}]"
        return super().value(kind, size)

    def opinions(self, share):
        rows = []
        for name, kind in [*self.attributes, ("size", "double")]:
            if not self.chance(share / 3 if name == "size" else share):
                continue
            value = self.random.choice(("", " = None", " = AnimationBlock", *[" = V"] * 4))
            rows.append(f"{kind} {name}" + value.replace("V", self.value(kind)))
            if self.chance(0.25):
                rows.append(f"{kind} {name}.timeSamples = {self.samples(kind)}")
            elif kind in value_scenes.SPLINE_TYPES and self.chance(0.4):
                rows.append(f"{kind} {name}.spline = {self.spline()}")
        return "\n".join(rows)

    def host(self, name, sublayers, arcs, clips, declares):
        rows = list(arcs)
        if clips and self.chance(0.4):
            rows += self.clip_metadata(clips)
        rows += ['variants = { string v = "one" }', 'prepend variantSets = "v"']
        listed = ", ".join(f"@{layer}@{self.offset()}" for layer in sublayers)
        head = f"(\nstartTimeCode = {self.random.choice(TIMES)}\nsubLayers = [{listed}]\n)\n"
        chosen = "\n".join(f'"{variant}" {{\n{self.opinions(0.3)}\n}}'
                           for variant in ("one", "two"))
        below = f'def Cube "B"\n{{\n{self.opinions(0.5)}\n}}\n'
        self.write(name, f'#usda 1.0\n{head}def Cube "A" (\n' + "\n".join(rows) + "\n)\n{\n" +
                   f'{self.opinions(0.4)}\n{below}variantSet "v" = {{\n{chosen}\n}}\n}}\n' +
                   f'class "C"\n{{\n{self.opinions(0.3)}\n}}\n')


def make_scene(seed, folder):
    """-> (path, {attribute path: times})"""
    rng = random.Random(seed)
    folder = os.path.join(folder, str(seed))
    os.makedirs(folder)
    kind = (value_scenes.Scene, value_scenes.ClipScene, MixedScene)[seed % 3]
    scene = kind(rng, folder)
    path = scene.make()
    names = [name for name, _ in scene.attributes] + ["size"] * 2 * (kind is MixedScene)
    questions = {}
    for _ in range(TRIPLES):
        attribute = f"{rng.choice(('/A', '/A', '/A/B'))}.{rng.choice(names)}"
        questions.setdefault(attribute, set()).add(rng.choice(("default", *TIMES, *TIMES)))
    return path, {attribute: sorted(times, key=str) for attribute, times in questions.items()}


def run(words):
    process = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                             check=False, timeout=60)
    return process.returncode, process.stdout, process.stderr


def answer_of(words):
    """What a verb says in JSON; None where it knows no such property."""
    code, out, error = run([*words, "--json"])
    if code == 2:
        return None
    try:
        return json.loads(out)
    except json.JSONDecodeError:
        raise AssertionError(f"{words}: exit {code}: {error}") from None


def named(row):
    """An opinion as each of the four names it."""
    place = None if row["file"] is None else os.path.realpath(row["file"])
    clip = row.get("clip")
    return (place, row["path"], row["what"], row.get("clipSet", row.get("set")),
            clip and os.path.realpath(clip))


def said_by_where(answer, time):
    """(the opinions that win, those that have a part in the value, at this time or another)"""
    wins = {"wins", "wins at the default time" if time is None else "wins at times"}
    rows = [row for row in answer["opinions"] if row["what"] != "connectionPaths"]
    return ([named(row) for row in rows if row["verdict"] in wins],
            [named(row) for row in rows
             if row["verdict"] == "combined" or row["verdict"].startswith("wins")])


def difference(tenon, traced):
    """What is wrong with the answers about one triple; None."""
    path, attribute, time = traced["layer"], traced["attribute"], traced["time"]
    if not traced["value"] == traced["traced"] == traced["alone"]:
        return f"value {traced['value']}, traced {traced['traced']}, alone {traced['alone']}"
    rows = traced["opinions"]
    wins = [named(row) for row in rows if row["role"] == "wins"]
    combined = [named(row) for row in rows if row["role"] == "combined"]
    asked = [] if time is None else ["--time", time]
    where = answer_of([tenon, "where", path, attribute, *asked])
    if where is None:
        return "where knows no such property"
    if len(wins) > 1 or (wins and wins[0][2] != traced["source"] and not combined and
                         traced["value"] is not None):
        return f"winners {wins} of the source {traced['source']}"
    told, together = said_by_where(where, time)
    if told != wins or not set(combined) <= set(together):
        return f"where names {told} and {together}, the trace {wins} and {combined}"
    return None


def explain_difference(tenon, traced):
    """The same about `explain`, which answers for the time where physics starts."""
    explained = answer_of([tenon, "explain", traced["layer"], traced["attribute"]])
    if explained is None:
        return "explain knows no such property"
    used = [named(row) for row in explained["opinions"] if row["used"]]
    expected = [named(row) for row in traced["opinions"]
                if row["role"] in ("wins", "combined") and row["what"] != "fallback"]
    if used != expected or explained["value"] != traced["value"]:
        return (f"explain names {used} for {explained['value']}, the trace {expected} for "
                f"{traced['value']} at {traced['time']}")
    return None


def start_of(layer):
    """The start time code of a root layer; explain reads values there."""
    for line in pathlib.Path(layer).read_text(encoding="utf-8").splitlines():
        if line.startswith("startTimeCode = "):
            return line.split(" = ")[1]
        if line.startswith(("def", "over", "class")):
            break
    return "0"


def check_scene(arguments, seed, folder):
    """(triples, kinds of the winners, lines about what is wrong)"""
    path, questions = make_scene(seed, folder)
    words = [arguments.trace, path]
    for attribute, times in questions.items():
        words += [attribute, *times, start_of(path)]
    code, out, error = run(words)
    if code:
        return 0, [], [f"seed {seed}: exit {code}: {error}"]
    # Clips give values to names that no layer declares; no verb takes these for properties.
    traces = [trace for trace in map(json.loads, out.splitlines()) if trace["defined"]]
    at_start = {}
    wrong, kinds, count = [], [], 0
    for traced in traces:
        at_start[traced["attribute"]] = traced  # the last time of each is the start
    for attribute, traced in at_start.items():
        text = explain_difference(arguments.tenon, traced)
        if text:
            wrong.append(f"seed {seed} {attribute}: {text}")
    for traced in traces:
        if traced is at_start[traced["attribute"]]:
            continue
        count += 1
        kinds += [row["what"] for row in traced["opinions"] if row["role"] == "wins"]
        text = difference(arguments.tenon, traced)
        if text:
            wrong.append(f"seed {seed} {traced['attribute']} at {traced['time']}: {text}")
    return count, kinds, wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tenon")
    parser.add_argument("trace")
    parser.add_argument("--seeds", nargs=2, type=int, default=SEEDS)
    parser.add_argument("--show", type=int, default=10)
    arguments = parser.parse_args()
    first, count = arguments.seeds
    triples, kinds, wrong = 0, [], []
    with tempfile.TemporaryDirectory() as folder:
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            jobs = [pool.submit(check_scene, arguments, seed, folder)
                    for seed in range(first, first + count)]
            for job in jobs:
                done, winners, lines = job.result()
                triples, kinds, wrong = triples + done, kinds + winners, wrong + lines
    for line in wrong[:arguments.show]:
        print(line)
    counted = {kind: kinds.count(kind) for kind in sorted(set(kinds))}
    print(f"{triples} values, {len(wrong)} wrong; winners: {counted}")
    # A generator that makes none of a kind compares nothing.
    full = tuple(arguments.seeds) == SEEDS
    missing = {"default", "timeSamples", "spline", "valueClips", "fallback"} - set(kinds)
    if full and (missing or triples < 1000):
        print(f"too few: none of {sorted(missing)}")
        return 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
