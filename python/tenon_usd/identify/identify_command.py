# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon identify ASSET LOG...`.

Exit codes are those of the command: 0 identified, 1 the answer is no (the log does not tell a
parameter, is not of this asset, or what was found predicts held-out motion no better), 2 a file or
an option cannot be used, 4 a package is missing, 130 interrupted.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from typing import Any

from .._command import ProgressLine, arguments_of, fail, text_of
from .._toml import FileError as TomlError
from ..errors import Error, InvalidError, MissingError
from ..functions import open as open_stage
from ..sweep.cases import ExtraMissing
from ..sweep.chunks import write_whole
from .joints import asset_joints
from .linear import scipy
from .log import Log, LogError
from .log_files import read_log
from .overlay import make_overlay, write_overlay
from .parameters import Row, prior_from_text, rows_from_file, rows_from_text
from .reading_options import add_reading_options, reading_of
from .report import (check_json, check_lines, identified_json, identified_lines, page,
                     self_test_json, self_test_lines)
from .run import Check, Identified, RefusedError, identify
from .selftest import Sensors, self_test
from .solve import SOLVERS
from .starts import MAX_STARTS, check_place

ABOUT = "Finds numbers of a robot in its logs: friction, damping, armature, gains, delays, masses."


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("tenon identify", description=ABOUT, allow_abbrev=False)
    add = parser.add_argument
    add("asset", help="the asset")
    add("logs", nargs="*", metavar="LOG", help="logs: .csv, .npz, .parquet, .mcap, folders of bags")
    add("--identify", action="append", default=[], metavar="FAMILY:REGEX",
        help="what to identify, =LOW..HIGH behind it for bounds")
    add("--parameters", metavar="FILE", help="the same as tables [[parameter]] of a TOML file")
    add("--prior", action="append", default=[], metavar="FAMILY:REGEX=VALUE,DEVIATION",
        help="what is known of it")
    add("--hold", action="store_true",
        help="what the logs do not tell keeps the asset's number, instead of an error")
    add("--held-out", action="append", default=[], metavar="LOG", help="a log that is not fitted")
    add("--training", type=float, default=0.7, metavar="PART",
        help="of each log what is fitted, without --held-out (0.7)")
    add("--engine", metavar="NAME", help="the engine that simulates")
    add("--physics", metavar="VARIANT", help="the variant of Physics")
    add("--dt", type=float, default=0.0, metavar="SECONDS", help="time step; the asset's")
    add("--window", type=float, default=0.0, metavar="SECONDS",
        help="how often the simulation begins at the log's state again; 4, of efforts 0.5")
    add("--solver", choices=SOLVERS, default=SOLVERS[0])
    add("--seed", type=int, default=0, metavar="NUMBER", help="of cma, --starts and --self-test")
    add("-j", "--jobs", type=int, default=0, metavar="COUNT", help="threads; 0: all there are")
    add("--state", default="", metavar="FILE", help="the best so far, to go on from")
    add("--starts", type=int, default=1, metavar="COUNT",
        help="fits from as many starts, of which the one counts that leaves least (1)")
    add("--on", default="", metavar="PLACE",
        help="the starts on ray: a cluster of this machine; ray=HOST:PORT, ray=auto")
    add("--check", action="store_true", help="only say what the logs tell")
    add("--report", metavar="FILE", help="a page with tables and plots (.html)")
    add("--write", metavar="FILE", help="a layer over the asset with the numbers (.usda)")
    add("--dry-run", action="store_true",
        help="print the layer that --write would write, with --json as its field layer")
    add("--force", action="store_true",
        help="write also what predicts held-out motion no better, and over a file")
    add("--self-test", action="store_true",
        help="make a log with other numbers and find them: no LOG")
    add("--duration", type=float, default=10.0, metavar="SECONDS", help="of the log of --self-test")
    add("--finer", type=int, default=4, metavar="COUNT",
        help="steps of the log of --self-test in one time step (4)")
    add_reading_options(parser)
    add("--json", action="store_true", help="print one JSON object on standard output")
    add("-q", "--quiet", action="store_true", help="no progress")
    add("--progress", action="store_true",
        help="how far it is as lines of standard error, for programs that show it")
    return parser


class _Shown(ProgressLine):
    def __init__(self, quiet: bool, lines: bool) -> None:
        super().__init__(quiet or lines)
        self.lines = lines

    def __call__(self, what: str, simulations: int, cost: float) -> None:
        told = f"{what}: {simulations} simulations, {cost:.6g} left"
        self.show(told)
        if self.lines:
            print(f"progress: {told}", file=sys.stderr, flush=True)


def _rows(arguments: argparse.Namespace) -> list[Row]:
    rows = [row for text in arguments.identify for row in rows_from_text(text)]
    if arguments.parameters:
        rows += rows_from_file(arguments.parameters)
    return rows + [row for text in arguments.prior for row in prior_from_text(text)]


def _check_arguments(arguments: argparse.Namespace) -> None:
    """Raises InvalidError for options that do not go together, or are out of range."""
    if arguments.self_test == bool(arguments.logs):
        raise InvalidError("--self-test makes its own log: leave LOG out" if arguments.logs
                           else "give a LOG, or --self-test")
    for name, low, high in (("training", 0.05, 0.95), ("window", 0.0, 1e4), ("dt", 0.0, 1.0),
                            ("duration", 0.5, 3600.0), ("finer", 1, 100), ("jobs", 0, 4096),
                            ("seed", 0, 2 ** 31)):
        if not low <= getattr(arguments, name) <= high:
            raise InvalidError(f"--{name} is {getattr(arguments, name)}; expected {low:g} to "
                               f"{high:g}")
    if not 1 <= arguments.starts <= MAX_STARTS:
        raise InvalidError(f"--starts is {arguments.starts}; expected 1 to {MAX_STARTS}")
    for option in ("--state", "--self-test"):
        if getattr(arguments, option[2:].replace("-", "_")) and (
                arguments.starts > 1 or arguments.on):
            raise InvalidError(f"{option} is of a single start: leave --starts and --on out")
    if arguments.prior and not arguments.identify and not arguments.parameters:
        raise InvalidError("--prior is about what --identify or --parameters name")
    _check_outputs(arguments)


def _check_outputs(arguments: argparse.Namespace) -> None:
    if arguments.write and not arguments.write.endswith(".usda"):
        raise InvalidError(f"--write {arguments.write}: expected a .usda file")
    if arguments.dry_run and not arguments.write:
        raise InvalidError("--dry-run is about --write: name the file that would be written")
    if arguments.report and not arguments.report.endswith(".html"):
        raise InvalidError(f"--report {arguments.report}: expected an .html file")
    for output in (arguments.write, arguments.report, arguments.state):
        folder = os.path.dirname(os.path.abspath(output)) if output else "."
        if not os.path.isdir(folder):
            raise InvalidError(f"{output}: there is no folder {folder}")


def _run(arguments: argparse.Namespace, shown: _Shown) -> int:
    _check_arguments(arguments)
    rows = _rows(arguments)
    options: dict[str, Any] = {"physics": arguments.physics} if arguments.physics else {}
    if not arguments.check:
        scipy("optimize")  # what is missing is told now, not later
        check_place(arguments.on)
    if arguments.self_test:
        return _self_test(arguments, rows, options, shown)
    joints = asset_joints(open_stage(arguments.asset, **options).physics())
    logs, notes = _logs(arguments.logs, joints, arguments)
    held_out, more = _logs(arguments.held_out, joints, arguments)
    try:
        found = identify(
            arguments.asset, logs, rows, held_out=held_out, engine=arguments.engine,
            step=arguments.dt, window=arguments.window, training=arguments.training,
            hold=arguments.hold or None, solver=arguments.solver, seed=arguments.seed,
            state=arguments.state, starts=arguments.starts, on=arguments.on,
            threads=arguments.jobs, check_only=arguments.check,
            shown=shown, **options)
    finally:
        shown.end()
    for note in [*notes, *more]:
        print(str(note), file=sys.stderr)
    if isinstance(found, Check):
        _print(arguments, {"ok": not found.reasons, "check": check_json(found)},
               check_lines(found))
        return 1 if found.reasons else 0
    return _finish(arguments, found)


def _logs(paths: list[str], joints: Any, arguments: argparse.Namespace
          ) -> tuple[list[Log], list[Any]]:
    logs, notes = [], []
    for path in paths:
        log, found = read_log(path, joints, reading_of(arguments))
        logs.append(log)
        notes += found
    return logs, notes


def _finish(arguments: argparse.Namespace, found: Identified) -> int:
    """Prints, and writes what may be written."""
    lines, no = identified_lines(found), []
    if found.foreign:
        no.append(f"{', '.join(found.foreign)}: what the log has there no number of the asset "
                  "explains; it is of another robot or joint, or the asset lacks what moves it")
    if not found.improved:
        no.append("held-out motion is predicted no better than by the asset as it is")
    if not found.solution.finished:
        no.append("interrupted: the best so far" + (
            "; the same command goes on from here" if arguments.state else ""))
    written = []
    if arguments.report:
        write_whole(os.path.abspath(arguments.report),
                    page(found, arguments.asset, arguments.logs).encode())
        written.append(arguments.report)
    value: dict[str, Any] = {}
    if arguments.write and (not no or arguments.force or arguments.dry_run):
        overlay = make_overlay(arguments.asset, arguments.write, found.parameters,
                               found.solution.values)
        lines += [f"{each.name} is not in the layer: {why}" for each, why in overlay.left]
        if arguments.dry_run:
            value["layer"] = overlay.text
            lines += ["", *overlay.text.splitlines()]
        else:
            write_overlay(overlay, arguments.write, arguments.asset, arguments.force)
            written.append(arguments.write)
    elif arguments.write:
        no.append(f"{arguments.write} is not written; --force does that")
    value = {"ok": not no, **identified_json(found), **value, "written": written, "problems": no}
    _print(arguments, value, [*lines, *written])
    for line in no:
        print(f"error: {line}", file=sys.stderr)
    if not found.solution.finished:
        return 130
    return 1 if no else 0


def _self_test(arguments: argparse.Namespace, rows: list[Row], options: dict[str, Any],
               shown: _Shown) -> int:
    try:
        done = self_test(arguments.asset, rows, engine=arguments.engine, seed=arguments.seed,
                         duration=arguments.duration, step=arguments.dt, finer=arguments.finer,
                         sensors=Sensors(), solver=arguments.solver, window=arguments.window,
                         threads=arguments.jobs, shown=shown, **options)
    finally:
        shown.end()
    _print(arguments, {"ok": done.passed, **self_test_json(done)}, self_test_lines(done))
    return 0 if done.passed else 1


def _print(arguments: argparse.Namespace, value: dict[str, Any], lines: list[str]) -> None:
    if arguments.json:
        print(json.dumps({"tool": "tenon", "schema": "tenon.identify/1",
                          "asset": arguments.asset, **value}))
    else:
        print("\n".join(lines))


def _fail(error: Exception, code: int, in_json: bool) -> int:
    lines = error.lines if isinstance(error, RefusedError) else text_of(error).split("\n")
    return fail(error, code, "tenon.identify/1" if in_json else None,
                [line.removeprefix("error: ") for line in lines])


def main(words: list[str] | None = None) -> int:
    """The command; -> its exit code."""
    arguments = arguments_of(_parser(), words)
    if isinstance(arguments, int):
        return arguments
    try:
        code = _run(arguments, _Shown(arguments.quiet or arguments.json, arguments.progress))
        sys.stdout.flush()
        return code
    except RefusedError as error:
        return _fail(error, 1, arguments.json)
    except (ExtraMissing, MissingError) as error:
        return _fail(error, 4, arguments.json)
    except (Error, LogError, TomlError, OSError) as error:
        return _fail(error, 2, arguments.json)
    except KeyboardInterrupt:
        print("\ninterrupted", file=sys.stderr, flush=True)
        os._exit(130)  # threads in the middle of a step are not waited for; files are whole
