// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gtest/gtest.h>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/physics/read_physics.h"
#include "tenon/scene/filter_sets.h"
#include "tenon/stage/test_stage.h"

namespace tenon::physics {
namespace {

PhysicsScene scene_of(const std::string& prims) {
  Diagnostics findings;
  const stage::Stage stage =
      stage::open_text("(metersPerUnit = 1; kilogramsPerUnit = 1; upAxis = \"Z\")\n" + prims);
  return read_physics(stage, {}, findings);
}

std::string sphere(const std::string& name, const std::string& inside = "") {
  return "def Sphere \"" + name +
         "\" (apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsCollisionAPI\", "
         "\"PhysicsFilteredPairsAPI\"]) {" +
         inside + "}\n";
}

// A set for each body and one for all of them, however many name it.
TEST(FilteredPairs, APrimAboveAllIsOneSet) {
  std::string bodies;
  for (int i = 0; i < 20; ++i) {
    bodies += sphere("b" + std::to_string(i), "rel physics:filteredPairs = </W>");
  }
  const PhysicsScene scene = scene_of("def Xform \"W\" {\n" + bodies + "}\n");
  EXPECT_EQ(scene::members_of_sets(scene.filter).size(), 21u);
  EXPECT_EQ(scene.filter.sets_off.size(), 20u);
  EXPECT_EQ(scene.disabled_pairs().pairs.size(), 190u);
}

// A body of one collider is apart from itself anyway.
TEST(FilteredPairs, WhatMeansNoTwoBodiesIsNoPair) {
  const PhysicsScene scene = scene_of(sphere("b", "rel physics:filteredPairs = </b>"));
  EXPECT_TRUE(scene.filter.sets_off.empty());
}

TEST(FilteredPairs, MoreSetsThanOneColliderMayBeInAreTold) {
  constexpr std::size_t kDepth = limits::kSetsOfCollider + 20;
  std::string path;
  std::string targets;
  std::string open;
  for (std::size_t i = 0; i < kDepth; ++i) {
    // A sphere on each level, so that no two levels are the same set.
    path += "/n" + std::to_string(i);
    targets += (i == 0 ? "<" : ", <") + path + ">";
    open += "def Xform \"n" + std::to_string(i) + "\" {\n" + sphere("s" + std::to_string(i));
  }
  const PhysicsScene scene = scene_of(open + std::string(kDepth, '}') + "\n" +
                                      sphere("b", "rel physics:filteredPairs = [" + targets + "]"));
  for (const std::vector<Index>& sets : scene.filter.sets_of_collider) {
    EXPECT_LE(sets.size(), limits::kSetsOfCollider);
  }
  ASSERT_EQ(scene.not_read.size(), 1u);
  EXPECT_EQ(scene.not_read.front().prim.str(), "/b");
  EXPECT_NE(scene.not_read.front().why.find("kSetsOfCollider"), std::string::npos);
}

// A pattern that is named again says the same again.
TEST(CollisionGroups, AnExpressionMayNameAPatternTwice) {
  const std::string expression =
      "(apiSchemas = [\"CollectionAPI:colliders\"]) { pathExpression "
      "collection:colliders:membershipExpression = \"//*a + //*a + //*a\" }\n";
  const PhysicsScene scene =
      scene_of(sphere("xa") + sphere("xb") + "def PhysicsCollisionGroup \"g\" " + expression);
  EXPECT_EQ(scene.filter.groups_of_collider, (std::vector<std::vector<Index>>{{0}, {}}));
}

}  // namespace
}  // namespace tenon::physics
