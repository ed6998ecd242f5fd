// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/pairs/body_pairs.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/dynamics/drawn_postures.h"
#include "tenon/engines/test_scene.h"
#include "tenon/scene/filter_sets.h"

namespace tenon {
namespace {

using engines::TestScene;
using scene::Index;
using scene::JointKind;

constexpr double kRadius = 0.05;
constexpr double kReach = 0.5;

/// A kinematic base, a ball on an arm that turns about Z by `lower` to `upper`, and a ball on the
/// base, at `post` on the circle of the other [rad].
TestScene arm_and_post(double lower, double upper, double post) {
  TestScene scene;
  scene.add_collider("arm/ball", scene.add_body("arm", {{kReach, 0, 0}}), engines::sphere(kRadius));
  const Index base = scene.add_body("base", {{0, 0, 0}});
  scene.bodies[base].kinematic = true;
  scene.add_collider("base/post", base, engines::sphere(kRadius),
                     {{{kReach * std::cos(post), kReach * std::sin(post), 0}}});
  scene::Joint& turn = scene.add_joint("turn", JointKind::Revolute, base, 0);
  turn.frame1.position = {{-kReach, 0, 0}};
  turn.lower = lower;
  turn.upper = upper;
  return scene;
}

BodyPairs pairs_of(const scene::PhysicsScene& scene, std::size_t samples, std::size_t threads = 0,
                   const physics::Provenance& provenance = {}) {
  BodyPairsOptions options;
  options.samples = samples;
  options.threads = threads;
  Diagnostics diagnostics;
  auto pairs = body_pairs(scene, provenance, options, diagnostics);
  EXPECT_TRUE(pairs.has_value()) << (pairs.has_value() ? "" : pairs.error().to_string());
  return pairs.has_value() ? *std::move(pairs) : BodyPairs();
}

TEST(DrawnPostures, NumbersOfASeedAreTheSameAlways) {
  const TestScene scene = arm_and_post(-1, 2, 1);
  const dynamics::Multibody multibody(scene);
  const dynamics::DrawnPostures drawn(multibody);
  EXPECT_EQ(drawn.coordinate_count(), 1u);
  EXPECT_EQ(drawn.draw(0, 0).joints, drawn.draw(0, 0).joints);
  EXPECT_NE(drawn.draw(0, 0).joints, drawn.draw(0, 1).joints);
  EXPECT_NE(drawn.draw(0, 0).joints, drawn.draw(1, 0).joints);
  double sum = 0;
  constexpr int kCount = 10000;
  for (int i = 0; i < kCount; ++i) {
    const double angle = drawn.draw(5, static_cast<std::uint64_t>(i)).joints[0][0];
    ASSERT_GE(angle, -1);
    ASSERT_LE(angle, 2);
    sum += angle;
  }
  EXPECT_NEAR(sum / kCount, 0.5, 4 * 3 / std::sqrt(12.0 * kCount));  // of a uniform number
}

TEST(DrawnPostures, RotationsWithoutLimitsGoAroundAndSlidesStay) {
  TestScene scene = arm_and_post(-scene::kUnlimited, scene::kUnlimited, 1);
  const dynamics::Multibody around(scene);
  double least = 0;
  double most = 0;
  const dynamics::DrawnPostures drawn(around);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double angle = drawn.draw(0, i).joints[0][0];
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  EXPECT_NEAR(least, -M_PI, 0.05);
  EXPECT_NEAR(most, M_PI, 0.05);
  EXPECT_GE(least, -M_PI);
  EXPECT_LE(most, M_PI);
  scene.joints[0].kind = JointKind::Prismatic;
  const dynamics::Multibody slide(scene);
  EXPECT_EQ(dynamics::DrawnPostures(slide).coordinate_count(), 0u);
}

TEST(DrawnPostures, BallsStayInTheirCone) {
  TestScene scene = arm_and_post(0, 0, 1);
  scene.joints[0].kind = JointKind::Spherical;
  scene.joints[0].axis = scene::Axis::X;
  scene.joints[0].cone_angle0 = 0.4;
  scene.joints[0].cone_angle1 = 0.4;
  const dynamics::Multibody multibody(scene);
  const dynamics::DrawnPostures drawn(multibody);
  EXPECT_EQ(drawn.coordinate_count(), 3u);
  double widest = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3d arm = drawn.draw(0, i).bodies[0].position;
    widest = std::max(widest, std::acos(std::min(1.0, arm[0] / kReach)));
  }
  EXPECT_LE(widest, 0.4 + 1e-9);
  EXPECT_GT(widest, 0.39);
}

TEST(DrawnPostures, FollowersAreNotDrawn) {
  TestScene scene = arm_and_post(-1, 1, 1);
  scene.add_body("tip", {{2 * kReach, 0, 0}});
  scene::Joint& bend = scene.add_joint("zbend", JointKind::Revolute, 0, 2);
  bend.frame0.position = {{kReach, 0, 0}};
  bend.lower = -3;
  bend.upper = 3;
  scene::Mimic mimic;
  mimic.dof = scene::Dof::RotZ;
  mimic.leader = 0;
  mimic.leader_dof = scene::Dof::RotZ;
  mimic.multiplier = 2;
  bend.mimics.push_back(mimic);
  const dynamics::Multibody multibody(scene);
  const dynamics::DrawnPostures drawn(multibody);
  EXPECT_EQ(drawn.coordinate_count(), 1u);
  const dynamics::Posture posture = drawn.draw(0, 3);
  EXPECT_NEAR(posture.joints[1][0], 2 * posture.joints[0][0], 1e-12);
}

/// A parallelogram that turns by +-60 degrees at each corner: base, crank, rocker and coupler.
TestScene four_bar() {
  TestScene scene;
  const Index base = scene.add_body("base", {{0, 0, 0}});
  scene.bodies[base].kinematic = true;
  const Index crank = scene.add_body("crank", {{0, 0.5, 0}});
  const Index rocker = scene.add_body("rocker", {{1, 0.5, 0}});
  const Index coupler = scene.add_body("coupler", {{0.5, 1, 0}});
  for (Index body = 0; body < 4; ++body) {
    scene.add_collider("shape" + std::to_string(body), body, engines::sphere(kRadius));
  }
  const auto hinge = [&](const char* name, Index a, Index b, const Vec3d& at_a, const Vec3d& at_b) {
    scene::Joint& joint = scene.add_joint(name, JointKind::Revolute, a, b);
    joint.frame0.position = at_a;
    joint.frame1.position = at_b;
    joint.lower = -M_PI / 3;
    joint.upper = M_PI / 3;
  };
  hinge("j1", base, crank, {}, {{0, -0.5, 0}});
  hinge("j2", base, rocker, {{1, 0, 0}}, {{0, -0.5, 0}});
  hinge("j3", crank, coupler, {{0, 0.5, 0}}, {{-0.5, 0, 0}});
  hinge("j4", rocker, coupler, {{0, 0.5, 0}}, {{0.5, 0, 0}});
  return scene;
}

TEST(BodyPairs, LoopsCloseWithinTheLimits) {
  // Folded, crank and coupler would meet; the limits do not let them.
  const BodyPairs pairs = pairs_of(four_bar(), 500);
  EXPECT_EQ(pairs.coordinates, 3u);
  EXPECT_LT(pairs.skipped, 450u);
  for (const BodyPair& pair : pairs.pairs) {
    EXPECT_FALSE(pair.touches()) << pair.a.str() << " " << pair.b.str();
  }
}

TEST(BodyPairs, ClassesFollowTheShare) {
  const double half = 2 * std::asin(kRadius / kReach);  // the balls touch within it
  EXPECT_EQ(pairs_of(arm_and_post(1 - half / 2, 1 + half / 2, 1), 500).pairs[0].often,
            PairClass::Always);
  EXPECT_EQ(pairs_of(arm_and_post(1 - 1.5 * half, 1 + 1.5 * half, 1), 500).pairs[0].often,
            PairClass::Often);
  const BodyPairs some = pairs_of(arm_and_post(1 - 3 * half, 1 + 3 * half, 1), 2000);
  EXPECT_EQ(some.pairs[0].often, PairClass::Sometimes);
  EXPECT_NEAR(static_cast<double>(some.pairs[0].touching) / 2000, 1.0 / 3, 0.05);
  EXPECT_NEAR(some.pairs[0].depth, 2 * kRadius, 0.002);
  const BodyPairs never = pairs_of(arm_and_post(-1, 0.5, 1), 500);
  ASSERT_EQ(never.pairs.size(), 1u);  // as a joint connects the two
  EXPECT_EQ(never.pairs[0].often, PairClass::Never);
  EXPECT_TRUE(never.pairs[0].adjacent);
  EXPECT_EQ(never.never, 1u);
}

TEST(BodyPairs, ThreadsChangeNothing) {
  const TestScene scene = arm_and_post(-1, 2, 1);
  const BodyPairs one = pairs_of(scene, 333, 1);
  for (const std::size_t threads : {2u, 3u, 7u}) {
    const BodyPairs many = pairs_of(scene, 333, threads);
    ASSERT_EQ(many.pairs.size(), 1u);
    EXPECT_EQ(many.pairs[0].touching, one.pairs[0].touching);
    EXPECT_EQ(many.pairs[0].depth, one.pairs[0].depth);
    EXPECT_EQ(many.pairs[0].posture, one.pairs[0].posture);
  }
}

TEST(BodyPairs, TheStartIsNoDrawnPosture) {
  const BodyPairs pairs = pairs_of(arm_and_post(0.5, 0.6, 0.05), 100);
  ASSERT_EQ(pairs.pairs.size(), 1u);
  EXPECT_NEAR(pairs.pairs[0].start_depth.value_or(0), 0.1 - 2 * kReach * std::sin(0.025), 1e-9);
  EXPECT_EQ(pairs.pairs[0].touching, 0u);
  EXPECT_EQ(pairs.pairs[0].often, PairClass::Never);
  EXPECT_FALSE(pairs.pairs[0].posture.has_value());
}

TEST(BodyPairs, FilteredPairsThatRarelyTouchAreOverFiltered) {
  TestScene scene = arm_and_post(-1, 2, 1);
  scene::keep_pairs_apart(scene, {{0, 1}});
  physics::Provenance provenance;
  provenance.pairs.push_back({0, 1, physics::PairRule::FilteredPair, Path::from("/arm")});
  const BodyPairs pairs = pairs_of(scene, 500, 0, provenance);
  ASSERT_EQ(pairs.pairs.size(), 1u);
  EXPECT_EQ(pairs.pairs[0].filtered, PairFiltered::Yes);
  EXPECT_TRUE(pairs.pairs[0].over_filtered);
  provenance.pairs.push_back({0, 1, physics::PairRule::Joint, Path::from("/turn")});
  EXPECT_FALSE(pairs_of(scene, 500, 0, provenance).pairs[0].over_filtered);
}

}  // namespace
}  // namespace tenon
