// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/dynamics/masks.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tenon/scene/fields/insert_joints.h"
#include "tenon/scene/joint_forest.h"

namespace tenon::dynamics {
namespace {

using scene::Index;
using scene::Joint;
using scene::JointKind;
using scene::PhysicsScene;

/// "/b0" on the world by "/j0", each further body on the one before, about Z.
PhysicsScene chain(Index count, bool fixed) {
  PhysicsScene scene;
  scene.scenes.emplace_back();
  scene::Articulation articulation;
  articulation.path = *Path::parse("/robot");
  articulation.fixed_base = fixed;
  for (Index b = 0; b < count; ++b) {
    scene::Body body;
    body.path = *Path::parse("/b" + std::to_string(b));
    body.pose.position = {{static_cast<double>(b), 0, 0}};
    scene.bodies.push_back(body);
    articulation.links.push_back(b);
    if (b == 0 && !fixed) {
      continue;
    }
    Joint joint;
    joint.path = *Path::parse("/j" + std::to_string(b));
    joint.kind = b == 0 ? JointKind::Fixed : JointKind::Revolute;
    joint.axis = scene::Axis::Z;
    joint.body1 = b;
    if (b > 0) {
      joint.body0 = b - 1;
      joint.frame0.position = {{1, 0, 0}};
    }
    joint.articulation = 0;
    articulation.joints.push_back(static_cast<Index>(scene.joints.size()));
    scene.joints.push_back(joint);
  }
  articulation.root = fixed ? scene.joints[0].path : scene.bodies[0].path;
  scene.articulations.push_back(articulation);
  return scene;
}

Diagnostics masked(PhysicsScene& scene, const Masks& masks) {
  Diagnostics found;
  const Result<void> done = apply_masks(masks, scene, found);
  EXPECT_TRUE(done) << done.error().diagnostic().message;
  return found;
}

std::size_t count_of(const Diagnostics& found, std::string_view rule) {
  std::size_t count = 0;
  for (const Diagnostic& finding : found) {
    count += finding.rule == rule ? 1 : 0;
  }
  return count;
}

TEST(Masks, NothingChangesNothing) {
  PhysicsScene scene = chain(3, true);
  const Diagnostics found = masked(scene, {});
  EXPECT_EQ(count_of(found, "mask.deactivated"), 0u);
  EXPECT_EQ(scene.joints.size(), 3u);
}

TEST(Masks, WhatIsCutOffIsAnArticulationOfItsOwn) {
  PhysicsScene scene = chain(4, true);
  masked(scene, {.deactivate = {"j2"}});
  EXPECT_FALSE(scene.joints[2].enabled);
  EXPECT_EQ(scene.articulations[0].links, (std::vector<Index>{0, 1}));
  EXPECT_EQ(scene.articulations[0].joints, (std::vector<Index>{0, 1}));
  ASSERT_EQ(scene.articulations.size(), 2u);
  EXPECT_EQ(scene.articulations[1].path, scene.articulations[0].path);
  EXPECT_EQ(scene.articulations[1].links, (std::vector<Index>{2, 3}));
  EXPECT_FALSE(scene.articulations[1].fixed_base);
  EXPECT_EQ(scene.joints[3].articulation, std::optional<Index>(1));
  EXPECT_FALSE(scene.joints[2].articulation.has_value());
  const scene::JointForest forest = joint_forest(scene);
  EXPECT_FALSE(forest.bodies[2].parent.has_value());
  EXPECT_EQ(forest.bodies[3].parent, std::optional<Index>(2));
}

TEST(Masks, ALinkTakesAllThatHangsOnIt) {
  PhysicsScene scene = chain(4, true);
  const Diagnostics found = masked(scene, {.deactivate = {"/b1"}});
  EXPECT_EQ(count_of(found, "mask.deactivated"), 3u);
  for (const Index b : {1u, 2u, 3u}) {
    EXPECT_FALSE(scene.bodies[b].enabled);
    EXPECT_TRUE(scene.bodies[b].kinematic);
    EXPECT_FALSE(scene.joints[b].enabled);
  }
  EXPECT_EQ(scene.articulations[0].links, (std::vector<Index>{0}));
}

TEST(Masks, TheAnchorOfALinkThatFloatsIsItsRoot) {
  PhysicsScene scene = chain(3, false);
  scene::Mimic mimic;
  mimic.leader = 0;  // /j1
  scene.joints[1].mimics.push_back(mimic);
  masked(scene, {.anchor = {"b1"}});
  ASSERT_EQ(scene.joints.size(), 3u);
  EXPECT_EQ(scene.joints[0].path.str(), "/b1/anchor");  // sorted by path, before /j1
  EXPECT_EQ(scene.joints[2].mimics[0].leader, 1u) << "still /j1";
  const scene::Articulation& robot = scene.articulations[0];
  EXPECT_TRUE(robot.fixed_base);
  EXPECT_EQ(robot.root, scene.joints[0].path);
  EXPECT_EQ(robot.links, (std::vector<Index>{1, 0, 2}));
  EXPECT_EQ(robot.joints, (std::vector<Index>{0, 1, 2}));
  EXPECT_TRUE(joint_forest(scene).bodies[0].fixed);
}

TEST(Masks, ASecondAnchorClosesALoop) {
  PhysicsScene scene = chain(3, true);
  masked(scene, {.anchor = {"b2"}});
  EXPECT_EQ(scene.articulations[0].loop_joints, (std::vector<Index>{0}));
  EXPECT_EQ(joint_forest(scene).loop_joints, (std::vector<Index>{0}));
}

TEST(Masks, ABypassedLinkHandsItsJointsOn) {
  PhysicsScene scene = chain(4, true);
  masked(scene, {.bypass = {"b2"}});
  EXPECT_EQ(scene.joints[3].body0, std::optional<Index>(1));
  EXPECT_NEAR(scene.joints[3].frame0.position[0], 2, 1e-12);
  EXPECT_FALSE(scene.joints[2].enabled);
  EXPECT_EQ(scene.articulations[0].links, (std::vector<Index>{0, 1, 3}));
}

TEST(Masks, ABypassedJointStandsAsItStarts) {
  PhysicsScene scene = chain(3, true);
  scene.joints[2].initial_position = M_PI / 2;
  masked(scene, {.bypass = {"j2"}});
  EXPECT_EQ(scene.joints[2].kind, JointKind::Fixed);
  EXPECT_FALSE(scene.joints[2].initial_position.has_value());
  const Pose held = scene.bodies[1].pose * scene.joints[2].frame0 *
                    inverse(scene.bodies[2].pose * scene.joints[2].frame1);
  EXPECT_NEAR(length(held.position), 0, 1e-12);
  EXPECT_NEAR(std::abs(scene.bodies[2].pose.orientation.z), std::sqrt(0.5), 1e-12);
}

TEST(Masks, TracksOfMaskedPartsGo) {
  PhysicsScene scene = chain(3, true);
  scene.switch_tracks.push_back({scene::Switch::JointEnabled, 2, {0, 1}, {1, 1}});
  scene.switch_tracks.push_back({scene::Switch::JointEnabled, 1, {0, 1}, {1, 0}});
  scene.bounds_tracks.push_back({2, {0}, {{}}, false});
  masked(scene, {.deactivate = {"j2"}});
  ASSERT_EQ(scene.switch_tracks.size(), 1u);
  EXPECT_EQ(scene.switch_tracks[0].object, 1u);
  EXPECT_TRUE(scene.bounds_tracks.empty());
}

TEST(Masks, RefusesWhatItDoesNotKnow) {
  PhysicsScene scene = chain(3, true);
  Diagnostics found;
  const auto rule = [&](const Masks& masks) {
    const Result<void> done = apply_masks(masks, scene, found);
    return done ? std::string() : done.error().diagnostic().rule;
  };
  EXPECT_EQ(rule({.anchor = {"j1"}}), "mask.unknown");
  EXPECT_EQ(rule({.deactivate = {"/none"}}), "mask.unknown");
  EXPECT_EQ(rule({.deactivate = {"b1"}, .anchor = {"b2"}}), "mask.conflict");
  EXPECT_EQ(rule({.bypass = {"("}}), "name.bad-pattern");
}

TEST(InsertJoints, WhatReferredStillMeansTheSame) {
  PhysicsScene scene = chain(4, true);
  scene.sensors.emplace_back().joint = 3;
  scene.tendons.emplace_back().joints = {1, 3};
  scene::MujocoActuator actuator;
  actuator.kind = scene::MujocoActuator::Target::Joint;
  actuator.target = 2;
  scene.actuators.push_back(actuator);
  scene.filter.joint_pairs.push_back({1, {}});
  Joint first;
  first.path = *Path::parse("/a");
  Joint between;
  between.path = *Path::parse("/j1/more");
  EXPECT_EQ(insert_joints(scene, {between, first}), (std::vector<Index>{3, 0}));
  EXPECT_EQ(scene.joints[*scene.sensors[0].joint].path.str(), "/j3");
  EXPECT_EQ(scene.joints[scene.tendons[0].joints[0]].path.str(), "/j1");
  EXPECT_EQ(scene.joints[scene.actuators[0].target].path.str(), "/j2");
  EXPECT_EQ(scene.joints[scene.filter.joint_pairs[0].joint].path.str(), "/j1");
  EXPECT_EQ(scene.joints[scene.articulations[0].joints[3]].path.str(), "/j3");
}

}  // namespace
}  // namespace tenon::dynamics
