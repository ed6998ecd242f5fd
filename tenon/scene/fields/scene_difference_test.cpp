// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/scene_difference.h"

#include <gtest/gtest.h>

#include "tenon/scene/test_filled_scene.h"

namespace tenon::scene {
namespace {

PhysicsScene one_joint() {
  PhysicsScene scene;
  scene.bodies.resize(2);
  scene.bodies[0].path = Path::from("/r/a");
  scene.bodies[1].path = Path::from("/r/b");
  Joint joint;
  joint.path = Path::from("/r/j");
  joint.kind = JointKind::Revolute;
  joint.body0 = 0;
  joint.body1 = 1;
  joint.lower = -1;
  joint.upper = 1;
  joint.drives.push_back({});
  scene.joints.push_back(joint);
  return scene;
}

TEST(SceneDifference, ALimitIsNamedWithItsUnit) {
  const PhysicsScene before = one_joint();
  PhysicsScene after = before;
  after.joints[0].upper = 1.25;
  const auto found = scene_differences(before, after);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].object, "joint");
  EXPECT_EQ(found[0].path, "/r/j");
  EXPECT_EQ(found[0].before.name, "upper limit");
  EXPECT_EQ(found[0].before.unit, "rad");
  EXPECT_EQ(found[0].before.numbers, std::vector<double>{1});
  EXPECT_EQ(found[0].after.numbers, std::vector<double>{1.25});
  EXPECT_EQ(found[0].largest, 0.25);
  EXPECT_TRUE(scene_differences(before, after, {.tolerance = 0.2}).empty());
}

TEST(SceneDifference, ARotationAndItsNegativeAreOne) {
  const PhysicsScene before = one_joint();
  PhysicsScene after = before;
  after.bodies[1].pose.orientation = {0, 0, 0, -1};
  EXPECT_TRUE(scene_differences(before, after).empty());
  after.bodies[1].pose.orientation = {0, 0, 1, 0};
  EXPECT_EQ(scene_differences(before, after).size(), 1u);
}

TEST(SceneDifference, WhatCameAndWentIsNamed) {
  const PhysicsScene before = one_joint();
  PhysicsScene after = before;
  after.joints[0].drives.clear();
  after.joints[0].mimics.emplace_back();
  Body body;
  body.path = Path::from("/r/c");
  after.bodies.push_back(body);
  const auto found = scene_differences(before, after);
  ASSERT_GE(found.size(), 3u);
  EXPECT_EQ(found[0].object, "body");
  EXPECT_EQ(found[0].change, Change::Added);
  EXPECT_EQ(found[0].path, "/r/c");
  EXPECT_EQ(found[1].change, Change::Removed);
  EXPECT_EQ(found[1].before.name, "drive rotX source");
  EXPECT_EQ(found.back().change, Change::Added);
}

/// By construction: whatever field differs, a difference says so.
TEST(SceneDifference, NoLeafDiffersInSilence) {
  const PhysicsScene scene = filled_scene();
  EXPECT_TRUE(scene_differences(scene, scene).empty());
  each_changed_leaf(scene, [&](const PhysicsScene& changed, const Leaf& leaf) {
    // The unbound material is one of a kind: what it is called tells it from no other.
    EXPECT_EQ(scene_differences(scene, changed).empty(), leaf.name == ".unbound.path") << leaf.name;
  });
}

/// What only says where a value comes from is no difference of motion; all else is.
TEST(SceneDifference, TheProofMissesNoPhysics) {
  const PhysicsScene scene = filled_scene();
  const CompareOptions motion{.smallest_size = 1e-6, .motion_alone = true};
  EXPECT_TRUE(scene_differences(scene, scene, motion).empty());
  each_changed_leaf(scene, [&](const PhysicsScene& changed, const Leaf& leaf) {
    const bool found = !scene_differences(scene, changed, motion).empty();
    // Materials and scenes are compared by what they say, and of the filter what counts is which
    // pairs it lets touch.
    const bool by_effect = leaf.name == ".materials.path" || leaf.name == ".scenes.path" ||
                           leaf.name == ".unbound.path" || leaf.name.starts_with(".filter.");
    if (by_effect) {
      return;
    }
    EXPECT_EQ(found, leaf.role != Role::Provenance) << leaf.name;
  });
}

TEST(SceneDifference, WhatIsForMujocoAloneIsNamedToo) {
  PhysicsScene before = one_joint();
  before.colliders.emplace_back().path = Path::from("/r/c");
  Tendon& tendon = before.tendons.emplace_back();
  tendon.path = Path::from("/r/t");
  tendon.joints = {0};
  tendon.coefficients = {1};
  tendon.wraps.emplace_back().attachment.body = 1;
  EXPECT_TRUE(scene_differences(before, before).empty());
  PhysicsScene after = before;
  after.colliders[0].parts.mujoco.condim = 6;
  after.joints[0].parts.mujoco.solref_limit = {0.05, 0.8};
  after.tendons[0].coefficients = {2};
  after.tendons[0].wraps[0].attachment.pose.position = {{0, 0, 1}};
  const auto found = scene_differences(before, after);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].after.name, "MuJoCo condim");
  EXPECT_EQ(found[1].after.name, "MuJoCo solref of the limit");
  EXPECT_EQ(found[2].object, "tendon");
  EXPECT_EQ(found[2].before.name, "coefficients");
  EXPECT_EQ(found[3].before.name, "wrap 1 attachment position");
}

}  // namespace
}  // namespace tenon::scene
