// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/physics_scene.h"

#include <gtest/gtest.h>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::scene {
namespace {

TEST(ScalarTrack, InterpolatesAndHoldsItsEnds) {
  ScalarTrack track;
  track.times = {1, 3};
  track.values = {10, 20};
  EXPECT_DOUBLE_EQ(track.at(0), 10);
  EXPECT_DOUBLE_EQ(track.at(2), 15);
  EXPECT_DOUBLE_EQ(track.at(9), 20);
  track.held = true;
  EXPECT_DOUBLE_EQ(track.at(2.9), 10);
  EXPECT_DOUBLE_EQ(track.at(3), 20);
}

TEST(PoseTrack, SlerpsBetweenPoses) {
  PoseTrack track;
  track.times = {0, 1};
  track.poses = {{}, {{{2, 0, 0}}, rotation_about({{0, 0, 1}}, 1)}};
  const Pose half = track.at(0.5);
  EXPECT_DOUBLE_EQ(half.position[0], 1);
  EXPECT_NEAR(rotation_vector(half.orientation)[2], 0.5, 1e-12);
}

/// Colliders: 0 on body 0, 1 on body 1, 2 and 3 static.
PhysicsScene four_colliders() {
  PhysicsScene scene;
  scene.scenes.resize(2);
  scene.bodies.resize(2);
  scene.colliders.resize(4);
  scene.colliders[0].body = 0;
  scene.colliders[1].body = 1;
  scene.filter.groups_of_collider.resize(4);
  return scene;
}

TEST(PhysicsScene, SameBodyStaticDisabledAndOtherScenesNeverTouch) {
  PhysicsScene scene = four_colliders();
  EXPECT_TRUE(scene.may_collide(0, 1));
  EXPECT_TRUE(scene.may_collide(2, 0));
  EXPECT_FALSE(scene.may_collide(2, 3));
  scene.colliders[1].scene = 1;
  EXPECT_FALSE(scene.may_collide(0, 1));
  scene.colliders[1].scene = 0;
  scene.colliders[1].enabled = false;
  EXPECT_FALSE(scene.may_collide(0, 1));
}

TEST(PhysicsScene, FiltersOnlyRemovePairs) {
  PhysicsScene scene = four_colliders();
  keep_pairs_apart(scene, {{0, 1}});
  EXPECT_FALSE(scene.may_collide(1, 0));
  scene.filter.group_paths = {Path::from("/G"), Path::from("/H")};
  scene.filter.group_pair_off = {0, 1, 1, 0};
  scene.filter.ungrouped_off = {0, 1};
  scene.filter.groups_of_collider[0] = {0};
  scene.filter.groups_of_collider[1] = {1};
  scene.filter.groups_of_collider[2] = {0, 1};
  EXPECT_FALSE(scene.may_collide(0, 2));  // E-92: one pair of memberships is off
  EXPECT_TRUE(scene.may_collide(0, 3));
  EXPECT_FALSE(scene.may_collide(1, 3));  // S-78
  const std::vector<std::pair<Index, Index>> expected{{0, 1}, {0, 2}, {1, 2}, {1, 3}};
  EXPECT_EQ(scene.disabled_pairs(), (ColliderPairs{expected, false}));
}

TEST(PhysicsScene, SetsAreApartWithAllThatIsInThem) {
  PhysicsScene scene = four_colliders();
  scene.bodies.push_back({});
  scene.colliders[2].body = 2;
  // 0: of body 0; 1: all but the last; 2: the last alone.
  scene.filter.sets_of_collider = {{0, 1}, {1}, {1}, {2}};
  scene.filter.sets_off = {{0, 1}, {0, 2}};
  const std::vector<std::pair<Index, Index>> expected{{0, 1}, {0, 2}, {0, 3}};
  EXPECT_EQ(scene.disabled_pairs(), (ColliderPairs{expected, false}));
  EXPECT_TRUE(scene.may_collide(1, 2));
  scene.filter.sets_off = {{1, 1}};
  EXPECT_FALSE(scene.may_collide(1, 2));
  EXPECT_TRUE(scene.may_collide(0, 3));
}

TEST(PhysicsScene, PairsAreCutWhereThereAreMoreThanAreListed) {
  PhysicsScene scene;
  scene.scenes.resize(1);
  scene.bodies.resize(2000);
  scene.colliders.resize(2000);
  for (Index i = 0; i < 2000; ++i) {
    scene.colliders[i].body = i;
    scene.filter.sets_of_collider.push_back({0});
  }
  scene.filter.sets_off = {{0, 0}};
  const ColliderPairs pairs = scene.disabled_pairs();
  EXPECT_TRUE(pairs.is_cut);
  EXPECT_EQ(pairs.pairs.size(), limits::kDisabledPairs);
}

TEST(Joint, DofFollowsKindAndAxis) {
  Joint joint;
  joint.kind = JointKind::Revolute;
  joint.axis = Axis::Z;
  EXPECT_EQ(joint.dof(), Dof::RotZ);
  joint.kind = JointKind::Prismatic;
  joint.axis = Axis::Y;
  EXPECT_EQ(joint.dof(), Dof::TransY);
  EXPECT_EQ(dof_name(joint.dof()), "transY");
}

}  // namespace
}  // namespace tenon::scene
