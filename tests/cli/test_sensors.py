#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What `tenon sim --log sensors` measures and writes, and what other verbs do with sensors.

    test_sensors.py TENON
"""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError:
    numpy = None

TENON = str(pathlib.Path(sys.argv[1]).absolute())
GRAVITY = 9.81

# A box on the ground, in centimetres: forces are in N whatever the unit of length.
BOX = """#usda 1.0
(
    metersPerUnit = 0.01
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def PhysicsScene "Scene"
{
    vector3f physics:gravityDirection = (0, 0, -1)
    float physics:gravityMagnitude = 981
}
def Plane "ground" (prepend apiSchemas = ["PhysicsCollisionAPI"])
{
    uniform token axis = "Z"
}
def Cube "box" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
)
{
    float physics:mass = 2
    double size = 20
    double3 xformOp:translate = (0, 0, 10)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
# The box with an instrument of each kind, on an arm that a driven hinge holds level.
SENSORS = BOX.rstrip("}\n") + """
    def IsaacContactSensor "touch" {
        float radius = %(radius)g
    }
    def IsaacImuSensor "imu" {
        int linearAccelerationFilterWidth = %(width)d
    }
    def IsaacImuSensor "off" {
        bool enabled = 0
    }
}
def Xform "arm" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{
    float physics:mass = 3
    point3f physics:centerOfMass = (30, 0, 0)
    float3 physics:diagonalInertia = (100, 100, 100)
    double3 xformOp:translate = (0, 500, 100)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Xform "wrist" {
        custom uniform token tenon:sensor = "forceTorque"
    }
}
def PhysicsFixedJoint "weld"
{
    rel physics:body1 = </arm>
    point3f physics:localPos0 = (0, 500, 100)
    custom uniform token tenon:sensor = "joint"
}
"""


class Sensors(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = pathlib.Path(place.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def ok(self, *arguments):
        process = subprocess.run([TENON, "sim", *map(str, arguments)], capture_output=True,
                                 text=True, check=False, timeout=120, cwd=self.folder)
        self.assertEqual(process.returncode, 0, process.stderr)
        return process

    def rows(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return [{key: float(value) for key, value in row.items()}
                    for row in csv.DictReader(file)]

    def lines(self, name):
        return [json.loads(line) for line in (self.folder / name).read_text().splitlines()]

    def test_sensors_read_in_every_format_what_holds_the_box(self):
        """An IMU reads g upwards (cm/s^2), a contact sensor m g, a wrist m g and m g l."""
        path = self.write("sensors.usda", SENSORS % {"radius": -1, "width": 1})
        for name in ("run.csv", "run.jsonl"):
            self.ok(path, "--duration", 1, "-o", name, "--log", "sensors")
        row, line = self.rows("run.csv")[-1], self.lines("run.jsonl")[-1]
        sensors = line["sensors"]
        self.assertEqual(list(sensors), ["/arm/wrist", "/box/imu", "/box/touch", "/weld"])
        self.assertEqual(sensors["/box/touch"]["kind"], "contact")
        self.assertEqual(row["/box/touch.inContact"], 1)
        self.assertAlmostEqual(row["/box/touch.normalForce"], 2 * GRAVITY, places=3)
        self.assertAlmostEqual(row["/box/imu.linearAcceleration.z"], 100 * GRAVITY, delta=0.1)
        self.assertAlmostEqual(row["/arm/wrist.force.z"], 3 * GRAVITY, places=4)
        self.assertAlmostEqual(row["/arm/wrist.torque.y"], -3 * GRAVITY * 0.3, places=4)
        self.assertEqual(sensors["/box/imu"]["angularVelocity"],
                         [row[f"/box/imu.angularVelocity.{axis}"] for axis in "xyz"])
        self.assertNotIn("contacts", line)  # what sensors are made from is not asked for
        self.assertNotIn("/weld.reactionForce.x", row)
        if numpy:
            self.ok(path, "--duration", 1, "-o", "run.npz", "--log", "sensors")
            archive = numpy.load(self.folder / "run.npz")
            paths = [path.decode() for path in archive["sensor_paths"]]
            at = archive["sensor_force_offsets"][paths.index("/arm/wrist")]
            self.assertEqual(archive["sensor_force"][-1, at + 2], row["/arm/wrist.force.z"])
            self.assertEqual(archive["sensor_kinds"][paths.index("/box/imu")], b"imu")

    def test_frames_and_rays_are_read_in_the_units_of_the_stage(self):
        """A frame 4 cm above the centre of a box, a ray down from there, one to nothing."""
        path = self.write("frames.usda", BOX.rstrip("}\n") + """
    def Xform "tip" {
        custom uniform token tenon:sensor = "frame"
        double3 xformOp:translate = (0, 0, 4)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def IsaacRaycastSensor "rays" {
            float3[] rayDirections = [(0, 0, -1), (1, 0, 0)]
        }
    }
}
""")
        for name in ("run.csv", "run.jsonl"):
            self.ok(path, "--duration", 1, "-o", name, "--log", "sensors")
        row, sensors = self.rows("run.csv")[-1], self.lines("run.jsonl")[-1]["sensors"]
        self.assertAlmostEqual(row["/box/tip.framePosition.z"], 14, delta=0.01)
        self.assertAlmostEqual(row["/box/tip.frameOrientation.w"], 1, delta=1e-3)
        self.assertAlmostEqual(row["/box/tip.frameLinearVelocity.x"], 0, delta=1e-3)
        self.assertAlmostEqual(row["/box/tip/rays.distance.0"], 14, delta=0.01)
        self.assertEqual(row["/box/tip/rays.distance.1"], -1)
        self.assertEqual(sensors["/box/tip/rays"]["kind"], "rays")
        self.assertEqual(sensors["/box/tip"]["framePosition"][2], row["/box/tip.framePosition.z"])
        if numpy:
            self.ok(path, "--duration", 1, "-o", "run.npz", "--log", "sensors")
            archive = numpy.load(self.folder / "run.npz")
            self.assertEqual(archive["sensor_distance"][-1].tolist(),
                             [row["/box/tip/rays.distance.0"], -1])

    def test_sensors_that_cannot_measure_are_told(self):
        bad = self.write("bad.usda", SENSORS % {"radius": math.nan, "width": 0})
        process = self.ok(bad, "--duration", 0.1, "-o", "run.csv", "--log", "sensors")
        self.assertIn("attribute.not-a-number", process.stderr)
        self.assertIn("sensor.setting", process.stderr)
        plain = self.write("plain.usda", BOX)
        process = self.ok(plain, "--duration", 0.1, "-o", "run.csv", "--log", "sensors")
        self.assertIn("sim.no-sensors", process.stderr)
        mean = self.write("mean.usda", SENSORS % {"radius": -1, "width": 4})
        self.ok(mean, "--duration", 0.1, "--state-out", "mean.state")
        process = self.ok(mean, "--state-in", "mean.state", "--duration", 0.1, "-o", "run.csv",
                          "--log", "sensors")
        self.assertIn("sim.sensors-anew", process.stderr)

    def tenon(self, *arguments):
        return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                              check=True, timeout=120, cwd=self.folder).stdout

    def test_structure_keeps_sensors_and_strip_takes_them_out(self):
        asset = self.write("asset.usda", """#usda 1.0
(
    defaultPrim = "Rig"
    metersPerUnit = 1
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def Xform "Rig"
{
    def Xform "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 3
        def IsaacImuSensor "imu" {
            float sensorPeriod = 0.01
            double3 xformOp:translate = (0.1, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
        def IsaacContactSensor "touch" {
            float radius = 0.3
        }
        def Xform "wrist" {
            token tenon:sensor = "forceTorque"
        }
    }
    def PhysicsFixedJoint "joint" {
        rel physics:body1 = </Rig/base>
        token tenon:sensor = "joint"
    }
}
""")
        before = json.loads(self.tenon("physics", asset, "--json"))["sensors"]
        self.assertEqual([sensor["kind"] for sensor in before],
                         ["imu", "contact", "forceTorque", "joint"])
        self.assertIn("4 sensors", self.tenon("physics", asset))
        self.tenon("structure", asset, "-o", "rig")
        place = self.folder / "rig/Rig.usda"
        self.assertEqual(json.loads(self.tenon("physics", place, "--json"))["sensors"], before)
        self.assertTrue(json.loads(self.tenon("check", place, "--json"))["ok"])
        self.tenon("strip", asset, "-o", "bare.usda")
        self.assertNotIn("ensor", (self.folder / "bare.usda").read_text())


if __name__ == "__main__":
    sys.argv = sys.argv[:1]
    unittest.main()
