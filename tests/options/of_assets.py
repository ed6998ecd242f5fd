# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Options of every verb, and those that say what of an asset is read."""

import re

from option_row import Row


def is_quiet(without, outcome, _):
    """Of what is told, errors alone."""
    return "error: " in outcome.said and len(outcome.said) < len(without.said) and all(
        "error: " in line for line in outcome.said.splitlines() if line)


def is_coloured(without, outcome, _):
    return "\x1b[" in outcome.said and "\x1b[" not in without.said


def said(outcome):
    """All text but addresses of views."""
    return re.sub(r"(http\S*|\d+:127\S*)", "", outcome.said + outcome.text)


def of_every_verb():
    yield Row("--json", (), wanted=lambda _, out, __: out.answer["schema"], once=True)
    # A layer is missing, many times.
    text = {"leaves_out": ("--json",), "asset": "noisy.usda", "once": True}
    yield Row("--quiet", ("--quiet",), wanted=is_quiet, **text)
    yield Row("--verbose", ("--verbose",), sees=said, **text)
    yield Row("--color", ("--color", "always"), wanted=is_coloured, **text)
    yield Row("--color", ("--color", "never"), wanted=lambda _, out, __: "\x1b[" not in out.said,
              **text)
    yield Row("--color", ("--color", "auto"), sees=lambda o: "\x1b[" in o.said,
              same=("mujoco", "jolt", "physx"), **text)
    yield Row("--version", ("--version",), wanted=lambda _, out, __: out.text.startswith("tenon "),
              once=True)


def of_assets():
    """Each takes bodies away, or brings some."""
    yield Row("--physics", ("--physics", "heavy"))
    yield Row("--mask", ("--mask", "/World/Slider,/World/Floor,/World/PhysicsScene,/World/Arm,"
                         "/World/Base,/World/Hinge,/World/Weld,/World/Seen,/World/Eye"))
    yield Row("--unloaded", ("--unloaded",))
    yield Row("--load", ("--load", "none"))
    yield Row("--mute-layer", ("--mute-layer", "{assets}/extra.usda"))
    yield Row("--search-path", ("--search-path", "{folder}/library"), asset="search.usda")
    yield Row("--sandbox", ("--sandbox", "{assets}"), asset="outside.usda")
    yield Row("--allow-read", ("--allow-read", "{folder}/outside"), asset="outside.usda",
              with_=("--sandbox", "{assets}"))
    yield Row("--max-work", ("--max-work", "5"), wanted=(
        lambda _, out, __: "compose.work-exceeded" in out.findings()))


def of_settings(name):
    """tenon.toml chooses the engine where no option does; `name` reads it off."""
    def settled(without, outcome, engine):
        return name(without) == "jolt" and name(outcome) == "mujoco" and engine is not None
    return Row("--no-settings", ("--no-settings",), asset="settled/main.usda",
               leaves_out=("--engine",), wanted=settled, once=True)
