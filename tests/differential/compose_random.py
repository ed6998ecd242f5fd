#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares composition with OpenUSD's on random scenes of several layers: all arc kinds, list
edits, time offsets, variants, relocates, instances, load rules, muting, sessions, variable
expressions. Needs Python with OpenUSD's modules.

usage: compose_random.py DUMP [--scenes N] [--seed S] [--keep FOLDER] [--show N] [--measured]
                         [--outcomes FILE] [--seconds N] [--misses FILE]

DUMP is the program tests/tools/composition_dump.cpp. Per prim these must agree: contributing nodes
in order of strength with arc, site and time offset; specs of all layers; selected variants; names
of children and properties; prohibited names; what it is an instance like; targets; classes of
findings. A scene that differs is cut down while it still does and printed. Scenes that OpenUSD does
not finish in time, or dies of, are counted apart; tenon must finish them. Where tenon ends at its
stated work it is asked once more with AMPLE_WORK, so that the rules are compared and not the limit;
such scenes are counted. --keep writes scenes that differ there; of more than --show (3) only the
number is printed. --measured notes the figure for CONFORMANCE.md. --outcomes writes what became of
each scene, for scene_outcomes.py. --seconds: of processor time that OpenUSD has for a scene.
--misses lists scenes that may differ, with reasons; one of them that is equal is reported like one
that differs and is not listed. The last line tells what became of all scenes. Exit 1: a scene
differs and is not listed, or is listed and does not; 77: no OpenUSD.
"""

import argparse
import collections
import contextlib
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import traceback

try:
    from pxr import Pcp, Sdf, Usd, UsdGeom  # noqa: F401  pylint: disable=unused-import
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

import pcp_oracle
import random_scenes
import scene_outcomes

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "conformance"))
import suite  # noqa: E402  pylint: disable=wrong-import-position

SECONDS = 3
AMPLE_WORK = 4_000_000_000  # units; a hundred times kComposeWork
TENON_SECONDS = 600  # after which tenon is taken for one that never ends
WORK_EXCEEDED = "!! compose.work-exceeded"
Result = collections.namedtuple("Result", "kind text")  # kind: equal, differs, slow, died


class Dumper:
    """DUMP running in batch mode; started anew when it dies, killed when it does not answer."""

    def __init__(self, program):
        self.program = program
        self.process = None
        self.most_seconds = 0  # of processor time for one answer

    def seconds(self):
        """Processor time that the program has taken so far."""
        with open(f"/proc/{self.process.pid}/stat", encoding="utf-8") as file:
            times = file.read().rpartition(")")[2].split()[11:13]
        return sum(int(ticks) for ticks in times) / os.sysconf("SC_CLK_TCK")

    def ask(self, words):
        """-> (exit status, lines); the status is negative when the program died."""
        if self.process is None:
            self.process = subprocess.Popen([self.program, "--batch"], text=True,
                                            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            stderr=subprocess.DEVNULL)
        before, lines = self.seconds(), []
        watch = threading.Timer(TENON_SECONDS, self.process.kill)
        watch.start()
        try:
            with contextlib.suppress(BrokenPipeError):  # it has died; how, its status says
                self.process.stdin.write("\t".join(words) + "\n")
                self.process.stdin.flush()
            for line in self.process.stdout:
                if line.startswith("@@@ "):
                    self.most_seconds = max(self.most_seconds, self.seconds() - before)
                    return int(line[4:]), lines
                lines.append(line.rstrip("\n"))
        finally:
            watch.cancel()
        status = self.process.wait()
        self.process = None
        return -abs(status), lines


def words_of(folder, options):
    words = [os.path.join(folder, "l0.usda"), "--nodes"]
    if "session" in options:
        words += ["--session", os.path.join(folder, options["session"])]
    for name in options.get("muted", []):
        words += ["--muted", os.path.join(folder, name)]
    for name, variants in options.get("fallbacks", {}).items():
        for variant in variants:
            words += ["--fallback", name, variant]
    if "load" in options:
        words.append("--no-payloads")
        for prim in options["load"].get("loaded", []):
            words += ["--loaded", prim]
    return words


def composed(dumper, folder, options, only=None, work=0):
    """{heading: lines} from DUMP; of one prim when `only` names it; with `work` units, 0: as many
    as tenon states."""
    words = words_of(folder, options) + (["--prim", only] if only else [])
    words += ["--max-work", str(work)] if work else []
    status, printed = dumper.ask(words)
    if status != 0:
        return {"exit": ["rejected"] if status == 3 else [str(status)] + printed[-5:]}
    result, lines = {}, None
    for line in printed:
        if line.startswith("== "):
            lines = result.setdefault(line[3:], [])
        elif line.startswith("!! "):
            if line not in lines:
                lines.append(line)
        elif line and not re.search(r" (inert|culled|no-specs)\b", line):
            lines.append(re.sub(r" ancestral\b", "", line.strip()))
    return {heading: in_order(lines) for heading, lines in result.items()}


def in_order(lines):
    """Findings sorted where they are."""
    findings = sorted(line for line in lines if line.startswith("!! "))
    if not findings:
        return lines
    at = next(i for i, line in enumerate(lines) if line.startswith("!! "))
    others = [line for line in lines if not line.startswith("!! ")]
    return others[:at] + findings + others[at:]


def in_child(work, seconds=SECONDS):
    """What `work` returns, made in a process of its own; (None, status) when that fails."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reader)
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
        silent = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silent, 1)
        os.dup2(silent if not os.environ.get("COMPOSE_RANDOM_LOUD") else 2, 2)
        try:
            result = repr(work())
            with os.fdopen(writer, "w") as file:
                file.write(result)
            os._exit(0)
        except BaseException:  # pylint: disable=broad-except
            traceback.print_exc()
            os._exit(1)
    os.close(writer)
    with os.fdopen(reader) as file:
        text = file.read()
    _, status = os.waitpid(child, 0)
    return (eval(text, {"__builtins__": {}}), 0) if status == 0 else (None, status)


def failed(status):
    return Result("slow" if status == signal.SIGXCPU else "died", f"status {status}")


def without_unresolved(result):
    """Where OpenUSD's check of its arc numbers fails, it may drop this finding."""
    unresolved = "!! compose.unresolved-prim-path"
    return {heading: [line for line in lines if line != unresolved]
            for heading, lines in result.items()}


def without_targets(result):
    """OpenUSD 26.11 rejects targets that class arcs lead to what a relocate moved, against its own
    published results, which tests/conformance/composition keeps to."""
    return {heading: [line for line in lines if not line.startswith("targets ")]
            for heading, lines in result.items()}


def difference(want, have):
    for heading in list(want) + [heading for heading in have if heading not in want]:
        if want.get(heading) != have.get(heading):
            return f"{heading}\n  OpenUSD: " + "\n           ".join(want.get(heading, ["absent"])) \
                + "\n  tenon:   " + "\n           ".join(have.get(heading, ["absent"]))
    return ""


class Judge:
    def __init__(self, arguments, folder):
        self.dumper = Dumper(arguments.dump)
        self.folder = folder
        self.count = 0
        self.prims = 0
        self.faults = collections.Counter()
        self.ended_at_work = False  # tenon, of the scene judged last
        self.beyond_work = 0  # scenes that it ended so
        self.failed = False  # tenon died of the scene judged last, or was killed
        self.tenon_failed = 0  # scenes that it did not end
        self.seconds = getattr(arguments, "seconds", SECONDS)
        self.only = None  # the path of the only prim to compare

    def judge(self, scene):
        """Each time in a fresh folder: OpenUSD's process is forked, but its caches of paths are not
        to be trusted with files that change."""
        self.count += 1
        folder = os.path.join(self.folder, str(self.count))
        os.mkdir(folder)
        try:
            for name, text in random_scenes.texts(scene).items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            return self.compare(folder, scene["options"])
        finally:
            shutil.rmtree(folder)

    @staticmethod
    def has_relocates(folder):
        for name in os.listdir(folder):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                if "relocates = " in file.read():
                    return True
        return False

    def compare(self, folder, options):
        def work():
            oracle = pcp_oracle.Oracle(os.path.join(folder, "l0.usda"), options)
            one = self.only and oracle.composed_one(self.only)
            return one or oracle.composed(), oracle.faults
        answer, status = in_child(work, self.seconds)
        have = composed(self.dumper, folder, options, self.only)
        self.ended_at_work = any(WORK_EXCEEDED in lines for lines in have.values())
        self.failed = have.get("exit", ["rejected"]) != ["rejected"]
        if self.failed:
            return Result("differs", f"tenon ended with {' '.join(have['exit'])}")
        if answer is None:
            return failed(status)
        want, faults = answer
        self.prims += len(want)
        self.faults.update({fault.split(" : ")[-1] for fault in faults})
        if self.ended_at_work:
            have = composed(self.dumper, folder, options, self.only, AMPLE_WORK)
        if faults:
            want, have = without_unresolved(want), without_unresolved(have)
        text = difference(want, have)
        if text and self.has_relocates(folder):
            text = difference(without_targets(want), without_targets(have))
            self.faults["targets"] += not text
        return Result("differs" if text else "equal", text)


def keep(scene, folder):
    os.makedirs(folder, exist_ok=True)
    for name, text in random_scenes.texts(scene).items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)


def show(judge, scene, seed, arguments):
    """Cuts a scene that differs down, prints and keeps it. Looking at one prim is faster."""
    def differs(cut):
        return judge.judge(cut).kind == "differs"
    judge.only = judge.judge(scene).text.split(" ")[0].split("\n")[0]
    if not judge.only.startswith("/") or not differs(scene):
        judge.only = None
    small = random_scenes.shrink(scene, differs)
    print(f"scene {seed} ({random_scenes.family_of(seed)}) differs, cut down to:")
    for name, text in random_scenes.texts(small).items():
        print(f"--- {name}\n{text}", end="")
    print(f"options: {small['options']}\n{judge.judge(small).text}\n", flush=True)
    judge.only = None
    if arguments.keep:
        keep(small, os.path.join(arguments.keep, f"scene{seed}"))


def arguments_of(parser):
    parser.add_argument("dump")
    parser.add_argument("--scenes", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep")
    parser.add_argument("--show", type=int, default=3)
    parser.add_argument("--measured", action="store_true")
    parser.add_argument("--outcomes")
    parser.add_argument("--seconds", type=int, default=SECONDS)
    parser.add_argument("--misses")
    return parser.parse_args()


def summary(judge, arguments, outcomes, listed):
    """All of it in one line."""
    counts = collections.Counter(outcomes.values())
    tenon = f"does not end {judge.tenon_failed}" if judge.tenon_failed else "ends all"
    return (f"{len(outcomes)} scenes from seed {arguments.seed} on: {counts['equal']} equal, "
            f"{counts['differs']} differ ({listed} of them listed), OpenUSD takes more than "
            f"{judge.seconds} s for {counts['slow']} and dies of {counts['died']}; tenon {tenon}, "
            f"at most {judge.dumper.most_seconds:.1f} s each, "
            f"{judge.beyond_work} at its stated work")


def judge_one(judge, seed, scene, arguments, shown):
    """-> what became of a scene; one that differs is shown, at length while few are."""
    result = judge.judge(scene)
    judge.beyond_work += judge.ended_at_work
    judge.tenon_failed += judge.failed
    if result.kind == "differs" and shown < arguments.show:
        show(judge, scene, seed, arguments)
    elif result.kind == "differs":
        print(f"scene {seed} ({random_scenes.family_of(seed)}) differs at "
              f"{result.text.splitlines()[0]}", flush=True)
    return result.kind


def judge_all(judge, arguments, make_scene, name):
    """Judges scenes from arguments.seed on; the exit status."""
    if arguments.measured:
        suite.forget(f"{name}_scenes")
    outcomes = {}
    for seed in range(arguments.seed, arguments.seed + arguments.scenes):
        shown = sum(kind == "differs" for kind in outcomes.values())
        outcomes[seed] = judge_one(judge, seed, make_scene(seed), arguments, shown)
        if arguments.outcomes and (seed % 20 == 0 or len(outcomes) == arguments.scenes):
            scene_outcomes.write(arguments.outcomes, outcomes)
        if seed % 500 == 0:
            print(f"seed {seed}: {dict(collections.Counter(outcomes.values()))}", flush=True)
    print(f"prims per scene: {judge.prims / judge.count:.0f}")
    for fault, count in judge.faults.most_common():
        print(f"OpenUSD's own check failed in {count} scenes: {fault}")
    listed, good = scene_outcomes.hold_to_misses(outcomes, arguments.misses)
    print(summary(judge, arguments, outcomes, listed))
    if arguments.measured:
        label = f"random scenes: {name}, against OpenUSD"
        equal = sum(kind == "equal" for kind in outcomes.values())
        suite.record(f"{name}_scenes", [(label, equal, arguments.scenes)])
    return 0 if good else 1


def main():
    arguments = arguments_of(argparse.ArgumentParser())
    with tempfile.TemporaryDirectory() as folder:
        judge = Judge(arguments, folder)
        return judge_all(judge, arguments, random_scenes.make_scene, "composition")


if __name__ == "__main__":
    sys.exit(main())
