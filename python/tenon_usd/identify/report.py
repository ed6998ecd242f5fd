# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What came of an identification: as JSON, as lines for people, and as one page of HTML with plots
inside, without scripts and without anything from elsewhere."""

from __future__ import annotations

import html
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ..sweep.report import STYLE, _table
from .identifiable import Identifiability
from .log import Array
from .parameters import FAMILIES, Parameter
from .raw_log import lined
from .run import Check, Identified, Residuals
from .selftest import SelfTest
from .starts import alike

#: Plots of a page, and points of a line.
MAX_PLOTS, MAX_POINTS = 60, 1500
WIDTH, HEIGHT, MARGIN = 520, 240, 60
LINES = """\
svg polyline.log { stroke: currentColor; stroke-opacity: 0.55; stroke-width: 3; }
svg polyline.before { stroke: #c2571a; stroke-dasharray: 4 3; }
svg polyline.after { stroke: var(--mark); }
.bad { color: #b3261e; }
@media (prefers-color-scheme: dark) { .bad { color: #ff8a80; } }
"""


def _plain(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _unit(parameter: Parameter, sliding: bool = False) -> str:
    first, _, second = FAMILIES[parameter.family].unit.partition(" or ")
    return second if sliding and second else first


# ---- JSON


def _of(parameter: Parameter) -> dict[str, Any]:
    return {"name": parameter.name, "family": parameter.family, "paths": list(parameter.paths),
            "weights": list(parameter.weights), "unit": parameter.unit,
            "nominal": _plain(parameter.nominal)}


#: Said once where there are sums.
SUMS = ("a sum is one number: no motion tells apart what joints that follow each other by a mimic "
        "law have of it; a layer shares it out as the asset has it")


def check_json(check: Check) -> dict[str, Any]:
    told = check.told
    return {
        "quality": check.quality.to_json(),
        "singularValues": [_plain(value) for value in told.singular_values],
        "parameters": [{**_of(each), "expectedError": _plain(told.errors[at]),
                        "sensitivity": _plain(told.sensitivities[at]),
                        "told": at not in told.refused}
                       for at, each in enumerate(check.parameters)],
        "together": [[check.parameters[at].name for at in group] for group in told.groups],
        "refused": list(check.reasons)}


def _residuals_json(rows: Sequence[Residuals], joints: Sequence[str]) -> list[dict[str, Any]]:
    return [{"channel": each.channel, "joint": joint, "before": _plain(before),
             "after": _plain(after)}
            for each in rows for joint, before, after in zip(joints, each.before, each.after)
            if math.isfinite(before)]


def identified_json(found: Identified) -> dict[str, Any]:
    solution = found.solution
    return {
        "engine": found.engine, "timeStep": found.step, "finished": solution.finished,
        "settled": solution.settled, "simulations": solution.simulations,
        "starts": [_plain(cost) for cost in found.costs],
        "check": check_json(found.check),
        "parameters": [{**_of(each), "value": _plain(solution.values[at]),
                        "error": _plain(solution.errors[at]), "low": _plain(solution.low[at]),
                        "high": _plain(solution.high[at])}
                       for at, each in enumerate(found.parameters)],
        "held": [_of(each) for each in found.held],
        "atBounds": [each.name for each in found.at_bounds],
        "training": _residuals_json(found.training, found.joints),
        "heldOut": _residuals_json(found.held_out, found.joints),
        "score": {"before": _plain(found.score[0]), "after": _plain(found.score[1])},
        "improved": found.improved,
        "unexplained": {joint: _plain(part)
                        for joint, part in zip(found.joints, found.unexplained)},
        "foreign": list(found.foreign),
        "engines": [{"engine": each.engine, "before": _plain(each.before),
                     "after": _plain(each.after), "why": each.why} for each in found.replays]}


def self_test_json(done: SelfTest) -> dict[str, Any]:
    return {
        "passed": done.passed, "timeStep": done.step, "simulations": done.solution.simulations,
        "scores": [{**_of(each.parameter), "truth": each.truth, "found": each.found,
                    "low": each.low, "high": each.high, "error": each.error,
                    "allowed": each.allowed, "passed": each.passed}
                   for each in done.scores],
        "refused": [each.name for each in done.refused]}


# ---- lines


def _short(value: float) -> str:
    return f"{value:.4g}" if math.isfinite(value) else "-"


def check_lines(check: Check) -> list[str]:
    told = check.told
    rows = [("parameter", "asset", "expected error", "")]
    rows += [(each.name, _short(each.nominal), _short(told.errors[at]),
              "not told" if at in told.refused else "") for at, each in enumerate(check.parameters)]
    sums = [SUMS] if any(each.weights for each in check.parameters) else []
    values = told.singular_values
    spread = values[0] / values[-1] if values[-1] > 0 else math.inf
    return [*check.quality.text().split("\n"), "", *lined(rows),
            *sums, f"condition {_short(spread)}", *check.reasons]


def identified_lines(found: Identified) -> list[str]:
    solution = found.solution
    rows = [("parameter", "asset", "identified", "95 %", "unit")]
    rows += [(each.name, _short(each.nominal), _short(solution.values[at]),
              f"+- {_short(float(solution.high[at] - solution.values[at]))}", _unit(each))
             for at, each in enumerate(found.parameters)]
    lines = lined(rows)
    lines += [SUMS] if any(each.weights for each in found.parameters) else []
    if solution.finished and not solution.settled:
        lines.append("the fit used up its steps: other numbers may leave less")
    lines += starts_lines(found)
    lines += [f"{each.name}: the log does not tell it; it stays {_short(each.nominal)}"
              for each in found.held]
    lines += [f"{each.name}: it ended at its bound" for each in found.at_bounds]
    lines += ["", "held-out motion, residual (root mean square)"]
    rows = [("joint", "channel", "before", "after", "")]
    for each in found.held_out:
        for joint, before, after in zip(found.joints, each.before, each.after):
            if math.isfinite(before):
                rows.append((joint.rpartition("/")[2], each.channel, _short(before),
                             _short(after), ""))
    lines += lined(rows, 2)
    for replay in found.replays:
        told = replay.why or f"positions {_short(replay.before)} -> {_short(replay.after)}"
        lines.append(f"{replay.engine}: {told}")
    return lines


def starts_lines(found: Identified) -> list[str]:
    """Of several starts one line."""
    if not len(found.costs):
        return []
    return [f"{alike(found.costs)} of {len(found.costs)} starts end where least is left; the "
            f"worst leaves {_short(float(found.costs.max() / found.costs.min()))} times as much"]


def self_test_lines(done: SelfTest) -> list[str]:
    rows = [("parameter", "truth", "found", "off", "allowed", "")]
    for each in done.scores:
        unit = " step" if each.parameter.family == "delay" else " %"
        factor = 1 if each.parameter.family == "delay" else 100
        rows.append((each.parameter.name, _short(each.truth), _short(each.found),
                     f"{factor * each.error:.2f}{unit}", f"{factor * each.allowed:g}{unit}",
                     "ok" if each.passed else "FAILED"))
    within = sum(each.low <= each.truth <= each.high for each in done.scores)
    return [*lined(rows), f"{within} of {len(done.scores)} truths are within the 95 % intervals",
            *(f"{each.name}: the log does not tell it" for each in done.refused)]


# ---- page


def _line(x: Array, y: Array, name: str, ends: tuple[float, float, float, float]) -> str:
    left, right, low, high = ends
    good = np.isfinite(y)
    step = max(1, -(-int(good.sum()) // MAX_POINTS))
    across = MARGIN + (x[good][::step] - left) / (right - left or 1) * (WIDTH - MARGIN - 8)
    up = HEIGHT - 20 - (y[good][::step] - low) / (high - low or 1) * (HEIGHT - 40)
    points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(across, up))
    return f'<polyline class="{name}" points="{points}"/>'


def _plot(time: Array, lines: dict[str, Array], told: str) -> str:
    whole = np.concatenate([values[np.isfinite(values)] for values in lines.values()])
    if not whole.size:
        return ""
    ends = (float(time[0]), float(time[-1]), float(whole.min()), float(whole.max()))
    marks = (f'<text x="{MARGIN}" y="{HEIGHT - 4}">{ends[0]:.4g} s</text>'
             f'<text x="{WIDTH - 8}" y="{HEIGHT - 4}" text-anchor="end">{ends[1]:.4g} s</text>'
             f'<text x="{MARGIN - 4}" y="{HEIGHT - 20}" text-anchor="end">{ends[2]:.4g}</text>'
             f'<text x="{MARGIN - 4}" y="28" text-anchor="end">{ends[3]:.4g}</text>')
    axis = f'<path class="axis" d="M{MARGIN} 16V{HEIGHT - 20}H{WIDTH - 4}"/>'
    drawn = "".join(_line(time, values, name, ends) for name, values in lines.items())
    return (f'<figure><svg width="{WIDTH}" height="{HEIGHT}" role="img" '
            f'aria-label="{html.escape(told, quote=True)}">{axis}{marks}{drawn}</svg>'
            f"<figcaption>{html.escape(told)}</figcaption></figure>")


def _plots(found: Identified) -> str:
    motion, made = found.motion, []
    time = motion["time"].reshape(-1)
    for column, joint in enumerate(found.joints[:MAX_PLOTS // 2]):
        lines = {name: motion[name][:, :, column].reshape(-1) for name in ("log", "before",
                                                                           "after")}
        made.append(_plot(time, lines, f"{joint}: position [rad or m]; log thick, asset dashed, "
                          "identified thin"))
        made.append(_plot(time, {name: lines[name] - lines["log"] for name in ("before", "after")},
                          f"{joint}: residual [rad or m]; asset dashed, identified thin"))
    left = len(found.joints) - MAX_PLOTS // 2
    more = f"<p>{left} more joints are not drawn.</p>" if left > 0 else ""
    return "<h2>Held-out motion</h2>" + "".join(made) + more


def _told_table(check: Check, told: Identifiability) -> str:
    rows = [(each.name, _short(told.sensitivities[at]), _short(told.errors[at]), _unit(each),
             "no" if at in told.refused else "yes") for at, each in enumerate(check.parameters)]
    values = ", ".join(_short(value) for value in told.singular_values)
    lines = "".join(f'<p class="bad">{html.escape(line)}</p>' for line in check.reasons)
    return ("<h2>What the log tells</h2><p>Sensitivity: deviations of the noise by which all "
            "samples together move for a change as large as the parameter. Expected error: the "
            "standard error of the best fit, from the Fisher information.</p>"
            + _table(["parameter", "sensitivity", "expected error", "unit", "told"], rows)
            + f"<p>Singular values: {values}</p>" + lines)


def page(found: Identified, asset: str, sources: Sequence[str]) -> str:
    """The page as text."""
    solution = found.solution
    verdict = "better than the asset" if found.improved else "not better than the asset"
    about = [("asset", asset), ("logs", ", ".join(sources)), ("engine", found.engine),
             ("time step", f"{found.step:g} s"), ("simulations", str(solution.simulations)),
             ("held-out motion", f"{verdict}: {_short(found.score[0])} -> "
              f"{_short(found.score[1])}")]
    numbers = [(each.name, _short(each.nominal), _short(solution.values[at]),
                _short(solution.low[at]), _short(solution.high[at]), _unit(each),
                "at its bound" if each in found.at_bounds else "")
               for at, each in enumerate(found.parameters)]
    numbers += [(each.name, _short(each.nominal), "", "", "", _unit(each),
                 "the log does not tell it")
                for each in found.held]
    left = [(which, each.channel, joint, _short(before), _short(after))
            for which, rows in (("training", found.training), ("held out", found.held_out))
            for each in rows
            for joint, before, after in zip(found.joints, each.before, each.after)
            if math.isfinite(before)]
    engines = [(each.engine, _short(each.before), _short(each.after), each.why)
               for each in found.replays]
    foreign = "".join(
        f'<p class="bad">{html.escape(joint)}: {part:.0%} of what it does stays unexplained</p>'
        for joint, part in zip(found.joints, found.unexplained) if joint in found.foreign)
    about += [("starts", line) for line in starts_lines(found)]
    parts = ["<h1>Identification</h1>", _table(["", ""], about), foreign, "<h2>Parameters</h2>",
             _table(["parameter", "asset", "identified", "low (95 %)", "high", "unit", ""],
                    numbers),
             "<h2>Residuals</h2><p>Root mean squares.</p>",
             _table(["motion", "channel", "joint", "before", "after"], left)]
    if engines:
        parts.append("<h2>On each engine</h2><p>Root mean square of all positions over the "
                     "held-out motion [rad or m].</p>"
                     + _table(["engine", "before", "after", ""], engines))
    parts += [_told_table(found.check, found.check.told), _plots(found), "<h2>Quality of the logs"
              "</h2><pre>" + html.escape(found.check.quality.text()) + "</pre>"]
    return ("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
            f"<title>Identification of {html.escape(asset)}</title>"
            f"<style>{STYLE}{LINES}</style></head><body>{''.join(parts)}</body></html>\n")
