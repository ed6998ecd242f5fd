#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon sweep` at its full size: 2,000 cases on threads, on 4 shards and on a local cluster of Ray
of two nodes have the same bytes, and so has what comes of runs whose driver or workers were killed
twenty times. Also what the sweep costs beside the steps alone, and the tests of the package's
extras: SciPy, Arrow, MCAP, Rerun.

usage: at_scale.py [WHEEL]    (make judge ONLY=sweeps)

Runs in an environment with requirements-sweep.txt; without a wheel one is made for its Python.
"""

import contextlib
import glob
import hashlib
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
KILLS = 20
PLAN = """
asset = "hand/grasp.usda"
engine = "mujoco"
duration = 0.1
samples = 100
seed = 11
chunk = 20

[[vary]]
scale = "driveStiffness"
grid = {from = 0.5, to = 2, count = 10}

[[vary]]
scale = "gravity"
grid = [0.9, 1.1]

[[vary]]
scale = "bodyMass@/World/can"
random = [0.5, 2]
distribution = "log"

[[vary]]
scale = "colliderFriction"
sobol = [0.5, 1.5]

[[metric]]
of = "position.z@/World/can"

[[metric]]
of = "speed@/World/can"
take = "max"
"""
OVERHEAD = """
import statistics, sys, time
from tenon_usd.sweep import load_plan
from tenon_usd.sweep.simulate import make_runner
from tenon_usd.sweep.work import Worker
worker = Worker(load_plan(sys.argv[1]), make_runner)
worker.rows(0)
(model,) = worker.runner._models.values()

def seconds(call, *arguments):
    start = time.process_time()
    call(*arguments)
    return time.process_time() - start

def alone(index):
    model.world.reset()
    for setter, value in zip(model.setters, worker.cases[index].values):
        setter(model.world, value)
    return seconds(model.world.step, model.steps)

# Each case, a chunk of its own, right beside its steps, in turn before and after them, and the
# median of many such pairs: the rest of the machine slows down both of a pair, or one of a few.
pairs = []
for turn in range(6 * worker.plan.case_count):
    index = turn // 6
    if turn % 2:
        bare, swept = alone(index), seconds(worker.rows, index)
    else:
        swept, bare = seconds(worker.rows, index), alone(index)
    pairs.append((swept / bare, bare))
more, bare = (statistics.median(column) for column in zip(*pairs))
print(f"{more - 1:.4f} {bare:.4f}")
"""


def say(text):
    print(text, flush=True)


class Place:
    """The wheel in a folder of its own, the plan with a copy of the asset, results beside."""

    def __init__(self, folder, wheel):
        self.folder = pathlib.Path(folder)
        packages = self.folder / "packages"
        subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target",
                        packages, wheel], check=True)
        shutil.copytree(ROOT / "examples/inspire_hand", self.folder / "hand")
        self.plan = self.folder / "plan.toml"
        self.plan.write_text(PLAN)
        self.environment = {**os.environ, "PYTHONPATH": str(packages), "RAY_AUTH_MODE": "disabled",
                            "RAY_USAGE_STATS_ENABLED": "0", "TENON_PYTHON": sys.executable}
        os.environ.update(self.environment)  # of Ray's nodes, which are started here
        self.tenon = packages / "tenon_usd/bin/tenon"

    def start(self, name, *words):
        return subprocess.Popen([self.tenon, "sweep", self.plan, "-o", self.folder / name, "-q",
                                 *words], env=self.environment, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True, start_new_session=True)

    def run(self, name, *words):
        process = self.start(name, *words)
        output, _ = process.communicate(timeout=1800)
        if process.returncode not in (0, 1):
            sys.exit(f"tenon sweep {' '.join(words)}: exit {process.returncode}\n{output}")

    def digest(self, name):
        path = self.folder / name / "result.parquet"
        return hashlib.sha256(path.read_bytes()).hexdigest() if path.exists() else "no result"


def children_of(process, name):
    """Processes below one whose command line begins so."""
    parents, commands = {}, {}
    for path in glob.glob("/proc/[0-9]*"):
        with contextlib.suppress(OSError, ValueError, IndexError):
            pid = int(path.rsplit("/", 1)[1])
            parents[pid] = int(pathlib.Path(path, "stat").read_text().rsplit(")", 1)[1].split()[1])
            commands[pid] = pathlib.Path(path, "cmdline").read_text()

    def is_below(pid):
        while pid in parents and pid != process:
            pid = parents[pid]
        return pid == process

    return [pid for pid, command in commands.items() if command.startswith(name) and is_below(pid)]


def kill_group(process):
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def kill_drivers(place, name, count, chance, *words):
    """Starts and kills, at a random time each, until so many died; then lets one end."""
    killed = 0
    while killed < count:
        process = place.start(name, *words)
        try:
            process.communicate(timeout=chance.uniform(0.5, 2.5))
            if process.returncode is not None and not left(place, name):
                say(f"all was done after {killed} kills")
                break
        except subprocess.TimeoutExpired:
            kill_group(process)
            killed += 1
    place.run(name, *words)
    return killed


def left(place, name):
    return not (place.folder / name / "result.parquet").exists()


def kill_workers(place, name, count, chance, *words):
    """Kills workers of Ray while one driver runs."""
    process, killed = place.start(name, *words), 0
    while killed < count and process.poll() is None:
        time.sleep(chance.uniform(0.3, 1.0))
        workers = children_of(os.getpid(), "ray::Worker")
        if workers:
            with contextlib.suppress(ProcessLookupError):
                os.kill(chance.choice(workers), signal.SIGKILL)
                killed += 1
    output, _ = process.communicate(timeout=1800)
    if process.returncode != 0:
        sys.exit(f"the driver ended with {process.returncode}\n{output}")
    return killed


def faults_at_scale(place):
    import ray.cluster_utils
    chance = random.Random(5)
    place.run("threads", "-j", "2")
    whole = place.digest("threads")
    found = {}
    for shard in range(4):
        place.run("shards", "-j", "1", "--shard", f"{shard}/4")
    found["shards"] = place.digest("shards")
    cluster = ray.cluster_utils.Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    cluster.add_node(num_cpus=1)
    where = f"--on=ray={cluster.address}"
    try:
        place.run("ray", where)
        found["ray"] = place.digest("ray")
        kills = kill_drivers(place, "killed_threads", KILLS // 2, chance, "-j", "2")
        found["killed_threads"] = place.digest("killed_threads")
        kills += kill_workers(place, "killed_workers", KILLS // 4, chance, where)
        found["killed_workers"] = place.digest("killed_workers")
        # Starting a driver of Ray takes seconds, so that it lives a while.
        for _ in range(KILLS - kills if KILLS - kills < KILLS // 2 else KILLS // 4):
            process = place.start("killed_ray", where)
            time.sleep(chance.uniform(3, 9))
            if process.poll() is None:
                kill_group(process)
                kills += 1
        place.run("killed_ray", where)
        found["killed_ray"] = place.digest("killed_ray")
    finally:
        cluster.shutdown()
    say(f"{kills} kills")
    faults = [f"{name}: {digest[:12]}, not {whole[:12]}" for name, digest in found.items()
              if digest != whole]
    if kills < KILLS:
        faults.append(f"only {kills} kills")
    return faults, kills


def overhead(place):
    """How much longer a case takes than its steps alone, and how long these are, in CPU seconds."""
    plan = place.folder / "long.toml"
    plan.write_text(PLAN.replace("duration = 0.1", "duration = 3.5")
                    .replace("samples = 100", "samples = 1").replace("chunk = 20", "chunk = 1"))
    done = subprocess.run([sys.executable, "-c", OVERHEAD, plan], env=place.environment,
                          capture_output=True, text=True, check=True)
    return map(float, done.stdout.split())


def tests_of_extras(place):
    for name in ("test_sweep_logic", "test_sweep_world", "test_logs"):
        done = subprocess.run([sys.executable, ROOT / f"python/tests/{name}.py"],
                              env={**place.environment, "TENON_EXTRAS": "1"}, capture_output=True,
                              text=True, check=False)
        if done.returncode:
            yield f"{name}: exit {done.returncode}\n{done.stdout}{done.stderr}"


def wheel():
    if len(sys.argv) > 1:
        return sys.argv[1]
    subprocess.run([ROOT / "tools/make_wheel.sh", sys.executable], check=True)
    tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    return max(glob.glob(str(ROOT / f"dist/tenon_usd-*-{tag}-*.whl")), key=os.path.getmtime)


def main():
    with tempfile.TemporaryDirectory(prefix="tenon_sweeps_") as folder:
        place = Place(folder, wheel())
        faults = list(tests_of_extras(place))
        more, seconds = overhead(place)
        say(f"a case of {seconds:.3f} s takes {100 * more:.1f} % more than its steps")
        if more > 0.05:
            faults.append(f"a case of {seconds:.3f} s takes {100 * more:.1f} % more than its steps")
        unequal, kills = faults_at_scale(place)
        faults += unequal
    for fault in faults:
        say(fault)
    say(f"2,000 cases on threads, 4 shards, 2 nodes of Ray, {kills} kills, {100 * more:.1f} % "
        f"beside {seconds:.3f} s of steps: {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
