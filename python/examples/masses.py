# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What an asset weighs, and where each mass comes from.

    python masses.py hand.usda
"""

import sys

import tenon_usd as tenon

stage = tenon.open(sys.argv[1])
scene = stage.physics()
for body, row in zip(scene.bodies, stage.masses()):
    print(f"{body.path}: {body.mass:.4f} kg ({row['reason']['mass']})")
print(f"together {scene.bodies.column('mass').sum():.4f} kg")
