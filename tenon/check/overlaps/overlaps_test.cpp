// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/check/overlaps/overlaps.h"

#include <gtest/gtest.h>

namespace tenon::check {
namespace {

/// Bodies with a box of 1 m each, at these places.
scene::PhysicsScene boxes_at(const std::vector<Vec3d>& places) {
  scene::PhysicsScene scene;
  scene.scenes.emplace_back();
  for (scene::Index i = 0; i < places.size(); ++i) {
    scene::Body body;
    body.pose.position = places[i];
    scene.bodies.push_back(body);
    scene::Collider collider;
    collider.path = Path::from("/Box" + std::to_string(i));
    collider.body = i;
    collider.shape.half_extents = {{0.5, 0.5, 0.5}};
    scene.colliders.push_back(collider);
  }
  return scene;
}

bool touch(double distance) {
  return !contacts_at_start(boxes_at({{{0, 0, 0}}, {{distance, 0, 0}}}), kAllOverlaps).empty();
}

TEST(ContactsAtStart, AllowForTheGapsOfRounding) {
  EXPECT_TRUE(touch(0.98));
  EXPECT_TRUE(touch(1));
  EXPECT_TRUE(touch(1.004));
  EXPECT_FALSE(touch(1.02));
}

TEST(ContactsAtStart, AreNoOverlaps) {
  const scene::PhysicsScene scene = boxes_at({{{0, 0, 0}}, {{0, 0, 1}}, {{0, 0, 1.5}}});
  EXPECT_EQ(contacts_at_start(scene, kAllOverlaps), (std::vector<ColliderPair>{{0, 1}, {1, 2}}));
  EXPECT_EQ(overlaps_at_start(scene, kAllOverlaps), (std::vector<ColliderPair>{{1, 2}}));
}

TEST(BelowPlanesAtStart, IsWhatReachesIntoOnesThatStandStill) {
  scene::PhysicsScene scene = boxes_at({{{0, 0, 0.3}}, {{5, 0, 0.5}}, {{9, 0, -0.8}}});
  scene::Collider floor;
  floor.path = Path::from("/Floor");
  floor.shape.kind = scene::ShapeKind::Plane;
  floor.shape.axis = scene::Axis::Z;
  scene.colliders.push_back(floor);
  EXPECT_EQ(below_planes_at_start(scene, kAllOverlaps),
            (std::vector<ColliderPair>{{0, 3}, {2, 3}}));
  EXPECT_TRUE(overlaps_at_start(scene, kAllOverlaps).empty());
}

TEST(RestsOn, IsAboutTheDirectionOfGravity) {
  const Vec3d down{{0, 0, -1}};
  const scene::PhysicsScene above = boxes_at({{{0, 0, 0}}, {{0.3, 0, 1}}});
  EXPECT_TRUE(rests_on(above, 1, 0, down));
  EXPECT_FALSE(rests_on(above, 0, 1, down));
  EXPECT_TRUE(rests_on(above, 0, 1, -down));
  const scene::PhysicsScene beside = boxes_at({{{0, 0, 0}}, {{1, 0, 0.3}}});
  EXPECT_FALSE(rests_on(beside, 1, 0, down));
  EXPECT_FALSE(rests_on(boxes_at({{{0, 0, 0}}, {{0, 0, 1.1}}}), 1, 0, down));
}

}  // namespace
}  // namespace tenon::check
