// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/timeline/timeline.h"

#include <gtest/gtest.h>

namespace tenon::scene {
namespace {

/// Two bodies a metre apart with a collider each, and a hinge between them.
PhysicsScene pair_of_bodies() {
  PhysicsScene scene;
  scene.scenes.push_back({Path::from("/Scene"), {{0, 0, -9.81}}, {}});
  for (const char* name : {"/A", "/B"}) {
    Body body;
    body.path = Path::from(name);
    body.pose.position[0] = static_cast<double>(scene.bodies.size());
    scene.bodies.push_back(body);
    Collider collider;
    collider.path = Path::from(std::string(name) + "/shape");
    collider.body = static_cast<Index>(scene.bodies.size() - 1);
    scene.colliders.push_back(collider);
    scene.filter.groups_of_collider.emplace_back();
  }
  Joint joint;
  joint.path = Path::from("/Hinge");
  joint.kind = JointKind::Revolute;
  joint.body0 = 0;
  joint.body1 = 1;
  scene.joints.push_back(joint);
  return scene;
}

TEST(Timeline, IsNeededForWhatChangesTheSceneAlone) {
  PhysicsScene scene = pair_of_bodies();
  scene.scalar_tracks.push_back({});
  scene.pose_tracks.push_back({0, {}, {0, 1}, {Pose{}, Pose{}}, false});
  EXPECT_FALSE(Timeline::is_needed(scene));
  PhysicsScene breaks = scene;
  breaks.joints[0].break_force = 10;
  EXPECT_TRUE(Timeline::is_needed(breaks));
  PhysicsScene weightless = scene;
  weightless.gravity_tracks.push_back({0, {0}, {Vec3d{}}, true});
  EXPECT_TRUE(Timeline::is_needed(weightless));
}

TEST(Timeline, SwitchesActAtTheirTimeAndWhatIsDisabledStandsStill) {
  PhysicsScene scene = pair_of_bodies();
  scene.switch_tracks.push_back({Switch::BodyEnabled, 0, {0, 1, 2}, {1, 0, 1}});
  scene.switch_tracks.push_back({Switch::BodyKinematic, 0, {0}, {0}});
  scene.switch_tracks.push_back({Switch::ColliderEnabled, 1, {0, 1}, {1, 0}});
  Timeline timeline(scene);
  EXPECT_FALSE(timeline.advance(0.5).structure);
  EXPECT_TRUE(timeline.advance(1 - 1e-12).structure);  // a sum of steps is not exact
  EXPECT_FALSE(timeline.scene().bodies[0].enabled);
  EXPECT_TRUE(timeline.scene().bodies[0].kinematic);
  EXPECT_FALSE(timeline.scene().colliders[1].enabled);
  EXPECT_FALSE(timeline.advance(1.5).structure);
  EXPECT_TRUE(timeline.advance(2).structure);
  EXPECT_TRUE(timeline.scene().bodies[0].enabled);
  EXPECT_FALSE(timeline.scene().bodies[0].kinematic);
  EXPECT_FALSE(timeline.scene().colliders[1].enabled);
}

TEST(Timeline, BrokenJointsStayBroken) {
  PhysicsScene scene = pair_of_bodies();
  scene.switch_tracks.push_back({Switch::JointEnabled, 0, {0, 1, 2}, {1, 0, 1}});
  Timeline timeline(scene);
  timeline.break_joint(0);
  EXPECT_FALSE(timeline.scene().joints[0].enabled);
  timeline.advance(1);
  timeline.advance(2);
  EXPECT_FALSE(timeline.scene().joints[0].enabled);
}

TEST(Timeline, BoundsAndGravityGoBetweenTheirSamples) {
  PhysicsScene scene = pair_of_bodies();
  JointBounds narrow;
  narrow.lower = -1;
  narrow.upper = 1;
  JointBounds wide = narrow;
  wide.upper = 2;
  scene.bounds_tracks.push_back({0, {0, 1}, {narrow, wide}, false});
  scene.gravity_tracks.push_back({0, {0, 1}, {Vec3d{{0, 0, -10}}, Vec3d{}}, false});
  Timeline timeline(scene);
  const SceneChange change = timeline.advance(0.5);
  EXPECT_TRUE(change.bounds);
  EXPECT_TRUE(change.gravity);
  EXPECT_FALSE(change.structure);
  EXPECT_DOUBLE_EQ(timeline.scene().joints[0].lower, -1);
  EXPECT_DOUBLE_EQ(timeline.scene().joints[0].upper, 1.5);
  EXPECT_DOUBLE_EQ(timeline.scene().scenes[0].gravity[2], -5);
}

TEST(Timeline, GroupsChangeWhereTheirTablesDo) {
  PhysicsScene scene = pair_of_bodies();
  scene.filter.group_paths = {Path::from("/Group")};
  scene.filter.group_pair_off = {0};
  scene.filter.ungrouped_off = {0};
  scene.group_states = {{0, {0}, {0}}, {1, {1}, {0}}};
  Timeline timeline(scene);
  EXPECT_FALSE(timeline.advance(0).structure);
  EXPECT_TRUE(timeline.advance(1).structure);
  EXPECT_EQ(timeline.scene().filter.group_pair_off, std::vector<char>{1});
}

TEST(Timeline, ShapesThatMoveInABodyChangeItsMass) {
  PhysicsScene scene = pair_of_bodies();
  BodyShapes before;
  before.poses = {Pose{}};
  before.shapes = {Shape{}};
  BodyShapes after = before;
  after.poses[0].position = {{0, 0, 1}};
  after.mass = 3;
  scene.shapes_tracks.push_back({1, {1}, {0, 1}, {before, after}});
  Timeline timeline(scene);
  EXPECT_FALSE(timeline.advance(0.9).structure);
  EXPECT_TRUE(timeline.advance(1).structure);
  EXPECT_EQ(timeline.scene().colliders[1].pose.position, (Vec3d{{0, 0, 1}}));
  EXPECT_EQ(timeline.scene().bodies[1].mass, 3);
}

TEST(Timeline, JointSidesThatMoveGetABodyOfTheirOwn) {
  PhysicsScene scene = pair_of_bodies();
  PoseTrack track;
  track.times = {0, 1};
  track.poses = {Pose{{{5, 0, 0}}}, Pose{}};
  track.joint = 0;
  scene.pose_tracks.push_back(track);
  ASSERT_TRUE(Timeline::is_needed(scene));
  const Timeline timeline(scene);
  ASSERT_EQ(timeline.scene().bodies.size(), 3u);
  EXPECT_EQ(timeline.scene().joints[0].body0, std::optional<Index>(2));
  EXPECT_TRUE(timeline.scene().bodies[2].kinematic);
  EXPECT_EQ(timeline.scene().bodies[2].pose.position, (Vec3d{{5, 0, 0}}));
}

TEST(Timeline, ABodyThatIsOffInsideAnotherHangsOnItWhereItIs) {
  PhysicsScene scene = pair_of_bodies();
  NestingState apart;
  NestingState together;
  together.time = 1;
  together.merged = {{1, 0}};
  together.masses = {{0, BodyMass{2, {}, Mat3d::identity()}}, {1, BodyMass{0, {}, {}}}};
  scene.nesting_states = {apart, together};
  Timeline timeline(scene, BodyMass{1e-9, {}, Mat3d::identity()});
  ASSERT_EQ(timeline.scene().joints.size(), 2u);
  EXPECT_FALSE(timeline.scene().joints[1].enabled);
  EXPECT_TRUE(timeline.advance(1).structure);
  EXPECT_TRUE(timeline.scene().joints[1].enabled);
  EXPECT_EQ(timeline.scene().bodies[0].mass, 2);
  EXPECT_EQ(timeline.scene().bodies[1].mass, 1e-9);
  // The engine brings it to where it has moved: 4 m from its carrier.
  std::vector<BodyState> states(2);
  states[0].pose.position = {{1, 0, 0}};
  states[1].pose.position = {{5, 0, 0}};
  states[1].linear_velocity = {{0, 0, -1}};
  const std::vector<MergedBody> joined = timeline.restart(states);
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_EQ(joined[0].body, 1u);
  EXPECT_EQ(timeline.scene().joints[1].frame0.position, (Vec3d{{4, 0, 0}}));
  EXPECT_EQ(timeline.scene().bodies[1].linear_velocity, (Vec3d{{0, 0, -1}}));
  EXPECT_TRUE(timeline.restart(states).empty());
}

TEST(Timeline, WhatHasMovedDoesNotStartAsleep) {
  PhysicsScene scene = pair_of_bodies();
  scene.bodies[0].starts_asleep = true;
  scene.bodies[1].starts_asleep = true;
  scene.joints[0].initial_position = 1;
  Timeline timeline(scene);
  std::vector<BodyState> states(2);
  states[1].pose = scene.bodies[1].pose;
  states[0].linear_velocity = {{1, 0, 0}};
  timeline.restart(states);
  EXPECT_FALSE(timeline.scene().bodies[0].starts_asleep);
  EXPECT_TRUE(timeline.scene().bodies[1].starts_asleep);
  EXPECT_FALSE(timeline.scene().joints[0].initial_position.has_value());
}

}  // namespace
}  // namespace tenon::scene
