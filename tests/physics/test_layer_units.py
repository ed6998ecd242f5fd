#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""S-11: an asset in millimetres and grams, referenced into a stage in metres and kilograms. Read by
the units of its layer it is what it is when it is opened by itself.

    test_layer_units.py TENON
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

TENON = sys.argv[1]
HEAD = """#usda 1.0
(
    defaultPrim = "Robot"
    {units}
    upAxis = "Z"
    timeCodesPerSecond = 24
    startTimeCode = 0
    endTimeCode = 48
)
"""
ASSET = """
def Xform "Robot"
{
    def PhysicsScene "Scene"
    {
        float physics:gravityMagnitude = 5000
    }
    def Cube "Base" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
    )
    {
        double size = 100
        float physics:mass = 250
        point3f physics:centerOfMass = (1, 2, 3)
        float3 physics:diagonalInertia = (500000, 600000, 700000)
        vector3f physics:velocity = (10, 0, 20)
        vector3f physics:angularVelocity = (0, 90, 0)
        double3 xformOp:translate = (0, 0, 500)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Capsule "Slide" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
    )
    {
        double radius = 20
        double height = 80
        float physics:density = 0.002
        matrix4d xformOp:transform = ((0, 1, 0, 0), (-1, 0, 0, 0), (0, 0, 1, 0), (300, 0, 500, 1))
        uniform token[] xformOpOrder = ["xformOp:transform"]
    }
    def Mesh "Wedge" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI",
            "PhysicsMeshCollisionAPI"]
    )
    {
        uniform token subdivisionScheme = "none"
        uniform token physics:approximation = "convexHull"
        bool physics:kinematicEnabled = 1
        int[] faceVertexCounts = [3, 3, 3, 3]
        int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (100, 0, 0), (0, 100, 0), (0, 0, 100)]
        double3 xformOp:translate.timeSamples = { 0: (0, 900, 0), 48: (0, 900, 400) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsPrismaticJoint "Rail" (
        prepend apiSchemas = ["PhysicsDriveAPI:linear"]
    )
    {
        rel physics:body0 = </Robot/Base>
        rel physics:body1 = </Robot/Slide>
        point3f physics:localPos0 = (100, 0, 0)
        point3f physics:localPos1 = (0, 200, 0)
        quatf physics:localRot1 = (0.70710678, 0, 0, -0.70710678)
        float physics:lowerLimit = -50
        float physics:upperLimit = 150
        float physics:breakForce = 40000000
        float drive:linear:physics:stiffness = 3000
        float drive:linear:physics:damping = 200
        float drive:linear:physics:maxForce = 5000000
        float drive:linear:physics:targetPosition.timeSamples = { 0: 0, 48: 120 }
    }
    def PhysicsRevoluteJoint "Hinge" (
        prepend apiSchemas = ["PhysicsDriveAPI:angular"]
    )
    {
        rel physics:body1 = </Robot/Base>
        point3f physics:localPos0 = (0, 0, 500)
        float physics:lowerLimit = -30
        float physics:upperLimit = 60
        float physics:breakTorque = 9e9
        float drive:angular:physics:stiffness = 1000000
        uniform token drive:angular:physics:type = "%s"
    }
    def PhysicsDistanceJoint "Rope"
    {
        rel physics:body0 = </Robot/Wedge>
        rel physics:body1 = </Robot/Slide>
        float physics:minDistance = 10
        float physics:maxDistance = 2000
    }
}
"""
STAGE = """
def "Robot" (
    references = @./asset.usda@
)
{
}
"""
OWN = "metersPerUnit = 0.001\n    kilogramsPerUnit = 0.001"
SI = "metersPerUnit = 1\n    kilogramsPerUnit = 1"
READ = ("scenes", "bodies", "colliders", "joints", "animated")


def differences(one, two, where=""):
    """Paths of numbers that are not equal within rounding of floats, and of all else."""
    if isinstance(one, dict) and isinstance(two, dict) and one.keys() == two.keys():
        return [d for key in one for d in differences(one[key], two[key], f"{where}.{key}")]
    if isinstance(one, list) and isinstance(two, list) and len(one) == len(two):
        return [d for i, (a, b) in enumerate(zip(one, two))
                for d in differences(a, b, f"{where}[{i}]")]
    if isinstance(one, float) or isinstance(two, float):
        same = None not in (one, two) and abs(one - two) <= 1e-9 + 1e-6 * abs(one)
        return [] if same else [f"{where}: {one} {two}"]
    return [] if one == two else [f"{where}: {one} {two}"]


class LayerUnits(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def physics(self, name, *options):
        done = subprocess.run([TENON, "physics", str(pathlib.Path(self.folder.name) / name),
                               "--json", *options], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        answer = json.loads(done.stdout)
        return {key: answer[key] for key in READ}, {d["rule"] for d in answer["diagnostics"]}

    def both(self, drive_type):
        folder = pathlib.Path(self.folder.name)
        (folder / "asset.usda").write_text(HEAD.format(units=OWN) + ASSET % drive_type)
        (folder / "stage.usda").write_text(HEAD.format(units=SI) + STAGE)
        return self.physics("asset.usda")[0]

    def test_the_asset_is_as_large_and_heavy_as_by_itself(self):
        for drive_type in ("force", "acceleration"):
            with self.subTest(drive_type):
                alone = self.both(drive_type)
                read, rules = self.physics("stage.usda", "--reading", "layer-units=layer")
                self.assertEqual(differences(alone, read), [])
                self.assertNotIn("units.mixed", rules)

    def test_without_the_reading_it_is_a_thousand_times_larger_with_a_warning(self):
        alone = self.both("force")
        read, rules = self.physics("stage.usda")
        self.assertIn("units.mixed", rules)
        one, two = alone["colliders"][0], read["colliders"][0]
        self.assertEqual(one["path"], two["path"])
        for small, large in zip(one["halfExtents"], two["halfExtents"]):
            self.assertAlmostEqual(large / small, 1000)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
