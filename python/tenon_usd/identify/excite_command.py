# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon excite A -o FILE` and `python -m tenon_usd.identify.excite_command A -o FILE`.

Exit codes are those of the command: 0 written, 2 the asset or an option cannot be used or no motion
keeps the limits, 4 an engine or a package is missing, 130 interrupted.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
from typing import Any

from .._command import ProgressLine, arguments_of, fail
from ..errors import Error, MissingError
from .curves import KINDS
from .excite import Excitation, ExciteError, How, excite
from .raw_log import lined
from .trajectory_files import check_name, write

ABOUT = "Makes a motion that excites joints within their limits; writes it as a command table or " \
        "for ROS."
FOOTER = """\
Examples:
  tenon excite arm.usda -o arm.csv
  tenon excite arm.usda --kind ramps --joints 'shoulder|elbow' -o ramps.csv -o ramps.yaml
docs/identify-logs.md has all about it.
"""


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "tenon excite", description=ABOUT, epilog=FOOTER, allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    add, usual = parser.add_argument, How()
    add("asset", help="a .usd, .usda, .usdc or .usdz file")
    add("-o", "--output", action="append", default=[], metavar="FILE",
        help="command table (.csv, .npz) or JointTrajectory of ROS (.yaml); may be repeated")
    add("--kind", choices=KINDS, default=usual.kind)
    add("--joints", default=usual.joints, metavar="REGEX", help="joints whose path has this in it")
    add("--duration", type=float, default=usual.duration, metavar="SECONDS")
    add("--step", type=float, default=usual.step, metavar="SECONDS", help="between rows")
    add("--seed", type=int, default=usual.seed, metavar="NUMBER")
    add("--margin", type=float, default=usual.margin, metavar="PART",
        help="of each range, kept to the limits of position")
    add("--speed", type=float, default=usual.speed, metavar="PART", help="of the limits of speed")
    add("--effort", type=float, default=usual.effort, metavar="PART",
        help="of the limits of effort")
    add("--search", type=int, default=usual.search, metavar="COUNT",
        help="multisines that are tried")
    add("--no-collisions", action="store_true", help="do not look whether bodies touch")
    add("--physics", default="", metavar="NAME", help="variant of the variant sets \"Physics\"")
    add("--json", action="store_true", help="print one JSON object on standard output")
    add("-q", "--quiet", action="store_true", help="no progress")
    return parser


def _run(arguments: argparse.Namespace) -> int:
    from .. import physics
    from .log import Finding

    for name in arguments.output:
        check_name(name)
        if os.path.exists(name) and os.path.samefile(name, arguments.asset):
            raise ExciteError(Finding("excite.output", "is the asset itself", name,
                                      fix="give another name"))
    options: dict[str, Any] = {"physics": arguments.physics} if arguments.physics else {}
    scene = physics(arguments.asset, **options)
    how = How(arguments.kind, arguments.joints, arguments.duration, arguments.step, arguments.seed,
              arguments.margin, arguments.speed, arguments.effort, arguments.search,
              not arguments.no_collisions)
    shown = ProgressLine(arguments.quiet)
    try:
        motion = excite(scene, how, lambda what: shown.show(f"{what} ..."))
    finally:
        shown.end()
    for name in arguments.output:
        write(motion, name)
    if arguments.json:
        print(json.dumps({"tool": "tenon", "schema": "tenon.excite/1", "ok": True,
                          "asset": arguments.asset, "outputs": arguments.output,
                          **motion.to_json()}))
    elif not arguments.quiet:
        _print(motion, arguments.output)
    for each in motion.notes:
        if each.severity != "info":
            print(f"{each.severity}: {each}", file=sys.stderr)
    return 0


HEAD = ("joint", "from", "to", "speed", "of", "effort", "of", "size %", "crest")


def _print(motion: Excitation, outputs: list[str]) -> None:
    rows: list[tuple[str, ...]] = [HEAD]
    crest = motion.crest
    for k, joint in enumerate(motion.joints):
        position = motion.position[:, k]
        rows.append((joint.short, *(_number(value) for value in (
            position.min(), position.max(), abs(motion.velocity[:, k]).max(),
            joint.velocity_limit, motion.effort[k], joint.effort_limit, 100 * motion.shrunk[k],
            crest[k]))))
    print("\n".join(lined(rows)))
    told = f"{motion.how.kind}: {motion.times[-1]:.4g} s, {len(motion.times)} rows, seed " \
           f"{motion.how.seed}"
    if math.isfinite(motion.condition):
        told += f"; condition of friction and armature {motion.condition:.3g}, " \
                f"{motion.unknowns} unknowns told apart"
    print(told)
    for each in motion.notes:
        if each.severity == "info":
            print(str(each))
    for name in outputs:
        print(name)


def _number(value: float) -> str:
    return f"{float(value):.3g}" if math.isfinite(value) else "-"


def _fail(error: Exception, code: int, in_json: bool) -> int:
    return fail(error, code, "tenon.excite/1" if in_json else None,
                rule=error.rule if isinstance(error, Error) else "")


def main(words: list[str] | None = None) -> int:
    """The command; -> its exit code."""
    arguments = arguments_of(_parser(), words)
    if isinstance(arguments, int):
        return arguments
    try:
        code = _run(arguments)
        sys.stdout.flush()
        return code
    except (Error, OSError) as error:
        return _fail(error, 4 if isinstance(error, MissingError) else 2, arguments.json)
    except KeyboardInterrupt:
        print("\ninterrupted: nothing was written", file=sys.stderr, flush=True)
        return 130


if __name__ == "__main__":
    sys.exit(main())
