// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/pairs/overlaps_at.h"

#include <gtest/gtest.h>

#include "tenon/engines/test_scene.h"
#include "tenon/scene/filter_sets.h"

namespace tenon {
namespace {

using engines::TestScene;

constexpr double kBall = 0.1;

/// Two balls that may touch, and the postures in which they are `apart` [m].
std::vector<std::vector<Pose>> postures_apart(const std::vector<double>& apart) {
  std::vector<std::vector<Pose>> postures;
  for (const double distance : apart) {
    postures.push_back({Pose{}, Pose{{{distance, 0, 0}}}});
  }
  return postures;
}

TestScene two_balls() {
  TestScene scene;
  scene.add_collider("one/ball", scene.add_body("one", {{0, 0, 0}}), engines::sphere(kBall));
  scene.add_collider("two/ball", scene.add_body("two", {{1, 0, 0}}), engines::sphere(kBall));
  return scene;
}

TEST(OverlapsAt, TellsPostureAndDepthOfBallsThatMayTouch) {
  Diagnostics diagnostics;
  const auto found = overlaps_at(two_balls(), postures_apart({1, 0.15, 0.3, 0.19}), diagnostics);
  ASSERT_TRUE(found.has_value()) << found.error().to_string();
  ASSERT_EQ(found->size(), 2u);
  EXPECT_EQ((*found)[0].posture, 1u);
  EXPECT_NEAR((*found)[0].depth, 0.05, 1e-6);
  EXPECT_EQ((*found)[1].posture, 3u);
  EXPECT_NEAR((*found)[1].depth, 0.01, 1e-6);
}

TEST(OverlapsAt, WhatAFilterKeepsApartIsNoOverlap) {
  TestScene scene = two_balls();
  scene::keep_pairs_apart(scene, {{0, 1}});
  Diagnostics diagnostics;
  const auto found = overlaps_at(scene, postures_apart({0.1}), diagnostics);
  ASSERT_TRUE(found.has_value());
  EXPECT_TRUE(found->empty());
}

TEST(OverlapsAt, APostureOfAnotherSceneIsRefused) {
  Diagnostics diagnostics;
  const auto found = overlaps_at(two_balls(), {{Pose{}}}, diagnostics);
  ASSERT_FALSE(found.has_value());
  EXPECT_EQ(found.error().diagnostic().rule, "pairs.bodies");
}

}  // namespace
}  // namespace tenon
