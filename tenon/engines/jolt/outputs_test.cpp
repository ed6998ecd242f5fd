// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/engines/jolt/test_run.h"

namespace tenon::engines::jolt {
namespace {

using scene::Dof;
using scene::Index;
using scene::JointKind;

SimulationOptions with_reactions() {
  SimulationOptions options;
  options.outputs = {.efforts = true, .reactions = true, .accelerations = true};
  return options;
}

void expect_near(const Vec3d& found, const Vec3d& wanted, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found[i], wanted[i], tolerance) << i;
  }
}

/// A bob of 2 kg half a metre below a hinge about y, turned by 1 rad.
TestScene bob(bool reversed) {
  TestScene scene;
  const Vec3d position = rotate(rotation_about({{0, 1, 0}}, 1), {{0, 0, -0.5}});
  const Index body = scene.add_body("bob", position, 2, {{0.02, 0.02, 0.02}});
  scene.bodies[body].pose.orientation = rotation_about({{0, 1, 0}}, 1);
  scene::Joint& joint =
      reversed ? scene.add_joint("hinge", JointKind::Revolute, body, {}, scene::Axis::Y)
               : scene.add_joint("hinge", JointKind::Revolute, {}, body, scene::Axis::Y);
  (reversed ? joint.frame0 : joint.frame1).position = {{0, 0, 0.5}};
  return scene;
}

// m a = F + m g of the bob; about the hinge nothing carries a torque.
TEST(JoltOutputs, ReactionsOfAPendulumAreMassTimesAccelerationLessWeight) {
  for (const bool reversed : {false, true}) {
    const TestScene scene = bob(reversed);
    const auto swing = make_run(scene, with_reactions());
    run_for(*swing, 0.3);
    const Vec3d on_bob = (swing->body_acceleration(0)->linear + Vec3d{{0, 0, kG}}) * 2;
    const Wrench reaction = *swing->joint_reaction(0);
    expect_near(reaction.force, on_bob * (reversed ? -1 : 1), 0.02);
    expect_near(reaction.torque, {}, 0.02);
  }
}

// Joint i of a beam from a wall carries n = 3 - i pieces: F = n m g, T = F n / 2 about y.
TEST(JoltOutputs, ReactionsOfABeamAreShearAndMoment) {
  TestScene scene;
  std::optional<Index> last;
  for (int i = 0; i < 3; ++i) {
    const Index body =
        scene.add_body("b" + std::to_string(i), {{i + 0.5, 0, 0}}, 1, {{0.01, 0.1, 0.1}});
    scene::Joint& joint = scene.add_joint("j" + std::to_string(i), JointKind::Fixed, last, body);
    joint.frame0.position = {{last ? 0.5 : 0, 0, 0}};
    joint.frame1.position = {{-0.5, 0, 0}};
    joint.frame1.orientation = rotation_about({{0, 0, 1}}, 0.7);
    joint.frame0.orientation = joint.frame1.orientation;
    last = body;
  }
  const auto held = make_run(scene, with_reactions());
  run_for(*held, 1);
  for (Index i = 0; i < 3; ++i) {
    const double n = 3 - i;
    const Wrench reaction = *held->joint_reaction(i);
    expect_near(reaction.force, {{0, 0, n * kG}}, 0.02);
    expect_near(reaction.torque, {{0, -n * kG * n / 2, 0}}, 0.05);
  }
}

// At rest the drive carries the weight; the reaction has its torque.
TEST(JoltOutputs, EffortsOfADriveAtRestCarryTheWeight) {
  TestScene scene = bob(false);
  scene.joints[0].drives.push_back(drive(Dof::RotY, 200, 20));
  scene.joints[0].drives[0].target_position = 1;
  const auto held = make_run(scene, with_reactions());
  run_for(*held, 8);
  const double q = held->joint_state(0).position[0];
  const double effort = 200 * (1 - q);
  EXPECT_NEAR(effort, 2 * kG * 0.5 * std::sin(q), 0.01);
  EXPECT_NEAR((*held->drive_efforts(0))[0], effort, 0.01);
  const Wrench reaction = *held->joint_reaction(0);
  EXPECT_NEAR(reaction.torque[1], effort, 0.02);
  expect_near(reaction.force, {{0, 0, 2 * kG}}, 0.02);
}

}  // namespace
}  // namespace tenon::engines::jolt
