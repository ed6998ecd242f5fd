# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares the values of random splines with OpenUSD's, at knots, between and outside of them.
Needs OpenUSD's Python modules.

usage: splines.py SAMPLE_SPLINES [SEED COUNT]

SAMPLE_SPLINES is built from tests/tools. Values agree within 1e-6 of the spline's largest value
(float and half: within their own precision).
"""

import os
import random
import subprocess
import sys
import tempfile

try:
    from pxr import Sdf, Tf
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

TOLERANCE = {"double": 1e-6, "timecode": 1e-6, "float": 2e-6, "half": 2e-3}


def coarse(rng, low, high):
    """Often a whole number, so that knots, ends of loops and samples meet."""
    return rng.randint(int(low), int(high)) if rng.random() < 0.9 else number(rng, low, high)


def coarse_spline(rng):
    """Short, with every kind of knot, loop and end."""
    is_bezier = rng.random() < 0.6
    lines = ["bezier," if is_bezier else "hermite,"]
    ends = [extrapolation(rng) for _ in range(2)]
    lines += [f"{side}: {end}," for side, end in zip(("pre", "post"), ends) if rng.random() < 0.8]
    times = sorted({coarse(rng, -6, 12) for _ in range(rng.randint(1, 5))})
    if rng.random() < 0.5:
        start = rng.choice(times)
        end = start + rng.choice([1, 2, 3, 4, 6, 0.5, 10])
        counts = f"{rng.randint(0, 3)}, {rng.randint(0, 3)}"
        lines.append(f"loop: ({start}, {end}, {counts}, {coarse(rng, -3, 3)}),")
    before = "curve"
    for time in times:
        pre = f"{coarse(rng, -9, 9)} & " if rng.random() < 0.4 else ""
        after = rng.choice(["curve", "linear", "held", "none"])
        line = f"{time}: {pre}{coarse(rng, -9, 9)}"
        if before == "curve":
            line += f"; pre {tangent(rng, is_bezier, rng.choice([1, 3, 9]))}"
        line += f"; post {after}"
        line += f" {tangent(rng, is_bezier, rng.choice([1, 3, 9]))}" if after == "curve" else ""
        lines.append(line + ",")
        before = after
    return "\n".join(lines), times


def number(rng, low, high):
    return round(rng.uniform(low, high), rng.choice([0, 1, 3]))


def extrapolation(rng):
    mode = rng.choice(["held", "linear", "sloped", "loop repeat", "loop reset", "loop oscillate",
                       "none"])  # fmt: skip
    return f"sloped({number(rng, -3, 3)})" if mode == "sloped" else mode


def tangent(rng, is_bezier, longest):
    slope = number(rng, -4, 4)
    algorithm = rng.choice([""] * 8 + [", autoEase", ", custom"])
    return f"({number(rng, 0, longest)}, {slope}{algorithm})" if is_bezier else f"({slope})"


def spline(rng):
    is_bezier = rng.random() < 0.7
    lines = ["bezier," if is_bezier else "hermite,"]
    ends = [extrapolation(rng) for _ in range(2)]
    if any("loop" in end for end in ends):
        # OpenUSD rounds the time of a loop's end to one outside of the other end.
        ends = ["held" if end == "none" else end for end in ends]
    lines += [f"{side}: {end}," for side, end in zip(("pre", "post"), ends) if rng.random() < 0.7]
    times = sorted({number(rng, -10, 30) for _ in range(rng.randint(1, 6))})
    if len(times) > 2 and rng.random() < 0.25:
        start = rng.randrange(len(times) - 1)
        end = rng.choice(times[start + 1 :]) + rng.choice([0, 0.5])
        counts = f"{rng.randint(0, 2)}, {rng.randint(0, 2)}"
        lines.append(f"loop: ({times[start]}, {end}, {counts}, {number(rng, -2, 2)}),")
    longest = rng.choice([2, 6, 25])
    before = "curve"
    for time in times:
        pre = f"{number(rng, -9, 9)} & " if rng.random() < 0.2 else ""
        after = rng.choice(["curve"] * 5 + ["linear", "held", "none"])
        line = f"{time}: {pre}{number(rng, -9, 9)}"
        if before == "curve":
            line += f"; pre {tangent(rng, is_bezier, longest)}"
        line += f"; post {after}"
        line += f" {tangent(rng, is_bezier, longest)}" if after == "curve" else ""
        lines.append(line + ",")
        before = after
    return "\n".join(lines), times


def sample_times(rng, all_times):
    knots = rng.sample(sorted(all_times), min(40, len(all_times)))
    whole = list(range(-24, 36)) + [i + 0.5 for i in range(-8, 16)]
    between = [round(rng.uniform(-80, 110), 4) for _ in range(110)]
    return sorted(set(knots + whole + between))


def expected_values(curve, times):
    """None where OpenUSD fails."""
    try:
        return [curve.Eval(t) for t in times]
    except Tf.ErrorException:
        return None


def agrees(curve, time, theirs, ours, tolerance):
    """Where the curve is so steep that rounding the time shows, that much more is allowed."""
    if theirs is None or ours == "none":
        return theirs is None and ours == "none"
    difference = abs(float(ours) - theirs)
    if difference <= tolerance:
        return True
    beside = [curve.Eval(time + i * 1e-9) for i in range(-8, 9)]
    return difference <= tolerance + max([abs(v - theirs) for v in beside if v is not None] + [0])


def samples_of(program, path, times):
    command = [program, path] + [repr(t) for t in times]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()


def main():
    program = sys.argv[1]
    seed, count = (int(a) for a in sys.argv[2:4]) if len(sys.argv) > 3 else (1, 600)
    rng = random.Random(seed)
    text, all_times, kinds = ["#usda 1.0", 'def "A" {'], set(), {}
    for i in range(count):
        body, times = (coarse_spline if i % 2 else spline)(rng)
        kinds[f"/A.s{i}"] = kind = rng.choice(["double", "double", "float", "half", "timecode"])
        text += [f"{kind} s{i}.spline = {{", body, "}"]
        all_times.update(times)
    times = sample_times(rng, all_times)
    differences, compared, failures = {}, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "splines.usda")
        with open(path, "w", encoding="utf-8") as out:
            out.write("\n".join(text) + "\n}\n")
        from_text = Sdf.Layer.FindOrOpen(path)
        binary = os.path.join(folder, "splines.usdc")
        from_text.Export(binary)
        lines = [(from_text, line) for line in samples_of(program, path, times)]
        from_crate = Sdf.Layer.OpenAsAnonymous(binary)  # which shortens tangents
        lines += [(from_crate, line) for line in samples_of(program, binary, times)]
    for layer, line in lines:
        attribute, *values = line.split(" ")
        curve = layer.GetAttributeAtPath(attribute).GetSpline()
        expected = expected_values(curve, times)
        if expected is None:
            failures += 1
            continue
        size = max([1.0] + [abs(v) for v in expected if v is not None])
        for time, ours, theirs in zip(times, values, expected, strict=True):
            compared += 1
            if not agrees(curve, time, theirs, ours, TOLERANCE[kinds[attribute]] * size):
                differences.setdefault(attribute, []).append((time, theirs, ours))
    for attribute, found in list(differences.items())[:4]:
        at = text.index(f"{kinds[attribute]} {attribute[3:]}.spline = {{")
        print("\n".join(text[at : at + 3]))
        print("time, OpenUSD, tenon:", found[:6])
    print(
        f"{len(kinds)} splines, {compared} values compared, {len(differences)} splines differ, "
        f"OpenUSD fails on {failures}"
    )
    return 1 if differences or compared < count else 0


if __name__ == "__main__":
    sys.exit(main())
