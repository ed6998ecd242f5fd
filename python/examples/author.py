# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A new scene: a box that falls on a floor.

    python author.py box.usda
"""

import sys

import tenon_usd as tenon

stage = tenon.new(sys.argv[1], up_axis="Z", meters_per_unit=1.0)
stage.define("/World/scene", "PhysicsScene")
box = stage.define("/World/box", "Cube")
for schema in ("PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"):
    box.apply(schema)
box["size"] = 0.2
box["physics:density"] = 500.0  # kg/m^3
box.set("xformOp:translate", (0.0, 0.0, 1.0), type_name="double3")
box["xformOpOrder"] = ["xformOp:translate"]
floor = stage.define("/World/floor", "Plane")
floor.apply("PhysicsCollisionAPI")
stage.save()

world = tenon.World(sys.argv[1])
while world.time[0] < 2.0:
    world.step()
print("the box lies at", world.body_poses[0, 0, 2].round(3), "m")
