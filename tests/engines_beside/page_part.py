# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""An engine's part of docs/beside-other-engines.md, from what the runs gave."""

import math


def number(value):
    """Three digits after the point, less where they are zero; small ones are zero."""
    return f"{0.0 if abs(value) < 5e-4 else value:.3f}".rstrip("0").rstrip(".")


def triple(values):
    return "(" + ", ".join(number(value) for value in values) + ")"


def turn_vector(turn):
    """Of a quaternion (x, y, z, w): axis times angle [degrees]."""
    sign = -1 if turn[3] < 0 else 1
    size = math.hypot(*turn[:3])
    angle = math.degrees(2 * math.atan2(size, abs(turn[3])))
    return [sign * part / size * angle if size else 0 for part in turn[:3]]


def below(value, bounds=(0.01, 0.1, 0.2, 0.5, 1, 2, 3, 4, 5, 10, 20, 50, 100, 181)):
    """The next of some bounds: what is exact differs from machine to machine."""
    return f"{next(bound for bound in bounds if value < bound):g}"


def compared(row):
    return " and ".join(f"{time:g}" for time in row.times) + " s"


def tolerance(metres, degrees):
    turn = "" if degrees >= 180 else f", {degrees:g} degrees"
    return f"{1000 * metres:g} mm{turn}"


def quantity(case, apart):
    """-> (what, tenon's value, the engine's value), of what is farthest beyond its tolerance"""
    if apart.error:
        return "the run", "goes through", apart.error.split("Error: ")[-1].split(". ")[0][:90]
    by_place = apart.metres / case.tolerance[0] >= apart.degrees / case.tolerance[1]
    path, time, a, b = apart.place if by_place else apart.turn
    name = path.rsplit("/", 1)[-1]
    if by_place:
        return f"place of {name} at {time:g} s", triple(a), triple(b)
    rounded = [[round(part, 1) for part in turn_vector(turn)] for turn in (a, b)]
    return f"turn of {name} at {time:g} s, degrees", triple(rounded[0]), triple(rounded[1])


def cells(*words):
    return (
        "| " + " | ".join(str(word).replace("|", "/").replace("\n", " ") for word in words) + " |\n"
    )


def text(engine, results):
    """`results`: (case, how far apart) of every row."""
    equal = [(case, apart) for case, apart in results if not case.expects_difference()]
    other = [(case, apart) for case, apart in results if case.expects_difference()]
    lines = f"{len(results)} scenes: {len(equal)} equal, {len(other)} differ.\n\n"
    lines += cells("scene", "quantity", "tenon", engine, "because of", "rule")
    lines += "|---|---|---|---|---|---|\n"
    for case, apart in other:
        rule = case.difference.rule
        lines += cells(
            case.row.shows,
            *quantity(case, apart),
            case.difference.cause,
            f"[{rule.split('.')[1]}](rules/{rule}.md)",
        )
    lines += "\nEqual:\n\n"
    lines += cells("scene", "shows", "compared at", "tolerance", "apart")
    lines += "|---|---|---|---|---|\n"
    for case, apart in equal:
        lines += cells(
            case.row.name,
            case.row.shows,
            compared(case.row),
            tolerance(*case.tolerance),
            f"below {below(1000 * apart.metres)} mm, {below(apart.degrees)} degrees",
        )
    return lines
