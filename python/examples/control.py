# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Steers many hands at a time, each with drives of its own stiffness.

    python control.py hand.usda
"""

import sys

import numpy as np

import tenon_usd as tenon

world = tenon.World(sys.argv[1], envs=16, physics="physics", outputs=["efforts"])
names = world.drive_names
stiffness = {joint.path: joint.drives[0].stiffness
             for joint in world.scene.joints if len(joint.drives)}
for name in names:
    world.set_parameter("driveStiffness", name, stiffness[name] * np.linspace(0.1, 1.0, 16))
world.drive_targets = 0.5  # rad, of all drives of all environments
failed = world.step(20)
columns = [world.joint_names.index(name) for name in names]
reached = world.joint_positions[:, columns].mean(axis=1)
print("failed:", failed)
print("softest and stiffest:", reached[0].round(4), reached[-1].round(4), "rad")
print("largest effort:", np.abs(world.drive_efforts()).max().round(4), "N m")
