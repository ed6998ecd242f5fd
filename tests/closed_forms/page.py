# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""docs/closed-forms.md, from what the runs gave."""

import math

VERDICTS = ("right", "told", "silent", "false alarm")
# `tenon check --for` is about programs that read the layer by themselves. These rules name what
# such a reader makes of it, which is no property of the engine that this program feeds.
NOT_OF_THE_ENGINE = {
    "portability.articulation-root",
    "portability.drive-ignored",
    "portability.joint-kind",
    "portability.mass-without-inertia",
    "portability.root-above-joint",
    "portability.stretched-sphere",
}
MEASURED = 5  # column of what a run gave: its last digits differ from machine to machine

HEAD = """# Closed forms

{scenes} small scenes whose motion is known: by a closed form, or by an integration of their
equations in steps of 0.1 ms. Each runs on every engine of the build at the default step of 2 ms.
The scenes are in [tests/closed_forms](../tests/closed_forms/form.py), which also says how near a
run must come: within 1 or 2 % of the way, since all engines step by methods of first order.

- *right*: within the tolerance, and nothing calls the run into doubt;
- *told*: not within it, and a message names that: a warning, error or note of `tenon sim`, an entry
  of its `notMapped`, exit code 3, or a rule of `tenon check --for` the engine;
- *silent*: not within it, and no message;
- *false alarm*: right until a warning or error spoke.

The last two are misses. Those that are known stand by name in
[known_misses.txt](../tests/closed_forms/known_misses.txt), which only shrinks.
`make judge ONLY=closed_forms` holds this page and that list.

"""


def number(value):
    """Three digits."""
    if not isinstance(value, (int, float)) or math.isnan(value):
        return "none"
    return "0" if abs(value) < 1e-9 else f"{value:.3g}"


def count(outcomes):
    return {verdict: sum(each.verdict() == verdict for each in outcomes) for verdict in VERDICTS}


def result(outcomes, faults):
    """The last line of a run; the judgement has it in its table."""
    scenes = len({each.form.name for each in outcomes})
    engines = sorted({each.engine for each in outcomes})
    parts = []
    for engine in engines:
        found = count([each for each in outcomes if each.engine == engine])
        parts.append(f"{engine} " + ", ".join(f"{n} {what}" for what, n in found.items() if n))
    return f"{faults} faults, {scenes} scenes: " + "; ".join(parts)


def cells(*words):
    return "| " + " | ".join(str(word).replace("|", "/") for word in words) + " |\n"


def counts(outcomes, kinds):
    """Kind by engine: right, told, silent and false alarms."""
    engines = sorted({each.engine for each in outcomes})
    lines = cells("kind", "scenes", *engines) + "|---|---|" + "---|" * len(engines) + "\n"
    for kind in [*kinds, "all"]:
        own = [each for each in outcomes if kind in ("all", each.form.kind)]
        row = []
        for engine in engines:
            found = count([each for each in own if each.engine == engine])
            row.append(", ".join(f"{n} {what}" for what, n in found.items() if n))
        lines += cells(kind, len({each.form.name for each in own}), *row)
    return lines


def deviations(outcomes, verdict):
    lines = cells("scene", "engine", "what it shows", "quantity", "expected", "measured", "said")
    lines += "|---|---|---|---|---|---|---|\n"
    found = [each for each in outcomes if each.verdict() == verdict]
    for each in found:
        what, expected, measured = each.wrong[0] if each.wrong else ("all", "", "as expected")
        value = measured if isinstance(measured, str) else number(measured)
        words = ", ".join(f"`{said}`" for said in each.said())
        lines += cells(
            each.form.name,
            each.engine,
            each.form.shows,
            what,
            number(expected) if each.wrong else "",
            value,
            words,
        )
    return lines if found else "None.\n"


def text(outcomes, kinds):
    """The page. Lengths in units of the stage, angles in degrees; of each row the first quantity
    that is not as expected."""
    lines = HEAD.format(scenes=len({each.form.name for each in outcomes}))
    lines += counts(outcomes, kinds)
    lines += (
        "\nBelow, lengths are in units of the stage and angles in degrees; of each scene the first "
        "quantity that is\nnot as expected. `none`: the run ended before.\n"
    )
    for verdict in VERDICTS[1:]:
        lines += f"\n## {verdict.capitalize()}\n\n" + deviations(outcomes, verdict)
    return lines


def without_measured(page):
    rows = []
    for line in page.splitlines():
        parts = line.split(" | ")
        if len(parts) == 7:
            parts[MEASURED] = ""
        rows.append(" | ".join(parts))
    return rows


def same(old, new):
    """Whether two pages say the same, without the measured values."""
    return without_measured(old) == without_measured(new)
