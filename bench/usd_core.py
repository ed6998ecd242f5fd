#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The same work through usd-core (OpenUSD's Python wheel), in the same JSON lines.

Usage: usd_core.py WORK FILE [--repeats N] [--dump-script FILE]
       usd_core.py convert FROM TO
       usd_core.py export FROM TO     opens FROM as a stage and writes it flattened
       usd_core.py tree FILE          prints the names of all prims

WORK: one_layer | compose | count_prims | suite | robots | asset | flatten | first_value | physics |
edit, whose FILE is a number of prims.
Imports are not timed. The phases parse, compose, open, flatten, export and physics run in OpenUSD's
C++; traverse, transforms, read_attributes and dump also measure Python.
"""

import argparse
import gc
import importlib.util
import json
import os
import resource
import sys
import time
import warnings

from pxr import Gf, Sdf, Tf, Usd, UsdPhysics
from pxr import UsdGeom  # also where it is not used: its schemas count as loaded for tenon, too

VISITED = Usd.PrimDefaultPredicate
WITH_PROXIES = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)


class Report:
    def __init__(self, workload):
        self.workload = workload
        self.phases, self.counts = {}, {}

    def time(self, phase, call):
        cpu, wall = time.process_time(), time.perf_counter()
        result = call()
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        laps = self.phases.setdefault(phase, {"wall": [], "cpu": []})
        laps["wall"].append(wall)
        laps["cpu"].append(cpu)
        return result

    def print(self):
        head = {"workload": self.workload}
        for phase, laps in self.phases.items():
            print(json.dumps({**head, "phase": phase, **laps}))
        for name, value in self.counts.items():
            print(json.dumps({**head, "count": name, "value": value}))
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        print(json.dumps({**head, "peak_rss_mb": round(peak, 1)}))


def time_traverse(report, stage, predicate):
    prims = report.time("traverse", lambda: list(stage.Traverse(predicate)))
    report.counts["prims"] = len(prims)
    return prims


def read_attributes(prims):
    attributes = values = 0
    for prim in prims:
        for attribute in prim.GetAuthoredAttributes():
            attributes += 1
            values += attribute.Get() is not None
    return attributes, values


def time_attributes(report, prims):
    counts = report.time("read_attributes", lambda: read_attributes(prims))
    report.counts["attributes"], report.counts["values"] = counts


def one_layer(report, file, _):
    layer = report.time("parse", lambda: Sdf.Layer.FindOrOpen(file))
    stage = report.time("compose", lambda: Usd.Stage.Open(layer))
    time_attributes(report, time_traverse(report, stage, VISITED))


def compose(report, file, _):
    stage = report.time("open", lambda: Usd.Stage.Open(file))
    time_traverse(report, stage, WITH_PROXIES)


def count_prims(report, file, _):
    stage = report.time("open", lambda: Usd.Stage.Open(file))
    report.counts["prims"] = report.time("traverse", lambda: sum(1 for _ in stage.Traverse()))


def open_all(files):
    stages = []
    for file in files:
        try:
            stages.append(Usd.Stage.Open(file))
        except Tf.ErrorException:
            pass
    return stages


def suite(report, file, _):
    with open(file, encoding="utf-8") as lines:
        files = lines.read().splitlines()
    stages = report.time("open", lambda: open_all(files))
    report.counts["stages"] = len(stages)
    report.counts["prims"] = sum(len(list(stage.Traverse(WITH_PROXIES))) for stage in stages)


def place_all(prims):
    cache, identity = UsdGeom.XformCache(), Gf.Matrix4d(1)
    return sum(cache.GetLocalToWorldTransform(prim) != identity for prim in prims)


def robots(report, file, _):
    stage = report.time("open", lambda: Usd.Stage.Open(file))
    prims = time_traverse(report, stage, WITH_PROXIES)
    report.counts["moved"] = report.time("transforms", lambda: place_all(prims))
    time_attributes(report, prims)


def asset(report, file, dumper):
    stage = report.time("open", lambda: Usd.Stage.Open(file))
    time_attributes(report, time_traverse(report, stage, WITH_PROXIES))
    report.time("flatten", lambda: stage.Flatten(addSourceFileComment=False).ExportToString())
    if dumper:
        report.time("dump", lambda: dumper(stage))


def flatten(report, file, _):
    stage = report.time("open", lambda: Usd.Stage.Open(file))
    layer = report.time("flatten", lambda: stage.Flatten(addSourceFileComment=False))
    text = report.time("export", layer.ExportToString)
    report.counts["bytes"] = len(text.encode())


def first_value(report, file, _):
    stage = report.time("open", lambda: Usd.Stage.Open(file))
    points = report.time("value", lambda: stage.GetAttributeAtPath("/World/Terrain.points").Get())
    report.counts["points"], report.counts["first"] = len(points), float(points[0][2])


def edit_prims(prims, edit, shows):
    shown = 0
    for path in prims:
        edit(path)
        shown += shows(path)
    return shown


def edit(report, file, _):
    stage = Usd.Stage.CreateInMemory()
    prims = [f"/World/g{i // 100}/p{i}" for i in range(int(os.path.basename(file)))]
    prim = stage.GetPrimAtPath

    def phase(name, change, shows):
        report.counts[name] = report.time(name, lambda: edit_prims(prims, change, shows))

    phase("define", lambda path: stage.DefinePrim(path, "Cube"),
          lambda path: prim(path).GetTypeName() == "Cube")
    phase("set", lambda path: prim(path).GetAttribute("size").Set(3.0),
          lambda path: prim(path).GetAttribute("size").Get() == 3.0)
    phase("apply", lambda path: prim(path).ApplyAPI(UsdPhysics.MassAPI),
          lambda path: prim(path).HasAPI(UsdPhysics.MassAPI))
    phase("set_again", lambda path: prim(path).GetAttribute("physics:mass").Set(2.0),
          lambda path: prim(path).GetAttribute("physics:mass").Get() == 2.0)


def physics(report, file, _):
    stage = report.time("open", lambda: Usd.Stage.Open(file))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the range form is deprecated; the other one is as fast
        found = report.time("physics", lambda: UsdPhysics.LoadUsdPhysicsFromRange(stage, ["/"]))
    count = {str(kind).rsplit(".", 1)[-1]: len(paths) for kind, (paths, _) in found.items()}
    report.counts["bodies"] = count.get("RigidBody", 0)
    report.counts["colliders"] = sum(n for kind, n in count.items() if kind.endswith("Shape"))
    report.counts["joints"] = sum(n for kind, n in count.items() if kind.endswith("Joint"))


WORKS = {work.__name__: work for work in (one_layer, compose, count_prims, suite, robots, asset,
                                          flatten, first_value, physics, edit)}


def dumper_of(script):
    """-> function(stage) -> text, of a dump script with a class Dumper; None without a script."""
    if not script:
        return None
    spec = importlib.util.spec_from_file_location("dump_stage", script)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    options = argparse.Namespace(builtins=False, stacks=False, xforms=False, full_arrays=256)
    return lambda stage: json.dumps(module.Dumper(stage, options).run(), indent=1)


def convert(source, target):
    layer = Sdf.Layer.FindOrOpen(source)
    return 0 if layer and layer.Export(target) else 1


def export(source, target):
    return 0 if Usd.Stage.Open(source).Export(target) else 1


def tree(file):
    stage = Usd.Stage.Open(file)  # kept: a range does not keep its stage
    for prim in stage.Traverse():
        print(prim.GetName())
    return 0


PROCESSES = {process.__name__: process for process in (convert, export, tree)}


def main():
    if sys.argv[1:2] and sys.argv[1] in PROCESSES:
        return PROCESSES[sys.argv[1]](*sys.argv[2:])
    parser = argparse.ArgumentParser()
    parser.add_argument("work", choices=WORKS)
    parser.add_argument("file")
    parser.add_argument("--repeats", type=int, default=1)
    parser.add_argument("--dump-script")
    arguments = parser.parse_args()
    report = Report(arguments.work)
    dumper = dumper_of(arguments.dump_script)
    gc.disable()
    for _ in range(arguments.repeats):
        WORKS[arguments.work](report, os.path.abspath(arguments.file), dumper)
    report.print()
    return 0


if __name__ == "__main__":
    sys.exit(main())
