# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes of single driven joints without gravity, whose effective inertia is known by hand."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "engines_beside"))
from author import body, drive, joint, scene

WEIGHTLESS = ["float physics:gravityMagnitude = 0"]


def drives(kind="angular", law="force", stiffness=1.0, **more):
    return [drive(kind, law, stiffness, **more)]


def wheel(name, at, moment):
    return body(name, at, collides=False, mass=2.0, inertia=(moment,) * 3)


def revolute(law="force", lines=(), apis=(), articulated=False, **more):
    """0.5 kg m2 about a fixed axis through the centre of mass."""
    return scene(
        wheel("A", (0, 0, 3), 0.5),
        joint("revolute", "J", None, "/World/A", (0, 0, 3), axis="Y", parts=drives(law=law, **more),
              lines=lines, apis=apis),
        gravity=WEIGHTLESS, articulated=articulated)


def prismatic(law="force", **more):
    """2 kg along X."""
    return scene(
        wheel("A", (0, 0, 3), 0.2),
        joint("prismatic", "J", None, "/World/A", (0, 0, 3), axis="X",
              parts=drives("linear", law, **more)),
        gravity=WEIGHTLESS)


def two_bodies(first=2.0, second=3.0, articulated=True):
    """Two bodies that float, a slider through both centres of mass between them."""
    parts = [body(name, at, collides=False, mass=mass, inertia=(0.1 * mass,) * 3)
             for name, at, mass in (("A", (0, 0, 3), first), ("B", (1, 0, 3), second))]
    return scene(
        *parts,
        joint("prismatic", "J", "/World/A", "/World/B", (1, 0, 0), axis="X",
              parts=drives("linear")),
        gravity=WEIGHTLESS, articulated=articulated)


RATIOS = (1.0, 0.5, -2.0)  # of each wheel to the first one; the last follows the middle one


def mimic_chain(moment=0.5):
    """J1 follows J0 by 0.5, J2 follows J1 by -4: one coordinate moves all three."""
    base = body("Base", (0, 0, 3), collides=False, mass=1.0, inertia=(1.0,) * 3)
    parts = [base, joint("fixed", "Hold", None, "/World/Base", (0, 0, 3))]
    for i in range(3):
        parts.append(wheel(f"W{i}", (0.5 * i, 0, 3), moment))
        words = {"parts": drives()} if i == 0 else {
            "apis": ["NewtonMimicAPI"],
            "lines": [f"float newton:mimicCoef1 = {RATIOS[i] / RATIOS[i - 1]}",
                      f"rel newton:mimicJoint = </World/J{i - 1}>"]}
        parts.append(joint("revolute", f"J{i}", "/World/Base", f"/World/W{i}", (0.5 * i, 0, 0),
                           axis="Y", limits=(-60, 60) if i == 0 else (-170, 170), **words))
    return scene(*parts, gravity=WEIGHTLESS, articulated=True)


def armature(extra=1.5):
    """0.5 kg m2 and an armature beside it."""
    return revolute(articulated=True, apis=["PhysxJointAxisAPI:angular"],
                    lines=[f"float physxJointAxis:angular:armature = {extra}"])


# name -> (layer, joint, inertia [kg m2 or kg]); of acceleration drives 1 counts.
SCENES = {
    "revolute": (revolute(), "J", 0.5),
    "prismatic": (prismatic(), "J", 2.0),
    "floating": (two_bodies(), "J", 2.0 * 3.0 / (2.0 + 3.0)),
    "mimic chain": (mimic_chain(), "J0", 0.5 * sum(r * r for r in RATIOS)),
    "armature": (armature(), "J", 0.5 + 1.5),
    "acceleration": (revolute("acceleration"), "J", 0.5),
}
