#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The bar chart of README.md, docs/speed.svg, from the recorded times beside usd-core.

usage: chart.py            compares the picture with the recorded times
       chart.py --write    draws it anew

Exit 0: the picture shows the recorded times; 1: it does not, or a row was not recorded.
"""

import html
import json
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RESULTS = os.path.join(ROOT, "bench/results/intel_r_xeon_r_processor_2.json")
PICTURE = os.path.join(ROOT, "docs/speed.svg")

# What a row of the chart says, and the recorded row: workload and phase, on one core.
ROWS = [
    ("Open 20,000 prims, text", "flatten_text", "open"),
    ("Open 20,000 prims, binary", "flatten_crate", "open"),
    ("Open 1,000 references to one asset", "compose_fleet", "open"),
    ("Open 64 instanced Isaac hands", "robots_isaac_hand", "open"),
    ("Parse a mesh of 1,000,000 points, text", "open_mesh_text", "parse"),
    ("Read the physics of 10,000 bodies", "read_physics", "physics"),
    ("Flatten 20,000 prims", "flatten_text", "flatten"),
    ("Write 20,000 prims as text", "flatten_text", "export"),
]
LABEL, BAR, NOTE, LINE, TOP = 255, 300, 215, 30, 62
WIDTH, HEIGHT = LABEL + BAR + NOTE, TOP + LINE * len(ROWS) + 34
GRAY, BLUE, INK, FAINT = "#d0d7de", "#0969da", "#1f2328", "#59636e"
NAME_SPACE = "http" + "://www.w3.org/2000/svg"


def milliseconds(value):
    return f"{value:.0f} ms" if value >= 10 else f"{value:.1f} ms"


def text(x, y, words, color=INK, more=""):
    return f'<text x="{x}" y="{y}" fill="{color}"{more}>{html.escape(words)}</text>'


def bars(y, words, ours, theirs):
    """One row: usd-core's time is the whole width, tenon's a part of it."""
    yield text(LABEL - 12, y + 15, words, more=' text-anchor="end"')
    yield f'<rect x="{LABEL}" y="{y}" width="{BAR}" height="20" rx="3" fill="{GRAY}"/>'
    width = max(1, round(BAR * ours / theirs))
    yield f'<rect x="{LABEL}" y="{y}" width="{width}" height="20" rx="3" fill="{BLUE}"/>'
    yield text(LABEL + BAR + 12, y + 15, f"{theirs / ours:.1f}x", more=' font-weight="bold"')
    yield text(LABEL + BAR + 62, y + 15, f"{milliseconds(ours)} / {milliseconds(theirs)}", FAINT)


def draw(results):
    """-> the picture as text"""
    recorded = {(row["workload"], row["phase"]): row for row in results["rows"]}
    parts = [
        f'<svg xmlns="{NAME_SPACE}" width="{WIDTH}" height="{HEIGHT}" '
        f'viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">',
        '<rect width="100%" height="100%" rx="6" fill="white"/>',
        text(16, 26, "Time on one core: tenon beside usd-core 26.11 (shorter is faster)",
             more=' font-size="15" font-weight="bold"'),
        f'<rect x="{LABEL}" y="40" width="12" height="12" fill="{BLUE}"/>',
        text(LABEL + 18, 51, "tenon", FAINT),
        f'<rect x="{LABEL + 72}" y="40" width="12" height="12" fill="{GRAY}"/>',
        text(LABEL + 90, 51, "usd-core", FAINT)]
    for number, (words, workload, phase) in enumerate(ROWS):
        row = recorded[workload, phase]
        parts += bars(TOP + LINE * number, words, row["tenon_ms"], row["peer_ms"])
    where = (f"{results['machine']}, {results['date']}, commit {results['commit'][:8]}: "
             f"medians of {results['rounds']} processes ({os.path.relpath(RESULTS, ROOT)})")
    parts += [text(16, HEIGHT - 14, where, FAINT, ' font-size="11"'), "</svg>\n"]
    return "\n".join(parts)


def main():
    with open(RESULTS, encoding="utf-8") as file:
        picture = draw(json.load(file))
    if "--write" in sys.argv:
        with open(PICTURE, "w", encoding="utf-8") as file:
            file.write(picture)
    with open(PICTURE, encoding="utf-8") as file:
        if file.read() != picture:
            print("docs/speed.svg does not show the recorded times: bench/chart.py --write")
            return 1
    print(f"{len(ROWS)} rows of {os.path.relpath(RESULTS, ROOT)} are in docs/speed.svg")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyError as error:
        sys.exit(f"chart: no recorded row {error}")
