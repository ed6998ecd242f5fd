// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/engines/mujoco/test_scene.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Axis;
using scene::Dof;
using scene::JointKind;

// 1 kg on a rail along x, driven.
TestScene rail(const scene::Drive& x_drive, double start = 0, double mass = 1) {
  TestScene scene(0);
  const auto body = scene.add_body("Mass", {{start, 0, 0}}, mass);
  auto& joint = scene.add_joint("Rail", JointKind::Prismatic, {}, body, Axis::X);
  joint.drives.push_back(x_drive);
  return scene;
}

TEST(Drives, UndampedDriveIsASpring) {
  TestScene scene = rail(drive(Dof::TransX, 100, 0), 0.1);
  auto sim = simulation(scene, 0.0002);
  // E-117: x = x0 cos(omega t), omega = sqrt(k / m) = 10.
  run(*sim, 0.5);
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.1 * std::cos(5.0), 2e-4);
}

TEST(Drives, StepResponseOfACriticallyDampedDrive) {
  scene::Drive d = drive(Dof::TransX, 100, 20);
  d.target_position = 1;
  TestScene scene = rail(d);
  auto sim = simulation(scene, 0.0002);
  run(*sim, 0.3);
  // x = 1 - (1 + w t) exp(-w t) with w = 10, damping ratio 1.
  EXPECT_NEAR(sim->joint_state(0).position[0], 1 - 4 * std::exp(-3.0), 1e-3);
}

TEST(Drives, VelocityDriveApproachesItsTarget) {
  scene::Drive d = drive(Dof::TransX, 0, 5);
  d.target_velocity = 2;
  TestScene scene = rail(d, 0, 2);
  auto sim = simulation(scene, 0.0002);
  run(*sim, 0.4);
  // v = v* (1 - exp(-t d / m)).
  EXPECT_NEAR(sim->joint_state(0).velocity[0], 2 * (1 - std::exp(-1.0)), 1e-3);
}

// 15 N of the drive less 12 N of friction, over a damper of 10 N s/m. What an asset says of
// MuJoCo's friction counts.
TEST(Drives, FrictionOfALightJointIsWhatTheAssetSays) {
  scene::Drive d = drive(Dof::TransX, 0, 10);
  d.target_velocity = 1.5;
  TestScene scene = rail(d, 0, 0.02);
  auto sim = simulation(scene, 0.002);
  ASSERT_TRUE(sim->set_parameter({Parameter::JointFriction, 0, 0}, 12).has_value());
  run(*sim, 1);
  EXPECT_NEAR(sim->joint_state(0).velocity[0], 0.3, 1e-3);
  scene.joints[0].friction = 12;
  sim = simulation(scene, 0.002);
  run(*sim, 1);
  EXPECT_NEAR(sim->joint_state(0).velocity[0], 0.3, 1e-3);
  scene.joints[0].parts.mujoco.solref_friction = {0.02, 1};
  sim = simulation(scene, 0.002);
  run(*sim, 1);
  EXPECT_GT(sim->joint_state(0).velocity[0], 0.5);
}

TEST(Drives, SpringAndDamperAreClampedAsOneForce) {
  scene::Drive d = drive(Dof::TransX, 1000, 1000);
  d.target_position = 100;
  d.target_velocity = -50;
  d.max_force = 3;
  TestScene scene = rail(d);
  auto sim = simulation(scene, 0.001);
  run(*sim, 1);
  // k x* + d v* = 50000 N is clamped to 3 N: v = F t / m.
  EXPECT_NEAR(sim->joint_state(0).velocity[0], 3, 1e-6);
}

TEST(Drives, WeakDriveCannotCarryTheWeight) {
  for (const double force : {5.0, 20.0}) {
    TestScene scene;
    const auto body = scene.add_body("Mass", {});
    auto& joint = scene.add_joint("Lift", JointKind::Prismatic, {}, body, Axis::Z);
    joint.drives.push_back(drive(Dof::TransZ, 10000, 100));
    joint.drives[0].max_force = force;
    auto sim = simulation(scene);
    run(*sim, 0.5);
    // E-120: 9.81 N of weight against 5 N sinks with a = -4.81 m/s^2 once the spring
    // is stretched enough (10 ms), against 20 N stays.
    const double expected = force < kG ? -(kG - force) * 0.5 : 0.0;
    EXPECT_NEAR(sim->joint_state(0).velocity[0], expected, 0.02) << force;
  }
}

TEST(Drives, AccelerationDriveDoesNotDependOnTheInertia) {
  for (const double mass : {0.01, 1.0, 50.0}) {
    scene::Drive d = drive(Dof::TransX, 100, 20);
    d.acceleration = true;
    d.target_position = 1;
    TestScene scene = rail(d, 0, mass);
    auto sim = simulation(scene, 0.0002);
    run(*sim, 0.3);
    EXPECT_NEAR(sim->joint_state(0).position[0], 1 - 4 * std::exp(-3.0), 1e-3) << mass;
  }
}

TEST(Drives, AccelerationDriveSeesTheInertiaOfBothBodies) {
  TestScene scene(0);
  const auto a = scene.add_body("A", {}, 1);
  const auto b = scene.add_body("B", {}, 3);
  auto& joint = scene.add_joint("Between", JointKind::Prismatic, a, b, Axis::X);
  joint.drives.push_back(drive(Dof::TransX, 100, 20));
  joint.drives[0].acceleration = true;
  joint.drives[0].target_position = 1;
  auto sim = simulation(scene, 0.0002);
  run(*sim, 0.3);
  EXPECT_NEAR(sim->joint_state(0).position[0], 1 - 4 * std::exp(-3.0), 1e-3);
}

TEST(Drives, StiffDriveOnALightLinkStaysStable) {
  TestScene scene;
  const auto link = scene.add_body("Link", {{0, 0, 0}}, 0.005, {{1e-7, 1e-7, 1e-7}});
  scene.bodies[link].center_of_mass = {{0.01, 0, 0}};
  auto& joint = scene.add_joint("Knuckle", JointKind::Revolute, {}, link, Axis::Y);
  joint.drives.push_back(drive(Dof::RotY, 100, 1));  // k dt^2 / I = 670
  joint.drives[0].target_position = 0.5;
  auto sim = simulation(scene);
  run(*sim, 2);
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.5, 1e-3);
}

TEST(Drives, TargetsFollowTheirTimeSamples) {
  TestScene scene = rail(drive(Dof::TransX, 10000, 200));
  scene.scalar_tracks.push_back(
      {scene::Animated::DriveTargetPosition, 0, 0, {0, 1, 2}, {0, 0.5, 0.5}, false});
  auto sim = simulation(scene);
  run(*sim, 0.8);
  // A ramp of 0.5 m/s is followed with the lag d / k v = 0.01 m.
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.4 - 0.01, 2e-3);
  run(*sim, 1);
  EXPECT_NEAR(sim->joint_state(0).position[0], 0.5, 1e-3);
}

TEST(Drives, GainsFollowTheirTimeSamples) {
  scene::Drive d = drive(Dof::TransX, 0, 0);
  d.target_position = 1;
  TestScene scene = rail(d);
  scene.scalar_tracks.push_back({scene::Animated::DriveStiffness, 0, 0, {0, 1}, {0, 1000}, true});
  scene.scalar_tracks.push_back({scene::Animated::DriveDamping, 0, 0, {0, 1}, {0, 60}, true});
  auto sim = simulation(scene);
  run(*sim, 0.9);
  EXPECT_EQ(sim->joint_state(0).position[0], 0);
  run(*sim, 1.1);
  EXPECT_NEAR(sim->joint_state(0).position[0], 1, 1e-3);
}

TEST(Drives, LimitsBeatDrives) {
  scene::Drive d = drive(Dof::TransX, 1000, 50);
  d.target_position = 2;
  TestScene scene = rail(d);
  scene.joints[0].upper = 1;
  auto sim = simulation(scene);
  run(*sim, 2);
  EXPECT_NEAR(sim->joint_state(0).position[0], 1, 0.01);  // S-101, E-122
}

TEST(Drives, DriveOnALockedDofIsReported) {
  TestScene scene = rail(drive(Dof::TransY, 10, 1));
  auto sim = simulation(scene);
  EXPECT_TRUE(mentions(sim->not_mapped(), "/Rail", "drive:transY"));
}

}  // namespace
}  // namespace tenon::engines::mujoco
