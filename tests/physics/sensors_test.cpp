// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What sensors of a file read on MuJoCo, against closed forms.
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "tenon/engines/environments.h"
#include "tenon/make_simulation.h"
#include "tenon/math/angle.h"
#include "tenon/physics/read_physics.h"
#include "tenon/stage/test_stage.h"

namespace tenon {
namespace {

using engines::SensorReading;

constexpr double kG = 10;  // [m/s^2]

/// A scene in metres, z up, and a world of it that measures.
class Measured {
 public:
  explicit Measured(const std::string& prims, double time_step = 0.001)
      : stage_(stage::open_text(
            "(metersPerUnit = 1; kilogramsPerUnit = 1; upAxis = \"Z\")\n"
            "def PhysicsScene \"S\" { vector3f physics:gravityDirection = (0, 0, -1)\n"
            "float physics:gravityMagnitude = 10 }\n" +
            prims)) {
    Diagnostics findings;
    scene_ = std::make_unique<scene::PhysicsScene>(physics::read_physics(stage_, {}, findings));
    engines::SimulationOptions options{.time_step = time_step};
    options.outputs.sensors = true;
    auto made = make_world("mujoco", *scene_, options, findings);
    EXPECT_TRUE(made.has_value()) << (made.has_value() ? "" : made.error().to_string());
    world_ = std::make_unique<engines::World>(*std::move(made));
  }

  engines::World& world() { return *world_; }
  const scene::PhysicsScene& scene() const { return *scene_; }
  void run(double seconds) {
    const auto steps = static_cast<std::size_t>(std::lround(seconds / world_->time_step()));
    const Result<void> done = world_->step(steps);
    ASSERT_TRUE(done.has_value()) << done.error().to_string();
  }
  SensorReading reading(const std::string& path) const {
    for (std::size_t i = 0; i < scene_->sensors.size(); ++i) {
      if (scene_->sensors[i].path.str() == path) {
        return (*world_->sensors())[i];
      }
    }
    ADD_FAILURE() << "no sensor " << path;
    return {};
  }

 private:
  stage::Stage stage_;
  std::unique_ptr<scene::PhysicsScene> scene_;
  std::unique_ptr<engines::World> world_;
};

void expect_near(const Vec3d& value, const Vec3d& wanted, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(value[i], wanted[i], tolerance) << i;
  }
}

const std::string kGround =
    "def Plane \"Ground\" (apiSchemas = [\"PhysicsCollisionAPI\"]) { uniform token axis = \"Z\" "
    "}\n";

/// A box of 0.4 m and 3 kg whose lower face is at `height`, with what is in it.
std::string box_at(double height, const std::string& inside) {
  return "def Xform \"Box\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"]) {\n"
         "float physics:mass = 3\n"
         "double3 xformOp:translate = (0, 0, " +
         std::to_string(height + 0.2) +
         ")\n"
         "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n"
         "def Cube \"Shape\" (apiSchemas = [\"PhysicsCollisionAPI\"]) { double size = 0.4 }\n" +
         inside + "}\n";
}

// At rest an accelerometer feels what holds it: g upwards, in its own axes (here turned by 90
// degrees about x, so that up is along its y).
TEST(Sensors, AnImuAtRestReadsGravityUpwards) {
  Measured box(kGround + box_at(0,
                                "def IsaacImuSensor \"Imu\" {\n"
                                "double3 xformOp:translate = (0.1, 0.05, 0)\n"
                                "float xformOp:rotateX = 90\n"
                                "uniform token[] xformOpOrder = [\"xformOp:translate\", "
                                "\"xformOp:rotateX\"]\n}\n"));
  box.run(1);
  const SensorReading at_rest = box.reading("/Box/Imu");
  expect_near(at_rest.linear_acceleration, {{0, kG, 0}}, 1e-4);
  expect_near(at_rest.angular_velocity, {}, 1e-6);
  expect_near(rotate(at_rest.orientation, {{0, 1, 0}}), {{0, 0, 1}}, 1e-3);
  EXPECT_NEAR(at_rest.time, 1, 1e-9);
}

// In free fall it feels nothing at the centre of mass, and w^2 r inwards beside it.
TEST(Sensors, AnImuInFreeFallReadsWhatTurningAlonePutsOnIt) {
  Measured box(box_at(50,
                      "vector3f physics:angularVelocity = (0, 0, 180)\n"
                      "def IsaacImuSensor \"Center\" {}\n"
                      "def IsaacImuSensor \"Side\" {\n"
                      "double3 xformOp:translate = (0.1, 0, 0)\n"
                      "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n"));
  box.run(0.1);
  const double spin = M_PI;
  expect_near(box.reading("/Box/Center").linear_acceleration, {}, 1e-9);
  expect_near(box.reading("/Box/Side").linear_acceleration, {{-spin * spin * 0.1, 0, 0}}, 1e-6);
  expect_near(box.reading("/Box/Side").angular_velocity, {{0, 0, spin}}, 1e-6);
}

// A frame beside the centre of a box that falls and turns: where it is, and v + w x r.
TEST(Sensors, AFrameReadsWhereItIsAndHowItMoves) {
  Measured box(box_at(50,
                      "vector3f physics:angularVelocity = (0, 0, 180)\n"
                      "def Xform \"Tip\" {\n"
                      "custom uniform token tenon:sensor = \"frame\"\n"
                      "double3 xformOp:translate = (0.1, 0, 0)\n"
                      "float xformOp:rotateZ = 90\n"
                      "uniform token[] xformOpOrder = [\"xformOp:translate\", "
                      "\"xformOp:rotateZ\"]\n}\n"));
  box.run(0.1);
  const double spin = M_PI;
  const double turn = spin * 0.1;
  const SensorReading tip = box.reading("/Box/Tip");
  const Vec3d out{{std::cos(turn), std::sin(turn), 0}};
  expect_near(tip.position, {{0.1 * out[0], 0.1 * out[1], 50.2 - kG * 0.01 / 2}}, 2e-3);
  expect_near(tip.linear_velocity, {{-spin * 0.1 * out[1], spin * 0.1 * out[0], -kG * 0.1}}, 1e-3);
  expect_near(tip.angular_velocity, {{0, 0, spin}}, 1e-6);
  expect_near(rotate(tip.orientation, {{1, 0, 0}}), {{-out[1], out[0], 0}}, 1e-3);
}

// Episodes begin where joints and bodies are set, without a step.
TEST(Sensors, OfStatesReadWhatWasSetSinceTheStep) {
  Measured box(kGround + box_at(1,
                                "def Xform \"Tip\" { custom token tenon:sensor = \"frame\"\n"
                                "double3 xformOp:translate = (0.1, 0, 0)\n"
                                "uniform token[] xformOpOrder = [\"xformOp:translate\"] }\n"
                                "def IsaacImuSensor \"Imu\" {}\n"
                                "def IsaacRaycastSensor \"Rays\" {\n"
                                "uniform vector3f[] rayDirections = [(0, 0, -1)]\n"
                                "uniform point3f[] rayOrigins = [(0, 0, 0)]\n"
                                "float minRange = 0\nfloat maxRange = 100\n}\n"));
  const auto set = [&](double height) {
    engines::BodyState state = box.world().body_state(0);
    state.pose = {{{0, 0, height}}, rotation_about({{0, 0, 1}}, kPi / 2)};
    state.angular_velocity = {{0, 0, 3}};
    ASSERT_TRUE(box.world().set_body_state(0, state).has_value());
    expect_near(box.reading("/Box/Tip").position, {{0, 0.1, height}}, 1e-9);
    expect_near(box.reading("/Box/Tip").angular_velocity, {{0, 0, 3}}, 1e-9);
    expect_near(box.reading("/Box/Imu").angular_velocity, {{0, 0, 3}}, 1e-9);
    EXPECT_NEAR(box.reading("/Box/Rays").distances.at(0), height, 1e-6);
  };
  set(5);
  box.run(0.01);
  const Vec3d felt = box.reading("/Box/Imu").linear_acceleration;
  set(7);
  EXPECT_EQ(box.reading("/Box/Imu").linear_acceleration, felt);
  ASSERT_TRUE(box.world().reset().has_value());
  expect_near(box.reading("/Box/Tip").position, {{0.1, 0, 1.2}}, 1e-9);
  set(3);
}

// A box of which one ray leads down to the ground, one to the side where nothing is, and one is too
// short; its own shape is no obstacle.
TEST(Sensors, RaysReadHowFarOtherThingsAre) {
  Measured box(
      kGround +
      box_at(0,
             "def IsaacRaycastSensor \"Rays\" {\n"
             "float3[] rayDirections = [(0, 0, -1), (1, 0, 0), (0, 0, -1), (0.6, 0, -0.8)]\n"
             "float3[] rayOrigins = [(0, 0, 0), (0, 0, 0), (0, 0, 5), (0, 0, 0.6)]\n"
             "float maxRange = 4\n"
             "double3 xformOp:translate = (0, 0, 0.1)\n"
             "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n"));
  box.run(0.5);
  const std::vector<double> found = box.reading("/Box/Rays").distances;
  ASSERT_EQ(found.size(), 4u);
  EXPECT_NEAR(found[0], 0.3, 1e-3);
  EXPECT_EQ(found[1], -1);
  EXPECT_EQ(found[2], -1);
  EXPECT_NEAR(found[3], 0.9 / 0.8, 2e-3);
}

std::string turntable(const std::string& settings) {
  return "def Xform \"Table\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"]) {\n"
         "float physics:mass = 2\n"
         "float3 physics:diagonalInertia = (0.1, 0.1, 0.2)\n"
         "def IsaacImuSensor \"Imu\" {\n" +
         settings +
         "double3 xformOp:translate = (0.5, 0, 0)\n"
         "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n}\n"
         "def PhysicsRevoluteJoint \"Axle\" (apiSchemas = [\"PhysicsJointStateAPI:angular\"]) {\n"
         "custom uniform token tenon:sensor = \"joint\"\n"
         "rel physics:body1 = </Table>\n"
         "uniform token physics:axis = \"Z\"\n"
         "float state:angular:physics:velocity = 90\n}\n";
}

// On a turntable: w^2 r towards the axle and g upwards.
TEST(Sensors, AnImuOnATurntableReadsTheCentripetalAcceleration) {
  Measured table(turntable(""));
  table.run(0.5);
  const double spin = M_PI / 2;
  const SensorReading imu = table.reading("/Table/Imu");
  expect_near(imu.linear_acceleration, {{-spin * spin * 0.5, 0, kG}}, 1e-6);
  expect_near(imu.angular_velocity, {{0, 0, spin}}, 1e-9);
  const SensorReading axle = table.reading("/Axle");
  ASSERT_EQ(axle.joint.position.size(), 1u);
  EXPECT_NEAR(axle.joint.position[0], spin * 0.5, 1e-6);
  EXPECT_NEAR(axle.joint.velocity[0], spin, 1e-9);
  EXPECT_TRUE(axle.efforts.empty());
}

// A reading stays until the next multiple of the period. The mean of the last four orientations, a
// step apart, lags by one step and a half.
TEST(Sensors, PeriodsAndMeansAct) {
  Measured held(turntable("float sensorPeriod = 0.25\n"));
  held.run(0.3);
  EXPECT_NEAR(held.reading("/Table/Imu").time, 0.25, 1e-9);
  const Quatd q = held.reading("/Table/Imu").orientation;
  EXPECT_NEAR(2 * std::atan2(q.z, q.w), M_PI / 2 * 0.25, 1e-6);
  Measured mean(turntable("int orientationFilterWidth = 4\n"));
  mean.run(0.3);
  const Quatd lagging = mean.reading("/Table/Imu").orientation;
  EXPECT_NEAR(2 * std::atan2(lagging.z, lagging.w), M_PI / 2 * (0.3 - 0.0015), 1e-7);
  ASSERT_TRUE(mean.world().reset().has_value());
  EXPECT_NEAR(mean.reading("/Table/Imu").orientation.w, 1, 1e-12);
}

TEST(Sensors, AContactSensorReadsTheWeightThatRestsOnIt) {
  const std::string contact = "def IsaacContactSensor ";
  Measured box(kGround +
               box_at(0, contact + "\"All\" {}\n" + contact +
                             "\"Strong\" { float2 threshold = (40, 100) }\n" + contact +
                             "\"Cut\" { float2 threshold = (0, 20) }\n" + contact +
                             "\"Corner\" { float radius = 0.05\n"
                             "double3 xformOp:translate = (0.2, 0.2, -0.2)\n"
                             "uniform token[] xformOpOrder = [\"xformOp:translate\"] }\n" +
                             contact +
                             "\"Top\" { float radius = 0.05\n"
                             "double3 xformOp:translate = (0, 0, 0.2)\n"
                             "uniform token[] xformOpOrder = [\"xformOp:translate\"] }\n" +
                             contact + "\"Off\" { bool enabled = 0 }\n"));
  box.run(1);
  EXPECT_TRUE(box.reading("/Box/All").in_contact);
  EXPECT_NEAR(box.reading("/Box/All").normal_force, 3 * kG, 1e-5);
  EXPECT_FALSE(box.reading("/Box/Strong").in_contact);
  EXPECT_EQ(box.reading("/Box/Strong").normal_force, 0);
  EXPECT_TRUE(box.reading("/Box/Cut").in_contact);
  EXPECT_EQ(box.reading("/Box/Cut").normal_force, 20);
  EXPECT_NEAR(box.reading("/Box/Corner").normal_force, 3 * kG / 4, 1e-4);
  EXPECT_FALSE(box.reading("/Box/Top").in_contact);
  EXPECT_FALSE(box.reading("/Box/Off").in_contact);
}

/// A mass of 2 kg whose centre is 0.3 m beside a fixed joint to the world; the sensor is at the
/// joint, in axes that are turned by 90 degrees about z.
std::string cantilever(const std::string& joint) {
  return "def Xform \"Arm\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"]) {\n"
         "float physics:mass = 2\n"
         "point3f physics:centerOfMass = (0.3, 0, 0)\n"
         "float3 physics:diagonalInertia = (0.01, 0.01, 0.01)\n"
         "def Xform \"Wrist\" {\n"
         "custom uniform token tenon:sensor = \"forceTorque\"\n"
         "float xformOp:rotateZ = 90\n"
         "uniform token[] xformOpOrder = [\"xformOp:rotateZ\"]\n}\n}\n"
         "def PhysicsFixedJoint \"Joint\" {\n" +
         joint + "}\n";
}

// The joint carries m g and, about itself, m g l: it turns the arm up, about -y of the world, which
// is -x of the sensor. The same wherever the joint's frame is, and whichever side the arm is.
TEST(Sensors, AForceTorqueSensorReadsTheWeightOfACantilever) {
  for (const std::string joint :
       {"rel physics:body1 = </Arm>\n", "rel physics:body0 = </Arm>\n",
        "rel physics:body1 = </Arm>\npoint3f physics:localPos0 = (0, 0.7, 0)\n"
        "point3f physics:localPos1 = (0, 0.7, 0)\n"}) {
    Measured arm(cantilever(joint));
    arm.run(0.05);
    const SensorReading wrist = arm.reading("/Arm/Wrist");
    expect_near(wrist.wrench.force, {{0, 0, 2 * kG}}, 1e-6);
    expect_near(wrist.wrench.torque, {{-2 * kG * 0.3, 0, 0}}, 1e-6);
  }
}

TEST(Sensors, OfAJointReadItsDrives) {
  Measured arm(
      "def Xform \"Arm\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"]) {\n"
      "float physics:mass = 2\n"
      "point3f physics:centerOfMass = (0.3, 0, 0)\n"
      "float3 physics:diagonalInertia = (0.01, 0.01, 0.01)\n}\n"
      "def PhysicsRevoluteJoint \"Hinge\" (apiSchemas = [\"PhysicsDriveAPI:angular\"]) {\n"
      "custom uniform token tenon:sensor = \"joint\"\n"
      "rel physics:body1 = </Arm>\n"
      "uniform token physics:axis = \"Y\"\n"
      "float drive:angular:physics:stiffness = 20\n"
      "float drive:angular:physics:damping = 2\n}\n");
  arm.run(4);
  const SensorReading hinge = arm.reading("/Hinge");
  ASSERT_EQ(hinge.efforts.size(), 1u);
  const double angle = hinge.joint.position[0];
  EXPECT_NEAR(hinge.efforts[0], -2 * kG * 0.3 * std::cos(angle), 1e-4);  // against gravity
  EXPECT_EQ(hinge.efforts, *arm.world().drive_efforts(0));
}

TEST(Sensors, AreOffUnlessTheyAreAskedForAndMeasureInEnvironments) {
  const stage::Stage stage = stage::open_text(box_at(0, "def IsaacImuSensor \"Imu\" {}\n"));
  Diagnostics findings;
  const scene::PhysicsScene scene = physics::read_physics(stage, {}, findings);
  auto without = make_world("mujoco", scene, {}, findings);
  ASSERT_TRUE(without.has_value());
  EXPECT_EQ(without->sensors().error().diagnostic().rule, "simulation.output-off");
  engines::EnvironmentOptions options{.count = 2};
  options.simulation.outputs.sensors = true;
  auto many = make_environments("mujoco", scene, options, findings);
  ASSERT_TRUE(many.has_value());
  EXPECT_EQ(many->step(10), 0u);
  expect_near((*(*many)[1].sensors())[0].linear_acceleration, {}, 1e-9);
}

}  // namespace
}  // namespace tenon
