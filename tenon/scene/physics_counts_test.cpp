// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/physics_counts.h"

#include <gtest/gtest.h>

namespace tenon::scene {
namespace {

Joint joint(JointKind kind, std::optional<Index> body0, std::optional<Index> body1) {
  Joint result;
  result.kind = kind;
  result.body0 = body0;
  result.body1 = body1;
  return result;
}

TEST(PhysicsCounts, AFloatingChainHasSixCoordinatesMoreThanItsJoints) {
  PhysicsScene scene;
  scene.bodies.resize(3);
  scene.joints = {joint(JointKind::Revolute, 0, 1), joint(JointKind::Spherical, 1, 2)};
  EXPECT_EQ(count_physics(scene).dofs, 10u);
  scene.joints.push_back(joint(JointKind::Fixed, std::nullopt, 0));
  EXPECT_EQ(count_physics(scene).dofs, 4u);
}

TEST(PhysicsCounts, AJointThatClosesALoopAddsNoCoordinates) {
  PhysicsScene scene;
  scene.bodies.resize(2);
  scene.joints = {joint(JointKind::Revolute, std::nullopt, 0), joint(JointKind::Revolute, 0, 1),
                  joint(JointKind::Revolute, std::nullopt, 1)};
  const PhysicsCounts counts = count_physics(scene);
  EXPECT_EQ(counts.dofs, 2u);
  EXPECT_EQ(counts.joints[static_cast<std::size_t>(JointKind::Revolute)], 3u);
}

TEST(PhysicsCounts, DisabledJointsAndCollidersDoNotCount) {
  PhysicsScene scene;
  scene.bodies.resize(1);
  scene.colliders.resize(2);
  scene.colliders[0].body = 0;
  scene.colliders[1].enabled = false;
  scene.joints = {joint(JointKind::Revolute, std::nullopt, 0)};
  scene.joints[0].enabled = false;
  const PhysicsCounts counts = count_physics(scene);
  EXPECT_EQ(counts.colliders, 1u);
  EXPECT_EQ(counts.static_colliders, 0u);
  EXPECT_EQ(counts.dofs, 6u);
}

TEST(PhysicsCounts, LockedAxesOfAD6JointAreNoCoordinates) {
  Joint d6 = joint(JointKind::D6, std::nullopt, 0);
  for (const Dof dof : {Dof::TransX, Dof::TransY, Dof::TransZ, Dof::RotX, Dof::RotY}) {
    d6.limits.push_back({dof, 1, -1});
  }
  EXPECT_EQ(free_dofs(d6), 1u);
}

TEST(PhysicsCounts, EachAxisThatFollowsIsAMimic) {
  PhysicsScene scene;
  scene.bodies.resize(2);
  scene.joints = {joint(JointKind::Revolute, std::nullopt, 0), joint(JointKind::D6, 0, 1)};
  scene.joints[1].mimics.resize(2);
  EXPECT_EQ(count_physics(scene).mimics, 2u);
}

}  // namespace
}  // namespace tenon::scene
