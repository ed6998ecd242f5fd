// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/diff/physics_difference.h"

#include <gtest/gtest.h>

namespace tenon::diff {
namespace {

physics::PhysicsScene one_joint() {
  physics::PhysicsScene scene;
  scene.bodies.resize(2);
  scene.bodies[0].path = Path::from("/r/a");
  scene.bodies[1].path = Path::from("/r/b");
  physics::Joint joint;
  joint.path = Path::from("/r/j");
  joint.kind = physics::JointKind::Revolute;
  joint.body0 = 0;
  joint.body1 = 1;
  joint.lower = -1;
  joint.upper = 1;
  joint.drives.push_back({});
  scene.joints.push_back(joint);
  return scene;
}

TEST(PhysicsDifference, ALimitIsNamedWithItsUnit) {
  const physics::PhysicsScene before = one_joint();
  physics::PhysicsScene after = before;
  after.joints[0].upper = 1.25;
  const auto found = physics_differences(before, after);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].object, "joint");
  EXPECT_EQ(found[0].path, "/r/j");
  EXPECT_EQ(found[0].before.name, "upper limit");
  EXPECT_EQ(found[0].before.unit, "rad");
  EXPECT_EQ(found[0].before.numbers, std::vector<double>{1});
  EXPECT_EQ(found[0].after.numbers, std::vector<double>{1.25});
  EXPECT_EQ(found[0].largest, 0.25);
  EXPECT_TRUE(physics_differences(before, after, {0.2}).empty());
}

TEST(PhysicsDifference, ARotationAndItsNegativeAreOne) {
  const physics::PhysicsScene before = one_joint();
  physics::PhysicsScene after = before;
  after.bodies[1].pose.orientation = {0, 0, 0, -1};
  EXPECT_TRUE(physics_differences(before, after).empty());
  after.bodies[1].pose.orientation = {0, 0, 1, 0};
  EXPECT_EQ(physics_differences(before, after).size(), 1u);
}

TEST(PhysicsDifference, WhatCameAndWentIsNamed) {
  const physics::PhysicsScene before = one_joint();
  physics::PhysicsScene after = before;
  after.joints[0].drives.clear();
  after.joints[0].mimic = physics::Mimic{};
  physics::Body body;
  body.path = Path::from("/r/c");
  after.bodies.push_back(body);
  const auto found = physics_differences(before, after);
  ASSERT_GE(found.size(), 3u);
  EXPECT_EQ(found[0].object, "body");
  EXPECT_EQ(found[0].change, Change::Added);
  EXPECT_EQ(found[0].path, "/r/c");
  EXPECT_EQ(found[1].change, Change::Removed);
  EXPECT_EQ(found[1].before.name, "drive rotX type");
  EXPECT_EQ(found.back().change, Change::Added);
}

TEST(PhysicsDifference, WhatIsForMujocoAloneIsNamedToo) {
  physics::PhysicsScene before = one_joint();
  before.colliders.emplace_back().path = Path::from("/r/c");
  physics::Tendon& tendon = before.tendons.emplace_back();
  tendon.path = Path::from("/r/t");
  tendon.joints = {0};
  tendon.coefficients = {1};
  tendon.stops.emplace_back().place.body = 1;
  EXPECT_TRUE(physics_differences(before, before).empty());
  physics::PhysicsScene after = before;
  after.colliders[0].mujoco.condim = 6;
  after.joints[0].mujoco.solref_limit = {0.05, 0.8};
  after.tendons[0].coefficients = {2};
  after.tendons[0].stops[0].place.pose.position = {{0, 0, 1}};
  const auto found = physics_differences(before, after);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].after.name, "MuJoCo condim");
  EXPECT_EQ(found[1].after.name, "MuJoCo solref of the limit");
  EXPECT_EQ(found[2].object, "tendon");
  EXPECT_EQ(found[2].before.name, "coefficient of /r/j");
  EXPECT_EQ(found[3].before.name, "stop 1 position");
}

}  // namespace
}  // namespace tenon::diff
