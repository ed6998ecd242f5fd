# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""How a command line says how logs are read: the options of all that read them."""

from __future__ import annotations

import argparse

from .channels import UNITS, Reading
from .log import Finding, LogError


def add_reading_options(parser: argparse.ArgumentParser) -> None:
    """--map, --units, --sign, --ignore, --allow-gaps, --no-check, --commands, --time, --topic and
    --episode."""
    add = parser.add_argument
    add("--map", action="append", default=[], metavar="NAME=JOINT",
        help="a column, or what columns call a joint; JOINT.command_position and the like say the "
             "signal, too")
    add("--units", action="append", default=[], metavar="UNITS",
        help="of positions, and per second of velocities: deg, rad, m, cm, mm")
    add("--sign", action="append", default=[], metavar="JOINT=-1",
        help="all signals of a joint the other way; JOINT.position=-1: that one")
    add("--ignore", action="append", default=[], metavar="REGEX",
        help="columns that are not read, by whole names")
    add("--allow-gaps", action="store_true",
        help="interpolate over gaps, and leave out rows without a state")
    add("--no-check", action="store_true", help="do not check units and signs against the asset")
    add("--commands", default="", metavar="FILE",
        help="a command table of the same clock, as tenon sim and tenon excite have it")
    add("--time", default="", metavar="COLUMN", help="the column with the times")
    add("--topic", action="append", default=[], metavar="NAME",
        help="a topic of a bag or of MCAP that is read; without it all of known types")
    add("--episode", type=int, metavar="NUMBER", help="of a data set, counted from 0")


def reading_of(arguments: argparse.Namespace) -> Reading:
    """What was given. Raises LogError for what cannot be."""
    mapping = dict(_pair(text, "--map", "NAME=JOINT") for text in arguments.map)
    signs = {name: _sign(value, name) for name, value in
             (_pair(text, "--sign", "JOINT=-1") for text in arguments.sign)}
    units = [word for text in arguments.units for word in text.split(",") if word]
    for word in units:
        if word not in UNITS:
            raise _wrong("--units", word, "one or two of " + ", ".join(UNITS))
    return Reading(mapping, tuple(units), signs, tuple(arguments.ignore), arguments.allow_gaps,
                   not arguments.no_check, arguments.commands, arguments.time,
                   tuple(arguments.topic), arguments.episode)


def _wrong(option: str, text: str, fix: str) -> LogError:
    return LogError(Finding("log.option", f"{option}: `{text}` cannot be used", fix=f"give {fix}"))


def _pair(text: str, option: str, form: str) -> tuple[str, str]:
    name, sign, value = text.rpartition("=")
    if not sign or not name or not value:
        raise _wrong(option, text, form)
    return name, value


def _sign(text: str, name: str) -> float:
    if text not in ("1", "-1", "+1"):
        raise _wrong("--sign", f"{name}={text}", "1 or -1")
    return float(text)
