#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""How time and memory grow with the input: families of generated layers, each size in a process.

Usage: complexity.py [--build DIR] [--largest N] [--record] [--smoke]
--record writes docs/complexity.svg and bench/results/complexity.json. Times are processor time.
"""

import argparse
import json
import math
import os
import sys
import tempfile

import machine
import run

# Family, sizes, what is drawn.
FAMILIES = [
    ("prims", [10, 100, 1000, 10000, 100000, 1000000],
     ["read_text", "read_crate", "write_text", "write_crate", "open"]),
    ("sublayers", [1, 3, 10, 30, 100, 300, 1000], ["open", "read_attributes"]),
    ("references", [1, 3, 10, 30, 100, 300, 1000], ["open", "read_attributes"]),
]
COLOURS = ["#1b6ca8", "#c0392b", "#27824b", "#8e44ad", "#b9770e", "#5d6d7e"]
WIDTH, HEIGHT, MARGIN = 360, 300, 56


def measure(program, family, size, rounds):
    """-> phase to seconds (the least of the rounds, as noise only adds), and MB under "memory"."""
    found = {}
    for _ in range(rounds):
        with tempfile.TemporaryDirectory() as folder:
            for line in run.run_lines([program, family, str(size), folder]):
                if "phase" in line:
                    best = min(line["cpu"])
                    found[line["phase"]] = min(found.get(line["phase"], best), best)
                elif "peak_rss_mb" in line:
                    found["memory"] = min(found.get("memory", math.inf), line["peak_rss_mb"])
    return found


def growth(points):
    """Exponent of the last tenfold: 1 for linear, 2 for quadratic; None for a single size."""
    if len(points) < 2:
        return None
    last_size, last = points[-1]
    size, value = max((p for p in points if p[0] * 9 <= last_size), default=points[0])
    return math.log(last / value) / math.log(last_size / size)


class Chart:
    """One family in logarithmic axes."""

    def __init__(self, left, title, series):
        self.left, self.title, self.series = left, title, series
        sizes = [size for points in series.values() for size, _ in points]
        values = [value for points in series.values() for _, value in points]
        self.x_range = (math.floor(math.log10(min(sizes))), math.ceil(math.log10(max(sizes))))
        self.y_range = (math.floor(math.log10(min(values))), math.ceil(math.log10(max(values))))

    def place(self, size, value):
        def share(number, low, high):
            return (math.log10(number) - low) / max(high - low, 1)
        x = self.left + MARGIN + share(size, *self.x_range) * (WIDTH - MARGIN - 12)
        y = HEIGHT - 40 - share(value, *self.y_range) * (HEIGHT - 80)
        return round(x, 1), round(y, 1)

    def axes(self):
        for power in range(self.x_range[0], self.x_range[1] + 1):
            x, bottom = self.place(10 ** power, 10 ** self.y_range[0])
            yield f'<line x1="{x}" y1="40" x2="{x}" y2="{bottom}" stroke="#ddd"/>'
            yield f'<text x="{x}" y="{bottom + 16}" text-anchor="middle">{10 ** power:,}</text>'
        for power in range(self.y_range[0], self.y_range[1] + 1):
            left, y = self.place(10 ** self.x_range[0], 10 ** power)
            right = self.left + WIDTH - 12
            yield f'<line x1="{left}" y1="{y}" x2="{right}" y2="{y}" stroke="#ddd"/>'
            yield f'<text x="{left - 6}" y="{y + 4}" text-anchor="end">{10.0 ** power:g}</text>'

    def svg(self):
        yield f'<text x="{self.left + MARGIN}" y="20" font-weight="bold">{self.title}</text>'
        yield from self.axes()
        for number, (name, points) in enumerate(self.series.items()):
            colour = COLOURS[number % len(COLOURS)]
            places = [self.place(*point) for point in points]
            line = " ".join(f"{x},{y}" for x, y in places)
            yield f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="1.5"/>'
            y = 54 + 13 * number
            yield (f'<text x="{self.left + MARGIN + 8}" y="{y}" fill="{colour}">{name}</text>')


def draw(results):
    """Upper row: seconds of each family; lower row: peak memory."""
    parts, height = [], 2 * HEIGHT
    for column, (family, rows) in enumerate(results.items()):
        names = [name for name in rows[0] if name not in ("size", "memory")]
        times = {name: [(row["size"], row[name]) for row in rows] for name in names}
        memory = {"peak memory": [(row["size"], row["memory"]) for row in rows]}
        parts += Chart(column * WIDTH, f"{family}: seconds", times).svg()
        parts.append(f'<g transform="translate(0,{HEIGHT})">')
        parts += Chart(column * WIDTH, f"{family}: MB", memory).svg()
        parts.append("</g>")
    width = WIDTH * len(results)
    name_space = "http" + "://www.w3.org/2000/svg"
    head = (f'<svg xmlns="{name_space}" width="{width}" height="{height}" '
            'font-family="sans-serif" font-size="11">')
    return "\n".join([head, '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>\n"])


def print_growth(results):
    print(f"\n{'family':<12}{'phase':<18}{'largest':>10}{'value':>12}{'growth':>8}")
    for family, rows in results.items():
        for name in rows[0]:
            if name != "size":
                points = [(row["size"], row[name]) for row in rows]
                exponent = growth(points)
                shown = "" if exponent is None else f"{exponent:8.2f}"
                print(f"{family:<12}{name:<18}{points[-1][0]:>10}{points[-1][1]:>12.4f}{shown}")
    print("\nseconds, MB; growth: the exponent over the last tenfold, 1 is linear")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--build", default=os.path.join(run.ROOT, "build/bench"))
    parser.add_argument("--largest", type=int, default=1000000)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--smoke", action="store_true", help="tiny inputs, once; for ctest")
    arguments = parser.parse_args()
    largest, rounds = (100, 1) if arguments.smoke else (arguments.largest, arguments.rounds)
    program = os.path.join(arguments.build, "bin/bench/complexity")
    results = {}
    for family, sizes, phases in FAMILIES:
        for size in (s for s in sizes if s <= largest):
            found = measure(program, family, size, rounds)
            row = {"size": size, **{name: found[name] for name in [*phases, "memory"]}}
            results.setdefault(family, []).append(row)
    print_growth(results)
    picture = draw(results)
    if arguments.record:
        folder = os.path.join(run.ROOT, "bench/results")
        os.makedirs(folder, exist_ok=True)
        with open(os.path.join(folder, "complexity.json"), "w", encoding="utf-8") as file:
            json.dump({**machine.description(run.ROOT, arguments.build), **results}, file, indent=1)
            file.write("\n")
        with open(os.path.join(run.ROOT, "docs/complexity.svg"), "w", encoding="utf-8") as file:
            file.write(picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
