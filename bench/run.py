#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the benchmarks beside usd-core and prints a table; see bench/README.md.

Usage: run.py [NAME...] [--build DIR] [--rounds N] [--repeats N] [--record] [--smoke]
Exit 0: all ran, whatever the times; 1: a program failed or the two sides counted differently.
"""

import argparse
import functools
import importlib.util
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

import converters
import inputs
import machine

BENCH = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(BENCH)
HAND = os.path.join(ROOT, "examples/inspire_hand/inspire_hand.usda")
GRASP = os.path.join(ROOT, "examples/inspire_hand/grasp.usda")
SHARED = os.environ.get("TENON_SHARED_DIR", os.path.join(os.path.dirname(ROOT), "shared"))
ISAAC_HAND = os.path.join(SHARED, "assets/inspire_hand_isaac/inspire_hand.usda")
CONFORMANCE = os.path.join(SHARED, "conformance")
SCENE_SCRIPT = os.path.join(SHARED, "bench/gen_scenes.py")
DUMP_SCRIPT = os.path.join(SHARED, "tools/dump_stage.py")
PEER = [sys.executable, "-B", os.path.join(BENCH, "usd_core.py")]

# What the two sides call the same work; `*` marks peers that also measure Python.
LAYER_ROWS = [
    ("parse", "parse", ""),
    ("compose", "compose", ""),
    ("traverse", "traverse", "*"),
    ("read_attributes", "read_attributes", "*"),
]
ASSET_ROWS = [
    ("open", "open", ""),
    ("read_attributes", "read_attributes", "*"),
    ("dump", "flatten", ""),
    ("dump", "dump", "*"),
]


ROBOT_ROWS = [
    ("open", "open", ""),
    ("traverse", "traverse", "*"),
    ("transforms", "transforms", "*"),
    ("read_attributes", "read_attributes", "*"),
]


class Failure(Exception):
    pass


class Workload:
    """One program of ours and the peer's program, on one file."""

    def __init__(self, name, ours, peer, rows, repeats=3):
        self.name, self.ours, self.peer, self.rows = name, ours, peer, rows
        self.repeats = repeats


class Run:
    """A process that has ended: what it printed, seconds, peak memory [MB]."""

    def __init__(self, command, cpu=None, threads=1):
        environment = dict(os.environ)
        if threads:
            environment["PXR_WORK_THREAD_LIMIT"] = str(threads)
        pin = functools.partial(os.sched_setaffinity, 0, {cpu}) if cpu is not None else None
        with tempfile.TemporaryFile("w+") as printed:
            start = time.perf_counter()
            process = subprocess.Popen(command, env=environment, preexec_fn=pin,
                                       stdout=printed, stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
            self.wall = time.perf_counter() - start
            process.returncode = os.waitstatus_to_exitcode(status)
            self.cpu = usage.ru_utime + usage.ru_stime
            self.peak = usage.ru_maxrss / 1024
            printed.seek(0)
            self.output = printed.read()
        if process.returncode != 0:
            tail = "\n".join(self.output.strip().split("\n")[-12:])
            raise Failure(f"{' '.join(command)}: exit {process.returncode}\n{tail}")


def run_program(command, cpu=None, threads=1):
    """Runs a command; -> what it printed."""
    return Run(command, cpu, threads).output


def run_lines(command, cpu=None, threads=1):
    """Runs a program of the benchmarks; -> its JSON lines."""
    lines = run_program(command, cpu, threads).split("\n")
    return [json.loads(line) for line in lines if line.startswith("{")]


class Figures:
    """Laps by phase, counts and peak memory of one side, over all rounds."""

    def __init__(self):
        self.phases, self.counts, self.peak = {}, {}, 0

    def add(self, lines):
        for line in lines:
            if "phase" in line:
                self.phases.setdefault(line["phase"], []).append(line)
            elif "count" in line:
                self.counts[line["count"]] = line["value"]
            elif "peak_rss_mb" in line:
                self.peak = max(self.peak, line["peak_rss_mb"])

    def median(self, phase, clock):
        """Median over the rounds of the median of a round [s]; None for an unknown phase."""
        rounds = self.phases.get(phase)
        if not rounds:
            return None
        return statistics.median(statistics.median(line[clock]) for line in rounds)


class Bench:
    def __init__(self, arguments):
        self.arguments = arguments
        self.programs = os.path.join(arguments.build, "bin/bench")
        self.scenes = os.path.join(arguments.build, "bench_scenes")
        self.peer = importlib.util.find_spec("pxr") is not None
        self.cpu = max(os.sched_getaffinity(0))
        self.rows, self.failures = [], []

    def program(self, name):
        return os.path.join(self.programs, name)

    def scene(self, name):
        return os.path.join(self.scenes, name)

    def make_scenes(self):
        size = ["--tiny"] if self.arguments.smoke else []
        run_lines([self.program("make_scenes"), self.scenes, *size])
        if self.peer:
            for name in ("prims", "physics", "mesh"):
                files = [self.scene(name + suffix) for suffix in (".usda", ".usdc")]
                run_lines([*PEER, "convert", *files])
        self.robots, self.turned_robots = {}, {}
        for name, file in (("hand", HAND), ("isaac_hand", ISAAC_HAND)):
            if os.path.exists(file):
                self.robots[name] = self.scene(f"robots_{name}.usda")
                self.turned_robots[name] = self.scene(f"turned_{name}.usda")
                inputs.write_robots(self.robots[name], file, 2 if size else 64)
                inputs.write_robots(self.turned_robots[name], file, 2 if size else 64, turned=True)
        suite = self.scene("composition_suite.txt")
        found = os.path.exists(CONFORMANCE) and inputs.write_suite_list(
            suite, CONFORMANCE, 6 if size else None)
        self.suite = suite if found else None
        published = self.peer and not size and os.path.exists(SCENE_SCRIPT) and \
            inputs.make_published_scenes(SCENE_SCRIPT, self.scene("published"))
        self.published = self.scene("published") if published else None

    def add_row(self, workload, label, ours, peer, threads=(None, None), note="", unit=1e3):
        """Seconds on one thread, and in `threads` those of both sides with all of theirs."""
        figures = [figure and figure * unit for figure in (ours, peer, *threads)]
        keys = ("tenon_ms", "peer_ms", "tenon_threads_ms", "peer_threads_ms")
        self.rows.append({"workload": workload, "phase": label, **dict(zip(keys, figures)),
                          "ratio": ours / peer if ours and peer else None, "note": note})

    def add_memory_row(self, workload, ours, peer):
        self.rows.append({"workload": workload, "phase": "peak memory", "tenon_mb": ours,
                          "peer_mb": peer or None, "ratio": ours / peer if peer else None})

    def measure(self, work):
        """A B A B ... on one processor; in the last columns both with all their threads."""
        ours, peer, threaded, peer_threaded = Figures(), Figures(), Figures(), Figures()
        repeats = ["--repeats", str(self.arguments.repeats or work.repeats)]
        for number in range(self.arguments.rounds):
            ours.add(run_lines([*work.ours, *repeats], self.cpu))
            if self.arguments.threads and number < 3:
                threaded.add(run_lines([*work.ours, *repeats], None, None))
            if self.peer and work.peer:
                peer.add(run_lines([*PEER, *work.peer, *repeats], self.cpu))
                if self.arguments.threads and number < 3:
                    peer_threaded.add(run_lines([*PEER, *work.peer, *repeats], None, None))
        self.compare_counts(work.name, ours.counts, peer.counts)
        clock = self.arguments.clock
        for own, other, note in work.rows:
            if ours.median(own, clock) is None:
                raise Failure(f"{work.name}: no phase {own}")
            label = own if own == other else f"{own} : {other}"
            if other not in peer.phases and own != other:
                continue
            threads = (threaded.median(own, "wall"), peer_threaded.median(other, "wall"))
            self.add_row(work.name, label, ours.median(own, clock), peer.median(other, clock),
                         threads, note)
        self.add_memory_row(work.name, ours.peak, peer.peak)

    def compare_counts(self, name, ours, peer):
        for key in sorted(ours.keys() & peer.keys()):
            if ours[key] != peer[key]:
                self.failures.append(f"{name}: {key}: tenon {ours[key]:g}, usd-core {peer[key]:g}")

    def measure_steps(self, name, program, note, *arguments):
        """Steps through our interface and through plain calls of an engine, in one process."""
        figures = Figures()
        tiny = ["--chunk", "5", "--chunks", "2"] if self.arguments.smoke else []
        for _ in range(self.arguments.rounds):
            figures.add(run_lines([self.program(program), *arguments, *tiny], self.cpu))
        steps = figures.counts["steps_per_lap"]
        clock = self.arguments.clock
        ours, plain = (figures.median(key, clock) / steps for key in ("tenon", "plain"))
        # Neighbours in time are compared, so that a machine that slows down does so for both.
        ratios = [a / b for our_lines, plain_lines in
                  zip(figures.phases["tenon"], figures.phases["plain"])
                  for a, b in zip(our_lines[clock], plain_lines[clock])]
        self.add_row(name, "one step [us]", ours, plain, note=note, unit=1e6)
        self.rows[-1]["ratio"] = statistics.median(ratios)
        self.rows[-1]["steps_per_second"] = 1 / ours

    def measure_processes(self, name, ours, peer, note):
        """Whole processes, start and imports included."""
        runs = {0: [], 1: []}
        for _ in range(self.arguments.rounds):
            for side, command in enumerate((ours, peer)):
                if command and (side == 0 or self.peer):
                    runs[side].append(Run(command, self.cpu))
        clock = self.arguments.clock
        medians = [statistics.median(getattr(run, clock) for run in runs[side])
                   if runs[side] else None for side in (0, 1)]
        self.add_row(name, "process", *medians, note=note)
        peaks = [max((run.peak for run in runs[side]), default=0) for side in (0, 1)]
        self.add_memory_row(name, *peaks)

    def measure_pairs(self, name, tenon, file):
        """Whole processes that look for pairs of bodies that touch; with all threads in MT."""
        command = [tenon, "pairs", file, "--json", "--sample",
                   "10" if self.arguments.smoke else "10000"]
        clock = self.arguments.clock
        one = [Run(command, self.cpu) for _ in range(self.arguments.rounds)]
        every = [Run(command, None, None) for _ in one[:3] if self.arguments.threads]
        self.add_row(name, "process", statistics.median(getattr(run, clock) for run in one), None,
                     (statistics.median(run.wall for run in every) if every else None, None),
                     "10,000 postures")
        self.add_memory_row(name, max(run.peak for run in one), 0)

    def measure_million(self, name, tenon, note):
        """Whole processes that open many prims with two attributes each."""
        file = inputs.make_many_prims(self.program("complexity"), self.scene("million"),
                                      100 if self.arguments.smoke else 1000000)
        file += {"million_text": ".usda", "million_crate": ".usdc"}[name]
        self.measure_processes(name, [tenon, "info", file], [*PEER, "count_prims", file],
                               "open and traverse only, " + note)


def layer_files(bench):
    """-> (what it is called, file) of the scenes of many prims."""
    yield "text", bench.scene("prims.usda")
    if bench.peer:  # which also made the binary layers
        yield "crate", bench.scene("prims.usdc")
    if bench.published:
        yield "big20k_text", os.path.join(bench.published, "big20k.usda")
        yield "big20k_crate", os.path.join(bench.published, "big20k.usdc")


def layer_workloads(bench):
    program, scene = bench.program, bench.scene
    files = list(layer_files(bench)) + [("mesh_text", scene("mesh.usda"))]
    if bench.peer:
        files.append(("mesh_crate", scene("mesh.usdc")))
    for name, file in files:
        ours = "open_crate" if file.endswith(".usdc") else "open_text"
        yield Workload(f"open_{name}", [program(ours), file], ["one_layer", file], LAYER_ROWS)
    if bench.peer:
        yield Workload("first_value", [program("first_value"), scene("mesh.usdc")],
                       ["first_value", scene("mesh.usdc")],
                       [("open", "open", ""), ("value", "value", "")])


def flatten_workloads(bench):
    rows = [(phase, phase, "") for phase in ("open", "flatten", "export")]
    for name, file in layer_files(bench):
        yield Workload(f"flatten_{name}", [bench.program("flatten_stage"), file],
                       ["flatten", file], rows)


def workloads(bench):
    program, scene = bench.program, bench.scene
    yield from layer_workloads(bench)
    yield from flatten_workloads(bench)
    for name in ("fleet", "instances"):
        yield Workload(f"compose_{name}", [program("compose_many"), scene(name + ".usda")],
                       ["compose", scene(name + ".usda")], LAYER_OPEN_ROWS)
    if bench.suite:
        yield Workload("compose_suite", [program("compose_suite"), bench.suite],
                       ["suite", bench.suite], [("open", "open", "")])
    for name, file in bench.robots.items():
        yield Workload(f"robots_{name}", [program("read_robots"), file], ["robots", file],
                       ROBOT_ROWS)
    yield Workload("read_physics", [program("read_physics"), scene("physics.usda")],
                   ["physics", scene("physics.usda")],
                   [("open", "open", ""), ("physics", "physics", "")])
    for kind, robots in (("physics", bench.robots), ("physics_turned", bench.turned_robots)):
        for name, file in robots.items():
            yield Workload(f"{kind}_{name}", [program("read_physics"), file], ["physics", file],
                           [("physics", "physics", "")])
    edits = "200" if bench.arguments.smoke else "6400"
    yield Workload("edit_stage", [program("edit_stage"), edits], ["edit", edits],
                   [(phase, phase, "*") for phase in ("define", "set", "apply", "set_again")])
    triangles = "2000" if bench.arguments.smoke else "1000000"
    yield Workload("mesh_mass", [program("mesh_mass"), triangles], None,
                   [(phase, phase, "") for phase in ("copy", "closed", "integrals")])
    script = ["--dump-script", DUMP_SCRIPT] if os.path.exists(DUMP_SCRIPT) else []
    for name, file in (("open_hand", HAND), ("open_isaac_hand", ISAAC_HAND)):
        if os.path.exists(file):
            yield Workload(name, [program("open_hand"), file], ["asset", file, *script],
                           ASSET_ROWS, repeats=10)


LAYER_OPEN_ROWS = [("open", "open", ""), ("traverse", "traverse", "*")]


def process_tasks(bench):
    tenon = os.path.join(bench.arguments.build, "bin/tenon")
    if not os.path.exists(tenon):
        return
    imports = "Python's start included"
    yield ("start", bench.measure_processes, [tenon, "tree", bench.scene("one_prim.usda")],
           [*PEER, "tree", bench.scene("one_prim.usda")], imports)
    for name, file in layer_files(bench):
        flat = bench.scene(f"flat_{name}.usda")
        yield (f"export_{name}", bench.measure_processes,
               [tenon, "cat", "--flatten", file, "-o", flat],
               [*PEER, "export", file, flat], imports)
    for name, work, ours, file in (
            [(f"process_robots_{name}", "robots", "read_robots", file)
             for name, file in bench.robots.items()] +
            [("process_suite", "suite", "compose_suite", bench.suite)] * bool(bench.suite)):
        yield (name, bench.measure_processes, [bench.program(ours), file], [*PEER, work, file],
               imports)
    if bench.peer:
        for name in ("million_text", "million_crate"):
            yield (name, bench.measure_million, tenon, imports)
        yield ("value_mesh_crate", bench.measure_processes,
               [bench.program("first_value"), bench.scene("mesh.usdc")],
               [*PEER, "first_value", bench.scene("mesh.usdc")], imports)
    bodies = bench.scene("physics.usda")
    yield ("physics_json", bench.measure_processes, [tenon, "--json", "physics", bodies],
           [*PEER, "physics", bodies], "usd-core writes no JSON; " + imports)
    for name, file in (("hand", HAND), ("isaac_hand", ISAAC_HAND)):
        if not os.path.exists(file):
            continue
        if os.path.exists(bench.program("step_mujoco")):  # whose shapes pairs are of
            yield f"pairs_{name}", bench.measure_pairs, tenon, file
        yield (f"info_{name}", bench.measure_processes, [tenon, "--json", "info", file],
               [*PEER, "asset", file], "open only, " + imports)
        if os.path.exists(DUMP_SCRIPT):
            yield (f"dump_{name}", bench.measure_processes, [tenon, "dump", file, "-o", os.devnull],
                   [sys.executable, "-B", DUMP_SCRIPT, file, "-o", os.devnull], "*")


def tasks(bench):
    """-> (name, function, arguments...)"""
    for work in workloads(bench):
        yield work.name, lambda name, work=work: bench.measure(work)
    pile = os.path.join(bench.scenes, "pile.usda")
    if os.path.exists(bench.program("step_mujoco")):
        plain = ("step_mujoco", "plain MuJoCo")
        yield "step_hand", bench.measure_steps, *plain, HAND
        yield "step_grasp", bench.measure_steps, *plain, GRASP
        if os.path.exists(ISAAC_HAND):
            yield "step_isaac_hand", bench.measure_steps, *plain, ISAAC_HAND
    if os.path.exists(bench.program("step_physx")):
        plain = ("step_physx", "plain PhysX")
        yield "step_physx_hand", bench.measure_steps, *plain, HAND
        yield "step_physx_grasp", bench.measure_steps, *plain, GRASP
        yield "step_physx_pile", bench.measure_steps, *plain, pile
    if os.path.exists(bench.program("step_jolt")):
        yield "step_jolt_pile", bench.measure_steps, "step_jolt", "plain Jolt", pile
    yield from process_tasks(bench)
    yield from converters.tasks(bench, ROOT, SHARED)


def number(value, form="10.3f"):
    return " " * int(form.split(".")[0]) if value is None else f"{value:{form}}"


def print_table(bench):
    titles = ("tenon", "usd-core", "ratio", "tenon MT", "usd MT")
    print(f"\n{'workload':<26}{'phase':<22}" + "".join(f"{title:>10}" for title in titles))
    for row in bench.rows:
        if row["phase"] == "peak memory":
            ours, peer, unit = row["tenon_mb"], row["peer_mb"], "MB"
        else:
            ours, peer, unit = row["tenon_ms"], row["peer_ms"], row.get("note", "")
        print(f"{row['workload']:<26}{row['phase']:<22}{number(ours)}{number(peer)}"
              f"{number(row['ratio'])}{number(row.get('tenon_threads_ms'))}"
              f"{number(row.get('peer_threads_ms'))}  {unit}")
    print("\nmilliseconds; ratio below 1: tenon is faster. MT: with all processors and threads."
          "\n*: usd-core's figure also measures Python. compose, parse, flatten, physics do not.")


def read_command_line():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*", help="only workloads whose name begins so")
    parser.add_argument("--build", default=os.path.join(ROOT, "build/bench"))
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--repeats", type=int, help="of the work within a process")
    parser.add_argument("--clock", choices=("wall", "cpu"), default="wall",
                        help="cpu: steadier on a busy machine")
    parser.add_argument("--record", action="store_true", help="write bench/results/<machine>.json")
    parser.add_argument("--smoke", action="store_true", help="tiny inputs, once; for ctest")
    arguments = parser.parse_args()
    if arguments.smoke:
        arguments.rounds = arguments.repeats = 1
    # All threads together take more processor time, not less: only the wall clock tells.
    arguments.threads = arguments.clock == "wall" and not arguments.smoke
    return arguments


def main():
    arguments = read_command_line()
    bench = Bench(arguments)
    if not bench.peer:
        print("usd-core is not installed: no ratios and no binary scenes (tools/make_oracle.sh)")
    bench.make_scenes()
    for name, function, *rest in tasks(bench):
        if arguments.names and not name.startswith(tuple(arguments.names)):
            continue
        print(name, flush=True)
        try:
            function(name, *rest)
        except Failure as failure:
            bench.failures.append(f"{name}: {failure}")
    print_table(bench)
    for failure in bench.failures:
        print("FAILED", failure)
    if arguments.record:
        print("wrote", machine.record(ROOT, arguments, bench.rows))
    return 1 if bench.failures else 0


if __name__ == "__main__":
    sys.exit(main())
