// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "tenon/engines/mujoco/test_scene.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;

// Balls on one spot: every pair that may touch has a contact at once.
TestScene heap(int count) {
  TestScene scene(0);
  for (int i = 0; i < count; ++i) {
    const auto body = scene.add_body("Body" + std::to_string(i), {{0.01 * i, 0, 0}});
    scene.add_collider("Shape" + std::to_string(i), body, sphere(0.5));
  }
  return scene;
}

using Pairs = std::set<std::pair<int, int>>;

Pairs touching(const TestScene& scene) {
  Diagnostics findings;
  Result<Model> model = build_model(scene, {}, findings);
  EXPECT_TRUE(model.has_value());
  Pairs pairs;
  for (int i = 0; model.has_value() && i < model->data->ncon; ++i) {
    const mjContact& contact = model->data->contact[i];
    pairs.insert(std::minmax(model->collider_of_geom[static_cast<std::size_t>(contact.geom[0])],
                             model->collider_of_geom[static_cast<std::size_t>(contact.geom[1])]));
  }
  return pairs;
}

TEST(Filters, WithoutRulesAllTouch) {
  EXPECT_EQ(touching(heap(3)), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
}

TEST(Filters, GroupsRemovePairsBothWays) {
  TestScene scene = heap(4);
  scene.filter.group_paths = {named("A"), named("B")};
  scene.filter.group_pair_off = {1, 1, 1, 0};  // A-A and A-B off, B-B on
  scene.filter.ungrouped_off = {0, 0};
  scene.filter.groups_of_collider = {{0}, {0}, {1}, {}};
  EXPECT_EQ(touching(scene), (Pairs{{0, 3}, {1, 3}, {2, 3}}));
}

TEST(Filters, InvertedGroupsRefuseUngroupedColliders) {
  TestScene scene = heap(3);
  scene.filter.group_paths = {named("A")};
  scene.filter.group_pair_off = {0};
  scene.filter.ungrouped_off = {1};
  scene.filter.groups_of_collider = {{0}, {0}, {}};
  EXPECT_EQ(touching(scene), (Pairs{{0, 1}}));  // S-78
}

TEST(Filters, AnyMembershipPairFilters) {
  TestScene scene = heap(2);
  scene.filter.group_paths = {named("G"), named("H"), named("K")};
  scene.filter.group_pair_off = {0, 0, 0, 0, 0, 1, 0, 1, 0};  // H-K
  scene.filter.ungrouped_off = {0, 0, 0};
  scene.filter.groups_of_collider = {{0, 1}, {2}};
  EXPECT_EQ(touching(scene), Pairs{});  // E-92
}

TEST(Filters, ExplicitPairsOfBodiesAndOfSingleColliders) {
  TestScene scene = heap(3);
  scene.add_collider("Extra", 1, sphere(0.4));
  // Body 0 against all of body 1 would be (0,1) and (0,3); (1,2) leaves Extra against body 2.
  keep_pairs_apart(scene, {{0, 1}, {0, 3}, {1, 2}});
  EXPECT_EQ(touching(scene), (Pairs{{0, 2}, {2, 3}}));
}

TEST(Filters, MoreGroupsThanBits) {
  TestScene scene = heap(40);
  for (Index i = 0; i < 40; ++i) {
    scene.filter.group_paths.push_back(named("G" + std::to_string(i)));
    scene.filter.groups_of_collider[i] = {i};
  }
  scene.filter.group_pair_off.assign(40 * 40, 1);
  scene.filter.ungrouped_off.assign(40, 0);
  scene.filter.group_pair_off[5 * 40 + 9] = 0;
  scene.filter.group_pair_off[9 * 40 + 5] = 0;
  EXPECT_EQ(touching(scene), (Pairs{{5, 9}}));
}

TEST(Filters, JointedNeighboursTouchUnlessFiltered) {
  TestScene scene = heap(2);
  scene.add_joint("Hinge", scene::JointKind::Revolute, 0, 1);
  EXPECT_EQ(touching(scene), (Pairs{{0, 1}}));  // collisionEnabled = true: no pair in the scene
  keep_pairs_apart(scene, {{0, 1}});
  EXPECT_EQ(touching(scene), Pairs{});  // S-92
}

TEST(Filters, ASetIsApartFromItself) {
  TestScene scene = heap(4);
  scene.filter.sets_of_collider = {{0}, {0}, {0}};
  scene.filter.sets_off = {{0, 0}};
  EXPECT_EQ(touching(scene), (Pairs{{0, 3}, {1, 3}, {2, 3}}));
}

TEST(Filters, SetsOfMoreThanAHundredThousandPairs) {
  constexpr Index kMany = 500;
  TestScene scene = heap(kMany);
  scene.filter.sets_of_collider.assign(kMany - 2, {0});
  scene.filter.sets_off = {{0, 0}};
  const Pairs pairs = touching(scene);
  EXPECT_FALSE(pairs.empty());
  for (const auto& [first, second] : pairs) {
    EXPECT_GE(second, static_cast<int>(kMany - 2)) << first;
  }
}

TEST(Filters, KinematicBodiesAndStaticsIgnoreEachOther) {
  TestScene scene = heap(3);
  scene.bodies[0].kinematic = true;
  scene.bodies[1].kinematic = true;
  scene.pose_tracks.push_back({0, {}, {0, 1}, {Pose{}, Pose{}}, false});
  scene.add_collider("Static", {}, sphere(0.5));
  EXPECT_EQ(touching(scene), (Pairs{{0, 2}, {1, 2}, {2, 3}}));
}

TEST(Filters, DisabledCollidersAndOtherScenesDoNotTouch) {
  TestScene scene = heap(3);
  scene.scenes.push_back({named("Other"), {}, {}});
  scene.colliders[0].enabled = false;
  scene.bodies[2].scene = 1;
  EXPECT_EQ(touching(scene), Pairs{});
}

TEST(Filters, StaticColliderAgainstOneBody) {
  TestScene scene = heap(2);
  const auto wall = scene.add_collider("Wall", {}, sphere(0.5));
  keep_pairs_apart(scene, {{0, wall}});
  EXPECT_EQ(touching(scene), (Pairs{{0, 1}, {1, 2}}));
}

}  // namespace
}  // namespace tenon::engines::mujoco
