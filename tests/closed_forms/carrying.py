# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Mimics whose followers carry a weight, beside their leaders and on their leaders' links."""

import math

from coupled import HALF, WHEEL, base, newton_mimic
from form import G, Form, coordinate

from author import body, drive, joint, scene


def load_on(name, shows, factor, follower_at, parent, leader, turned):
    """A follower of 1 kg carries its weight 0.3 m from its hinge; the leader's drive of 60 N m/rad
    gives way. `turned`: the horizontal arm of the weight for each angle of the leader [rad]."""
    angle = 0.0
    for _ in range(500):
        angle += 0.2 * (turned(angle) * G / 60 - angle)
    angle = math.degrees(angle)
    start = tuple(p - q for p, q in zip(follower_at, (0.3, 0, 0)))
    layer = scene(
        base(),
        leader,
        body("W1", (follower_at[0], 0, 3), collides=False, mass=1.0, inertia=(0.01,) * 3),
        joint(
            "revolute",
            "J0",
            "/World/Base",
            "/World/W0",
            (0, 0, 0),
            axis="Y",
            limits=(-3000, 3000),
            parts=[drive("angular", "force", 60 * HALF, 8 * HALF, 0.0)],
        ),
        joint(
            "revolute",
            "J1",
            parent,
            "/World/W1",
            start,
            (-0.3, 0, 0),
            axis="Y",
            **newton_mimic(factor),
        ),
        articulated=True,
    )
    return Form(
        name,
        shows,
        layer,
        2.5,
        (
            coordinate(2.5, angle, 0.15, "J0"),
            coordinate(2.5, factor * angle, 0.15 * max(1, abs(factor)), "J1"),
        ),
        says=("sim.drive-sags",),
    )


def mimics_under_load():
    """The leader feels what its follower carries, whatever both weigh."""
    for factor in (2.0, -3.0):
        yield load_on(
            f"mimic_carries_{factor:g}",
            f"a follower of factor {factor:g} beside its leader carries a weight",
            factor,
            (0.8, 0, 0),
            "/World/Base",
            body("W0", (0, 0, 3), **WHEEL),
            lambda a, factor=factor: 0.3 * factor * math.cos(factor * a),
        )
    for factor in (1.0, 0.5, -2.0):
        yield load_on(
            f"mimic_chain_carries_{factor:g}",
            f"a follower of factor {factor:g} on its leader's link carries a weight",
            factor,
            (0.7, 0, 0),
            "/World/W0",
            body("W0", (0, 0, 3), collides=False, mass=1.0, inertia=(0.02,) * 3),
            lambda a, factor=factor: (
                0.4 * math.cos(a) + 0.3 * (1 + factor) * math.cos((1 + factor) * a)
            ),
        )


KINDS = {"mimics that carry": (mimics_under_load,)}
