# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon sweep PLAN` and `python -m tenon_usd.sweep PLAN`.

Exit codes are those of the command: 0 every case ran, 1 some did not (they are rows of the result),
2 the plan or a file cannot be used, 4 an optional package is missing, 130 interrupted.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import time
from collections.abc import Callable
from typing import Any

from .._command import ProgressLine, arguments_of, fail
from .cases import Cases, ExtraMissing
from .chunks import FORMATS, FolderError, Results, Row
from .plan import Plan, PlanError, load_plan
from .report import write_report
from .work import MakeRunner, failures, run_on_ray, run_on_threads, shard_of

ABOUT = "Simulates an asset many times with values that a plan names; writes a table of results."
FOOTER = """\
Examples:
  tenon sweep plan.toml -o runs -j 8                     on 8 threads
  tenon sweep hand.usda --vary bodyMass=0.8..1.2 --samples 100 --duration 2 -o runs
  tenon sweep plan.toml -o runs --shard $SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT
  tenon sweep plan.toml -o runs --on ray=auto            on a cluster of Ray
The same command again goes on where a run was stopped. docs/sweep.md tells all about plans.
"""
SHOWN = 5  # failed cases that are told one by one


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "tenon sweep", description=ABOUT, epilog=FOOTER, allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("plan", help="a plan (.toml), or an asset that --vary varies")
    add("-o", "--output", default="runs", metavar="FOLDER", help="folder of results (runs)")
    add("-j", "--jobs", type=int, default=0, metavar="N",
        help="threads, or workers of Ray; 0: as many as this process may use")
    add("--vary", action="append", default=[], metavar="NAME=VALUES",
        help="one more row: LOW..HIGH at random, LOW:HIGH:COUNT a grid, A,B,C a list")
    add("--samples", type=int, metavar="N", help="how many draws of random and sobol")
    add("--seed", type=int, metavar="N")
    add("--duration", type=float, metavar="SECONDS")
    add("--engine", metavar="NAME")
    add("--shard", metavar="I/N", help="only each N-th chunk from the I-th, I from 0")
    add("--on", metavar="PLACE", help="ray: a cluster of this machine; ray=HOST:PORT, ray=auto")
    add("--format", choices=FORMATS, help="of the results; parquet where pyarrow is installed")
    add("--merge", action="store_true", help="run nothing: only put the chunks together")
    add("--list", action="store_true", help="run nothing: only print the cases")
    add("--report", action="store_true", help="write FOLDER/report.html, too: summary and plots")
    add("--json", action="store_true", help="print one JSON object on standard output")
    add("-q", "--quiet", action="store_true", help="no progress")
    return parser


def _shard(text: str | None) -> tuple[int, int] | None:
    if text is None:
        return None
    index, slash, count = text.partition("/")
    if not slash or not index.isdecimal() or not count.isdecimal():
        raise PlanError("--shard", [_fault(f"{text!r}: expected I/N, such as 0/4")])
    shard = (int(index), int(count))
    if shard[0] >= shard[1]:
        raise PlanError("--shard", [_fault(f"{text!r}: the first number is below the second; "
                                           "it counts from 0")])
    return shard


def _fault(message: str) -> Any:
    from .._toml import Fault
    return Fault("", 0, message)


class _Shown(ProgressLine):
    def __init__(self, quiet: bool) -> None:
        super().__init__(quiet)
        self.start = time.monotonic()

    def __call__(self, done: int, total: int, failed: int) -> None:
        left = (time.monotonic() - self.start) * (total - done) / max(done, 1)
        self.show(f"{done} of {total} cases, {failed} failed, {left:.0f} s left")


def _list_cases(plan: Plan) -> None:
    """The cases as lines of comma separated values."""
    import csv
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["case", *(row.name for row in plan.vary)])
    cases = Cases(plan)
    for index in range(plan.case_count):
        writer.writerow([index, *cases[index].values])


def _summary(results: Results, rows: list[Row] | None, path: str | None,
             report: str | None) -> dict[str, Any]:
    plan, counts = results.plan, dict[str, int]()
    for row in rows or []:
        counts[row["status"]] = counts.get(row["status"], 0) + 1
    return {"tool": "tenon", "schema": "tenon.sweep/1", "digest": results.digest,
            "folder": results.folder, "format": results.format, "cases": plan.case_count,
            "chunks": plan.chunk_count, "complete": path is not None, "result": path,
            "report": report,
            "statuses": counts,
            "failed": [{key: row[key] for key in ("case", "status", "time", "rule", "error")}
                       for row in failures(rows or [])]}


def _print(summary: dict[str, Any]) -> None:
    if not summary["complete"]:
        print(f"{summary['folder']}: chunks of other shards are missing; the last of them, or "
              "--merge, puts the results together")
        return
    told = ", ".join(f"{count} {status}" for status, count in sorted(summary["statuses"].items()))
    print(f"{summary['result']}: {summary['cases']} cases, {told}")
    for row in summary["failed"][:SHOWN]:
        print(f"  case {row['case']} {row['status']} at {row['time']:g} s: {row['error']}")
    if summary["report"]:
        print(summary["report"])
    if len(summary["failed"]) > SHOWN:
        print(f"  ... {len(summary['failed']) - SHOWN} more, see the column status")


def _run(arguments: argparse.Namespace, make_runner: MakeRunner | None,
         digest_of: Callable[[Plan], str] | None) -> int:
    plan = load_plan(arguments.plan, arguments.vary, samples=arguments.samples, seed=arguments.seed,
                     duration=arguments.duration, engine=arguments.engine)
    if arguments.list:
        _list_cases(plan)
        return 0
    shard = _shard(arguments.shard)
    Cases(plan)  # what a row needs is missing now, not later
    if make_runner is None or digest_of is None:
        from . import simulate
        make_runner, digest_of = simulate.make_runner, simulate.digest_of
    results = Results(arguments.output, plan, digest_of(plan), arguments.format)
    chunks = [] if arguments.merge else results.missing(shard_of(plan.chunk_count, shard))
    jobs = arguments.jobs or len(os.sched_getaffinity(0))
    shown = _Shown(arguments.quiet)
    try:
        if chunks and arguments.on:
            where, _, address = arguments.on.partition("=")
            if where != "ray":
                raise PlanError("--on", [_fault(f"{arguments.on!r}: expected ray or ray=ADDRESS")])
            run_on_ray(results, chunks, make_runner, address or None, arguments.jobs or None, shown)
        elif chunks:
            run_on_threads(results, chunks, make_runner, jobs, shown)
    finally:
        shown.end()
    path = results.merge()
    rows = results.rows() if path else None
    report = write_report(results, rows) if arguments.report and rows is not None else None
    summary = _summary(results, rows, path, report)
    if arguments.json:
        print(json.dumps({"ok": not summary["failed"], **summary}))
    else:
        _print(summary)
    if arguments.merge and not path:
        return 1
    return 1 if summary["failed"] else 0


def _fail(error: Exception, code: int, in_json: bool) -> int:
    return fail(error, code, "tenon.sweep/1" if in_json else None)


def main(words: list[str] | None = None, make_runner: MakeRunner | None = None,
         digest_of: Callable[[Plan], str] | None = None) -> int:
    """The command; -> its exit code. Without a runner of the caller's, tenon's own simulates."""
    arguments = arguments_of(_parser(), words)
    if isinstance(arguments, int):
        return arguments
    try:
        code = _run(arguments, make_runner, digest_of)
        sys.stdout.flush()
        return code
    except (PlanError, FolderError, OSError, ExtraMissing) as error:
        return _fail(error, 4 if isinstance(error, ExtraMissing) else 2, arguments.json)
    except KeyboardInterrupt:
        print("\ninterrupted: the same command goes on from here", file=sys.stderr, flush=True)
        os._exit(130)  # threads in the middle of a step are not waited for; files are whole
