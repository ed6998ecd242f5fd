// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/overlap/penetrations.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "tenon/engines/test_scene.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::engines::mujoco {
namespace {

using scene::Index;

constexpr double kRounding = 1e-6;  // [m]

std::vector<Pose> poses_of(const scene::PhysicsScene& scene) {
  std::vector<Pose> poses;
  for (const scene::Body& body : scene.bodies) {
    poses.push_back(body.pose);
  }
  return poses;
}

/// What overlaps at the start; a failed test where it cannot be told.
std::vector<Penetration> at_start(const scene::PhysicsScene& scene,
                                  StaticColliders statics = StaticColliders::Left) {
  Diagnostics findings;
  auto made = Penetrations::make(scene, statics, findings);
  EXPECT_TRUE(made.has_value()) << (made.has_value() ? "" : made.error().to_string());
  if (!made.has_value()) {
    return {};
  }
  auto found = made->at(poses_of(scene));
  EXPECT_TRUE(found.has_value()) << (found.has_value() ? "" : found.error().to_string());
  return found.has_value() ? *std::move(found) : std::vector<Penetration>();
}

/// Two spheres of radius 0.1, their centres `distance` apart.
TestScene two_spheres(double distance) {
  TestScene scene;
  scene.add_collider("a/ball", scene.add_body("a", {{0, 0, 0}}), sphere(0.1));
  scene.add_collider("b/ball", scene.add_body("b", {{distance, 0, 0}}), sphere(0.1));
  return scene;
}

TEST(Penetrations, SpheresOverlapByTheirRadiiLessTheirDistance) {
  const std::vector<Penetration> found = at_start(two_spheres(0.15));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].a, 0u);
  EXPECT_EQ(found[0].b, 1u);
  EXPECT_NEAR(found[0].depth, 0.05, 1e-12);
  EXPECT_TRUE(at_start(two_spheres(0.2001)).empty());
}

TEST(Penetrations, PosesAreThoseThatAreAskedFor) {
  const TestScene scene = two_spheres(5);
  Diagnostics findings;
  auto made = Penetrations::make(scene, StaticColliders::Left, findings);
  ASSERT_TRUE(made.has_value());
  std::vector<Pose> poses = poses_of(scene);
  EXPECT_TRUE(made->at(poses)->empty());
  poses[1].position = {{0, 0.17, 0}};
  const auto near = made->at(poses);
  ASSERT_EQ(near->size(), 1u);
  EXPECT_NEAR((*near)[0].depth, 0.03, 1e-12);
  auto other = made->another();
  ASSERT_TRUE(other.has_value());
  EXPECT_NEAR((*other->at(poses))[0].depth, 0.03, 1e-12);
  poses[1].position = {{0, 5, 0}};
  EXPECT_TRUE(made->at(poses)->empty());
}

TEST(Penetrations, ColliderPosesInTurnedBodiesCount) {
  TestScene scene;
  scene.add_collider("a/ball", scene.add_body("a", {{0, 0, 0}}), sphere(0.1), {{{0.5, 0, 0}}});
  scene.add_collider("b/ball", scene.add_body("b", {{0, 0.65, 0}}), sphere(0.1));
  EXPECT_TRUE(at_start(scene).empty());
  scene.bodies[0].center_of_mass = {{0.3, 0.2, 0.1}};  // a body of runs turns about it
  scene.bodies[0].pose.orientation = rotation_about({{0, 0, 1}}, M_PI / 2);
  const std::vector<Penetration> found = at_start(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].depth, 0.05, 1e-9);
}

TEST(Penetrations, BoxesOfAStackOverlapByWhatTheySink) {
  TestScene scene;
  for (int i = 0; i < 3; ++i) {
    const std::string name = "box" + std::to_string(i);
    scene.add_collider(name + "/shape", scene.add_body(name, {{0, 0, 0.19 * i}}),
                       box({{0.1, 0.1, 0.1}}));
  }
  const std::vector<Penetration> found = at_start(scene);
  ASSERT_EQ(found.size(), 2u);  // the first and the third are apart
  EXPECT_EQ(std::pair(found[0].a, found[0].b), std::pair(Index{0}, Index{1}));
  EXPECT_EQ(std::pair(found[1].a, found[1].b), std::pair(Index{1}, Index{2}));
  EXPECT_NEAR(found[0].depth, 0.01, kRounding);
  EXPECT_NEAR(found[1].depth, 0.01, kRounding);
}

TEST(Penetrations, NothingKeepsBodiesApart) {
  TestScene scene = two_spheres(0.15);
  scene.joints.clear();
  scene.add_joint("hinge", scene::JointKind::Revolute, 0, 1);
  scene.joints[0].frame0.position = {{0.15, 0, 0}};
  scene.bodies[0].kinematic = true;
  scene.bodies[1].kinematic = true;
  scene.articulations.push_back({});
  scene.articulations[0].links = {0, 1};
  scene.articulations[0].self_collision = false;
  scene::keep_pairs_apart(scene, {{0, 1}});
  scene.filter.group_paths = {named("group")};
  scene.filter.group_pair_off = {1};
  scene.filter.ungrouped_off = {0};
  scene.filter.groups_of_collider = {{0}, {0}};
  ASSERT_FALSE(scene.may_meet(0, 1));
  const std::vector<Penetration> found = at_start(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].depth, 0.05, 1e-12);
}

TEST(Penetrations, WhatCannotTouchTakesNoPart) {
  TestScene disabled = two_spheres(0.15);
  disabled.colliders[1].enabled = false;
  EXPECT_TRUE(at_start(disabled).empty());
  TestScene trigger = two_spheres(0.15);
  trigger.colliders[1].settings.trigger = true;
  EXPECT_TRUE(at_start(trigger).empty());
  TestScene scenes = two_spheres(0.15);
  scenes.scenes.push_back({named("Other"), {{0, 0, -kG}}, {}});
  scenes.bodies[1].scene = 1;
  scenes.colliders[1].scene = 1;
  EXPECT_TRUE(at_start(scenes).empty());
  TestScene one_body = two_spheres(0.15);
  one_body.colliders[1].body = 0;
  EXPECT_TRUE(at_start(one_body).empty());
}

TEST(Penetrations, MarginsAreZero) {
  TestScene scene = two_spheres(0.21);
  for (scene::Collider& collider : scene.colliders) {
    collider.contact_offset = 0.1;
    collider.rest_offset = 0.05;
  }
  EXPECT_TRUE(at_start(scene).empty());
}

TEST(Penetrations, StaticCollidersCountWhereTheyAreAskedFor) {
  TestScene scene;
  scene.add_collider("ball/shape", scene.add_body("ball", {{0, 0, 0.08}}), sphere(0.1));
  scene.add_collider("ground", std::nullopt, box({{1, 1, 0.1}}), {{{0, 0, -0.1}}});
  EXPECT_TRUE(at_start(scene).empty());
  const std::vector<Penetration> found = at_start(scene, StaticColliders::Included);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].depth, 0.02, kRounding);
}

/// A cube of side 0.2 with a corner at the origin, as points and triangles.
scene::TriangleMesh cube() {
  scene::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.points.push_back({{0.2 * (i & 1), 0.2 * (i >> 1 & 1), 0.2 * (i >> 2 & 1)}});
  }
  mesh.triangles = {{{0, 2, 1}}, {{1, 2, 3}}, {{4, 5, 6}}, {{5, 7, 6}}, {{0, 1, 4}}, {{1, 5, 4}},
                    {{2, 6, 3}}, {{3, 6, 7}}, {{0, 4, 2}}, {{2, 4, 6}}, {{1, 3, 5}}, {{3, 7, 5}}};
  return mesh;
}

TEST(Penetrations, HullsOfMeshesOverlap) {
  TestScene scene;
  scene.meshes.push_back(cube());
  scene::Shape hull;
  hull.kind = scene::ShapeKind::ConvexHull;
  scene.add_collider("a/mesh", scene.add_body("a", {{0, 0, 0}}), hull);
  scene.add_collider("b/mesh", scene.add_body("b", {{0.18, 0.05, 0.03}}), hull);
  const std::vector<Penetration> found = at_start(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].depth, 0.02, 1e-5);
}

TEST(Penetrations, DeepestPieceOfADecompositionCounts) {
  TestScene scene;
  scene.meshes = {cube(), cube()};
  for (Vec3d& point : scene.meshes[1].points) {
    point[0] += 0.21;
  }
  scene::Shape pieces;
  pieces.kind = scene::ShapeKind::ConvexHull;
  pieces.pieces = {0, 1};
  scene.add_collider("a/mesh", scene.add_body("a", {{0, 0, 0}}), pieces);
  scene.add_collider("b/ball", scene.add_body("b", {{0.5, 0.1, 0.1}}), sphere(0.12));
  const std::vector<Penetration> found = at_start(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].depth, 0.03, 1e-5);
}

/// A ball inside of a triangle mesh in the form of two walls, 0.2 apart.
std::vector<Penetration> between_walls(bool kinematic, Diagnostics& findings,
                                       std::vector<NotMapped>& not_mapped) {
  TestScene scene;
  scene::TriangleMesh walls;
  walls.points = {{{-0.1, -1, -1}}, {{-0.1, 1, -1}}, {{-0.1, 0, 1}},
                  {{0.1, -1, -1}},  {{0.1, 1, -1}},  {{0.1, 0, 1}}};
  walls.triangles = {{{0, 1, 2}}, {{3, 5, 4}}};
  scene.meshes.push_back(walls);
  scene::Shape mesh;
  mesh.kind = scene::ShapeKind::Mesh;
  const Index body = scene.add_body("walls", {{0, 0, 0}});
  scene.bodies[body].kinematic = kinematic;
  scene.add_collider("walls/mesh", body, mesh);
  scene.add_collider("ball/shape", scene.add_body("ball", {{0, 0, 0}}), sphere(0.05));
  auto made = Penetrations::make(scene, StaticColliders::Left, findings);
  EXPECT_TRUE(made.has_value());
  not_mapped = made->not_mapped();
  return *made->at(poses_of(scene));
}

TEST(Penetrations, TriangleMeshesAreTheirHullWhereTheyMove) {
  Diagnostics findings;
  std::vector<NotMapped> not_mapped;
  EXPECT_EQ(between_walls(false, findings, not_mapped).size(), 1u);
  ASSERT_EQ(not_mapped.size(), 1u);
  EXPECT_NE(not_mapped[0].why.find("convex hull"), std::string::npos);
  EXPECT_TRUE(between_walls(true, findings, not_mapped).empty());
}

}  // namespace
}  // namespace tenon::engines::mujoco
