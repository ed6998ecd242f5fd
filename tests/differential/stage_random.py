#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares whole stages with OpenUSD's on the random scenes of random_scenes.py: prims, prototypes
and instance proxies, values at times through offsets, metadata, targets, spec stacks, findings.
Population masks and rules of loading are drawn on top.

usage: stage_random.py DUMP [--scenes N] [--seed S] [--keep FOLDER] [--show N]
                       [--measured] [--plain]

DUMP is the program tests/tools/stage_dump.cpp; what OpenUSD makes of the same stage is dumped by
openusd_stage.py. --plain: without masks and rules of loading. A scene that differs is cut down
while it still does and printed; the
other options are those of compose_random.py. Exit 77: no OpenUSD.
"""

import argparse
import json
import os
import random
import sys
import tempfile
import types

# Which instance a prototype is made from depends on the order of OpenUSD's threads, which shows
# where targets lead out of it. One thread has one order.
os.environ["PXR_WORK_THREAD_LIMIT"] = "1"

import compose_random  # noqa: E402  pylint: disable=wrong-import-position
import dump_stage  # noqa: E402  pylint: disable=wrong-import-position
import random_scenes  # noqa: E402  pylint: disable=wrong-import-position
from pxr import Sdf, Tf, Usd  # noqa: E402  pylint: disable=wrong-import-position

RULES = ("AllRule", "OnlyRule", "NoneRule")


def options_of(scene, seed):
    """A mask and rules of loading for one scene in some."""
    chance = random.Random(f"stage {seed}")
    paths = prim_paths(scene)
    options = dict(scene["options"])
    if paths and chance.random() < 0.3:
        options["mask"] = sorted({chance.choice(paths) for _ in range(chance.randint(1, 3))})
    if paths and chance.random() < 0.35:
        options.pop("load", None)
        rules = {chance.choice(paths): chance.choice(RULES) for _ in range(chance.randint(1, 4))}
        if chance.random() < 0.5:
            rules["/"] = chance.choice(RULES)
        options["rules"] = sorted(rules.items())
    return options


def prim_paths(scene):
    """Paths of the prims of all layers as if each layer was the root, and a few that are deeper."""
    paths, open_prims = [], [("", p) for layer in scene["layers"] for p in layer["prims"]]
    while open_prims:
        above, prim = open_prims.pop()
        words = prim["head"].split('"')
        path = above if prim["head"].startswith('"') else f"{above}/{words[1]}"
        paths.append(path)
        open_prims += [(path, kid) for kid in prim["kids"]]
        open_prims += [(path, v) for s in prim["sets"] for v in s["variants"]]
    paths += [f"{path}/{kid}" for path in paths[:] for kid in random_scenes.KIDS]
    return sorted(set(path for path in paths if path))


def load_rules(options):
    """As OpenUSD wants them; None: everything."""
    rules = Usd.StageLoadRules()
    if "load" in options:
        rules.SetRules([(Sdf.Path("/"), Usd.StageLoadRules.NoneRule)])
        for path in options["load"].get("loaded", []):
            rules.LoadWithDescendants(path)
        return rules
    if "rules" in options:
        rules.SetRules([(Sdf.Path(path), getattr(Usd.StageLoadRules, rule))
                        for path, rule in options["rules"]])
        return rules
    return None


def is_own_fault(error):
    return any(check in str(error) for check in ("Failed verification", "Null map function"))


def quietly(call, *arguments):
    """OpenUSD's checks of itself raise when the work is done."""
    try:
        call(*arguments)
    except Tf.ErrorException as error:
        if not is_own_fault(error):
            raise


def open_stage(folder, options):
    """The stage is taken from a cache: so it is there even where OpenUSD's own checks raise."""
    root = Sdf.Layer.FindOrOpen(os.path.join(folder, "l0.usda"))
    Usd.Stage.SetGlobalVariantFallbacks(options.get("fallbacks", {}))
    session = Sdf.Layer.CreateAnonymous()
    if "session" in options:
        session = Sdf.Layer.FindOrOpen(os.path.join(folder, options["session"]))
    rules = load_rules(options)
    load = Usd.Stage.LoadNone if rules is not None else Usd.Stage.LoadAll
    if "mask" in options:
        mask = Usd.StagePopulationMask([Sdf.Path(path) for path in options["mask"]])
        stage = Usd.Stage.OpenMasked(root, session, mask, load)
    else:
        cache = Usd.StageCache()
        with Usd.StageCacheContext(cache):
            quietly(Usd.Stage.Open, root, session, load)
        stage = cache.GetAllStages()[0]
    if "muted" in options:
        paths = [os.path.join(folder, name) for name in options["muted"]]
        quietly(stage.MuteAndUnmuteLayers, paths, [])
        quietly(compose_anew, stage)
    if rules is not None:
        quietly(stage.SetLoadRules, rules)
    return stage


def compose_anew(stage):
    """What OpenUSD found about absent layers before they were muted it keeps until something else
    makes it compose again: here other sublayers, then other prims."""
    sublayers = stage.GetSessionLayer().subLayerPaths
    other = Sdf.Layer.CreateAnonymous()
    Sdf.CreatePrimInLayer(other, "/other")
    sublayers.append(other.identifier)
    sublayers.remove(other.identifier)
    rules = stage.GetLoadRules()
    for each in (Usd.StageLoadRules.LoadNone(), rules):
        stage.SetLoadRules(each)


def expected(module, folder, options):
    """The dump; None when OpenUSD rejects a layer."""
    try:
        stage = open_stage(folder, options)
    except Tf.ErrorException as error:
        if is_own_fault(error):
            raise
        return None
    arguments = types.SimpleNamespace(stacks=True, builtins=False, xforms=False, full_arrays=256)
    return module.Dumper(stage, arguments).run()


def words_of(folder, options):
    words = compose_random.words_of(folder, options)
    words.remove("--nodes")
    for path in options.get("mask", []):
        words += ["--mask", path]
    for path, rule in options.get("rules", []):
        words += ["--rule", path, rule]
    return words


def actual(dumper, folder, options):
    status, printed = dumper.ask(words_of(folder, options))
    if status == 3:
        return None
    return json.loads("".join(printed)) if status == 0 else {"exit": status}


def without_unmasked(dump):
    """In OpenUSD a mask does not hold for the children of instances while indices are composed: it
    tells what is wrong with prims that are not there, and keeps prototypes that no prim uses."""
    dump["compositionErrors"] = []
    for name in [name for name in dump["prototypes"] if name.startswith("/__Prototype_")]:
        del dump["prototypes"][name]


class StageJudge(compose_random.Judge):
    """`options` of a scene as options_of() gives them."""

    def __init__(self, arguments, folder):
        super().__init__(arguments, folder)
        self.module = dump_stage.oracle_module()

    def compare(self, folder, options):
        answer, status = compose_random.in_child(lambda: [expected(self.module, folder, options)])
        if answer is None:
            return compose_random.failed(status)
        want, have = answer[0], actual(self.dumper, folder, options)
        self.prims += len(want["prims"]) if want else 0
        if want is None or have is None:
            text = "" if want == have else f"rejected by {'tenon' if want else 'OpenUSD'}"
        else:
            if "mask" in options:
                without_unmasked(want)
                without_unmasked(have)
            text = "\n".join(sorted(dump_stage.differences(want, have)))
        return compose_random.Result("differs" if text else "equal", text)


def make_scene(seed, plain):
    scene = random_scenes.make_scene(seed)
    if not plain:
        scene["options"] = options_of(scene, seed)
    return scene


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plain", action="store_true")
    arguments = compose_random.arguments_of(parser)
    with tempfile.TemporaryDirectory() as folder:
        judge = StageJudge(arguments, folder)
        return compose_random.judge_all(judge, arguments,
                                        lambda seed: make_scene(seed, arguments.plain), "stages")


if __name__ == "__main__":
    sys.exit(main())
