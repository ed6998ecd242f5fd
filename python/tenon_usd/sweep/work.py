# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Cases become rows: on threads of this process, as one shard of several, or on a cluster of Ray.
What a row says is the same wherever it was made."""

from __future__ import annotations

import contextlib
import ctypes
import dataclasses
import importlib
import math
import os
import queue
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Protocol

from .cases import Case, Cases, ExtraMissing
from .chunks import Results, Row
from .plan import Plan

#: Of a row: it ran to its end; the simulation became unstable; the asset, or what a row of the plan
#: names in it, is not there; anything else that went wrong with this case.
OK, UNSTABLE, MISSING, FAILED = "ok", "unstable", "missing", "failed"


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What came of a case. `time` [s] is how far it ran; `metrics` are those of the plan, NaN where
    nothing was measured; `rule` and `error` say what went wrong."""

    status: str
    time: float
    metrics: tuple[float, ...] = ()
    rule: str = ""
    error: str = ""


class Runner(Protocol):
    """Simulates cases. What comes of one may not depend on those beside or before it."""

    def run(self, cases: Sequence[Case]) -> list[Outcome]:
        """An outcome for each case, in their order. A case that fails is an outcome."""


MakeRunner = Callable[[Plan], Runner]
#: Called after each chunk with the numbers of cases: done, of all, and failed among those done.
Progress = Callable[[int, int, int], None]


class Worker:
    """One at a time: keeps its runner, and so the models that the runner has made."""

    def __init__(self, plan: Plan, make_runner: MakeRunner) -> None:
        self.plan = plan
        self.cases = Cases(plan)
        self.runner = make_runner(plan)

    def rows(self, chunk: int) -> list[Row]:
        cases = [self.cases[index] for index in self.plan.chunk_cases(chunk)]
        outcomes = self.runner.run(cases)
        if len(outcomes) != len(cases):
            raise RuntimeError("a runner gives an outcome for each case")
        return [self._row(case, outcome) for case, outcome in zip(cases, outcomes, strict=True)]

    def _row(self, case: Case, outcome: Outcome) -> Row:
        row: Row = {"case": case.index}
        row.update({vary.name: value for vary, value in
                    zip(self.plan.vary, case.values, strict=True)})
        metrics = outcome.metrics or (math.nan,) * len(self.plan.metrics)
        row.update({metric.name: float(value) for metric, value in
                    zip(self.plan.metrics, metrics, strict=True)})
        row.update(status=outcome.status, time=float(outcome.time), rule=outcome.rule,
                   error=outcome.error)
        return row


class _Tally:
    """Counts what is done, and tells."""

    def __init__(self, results: Results, chunks: Sequence[int], progress: Progress | None) -> None:
        self.results, self.progress = results, progress
        self.total = sum(len(results.plan.chunk_cases(number)) for number in chunks)
        self.done = self.failed = 0
        self._lock = threading.Lock()

    def keep(self, chunk: int, rows: list[Row]) -> None:
        self.results.write_chunk(chunk, rows)
        with self._lock:
            self.done += len(rows)
            self.failed += sum(row["status"] != OK for row in rows)
            if self.progress:
                self.progress(self.done, self.total, self.failed)


def run_on_threads(results: Results, chunks: Sequence[int], make_runner: MakeRunner, threads: int,
                   progress: Progress | None = None) -> None:
    """Works on the chunks on so many threads. Errors: the first of any thread, after which the
    others end with the chunk that they are at. Ctrl-C ends them where they are."""
    tally = _Tally(results, chunks, progress)
    waiting: queue.SimpleQueue[int] = queue.SimpleQueue()
    for number in chunks:
        waiting.put(number)
    faults: list[BaseException] = []
    stop = threading.Event()

    def work() -> None:
        try:
            worker = Worker(results.plan, make_runner)
            while not stop.is_set():
                try:
                    number = waiting.get_nowait()
                except queue.Empty:
                    return
                tally.keep(number, worker.rows(number))
        except BaseException as error:
            faults.append(error)
            stop.set()

    running = [threading.Thread(target=work, daemon=True)
               for _ in range(max(1, min(threads, len(chunks))))]
    for thread in running:
        thread.start()
    try:
        for thread in running:
            thread.join()
    except BaseException:
        stop.set()
        for thread in running:
            _raise_in(thread, KeyboardInterrupt)
        raise
    if faults:
        raise faults[0]


def _raise_in(thread: threading.Thread, kind: type[BaseException]) -> None:
    """Raises an exception in another thread, when it runs code of Python next; steps of a World
    look for it, too."""
    if thread.ident is not None:  # a join() that is interrupted takes a thread for dead
        ctypes.pythonapi.PyThreadState_SetAsyncExc(
            ctypes.c_ulong(thread.ident), ctypes.py_object(kind))


def shard_of(chunk_count: int, shard: tuple[int, int] | None) -> range:
    """The chunks of shard (i, n), i from 0: each n-th, so that all shards are as long."""
    if shard is None:
        return range(chunk_count)
    index, count = shard
    if not 0 <= index < count:
        raise ValueError(f"shard {index}/{count}: the first number is from 0 to {count - 1}")
    return range(index, chunk_count, count)


def run_on_ray(results: Results, chunks: Sequence[int], make_runner: MakeRunner,
               address: str | None = None, workers: int | None = None,
               progress: Progress | None = None) -> None:
    """Works on the chunks on a cluster of Ray: one that is there ("auto" or HOST:PORT), or one of
    this machine that lives as long as the call. Each worker is an actor that keeps its models; one
    that dies is made anew and its chunk is done again. Rows are written here. Errors: ExtraMissing
    without Ray; those of a worker."""
    with ray_cluster(address, workers) as ray:
        _with_ray(ray, results, chunks, make_runner, workers, progress)


@contextlib.contextmanager
def ray_cluster(address: str | None = None, workers: int | None = None) -> Iterator[Any]:
    """The module `ray`, joined to the cluster at an address, or to one of this machine with so many
    workers, which ends with the block. Raises ExtraMissing without Ray."""
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")  # nothing is sent to anybody
    try:
        ray: Any = importlib.import_module("ray")
    except ImportError as error:
        raise ExtraMissing("Ray", "ray", "--on ray") from error
    own = not ray.is_initialized()
    if own:
        options: dict[str, Any] = {"address": address} if address else {"num_cpus": workers}
        ray.init(include_dashboard=False if not address else None, log_to_driver=False,
                 logging_level="warning", **options)
    try:
        yield ray
    finally:
        if own:
            ray.shutdown()


def _with_ray(ray: Any, results: Results, chunks: Sequence[int], make_runner: MakeRunner,
              workers: int | None, progress: Progress | None) -> None:
    tally = _Tally(results, chunks, progress)
    count = workers or max(1, int(ray.cluster_resources().get("CPU", 1)))
    actor = ray.remote(num_cpus=1, max_restarts=-1, max_task_retries=-1)(Worker)
    actors = [actor.remote(results.plan, make_runner) for _ in range(min(count, len(chunks)))]
    waiting = iter(chunks)
    running: dict[Any, tuple[Any, int]] = {}

    def give(worker: Any) -> None:
        number = next(waiting, None)
        if number is not None:
            running[worker.rows.remote(number)] = (worker, number)

    for worker in actors:
        give(worker)
    while running:
        (done,), _ = ray.wait(list(running))
        worker, number = running.pop(done)
        tally.keep(number, ray.get(done))
        give(worker)


def failures(rows: Iterable[Row]) -> list[Row]:
    """The rows of cases that did not run to their end."""
    return [row for row in rows if row["status"] != OK]
