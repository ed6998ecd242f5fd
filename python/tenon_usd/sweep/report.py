# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A page about the results of a sweep: counts, metrics, what they go with, plots, failed cases.

One file of HTML with its pictures inside, without scripts and without anything from elsewhere.
"""

from __future__ import annotations

import html
import os
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .chunks import Results, Row, write_whole
from .plan import Plan, Vary

Array = npt.NDArray[Any]
NAME = "report.html"
#: Plots of a page, points of a plot, failed cases that are listed.
MAX_PLOTS, MAX_POINTS, MAX_FAILED = 120, 2000, 100
WIDTH, HEIGHT, MARGIN = 350, 220, 60
STYLE = """\
:root { color-scheme: light dark; --line: #8888; --mark: #1f6fb4; }
@media (prefers-color-scheme: dark) { :root { --mark: #6cb2ee; } }
body { font: 15px/1.45 system-ui, sans-serif; max-width: 1120px; margin: 2em auto; padding: 0 1em; }
table { border-collapse: collapse; margin: 0.6em 0 1.6em; }
th, td { padding: 0.2em 0.9em 0.2em 0; border-bottom: 1px solid var(--line); text-align: left;
  vertical-align: top; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
figure { display: inline-block; margin: 0 0.8em 1em 0; }
figcaption { font-size: 13px; }
svg text { font-size: 11px; fill: currentColor; }
svg .axis { stroke: var(--line); fill: none; }
svg circle { fill: var(--mark); fill-opacity: 0.55; }
svg polyline { stroke: var(--mark); stroke-width: 1.5; fill: none; }
"""


def _said(value: Any) -> str:
    return html.escape(f"{value:.5g}" if isinstance(value, float) else str(value))


def _table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    rows = list(rows)
    right = [any(isinstance(row[i], (int, float)) for row in rows) for i in range(len(head))]

    def line(kind: str, cells: Sequence[Any]) -> str:
        made = "".join(f"<{kind}{' class=number' if number else ''}>{_said(cell)}</{kind}>"
                       for cell, number in zip(cells, right, strict=True))
        return f"<tr>{made}</tr>"

    return f"<table>{line('th', head)}{''.join(line('td', row) for row in rows)}</table>"


def _ranks(values: Array) -> Array:
    """Ranks from 0; equal values share the mean of theirs."""
    _, place, counts = np.unique(values, return_inverse=True, return_counts=True)
    ends = np.cumsum(counts)
    return np.asarray(((2 * ends - counts - 1) / 2.0)[place])


def rank_correlation(x: Array, y: Array) -> float:
    """Spearman's coefficient: from -1, falls wherever x rises, to 1; NaN where one is constant."""
    if len(x) < 3:
        return float("nan")
    a, b = _ranks(x), _ranks(y)
    a, b = a - a.mean(), b - b.mean()
    scale = float(np.sqrt((a @ a) * (b @ b)))
    return float(a @ b) / scale if scale > 0 else float("nan")


def _places(values: Array, room: float) -> tuple[Array, float, float]:
    """Where values are on an axis, and what its ends are."""
    low, high = float(values.min()), float(values.max())
    spread = high - low
    if spread == 0:
        return np.full(len(values), room / 2), low, high
    return (values - low) / spread * room, low, high


def _plot(x: Array, y: Array, of_x: str, of_y: str, names: Sequence[str] | None, line: bool) -> str:
    """A picture of points; `names` are what whole numbers on the x axis mean; `line` joins the
    means of equal x."""
    wide, high = WIDTH - MARGIN - 8, HEIGHT - 2 * 20
    across, left, right = _places(x, wide)
    up, bottom, top = _places(y, high)
    across, up = across + MARGIN, HEIGHT - 20 - up
    step = max(1, -(-len(x) // MAX_POINTS))
    points = "".join(f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2.2"/>'
                     for a, b in zip(across[::step], up[::step], strict=True))
    if line:
        at = np.unique(across)
        means = " ".join(f"{a:.1f},{up[across == a].mean():.1f}" for a in at)
        points += f'<polyline points="{means}"/>'
    ends = (names[0], names[-1]) if names else (_said(left), _said(right))
    marks = (
        f'<text x="{MARGIN}" y="{HEIGHT - 4}">{html.escape(ends[0])}</text>'
        f'<text x="{WIDTH - 8}" y="{HEIGHT - 4}" text-anchor="end">{html.escape(ends[1])}</text>'
        f'<text x="{MARGIN - 4}" y="{HEIGHT - 20}" text-anchor="end">{_said(bottom)}</text>'
        f'<text x="{MARGIN - 4}" y="28" text-anchor="end">{_said(top)}</text>')
    axis = f'<path class="axis" d="M{MARGIN} 16V{HEIGHT - 20}H{WIDTH - 4}"/>'
    told = f"{of_y} over {of_x}"
    return (f'<figure><svg width="{WIDTH}" height="{HEIGHT}" role="img" '
            f'aria-label="{html.escape(told, quote=True)}">{axis}{marks}{points}</svg>'
            f"<figcaption>{html.escape(told)}</figcaption></figure>")


def _named(name: str, units: dict[str, str]) -> str:
    return f"{name} [{units[name]}]" if name in units else name


def _numbers(rows: Sequence[Row], vary: Vary) -> tuple[Array, list[str] | None]:
    """A column of the plan as numbers: the values, or numbers of the texts that it has."""
    values = [row[vary.name] for row in rows]
    if all(isinstance(value, float) for value in values):
        return np.array(values), None
    texts = list(dict.fromkeys(str(value) for value in vary.values))
    found = {text: number for number, text in enumerate(texts)}
    return np.array([float(found.get(str(value), len(found))) for value in values]), texts


def page(plan: Plan, rows: Sequence[Row], digest: str = "") -> str:
    """The page as text, of all rows or of some."""
    from .table import units_of

    units = units_of(plan)
    good = [row for row in rows if row["status"] == "ok"]
    metrics = {metric.name: np.array([row[metric.name] for row in good], dtype=np.float64)
               for metric in plan.metrics}
    statuses: dict[str, int] = {}
    for row in rows:
        statuses[row["status"]] = statuses.get(row["status"], 0) + 1
    about = [("asset", plan.asset or "varies"), ("engine", plan.engine or "the asset's"),
             ("duration", f"{plan.duration:g} s"), ("seed", plan.seed),
             ("cases", f"{len(rows)} of {plan.case_count}"),
             *((status, count) for status, count in sorted(statuses.items())),
             ("digest", digest[:12])]
    parts = ["<h1>Sweep</h1>", _table(["", ""], [(name, str(value)) for name, value in about])]
    parts.append("<h2>Metrics</h2>" + _metrics(metrics, units))
    columns = {vary.name: _numbers(good, vary) for vary in plan.vary}
    parts.append(_goes_with(plan, metrics, columns))
    parts.append(_plots(plan, metrics, columns, units))
    failed = [row for row in rows if row["status"] != "ok"]
    if failed:
        shown = [(row["case"], row["status"], row["time"], row["error"])
                 for row in failed[:MAX_FAILED]]
        more = f"<p>{len(failed) - len(shown)} more</p>" if len(failed) > len(shown) else ""
        parts.append("<h2>Cases that did not run to their end</h2>"
                     + _table(["case", "status", "time [s]", "error"], shown) + more)
    return ("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
            f"<title>Sweep of {html.escape(plan.asset or plan.source)}</title>"
            f"<style>{STYLE}</style></head><body>{''.join(parts)}</body></html>\n")


def _metrics(metrics: dict[str, Array], units: dict[str, str]) -> str:
    rows: list[tuple[Any, ...]] = []
    for name, all_values in metrics.items():
        values = all_values[np.isfinite(all_values)]
        if len(values):
            rows.append((_named(name, units), len(values), float(values.min()),
                         float(np.median(values)), float(values.mean()), float(values.max()),
                         float(values.std())))
        else:
            rows.append((_named(name, units), 0, *(["-"] * 5)))
    return _table(["metric", "cases", "least", "median", "mean", "largest", "deviation"], rows)


def _goes_with(plan: Plan, metrics: dict[str, Array],
               columns: dict[str, tuple[Array, list[str] | None]]) -> str:
    """Rank correlations of metrics with what varied."""
    numeric = {name: values for name, (values, texts) in columns.items() if texts is None}
    if not numeric or not metrics:
        return ""
    rows = []
    for metric, y in metrics.items():
        fits = np.isfinite(y)
        found = [rank_correlation(x[fits], y[fits]) for x in numeric.values()]
        rows.append((metric, *(round(each, 2) if each == each else "-" for each in found)))
    return ("<h2>Rank correlations</h2><p>Of metrics with what varied (Spearman): 1 where the "
            "metric rises whenever the number does, -1 where it falls.</p>"
            + _table(["metric", *numeric], rows))


def _plots(plan: Plan, metrics: dict[str, Array],
           columns: dict[str, tuple[Array, list[str] | None]], units: dict[str, str]) -> str:
    made: list[str] = []
    for metric, y in metrics.items():
        fits = np.isfinite(y)
        for vary in plan.vary:
            x, texts = columns[vary.name]
            if fits.any() and len(made) < MAX_PLOTS:
                made.append(_plot(x[fits], y[fits], _named(vary.name, units),
                                  _named(metric, units), texts, vary.draw == "grid"))
    left = len(metrics) * len(plan.vary) - len(made)
    more = f"<p>{left} more are not drawn.</p>" if left > 0 else ""
    return "<h2>Plots</h2>" + "".join(made) + more if made else ""


def write_report(results: Results, rows: Sequence[Row]) -> str:
    """Writes FOLDER/report.html; -> its path. Errors: OSError."""
    path = os.path.join(results.folder, NAME)
    write_whole(path, page(results.plan, rows, results.digest).encode())
    return path
