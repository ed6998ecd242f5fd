// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/scale_field.h"

#include <array>

#include <gtest/gtest.h>

namespace tenon::scene {
namespace {

constexpr std::array<double, 1> kOne{0.5};
constexpr std::array<double, 3> kThree{1, 2, 3};
constexpr std::array<double, 9> kNine{1, 0, 0, 0, 2, 0, 0, 0, 2.5};

PhysicsScene follower() {
  PhysicsScene scene;
  scene.bodies.emplace_back().path = Path::from("/r/a");
  scene.bodies.emplace_back().path = Path::from("/r/b");
  Joint& joint = scene.joints.emplace_back();
  joint.path = Path::from("/r/j");
  joint.mimics.emplace_back();
  return scene;
}

TEST(SetField, OfOneObjectReplacesItsNumbers) {
  PhysicsScene scene = follower();
  const Path body = Path::from("/r/b");
  EXPECT_EQ(set_field("bodies", "centerOfMass", body, kThree, scene), 1);
  EXPECT_EQ(scene.bodies[1].center_of_mass, (Vec3d{{1, 2, 3}}));
  EXPECT_EQ(scene.bodies[0].center_of_mass, Vec3d{});
  EXPECT_EQ(set_field("bodies", "inertia", body, kNine, scene), 1);
  EXPECT_EQ(scene.bodies[1].inertia[2][2], 2.5);
  EXPECT_EQ(set_field("joints", "velocityLimit", Path::from("/r/j"), kOne, scene), 1);
  EXPECT_EQ(scene.joints[0].velocity_limit, 0.5);
  EXPECT_EQ(set_field("joints", "mimics.multiplier", Path::from("/r/j"), kOne, scene), 1);
  EXPECT_EQ(scene.joints[0].mimics[0].multiplier, 0.5);
}

TEST(SetField, OfOtherSizesOrNamesChangesNothing) {
  PhysicsScene scene = follower();
  const Path body = Path::from("/r/b");
  EXPECT_EQ(set_field("bodies", "centerOfMass", body, kOne, scene), 0);
  EXPECT_EQ(set_field("bodies", "mass", body, kThree, scene), 0);
  EXPECT_EQ(set_field("bodies", "path", body, kOne, scene), 0);
  EXPECT_EQ(set_field("bodies", "kinematic", body, kOne, scene), 0);
  EXPECT_EQ(set_field("bodies", "weight", body, kOne, scene), 0);
  EXPECT_EQ(set_field("links", "mass", body, kOne, scene), 0);
  EXPECT_EQ(set_field("bodies", "mass", Path::from("/r/c"), kOne, scene), 0);
  EXPECT_EQ(scene.bodies[1].center_of_mass, Vec3d{});
  EXPECT_EQ(scene.bodies[1].mass, 1);
}

}  // namespace
}  // namespace tenon::scene
