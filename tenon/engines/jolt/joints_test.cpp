// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/engines/jolt/test_run.h"

namespace tenon::engines::jolt {
namespace {

using scene::Dof;
using scene::Index;
using scene::JointKind;

double angle_of(const Simulation& simulation) { return simulation.joint_state(0).position.at(0); }
double speed_of(const Simulation& simulation) { return simulation.joint_state(0).velocity.at(0); }

// Critically damped: q = x* (1 - (1 + w t) exp(-w t)), whatever the wheel weighs.
TEST(JoltJoints, DrivesOfAccelerationsKnowNoMass) {
  for (const bool acceleration : {false, true}) {
    TestScene scene = wheel();
    scene::Drive law = drive(Dof::RotZ, acceleration ? 25 : 12.5, acceleration ? 10 : 5);
    law.acceleration = acceleration;
    law.target_position = 1;
    scene.joints[0].drives = {law};
    const auto simulation = make_run(scene);
    run_for(*simulation, 0.3);
    EXPECT_NEAR(angle_of(*simulation), 1 - (1 + 1.5) * std::exp(-1.5), 5e-3);
  }
}

// The inertia is that of all the tree: the wheel carries another one on its rim.
TEST(JoltJoints, DrivesOfAccelerationsMoveWhatHangsOnThem) {
  TestScene scene = wheel();
  const Index rim = scene.add_body("rim", {{1, 0, 1}}, 3, {{0.1, 0.1, 0.1}});
  scene::Joint& weld = scene.add_joint("weld", JointKind::Fixed, 0, rim);
  weld.frame0.position = {{1, 0, 0}};
  scene::Drive law = drive(Dof::RotZ, 25, 10);
  law.acceleration = true;
  law.target_position = 1;
  scene.joints[0].drives = {law};
  const auto simulation = make_run(scene);
  run_for(*simulation, 0.3);
  EXPECT_NEAR(angle_of(*simulation), 1 - (1 + 1.5) * std::exp(-1.5), 0.01);
}

TEST(JoltJoints, TargetsAndBoundsBeyondATurnCount) {
  TestScene scene = wheel();
  scene.joints[0].drives = {drive(Dof::RotZ, 20, 6)};
  scene.joints[0].drives[0].target_position = 6 * M_PI;
  const auto simulation = make_run(scene);
  run_for(*simulation, 4);
  EXPECT_NEAR(angle_of(*simulation), 6 * M_PI, 1e-3);
  scene.joints[0].upper = 4 * M_PI;
  const auto bounded = make_run(scene);
  run_for(*bounded, 4);
  EXPECT_NEAR(angle_of(*bounded), 4 * M_PI, 2e-3);
}

// w' = max_force / I until the drive is near its target.
TEST(JoltJoints, DrivesKeepToTheirMaximumAndTellWhatTheyExert) {
  TestScene scene = wheel();
  scene.joints[0].drives = {drive(Dof::RotZ, 1000, 10)};
  scene.joints[0].drives[0].target_position = 3;
  scene.joints[0].drives[0].max_force = 2;
  SimulationOptions options;
  options.outputs.efforts = true;
  const auto simulation = make_run(scene, options);
  run_for(*simulation, 0.2);
  EXPECT_NEAR(speed_of(*simulation), 0.2 * 2 / 0.5, 1e-3);
  EXPECT_NEAR(simulation->drive_efforts(0)->at(0), 2, 1e-9);
}

// Armature adds to the wheel's inertia, friction takes its torque.
TEST(JoltJoints, HaveArmatureFrictionAndSpeedLimits) {
  TestScene scene = wheel();
  scene.joints[0].armature = 0.3;
  scene.joints[0].friction = 0.4;
  const auto simulation = make_run(scene);
  const double effort = 1.2;
  ASSERT_TRUE(simulation->set_joint_efforts(0, {&effort, 1}).has_value());
  run_for(*simulation, 0.5);
  EXPECT_NEAR(speed_of(*simulation), 0.5 * (1.2 - 0.4) / (0.5 + 0.3), 2e-3);
  EXPECT_NEAR(simulation->energy().kinetic, 0.8 * 0.25 / 2, 1e-3);
  const double none = 0;
  ASSERT_TRUE(simulation->set_joint_efforts(0, {&none, 1}).has_value());
  run_for(*simulation, 1.5);
  EXPECT_NEAR(speed_of(*simulation), 0, 1e-6);

  scene.joints[0].velocity_limit = 0.2;
  const auto limited = make_run(scene);
  ASSERT_TRUE(limited->set_joint_efforts(0, {&effort, 1}).has_value());
  run_for(*limited, 1);
  EXPECT_NEAR(speed_of(*limited), 0.2, 1e-4);
}

// A wheel against a bound that is a spring of 50 N m/rad, pushed by 2 N m.
TEST(JoltJoints, BoundsMayBeSpringsAndMayRebound) {
  TestScene scene = wheel();
  scene.joints[0].upper = 0.5;
  scene.joints[0].limit_springs = {{Dof::RotZ, 50, 20}};
  const auto simulation = make_run(scene);
  const double effort = 2;
  ASSERT_TRUE(simulation->set_joint_efforts(0, {&effort, 1}).has_value());
  run_for(*simulation, 5);
  EXPECT_NEAR(angle_of(*simulation), 0.5 + 2.0 / 50, 1e-3);

  scene.joints[0].limit_springs = {{Dof::RotZ, 0, 0, 0.5, 0.01}};
  scene.bodies[0].angular_velocity = {{0, 0, 2}};
  const auto rebounding = make_run(scene);
  run_for(*rebounding, 0.4);
  EXPECT_NEAR(speed_of(*rebounding), -1, 1e-3);
}

// A mimic of 2 Hz follows as the spring of its frequency: held still by hand, the leader turned by
// 0.1 rad, the follower swings with period 1 / 2 s and decays with its ratio.
TEST(JoltJoints, AMimicWithAFrequencyIsASpring) {
  TestScene scene = wheel();
  const Index other = scene.add_body("other", {{3, 0, 1}}, 2, {{0.3, 0.3, 0.5}});
  scene.add_joint("other_axle", JointKind::Revolute, std::nullopt, other).frame0.position = {
      {3, 0, 1}};
  scene::Mimic mimic;
  mimic.dof = mimic.leader_dof = Dof::RotZ;
  mimic.leader = 0;
  mimic.multiplier = 2;
  mimic.natural_frequency = 10;
  mimic.damping_ratio = 1;
  scene.joints[1].mimics = {mimic};
  scene.joints[0].drives = {drive(Dof::RotZ, 1e5, 1e4)};
  scene.joints[0].drives[0].target_position = 0.1;
  const auto simulation = make_run(scene);
  run_for(*simulation, 2);
  EXPECT_NEAR(simulation->joint_state(1).position.at(0), 0.2, 1e-3);
  EXPECT_TRUE(simulation->not_mapped().empty());
}

// Two wheels whose joints share no body: neither gears nor tendons do that.
TEST(JoltJoints, AMimicHoldsWithPowersAcrossTrees) {
  TestScene scene = wheel();
  const Index slider = scene.add_body("slider", {{3, 0, 1}}, 2);
  scene.add_joint("rail", JointKind::Prismatic, std::nullopt, slider, scene::Axis::X)
      .frame0.position = {{3, 0, 1}};
  scene::Mimic mimic;
  mimic.dof = Dof::TransX;
  mimic.leader = 0;
  mimic.leader_dof = Dof::RotZ;
  mimic.multiplier = 0.5;
  mimic.offset = 0;
  mimic.higher = {0.25, 0, 0};
  scene.joints[1].mimics = {mimic};
  scene.joints[0].drives = {drive(Dof::RotZ, 50, 20)};
  scene.joints[0].drives[0].target_position = 1;
  const auto simulation = make_run(scene);
  for (int i = 0; i < 20; ++i) {
    run_for(*simulation, 0.1);
    const double q = angle_of(*simulation);
    EXPECT_NEAR(simulation->joint_state(1).position.at(0), 0.5 * q + 0.25 * q * q, 1e-3);
  }
  EXPECT_NEAR(angle_of(*simulation), 1, 2e-3);
}

// Two wheels on one tendon, q0 + 2 q1: its spring rests at 0.3, its range ends at 0.5.
TEST(JoltJoints, ATendonPullsAlongTheSumOfItsJoints) {
  TestScene scene = wheel();
  const Index other = scene.add_body("other", {{3, 0, 1}}, 2, {{0.3, 0.3, 0.5}});
  scene.add_joint("other_axle", JointKind::Revolute, std::nullopt, other).frame0.position = {
      {3, 0, 1}};
  scene::Tendon tendon;
  tendon.path = named("tendon");
  tendon.joints = {0, 1};
  tendon.coefficients = {1, 2};
  tendon.stiffness = 20;
  tendon.damping = 8;
  tendon.spring_length = {0.3, 0.3};
  scene.tendons = {tendon};
  const auto simulation = make_run(scene);
  EXPECT_TRUE(simulation->not_mapped().empty());
  run_for(*simulation, 5);
  const auto at = [](const Simulation& run, Index joint) {
    return run.joint_state(joint).position.at(0);
  };
  EXPECT_NEAR(at(*simulation, 0), 0.3 / 5, 1e-4);  // equal wheels share it as 1 to 2
  EXPECT_NEAR(at(*simulation, 1), 0.3 / 5 * 2, 1e-4);
  scene.tendons[0].stiffness = scene.tendons[0].damping = 0;
  scene.tendons[0].range = {{-1, 0.5}};
  const auto bounded = make_run(scene);
  const double effort = 1;
  ASSERT_TRUE(bounded->set_joint_efforts(1, {&effort, 1}).has_value());
  run_for(*bounded, 0.8);  // the first wheel is pulled back while the second goes on
  EXPECT_NEAR(at(*bounded, 0) + 2 * at(*bounded, 1), 0.5, 2e-3);
  EXPECT_LT(at(*bounded, 0), 0);
}

// A motor of 4 N m whose effort falls to nothing at 2 rad/s ends there, and not at its target
// speed.
TEST(JoltJoints, AMotorHasLessLeftAtASpeed) {
  TestScene scene = wheel();
  scene.joints[0].drives = {drive(Dof::RotZ, 0, 100)};
  scene.joints[0].drives[0].target_velocity = 10;
  scene.joints[0].drives[0].max_force = 4;
  scene.joints[0].drives[0].envelope.velocity_resistance = 2;
  const auto simulation = make_run(scene);
  run_for(*simulation, 0.25);  // I w' = 4 - 2 w
  EXPECT_NEAR(speed_of(*simulation), 2 * (1 - std::exp(-1.0)), 5e-3);
  run_for(*simulation, 3);
  EXPECT_NEAR(speed_of(*simulation), 2, 1e-3);
}

// The load at which it breaks is the weight below it, 2 kg.
TEST(JoltJoints, BreakUnderTheirLoad) {
  for (const double bound : {2 * kG - 0.2, 2 * kG + 0.2}) {
    TestScene scene;
    const Index body = scene.add_body("body", {{0, 0, 1}}, 2);
    scene::Joint& joint = scene.add_joint("joint", JointKind::Fixed, std::nullopt, body);
    joint.frame0.position = {{0, 0, 1}};
    joint.break_force = bound;
    const auto simulation = make_run(scene);
    run_for(*simulation, 0.5);
    const bool breaks = bound < 2 * kG;
    EXPECT_EQ(simulation->events().size(), breaks ? 1u : 0u);
    EXPECT_EQ(simulation->body_state(0).pose.position[2] < 0.9, breaks);
  }
}

// A D6 joint with a slide along x within bounds and a turn about z that is driven.
TEST(JoltJoints, SixDegreesOfFreedomAreHeldBoundedAndDrivenOneByOne) {
  TestScene scene;
  scene.scenes[0].gravity = {{3, 5, -kG}};
  const Index body = scene.add_body("body", {{0, 0, 1}}, 2, {{0.3, 0.3, 0.5}});
  scene::Joint& joint = scene.add_joint("joint", JointKind::D6, std::nullopt, body);
  joint.frame0.position = {{0, 0, 1}};
  joint.limits = {{Dof::TransX, -0.2, 0.3},
                  {Dof::TransY, 1, -1},
                  {Dof::TransZ, 1, -1},
                  {Dof::RotX, 1, -1},
                  {Dof::RotY, 1, -1}};
  joint.drives = {drive(Dof::RotZ, 20, 8)};
  joint.drives[0].target_position = 0.7;
  joint.damping = 1;
  const auto simulation = make_run(scene);
  run_for(*simulation, 4);
  const JointState state = simulation->joint_state(0);
  ASSERT_EQ(state.position.size(), 2u);
  EXPECT_NEAR(state.position[0], 0.3, 1e-3);
  EXPECT_NEAR(state.position[1], 0.7, 1e-3);
  const Pose pose = simulation->body_state(0).pose;
  EXPECT_NEAR(pose.position[1], 0, 1e-3);
  EXPECT_NEAR(pose.position[2], 1, 1e-3);
  EXPECT_NEAR(rotate(pose.orientation, {{0, 0, 1}})[2], 1, 1e-5);
}

// An arm of two links: the lower one goes along.
TEST(JoltJoints, AStateThatIsSetTakesAlongWhatHangsOnIt) {
  TestScene scene = wheel();
  const Index tip = scene.add_body("tip", {{1, 0, 1}}, 1);
  scene::Joint& elbow = scene.add_joint("elbow", JointKind::Revolute, tip, 0);  // reversed
  elbow.frame1.position = {{1, 0, 0}};
  const auto simulation = make_run(scene);
  run_for(*simulation, 0.01);
  ASSERT_TRUE(simulation->set_joint_state(0, {{M_PI / 2}, {3}}).has_value());
  EXPECT_NEAR(angle_of(*simulation), M_PI / 2, 1e-6);
  EXPECT_NEAR(speed_of(*simulation), 3, 1e-5);
  EXPECT_NEAR(length(simulation->body_state(tip).pose.position - Vec3d{{0, 1, 1}}), 0, 1e-6);
  EXPECT_NEAR(length(simulation->body_state(tip).linear_velocity - Vec3d{{-3, 0, 0}}), 0, 1e-5);
  ASSERT_TRUE(simulation->set_joint_state(1, {{0.5}, {-2}}).has_value());
  EXPECT_NEAR(simulation->joint_state(1).position.at(0), 0.5, 1e-6);
  EXPECT_NEAR(simulation->joint_state(1).velocity.at(0), -2, 1e-5);
  EXPECT_NEAR(angle_of(*simulation), M_PI / 2, 1e-6);
  run_for(*simulation, 0.01);
  EXPECT_NEAR(angle_of(*simulation), M_PI / 2 + 0.03, 2e-3);
}

// Two hinges that cross in a link without mass carry a bob as one joint of two axes would.
TEST(JoltJoints, LinksWithoutMassHoldWhatHangsOnThem) {
  TestScene scene;
  const Index cross = scene.add_body("cross", {{0, 0, 1}}, 0, {});
  scene.add_joint("first", JointKind::Revolute, std::nullopt, cross, scene::Axis::X)
      .frame0.position = {{0, 0, 1}};
  const Index bob = scene.add_body("bob", {{0, 0, 0.5}}, 2, {{0.02, 0.02, 0.02}});
  scene.add_joint("second", JointKind::Revolute, cross, bob, scene::Axis::Y).frame1.position = {
      {0, 0, 0.5}};
  scene.bodies[bob].linear_velocity = {{0.3, 0.4, 0}};
  const auto simulation = make_run(scene);
  const double energy = simulation->energy().total();
  for (int i = 0; i < 30; ++i) {
    run_for(*simulation, 0.1);
    const Pose pose = simulation->body_state(bob).pose;
    EXPECT_NEAR(length(transform_point(pose, {{0, 0, 0.5}}) - Vec3d{{0, 0, 1}}), 0, 1e-4);
  }
  EXPECT_NEAR(simulation->energy().total(), energy, 0.02);
}

// A body that the asset holds by a joint whose frames are apart starts where they meet.
TEST(JoltJoints, StartWhereTheirCoordinatesPutThem) {
  TestScene scene = wheel();
  scene.joints[0].initial_position = 7;  // beyond a turn
  scene.joints[0].initial_velocity = 2;
  const auto simulation = make_run(scene);
  run_for(*simulation, 0.1);
  EXPECT_NEAR(angle_of(*simulation), 7.2, 1e-3);
  EXPECT_NEAR(speed_of(*simulation), 2, 1e-4);
}

}  // namespace
}  // namespace tenon::engines::jolt
