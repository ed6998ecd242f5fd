# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""All scenes."""

import articulations
import bodies
import contacts
import differences
import differences_of_joints
import differences_of_newton
import joints
import tendons

PARTS = (
    bodies,
    contacts,
    joints,
    articulations,
    differences,
    differences_of_joints,
    differences_of_newton,
    tendons,
)


def rows():
    for part in PARTS:
        yield from part.scenes()
