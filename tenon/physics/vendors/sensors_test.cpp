// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gtest/gtest.h>

#include "tenon/physics/read_physics.h"
#include "tenon/stage/test_stage.h"

namespace tenon::physics {
namespace {

struct ReadSensors {
  PhysicsScene scene;
  Diagnostics findings;

  /// How many findings there are of a rule, and what the first of them says.
  std::size_t count(const std::string& rule) const {
    std::size_t found = 0;
    for (const Diagnostic& finding : findings) {
      found += finding.rule == rule ? 1 : 0;
    }
    return found;
  }
  std::string message(const std::string& rule) const {
    for (const Diagnostic& finding : findings) {
      if (finding.rule == rule) {
        return finding.message;
      }
    }
    return {};
  }
};

/// A stage in centimetres and grams.
ReadSensors read_sensors_of(const std::string& prims) {
  ReadSensors result;
  const stage::Stage stage = stage::open_text(
      "(metersPerUnit = 0.01; kilogramsPerUnit = 0.001; upAxis = \"Z\")\n" + prims);
  result.scene = read_physics(stage, {}, result.findings);
  return result;
}

std::string sensor_body(const std::string& inside, const std::string& settings = "") {
  return "def Xform \"B\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {\n" + settings +
         "double3 xformOp:translate = (0, 0, 100)\n"
         "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n" +
         inside + "}\n";
}

TEST(SensorReading, TakesIsaacsSensorsInSi) {
  const ReadSensors read = read_sensors_of(sensor_body(
      "def Xform \"Mount\" {\ndouble3 xformOp:translate = (0, 20, 0)\n"
      "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n"
      "def IsaacImuSensor \"Imu\" {\nfloat sensorPeriod = 0.01\n"
      "int linearAccelerationFilterWidth = 2\nint angularVelocityFilterWidth = 3\n"
      "int orientationFilterWidth = 4\nfloat xformOp:rotateX = 90\n"
      "uniform token[] xformOpOrder = [\"xformOp:rotateX\"]\n}\n}\n"
      "def IsaacContactSensor \"Touch\" {\nfloat radius = 5\nfloat2 threshold = (1000, 2000)\n}\n"
      "def IsaacContactSensor \"Whole\" {\nbool enabled = 0\n}\n"));
  ASSERT_EQ(read.scene.sensors.size(), 3u);
  const Sensor& imu = read.scene.sensors[0];
  EXPECT_EQ(imu.path.str(), "/B/Mount/Imu");
  EXPECT_EQ(imu.kind, SensorKind::Imu);
  EXPECT_EQ(imu.body, 0u);
  EXPECT_NEAR(imu.pose.position[1], 0.2, 1e-12);
  EXPECT_NEAR(rotate(imu.pose.orientation, {{0, 1, 0}})[2], 1, 1e-12);
  EXPECT_FLOAT_EQ(static_cast<float>(imu.period), 0.01F);
  EXPECT_EQ(imu.acceleration_width, 2);
  EXPECT_EQ(imu.velocity_width, 3);
  EXPECT_EQ(imu.orientation_width, 4);
  const Sensor& touch = read.scene.sensors[1];
  EXPECT_EQ(touch.kind, SensorKind::Contact);
  EXPECT_NEAR(touch.radius, 0.05, 1e-9);
  EXPECT_NEAR(touch.min_force, 1000 * 1e-5, 1e-9);  // g cm/s^2
  EXPECT_NEAR(touch.max_force, 2000 * 1e-5, 1e-9);
  const Sensor& whole = read.scene.sensors[2];
  EXPECT_FALSE(whole.enabled);
  EXPECT_EQ(whole.radius, kInfinity);
  EXPECT_NEAR(whole.max_force, 100000 * 1e-5, 1e-6);  // the schema's
  EXPECT_EQ(read.count("sensor.setting") + read.count("sensor.no-body"), 0u);
}

TEST(SensorReading, OneWithoutAnEnabledBodyIsToldAndLeftOut) {
  const ReadSensors alone = read_sensors_of("def IsaacImuSensor \"Imu\" {\n}\n");
  EXPECT_TRUE(alone.scene.sensors.empty());
  EXPECT_EQ(alone.message("sensor.no-body"),
            "no rigid body is at or above the sensor; it reads nothing");
  const ReadSensors off = read_sensors_of(sensor_body("def IsaacContactSensor \"Touch\" {\n}\n",
                                                      "bool physics:rigidBodyEnabled = 0\n"));
  EXPECT_TRUE(off.scene.sensors.empty());
  EXPECT_EQ(off.message("sensor.no-body"),
            "the body </B> of the sensor is disabled; it reads nothing");
  const ReadSensors nowhere = read_sensors_of(
      sensor_body("def IsaacImuSensor \"Imu\" {\ndouble3 xformOp:translate = (nan, 0, 0)\n"
                  "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n"));
  EXPECT_TRUE(nowhere.scene.sensors.empty());
  EXPECT_EQ(nowhere.count("sensor.no-body"), 1u);
}

TEST(SensorReading, NumbersThatCannotBeUsedAreToldAndTheirDefaultsCount) {
  const ReadSensors read = read_sensors_of(sensor_body(
      "def IsaacContactSensor \"A\" {\nfloat2 threshold = (nan, 1)\nfloat radius = inf\n}\n"
      "def IsaacContactSensor \"B\" {\nfloat2 threshold = (5, 1)\nfloat radius = nan\n}\n"
      "def IsaacContactSensor \"C\" {\nfloat2 threshold = (-1, 1)\n}\n"
      "def IsaacImuSensor \"D\" {\nint orientationFilterWidth = 0\n"
      "int angularVelocityFilterWidth = 100000\nfloat sensorPeriod = inf\n}\n"));
  ASSERT_EQ(read.scene.sensors.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.scene.sensors[i].min_force, 0) << i;
    EXPECT_EQ(read.scene.sensors[i].max_force, kInfinity) << i;
    EXPECT_EQ(read.scene.sensors[i].radius, kInfinity) << i;
  }
  EXPECT_EQ(read.scene.sensors[3].orientation_width, 1);
  EXPECT_EQ(read.scene.sensors[3].velocity_width, 10000);
  EXPECT_EQ(read.scene.sensors[3].period, 0);
  EXPECT_EQ(read.count("sensor.setting"), 7u);
  EXPECT_EQ(read.count("attribute.not-a-number"), 1u);  // the radius
}

const std::string kArm =
    "def Xform \"Arm\" (apiSchemas = [\"PhysicsRigidBodyAPI\"]) {\n"
    "def Xform \"Wrist\" {\ncustom uniform token tenon:sensor = \"forceTorque\"\n}\n}\n";

TEST(SensorReading, ForceTorqueSensorsBelongToTheJointThatHoldsTheirBody) {
  const ReadSensors held =
      read_sensors_of(kArm +
                      "def PhysicsRevoluteJoint \"J\" {\nrel physics:body0 = </Arm>\n"
                      "custom uniform token tenon:sensor = \"joint\"\n}\n");
  ASSERT_EQ(held.scene.sensors.size(), 2u);
  EXPECT_EQ(held.scene.sensors[0].kind, SensorKind::ForceTorque);
  EXPECT_EQ(held.scene.sensors[0].body, 0u);
  EXPECT_EQ(held.scene.sensors[0].joint, 0u);
  EXPECT_EQ(held.scene.sensors[1].kind, SensorKind::Joint);
  EXPECT_EQ(held.scene.sensors[1].body, std::nullopt);
  EXPECT_EQ(held.scene.sensors[1].joint, 0u);
  const ReadSensors free = read_sensors_of(kArm);
  EXPECT_TRUE(free.scene.sensors.empty());
  EXPECT_EQ(free.message("sensor.no-joint"),
            "no joint holds the body </Arm> of the force-torque sensor; it reads nothing");
}

TEST(SensorReading, SensorsOfMujocoThatNothingMeasuresAreNotRead) {
  const ReadSensors read = read_sensors_of(
      kArm +
      "def TenonMujocoSensor \"Held\" {\ncustom token tenon:mujoco:sensor = \"force\"\n"
      "rel tenon:mujoco:sensor:instrument = </Arm/Wrist>\n}\n"
      "def TenonMujocoSensor \"Clock\" {\ncustom token tenon:mujoco:sensor = \"clock\"\n}\n");
  ASSERT_EQ(read.scene.not_read.size(), 1u);
  EXPECT_EQ(read.scene.not_read[0].prim, Path::from("/Clock"));
  EXPECT_EQ(read.scene.not_read[0].property, "TenonMujocoSensor");
}

TEST(SensorReading, SensorsOfFramesBelongToTheBodyAboveThem) {
  const ReadSensors read = read_sensors_of(
      sensor_body("def Xform \"Tip\" {\ncustom uniform token tenon:sensor = \"frame\"\n"
                  "double3 xformOp:translate = (1, 2, 3)\n"
                  "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n"
                  "def Scope \"Y\" {\ncustom uniform token tenon:sensor = \"frame\"\n}\n"));
  ASSERT_EQ(read.scene.sensors.size(), 1u);
  EXPECT_EQ(read.scene.sensors[0].kind, SensorKind::Frame);
  EXPECT_NEAR(read.scene.sensors[0].pose.position[1], 0.02, 1e-15);
  EXPECT_EQ(read.count("sensor.no-body"), 1u);
}

TEST(SensorReading, WordsThatFitNoPrimAreTold) {
  const ReadSensors read = read_sensors_of(sensor_body(
      "custom uniform token tenon:sensor = \"joint\"\n"
      "def Xform \"X\" {\ncustom uniform token tenon:sensor = \"lidar\"\n}\n"
      "def Scope \"Y\" {\ncustom uniform token tenon:sensor = \"forceTorque\"\n}\n"
      "def IsaacImuSensor \"Z\" {\ncustom uniform token tenon:sensor = \"forceTorque\"\n}\n"));
  ASSERT_EQ(read.scene.sensors.size(), 1u);
  EXPECT_EQ(read.scene.sensors[0].kind, SensorKind::Imu);
  EXPECT_EQ(read.count("sensor.no-joint"), 1u);
  EXPECT_EQ(read.count("sensor.setting"), 2u);
  EXPECT_EQ(read.count("sensor.no-body"), 1u);
}

TEST(SensorReading, TakesRaysThatHaveADirection) {
  const ReadSensors read = read_sensors_of(sensor_body(
      "def IsaacRaycastSensor \"A\" {\nfloat3[] rayDirections = [(0, 0, 2), (0, 0, 0), (1, 0, 0)]\n"
      "float3[] rayOrigins = [(10, 0, 0)]\nfloat minRange = 5\nfloat maxRange = 1000\n}\n"
      "def IsaacRaycastSensor \"B\" {\n}\n"));
  ASSERT_EQ(read.scene.sensors.size(), 1u);
  const scene::Sensor& rays = read.scene.sensors[0];
  EXPECT_EQ(rays.kind, SensorKind::Rays);
  EXPECT_EQ(rays.ray_directions, (std::vector<Vec3d>{{{0, 0, 1}}, {{1, 0, 0}}}));
  EXPECT_NEAR(rays.ray_origins.at(0)[0], 0.1, 1e-12);
  EXPECT_EQ(rays.ray_origins.at(1), Vec3d{});
  EXPECT_NEAR(rays.min_range, 0.05, 1e-12);
  EXPECT_NEAR(rays.max_range, 10, 1e-12);
  EXPECT_EQ(read.count("sensor.setting"), 2u);  // a ray without a direction, a sensor without rays
}

TEST(SensorReading, BeamsAndMotionInsideBodiesAreListed) {
  const ReadSensors read = read_sensors_of(
      sensor_body("def IsaacLightBeamSensor \"Rays\" {\n}\n"
                  "def Camera \"Lidar\" (apiSchemas = [\"IsaacRtxLidarSensorAPI\"]) {\n}\n"
                  "def Xform \"Mount\" {\ndouble3 xformOp:translate.timeSamples = {0: (0, 0, 0), "
                  "9: (1, 0, 0)}\n"
                  "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n"
                  "def IsaacImuSensor \"Imu\" {\n}\n}\n"));
  ASSERT_EQ(read.scene.sensors.size(), 1u);
  const auto lists = [&](const std::string& prim, const std::string& property) {
    for (const NotRead& part : read.scene.not_read) {
      if (part.prim.str() == prim && part.property == property) {
        return true;
      }
    }
    return false;
  };
  EXPECT_TRUE(lists("/B/Rays", "IsaacLightBeamSensor"));
  EXPECT_TRUE(lists("/B/Lidar", "IsaacRtxLidarSensorAPI"));
  EXPECT_TRUE(lists("/B/Mount/Imu", "xformOp:translate"));
}

}  // namespace
}  // namespace tenon::physics
