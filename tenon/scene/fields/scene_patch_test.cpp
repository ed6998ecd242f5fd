// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/fields/scene_patch.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tenon/scene/fields/scene_difference.h"
#include "tenon/scene/test_filled_scene.h"

namespace tenon::scene {
namespace {

const CompareOptions kMotion{.smallest_size = 1e-6, .motion_alone = true};

PhysicsScene hinge(const char* name) {
  PhysicsScene scene;
  scene.scenes.emplace_back();
  scene.bodies.emplace_back().path = Path::from("/r/a");
  Joint& joint = scene.joints.emplace_back();
  joint.path = Path::from(name);
  joint.kind = JointKind::Revolute;
  joint.body1 = 0;
  Drive drive;
  drive.stiffness = 10;
  joint.drives.push_back(drive);
  return scene;
}

/// By construction: whatever acts on the motion and differs can be found, and taken over or told to
/// be beyond that.
TEST(ScenePatch, EveryLeafThatDiffersIsFoundAndTakenOver) {
  const PhysicsScene scene = filled_scene();
  EXPECT_TRUE(field_patches(scene, scene).empty());
  std::size_t taken = 0;
  each_changed_leaf(scene, [&](const PhysicsScene& changed, const Leaf& leaf) {
    if (leaf.role != Role::Physics) {
      return;
    }
    PhysicsScene a = scene;
    PhysicsScene b = changed;
    bool all = true;
    const std::vector<FieldPatch> patches = field_patches(a, b);
    for (const FieldPatch& patch : patches) {
      all = all && take_over(patch, a, b);
    }
    if (all) {
      EXPECT_TRUE(scene_differences(a, b, kMotion).empty()) << leaf.name;
      taken += patches.empty() ? 0 : 1;
    }
  });
  EXPECT_GT(taken, 200u);
}

TEST(ScenePatch, AFieldNamesItsObjects) {
  const PhysicsScene a = hinge("/r/j");
  PhysicsScene b = a;
  b.joints[0].drives[0].stiffness = 20;
  b.joints[0].armature = 0.5;
  const std::vector<FieldPatch> found = field_patches(a, b);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].list, "joints");
  EXPECT_EQ(found[0].field, "drives.stiffness");
  EXPECT_EQ(found[0].objects, std::vector<Path>{Path::from("/r/j")});
  EXPECT_EQ(found[1].field, "armature");
  PhysicsScene left = a;
  ASSERT_TRUE(take_over(found[0], left, b));
  EXPECT_EQ(b.joints[0].drives[0].stiffness, 10);
  EXPECT_EQ(b.joints[0].armature, 0.5);
}

TEST(ScenePatch, AJointOfOneSideIsSwitchedOffAndABodyCannotBe) {
  PhysicsScene a = hinge("/r/j");
  PhysicsScene b = hinge("/r/other");
  const std::vector<FieldPatch> found = field_patches(a, b);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].objects.size(), 2u);
  ASSERT_TRUE(take_over(found[0], a, b));
  EXPECT_FALSE(a.joints[0].enabled);
  EXPECT_FALSE(b.joints[0].enabled);
  b.bodies.emplace_back().path = Path::from("/r/b");
  const std::vector<FieldPatch> bodies = field_patches(a, b);
  ASSERT_FALSE(bodies.empty());
  EXPECT_EQ(bodies[0].list, "bodies");
  EXPECT_FALSE(take_over(bodies[0], a, b));
}

TEST(ScenePatch, ReferencesLeadToTheSameObjects) {
  PhysicsScene a = hinge("/r/j");
  a.materials.emplace_back().path = Path::from("/m/rubber");
  a.colliders.emplace_back().path = Path::from("/r/a/c");
  a.colliders[0].material = 0;
  PhysicsScene b = a;
  b.materials.insert(b.materials.begin(), Material{});
  b.materials[0].path = Path::from("/m/ice");
  b.colliders[0].material = 1;
  const auto of_colliders = [](const std::vector<FieldPatch>& patches) {
    return std::count_if(patches.begin(), patches.end(),
                         [](const FieldPatch& patch) { return patch.list == "colliders"; });
  };
  EXPECT_EQ(of_colliders(field_patches(a, b)), 0);
  b.colliders[0].material = 0;
  ASSERT_EQ(of_colliders(field_patches(a, b)), 1);
  ASSERT_TRUE(take_over({"colliders", "material", {}}, a, b));
  EXPECT_EQ(b.colliders[0].material, Index{1});
}

TEST(ScenePatch, PropertiesAreFoundByTheirLastPartAndReset) {
  PhysicsScene scene = hinge("/r/j");
  scene.joints[0].armature = 0.5;
  scene.joints[0].damping = 2;
  scene.joints[0].drives[0].damping = 3;
  scene.joints[0].limit_springs.push_back({.restitution = 0.5});
  const Path joint = Path::from("/r/j");
  const auto reset_all = [&](const char* property) {
    const auto found = fields_named(scene, joint, property);
    for (const FieldPatch& patch : found) {
      EXPECT_TRUE(reset(patch, scene)) << patch.field;
    }
    return found.size();
  };
  EXPECT_EQ(reset_all("physxJoint:armature"), 1u);
  EXPECT_EQ(scene.joints[0].armature, 0);
  EXPECT_EQ(reset_all("damping"), 1u);
  EXPECT_EQ(scene.joints[0].damping, 0);
  EXPECT_EQ(scene.joints[0].drives[0].damping, 3);
  EXPECT_EQ(reset_all("restitution"), 1u);
  EXPECT_EQ(scene.joints[0].limit_springs.at(0).restitution, 0);
  EXPECT_EQ(reset_all("drive"), 1u);
  EXPECT_TRUE(scene.joints[0].drives.empty());
  EXPECT_EQ(reset_all("nothing"), 0u);
}

}  // namespace
}  // namespace tenon::scene
