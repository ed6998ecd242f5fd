// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The two-link arm has a closed form; other robots are random chains that are put somewhere and
// have to find a posture with their frame at the same place.
#include "tenon/dynamics/reach.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace tenon::dynamics {
namespace {

using scene::Axis;
using scene::Dof;
using scene::Joint;
using scene::JointKind;
using scene::PhysicsScene;

constexpr double kDegree = M_PI / 180;

/// A body that hangs on the last one by a joint at `place` from it.
Joint& add_reaching_link(PhysicsScene& scene, JointKind kind, Axis axis, const Vec3d& place) {
  const bool first = scene.bodies.empty();
  scene::Body body;
  body.path = *Path::parse("/link" + std::to_string(scene.bodies.size()));
  body.mass = 1;
  body.inertia = Mat3d{};
  for (std::size_t i = 0; i < 3; ++i) {
    body.inertia[i][i] = 0.01;
  }
  body.pose.position = first ? place : scene.bodies.back().pose.position + place;
  scene.bodies.push_back(body);
  Joint joint;
  joint.path = *Path::parse("/joint" + std::to_string(scene.joints.size()));
  joint.kind = kind;
  joint.axis = axis;
  joint.body1 = static_cast<Index>(scene.bodies.size() - 1);
  if (!first) {
    joint.body0 = static_cast<Index>(scene.bodies.size() - 2);
  }
  joint.frame0.position = place;
  scene.joints.push_back(joint);
  return scene.joints.back();
}

void limit(Joint& joint, double lower, double upper) {
  const Dof dof = joint.kind == JointKind::Prismatic ? Dof::TransX : Dof::RotX;
  joint.limits.push_back(
      {static_cast<Dof>(static_cast<std::size_t>(dof) + static_cast<std::size_t>(joint.axis)),
       lower, upper});
}

/// Two hinges about z, links of 0.3 m and 0.2 m along x.
PhysicsScene two_links() {
  PhysicsScene scene;
  scene.scenes.emplace_back();
  add_reaching_link(scene, JointKind::Revolute, Axis::Z, {{0, 0, 0}});
  add_reaching_link(scene, JointKind::Revolute, Axis::Z, {{0.3, 0, 0}});
  return scene;
}

ReachTarget tip_at(const Vec3d& place) {
  return {1, Pose{{{0.2, 0, 0}}, kIdentityRotation}, place, std::nullopt};
}

TEST(Reach, TwoLinkArmHasTheAnglesOfTheClosedForm) {
  const PhysicsScene scene = two_links();
  const Multibody multibody(scene);
  for (const Vec3d& place : {Vec3d{{0.25, 0.2, 0}}, Vec3d{{-0.1, 0.3, 0}}, Vec3d{{0.05, -0.15, 0}},
                             Vec3d{{-0.3, -0.3, 0}}}) {
    ReachOptions exact;
    exact.distance = 1e-9;
    const auto found = reach(multibody, multibody.start(), {tip_at(place)}, exact);
    ASSERT_TRUE(found);
    ASSERT_TRUE(found->reached);
    // Law of cosines: cos q2 = (r^2 - a^2 - b^2) / (2 a b).
    const double squared = dot(place, place);
    const double elbow = std::acos((squared - 0.09 - 0.04) / 0.12);
    const double q1 = found->posture.joints[0][0];
    const double q2 = found->posture.joints[1][0];
    EXPECT_NEAR(std::abs(std::remainder(q2, 2 * M_PI)), elbow, 1e-7);
    const double shoulder =
        std::atan2(place[1], place[0]) - std::atan2(0.2 * std::sin(q2), 0.3 + 0.2 * std::cos(q2));
    EXPECT_NEAR(std::remainder(q1 - shoulder, 2 * M_PI), 0, 1e-7);
  }
}

TEST(Reach, StretchedArmReachesItsLongestPlace) {
  const PhysicsScene scene = two_links();
  const Multibody multibody(scene);
  const auto found = reach(multibody, multibody.start(), {tip_at({{0, 0.5, 0}})});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->reached);
}

TEST(Reach, BeyondTheLongestPlaceNothingIsReached) {
  const PhysicsScene scene = two_links();
  const Multibody multibody(scene);
  const auto found = reach(multibody, multibody.start(), {tip_at({{0.6, 0.3, 0}})});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->reached);
  EXPECT_EQ(found->obstacle, ReachObstacle::Distance);
  EXPECT_EQ(found->starts, 32U);
  EXPECT_NEAR(found->gaps[0].distance, std::hypot(0.6, 0.3) - 0.5, 1e-4);
}

TEST(Reach, LimitsAreKeptAndNamedWhereTheyAreInTheWay) {
  PhysicsScene scene = two_links();
  limit(scene.joints[0], -90 * kDegree, 90 * kDegree);
  limit(scene.joints[1], 0, 30 * kDegree);
  const Multibody multibody(scene);
  const auto far = reach(multibody, multibody.start(), {tip_at({{0.1, 0.2, 0}})});
  ASSERT_TRUE(far);
  EXPECT_FALSE(far->reached);
  EXPECT_EQ(far->obstacle, ReachObstacle::Limits);
  ASSERT_FALSE(far->at_limits.empty());
  EXPECT_EQ(far->at_limits.back().joint, 1U);
  EXPECT_NEAR(far->at_limits.back().bound, 30 * kDegree, 1e-12);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_GE(far->posture.joints[j][0], multibody.dofs()[j].free[0].lower - 1e-6);
    EXPECT_LE(far->posture.joints[j][0], multibody.dofs()[j].free[0].upper + 1e-6);
  }
}

TEST(Reach, OrientationThatThePlaneDoesNotHaveIsNamed) {
  const PhysicsScene scene = two_links();
  const Multibody multibody(scene);
  ReachTarget target = tip_at({{0.25, 0.2, 0}});
  target.orientation = rotation_about({{1, 0, 0}}, 1);
  const auto found = reach(multibody, multibody.start(), {target});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->reached);
  EXPECT_EQ(found->obstacle, ReachObstacle::Rotations);
}

TEST(Reach, FollowersKeepTheirLaw) {
  PhysicsScene scene = two_links();
  limit(scene.joints[0], 0, 120 * kDegree);
  limit(scene.joints[1], 0, 45 * kDegree);
  scene::Mimic mimic;
  mimic.dof = Dof::RotZ;
  mimic.leader = 0;
  mimic.leader_dof = Dof::RotZ;
  mimic.multiplier = 0.5;
  mimic.offset = 0.1;
  scene.joints[1].mimics.push_back(mimic);
  const Multibody multibody(scene);
  const double q = 0.9;
  std::vector<std::vector<double>> joints{{q}, {0}};
  const Posture there = multibody.moved(multibody.start(), joints);
  EXPECT_NEAR(there.joints[1][0], 0.1 + 0.5 * q, 1e-12);
  const Vec3d place = (there.bodies[1] * Pose{{{0.2, 0, 0}}, kIdentityRotation}).position;
  const auto found = reach(multibody, multibody.start(), {tip_at(place)});
  ASSERT_TRUE(found);
  ASSERT_TRUE(found->reached);
  EXPECT_NEAR(found->posture.joints[0][0], q, 1e-4);
  EXPECT_NEAR(found->posture.joints[1][0], 0.1 + 0.5 * found->posture.joints[0][0], 1e-12);
  // The follower's own bound ends the leader's way: 45 deg = 0.1 + 0.5 q.
  const double last = (45 * kDegree - 0.1) / 0.5;
  joints[0][0] = last + 0.2;
  const Posture beyond = multibody.moved(multibody.start(), joints);
  const auto ends =
      reach(multibody, multibody.start(),
            {tip_at((beyond.bodies[1] * Pose{{{0.2, 0, 0}}, kIdentityRotation}).position)});
  ASSERT_TRUE(ends);
  EXPECT_FALSE(ends->reached);
  EXPECT_EQ(ends->obstacle, ReachObstacle::Limits);
  EXPECT_LE(ends->posture.joints[1][0], 45 * kDegree + 1e-6);
}

TEST(Reach, HeldJointsAndOthersStay) {
  PhysicsScene scene = two_links();
  add_reaching_link(scene, JointKind::Revolute, Axis::Z, {{0.2, 0, 0}});
  const Multibody multibody(scene);
  ReachOptions options;
  options.held = {true, false, false};
  const Posture start = multibody.moved(multibody.start(), {{0.4}, {0.5}, {0.7}});
  const auto found = reach(multibody, start, {tip_at({{0.4, 0.25, 0}})}, options);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->posture.joints[0][0], 0.4);
  EXPECT_EQ(found->posture.joints[2][0], 0.7);  // carries no frame
  options.held = {true, true, false};
  const auto nothing = reach(multibody, start, {tip_at({{0.4, 0.25, 0}})}, options);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().diagnostic().rule, "pose.no-reach");
}

TEST(Reach, RandomChainsFindTheFrameAgain) {
  std::mt19937_64 random(7);
  const auto between = [&](double a, double b) {
    return a + (b - a) * (static_cast<double>(random() >> 11U) * 0x1p-53);
  };
  int missed = 0;
  for (int robot = 0; robot < 40; ++robot) {
    PhysicsScene scene;
    scene.scenes.emplace_back();
    std::vector<std::vector<double>> joints;
    for (int i = 0; i < 7; ++i) {
      const bool slides = random() % 6 == 0;
      const Vec3d place{{between(-0.1, 0.1), between(-0.1, 0.1), between(0.05, 0.3)}};
      Joint& joint = add_reaching_link(scene, slides ? JointKind::Prismatic : JointKind::Revolute,
                                       static_cast<Axis>(random() % 3), place);
      const double reach_of_joint = slides ? 0.2 : between(1, 2.8);
      limit(joint, -reach_of_joint, reach_of_joint);
      joints.push_back({between(-reach_of_joint, reach_of_joint)});
    }
    const Multibody multibody(scene);
    const Posture there = multibody.moved(multibody.start(), joints);
    const Pose frame{{{0.02, 0.05, 0.1}}, rotation_about({{0, 1, 0}}, 0.3)};
    const Pose world = there.bodies[6] * frame;
    const auto found =
        reach(multibody, multibody.start(), {{6, frame, world.position, world.orientation}});
    ASSERT_TRUE(found);
    missed += found->reached ? 0 : 1;
    const Pose back = found->posture.bodies[6] * frame;
    if (found->reached) {
      EXPECT_LT(length(back.position - world.position), 1e-5);
      EXPECT_LT(
          length(rotation_vector(normalized(back.orientation * conjugate(world.orientation)))),
          1e-4);
    }
    for (std::size_t j = 0; j < 7; ++j) {
      EXPECT_GE(found->posture.joints[j][0], multibody.dofs()[j].free[0].lower - 1e-6);
      EXPECT_LE(found->posture.joints[j][0], multibody.dofs()[j].free[0].upper + 1e-6);
    }
    const auto again =
        reach(multibody, multibody.start(), {{6, frame, world.position, world.orientation}});
    EXPECT_EQ(again->posture.joints, found->posture.joints);
  }
  EXPECT_EQ(missed, 0);
}

}  // namespace
}  // namespace tenon::dynamics
