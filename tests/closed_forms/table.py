# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""All scenes, by kind."""

import dataclasses
import itertools

import carrying
import coupled
import driven
import flight
import impacts
import kinematic
import limited
import settings
import sliding
import swinging
import watched

PARTS = (
    flight,
    sliding,
    impacts,
    swinging,
    limited,
    driven,
    coupled,
    carrying,
    kinematic,
    settings,
    watched,
)


def kinds():
    return [kind for part in PARTS for kind in part.KINDS]


def forms():
    for part in PARTS:
        for kind, scenes in part.KINDS.items():
            for form in itertools.chain(*(each() for each in scenes)):
                yield dataclasses.replace(form, kind=kind)
