# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Regular expressions of files and options. Python's search tries one way of a match after the
other, so that "(a+)+x" takes years on a long name: such expressions are refused before."""

from __future__ import annotations

import importlib
import math
import re
from collections.abc import Iterable
from typing import Any

#: How many ways the search may try on the longest name.
MOST_WAYS = 1e8
REPEATS = ("MAX_REPEAT", "MIN_REPEAT", "POSSESSIVE_REPEAT")


def compile_pattern(text: str, names: Iterable[str], anywhere: bool = False) -> re.Pattern[str]:
    """An expression that is matched to these names as a whole, or searched `anywhere` in them.
    Raises re.error for what is none, and for one whose search could go on for long."""
    longest = max(map(len, names), default=0)
    try:
        compiled = re.compile(text)
        free, others = _ways(importlib.import_module("re._parser").parse(text), longest)
    except (OverflowError, RecursionError) as reason:
        raise re.error(str(reason)) from None
    if _together(free + anywhere, others, longest) > math.log(MOST_WAYS):
        raise re.error(f"its repetitions fit a name of {longest} characters in more ways than can "
                       "be tried, for instance by one within another")
    return compiled


def _together(free: int, others: float, longest: int) -> float:
    """The logarithm of the ways in which `free` parts share the characters of a name, times
    others."""
    return others + (math.lgamma(longest + free + 1) - math.lgamma(longest + 1)
                     - math.lgamma(free + 1))


def _ways(parsed: Any, longest: int) -> tuple[int, float]:
    """How many parts of an expression take any number of characters, and the logarithm of the ways
    that all others have."""
    free, others = 0, 0.0
    for code, value in parsed:
        name = str(code)
        if name in REPEATS:
            least, most, body = value
            inner = _together(*_ways(body, longest), longest)
            if least > longest and body.getwidth()[0] == 0:
                inner = math.inf  # nothing, repeated without an end
            most = min(int(most), longest)
            if most == longest and inner == 0:
                free += 1
            elif most > 0:
                others += most * inner + math.log(max(most - least, 0) + 1)
        else:
            ways = [_ways(each, longest) for each in _within(name, value)]
            free += max((each for each, _ in ways), default=0)
            others += max((each for _, each in ways), default=0.0) + math.log(max(len(ways), 1))
    return free, others


def _within(name: str, value: Any) -> list[Any]:
    """The expressions within a part of one: alternatives of each other."""
    if name == "BRANCH":
        return list(value[1])
    if name == "GROUPREF_EXISTS":
        return [each for each in value[1:] if each is not None]
    if name == "ATOMIC_GROUP":
        return [value]
    return [value[-1]] if name in ("SUBPATTERN", "ASSERT", "ASSERT_NOT") else []
