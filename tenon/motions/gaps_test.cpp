// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/motions/gaps.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/math/angle.h"

namespace tenon::motions {
namespace {

constexpr std::size_t kFrames = 11;

/// A ball of 2 kg and radius of gyration 0.1 m, and a hinge, over a second.
Setup ball_and_hinge() {
  Setup setup;
  setup.scene.scenes.push_back({{}, {{0, 0, -10}}, {}});
  scene::Body& body = setup.scene.bodies.emplace_back();
  body.path = Path::from("/ball");
  body.mass = 2;
  for (std::size_t i = 0; i < 3; ++i) {
    body.inertia[i][i] = 2 * 0.1 * 0.1 * 2 / 3.0;  // half the trace is the mass by the square
  }
  scene::Joint& joint = setup.scene.joints.emplace_back();
  joint.path = Path::from("/hinge");
  joint.kind = scene::JointKind::Revolute;
  joint.body1 = 0;
  return setup;
}

/// Moves along x with `speed` [m/s], turns about z with `rate` [rad/s], the hinge as well.
Motion moving(double speed, double rate) {
  Motion motion;
  bake::StateRecording& recording = motion.run.recording;
  recording.body_count = 1;
  recording.joint_count = 1;
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double time = 0.1 * static_cast<double>(i);
    recording.times.push_back(time);
    const double half = rate * time / 2;
    recording.bodies.push_back({{{{speed * time, 0, 1}}, {std::cos(half), 0, 0, std::sin(half)}},
                                {{speed, 0, 0}},
                                {{0, 0, rate}}});
    recording.joints.push_back({{rate * time}, {rate}});
  }
  return motion;
}

const Gap* gap_of(const std::vector<Gap>& all, Metric metric) {
  for (const Gap& gap : all) {
    if (gap.metric == metric) {
      return &gap;
    }
  }
  return nullptr;
}

TEST(Gaps, EachMetricHasItsLargestWithItsMoment) {
  const motions::Setup setup = ball_and_hinge();
  const Motion slow = moving(1, 0.5);
  const Motion fast = moving(1.5, 0.75);
  const std::vector<Gap> found = gaps(setup, slow, setup, fast);
  const Gap* position = gap_of(found, Metric::Position);
  ASSERT_NE(position, nullptr);
  EXPECT_NEAR(position->largest, 0.5, 1e-12);
  EXPECT_NEAR(position->mean, 0.25, 1e-12);
  EXPECT_NEAR(position->time, 1, 1e-12);
  EXPECT_EQ(position->object, Path::from("/ball"));
  EXPECT_NEAR(gap_of(found, Metric::Orientation)->largest, 0.25, 1e-12);
  EXPECT_NEAR(gap_of(found, Metric::JointAngle)->largest, 0.25, 1e-12);
  EXPECT_EQ(gap_of(found, Metric::JointTravel), nullptr);
  EXPECT_NEAR(gap_of(found, Metric::Momentum)->largest, 1, 1e-12);
  const double moment = setup.scene.bodies[0].inertia[0][0];
  EXPECT_NEAR(gap_of(found, Metric::Energy)->largest,
              2 * (1.5 * 1.5 - 1) / 2 + moment * (0.75 * 0.75 - 0.5 * 0.5) / 2, 1e-12);
  EXPECT_EQ(gap_of(found, Metric::Contacts), nullptr);  // no engine told them
}

TEST(Gaps, OneMotionIsNotApartFromItself) {
  const motions::Setup setup = ball_and_hinge();
  const Motion motion = moving(1, 0.7);
  for (const Gap& gap : gaps(setup, motion, setup, motion)) {
    EXPECT_EQ(gap.largest, 0) << info_of(gap.metric).name;
  }
  EXPECT_EQ(distance(setup, motion, setup, motion, 1), 0);
}

TEST(Gaps, TheDistanceCountsTurnsAtTheRadiusOfGyration) {
  const motions::Setup setup = ball_and_hinge();
  const Motion still = moving(0, 0);
  EXPECT_NEAR(distance(setup, still, setup, moving(0, 1), 1), 0.1 * 0.5, 1e-12);
  EXPECT_NEAR(distance(setup, still, setup, moving(1, 0), 0.5), 0.25, 1e-12);
  EXPECT_NEAR(moment_of_largest_distance(setup, still, setup, moving(1, 0)), 1, 1e-12);
}

TEST(Gaps, BodiesArePairedByPathAndFramesByTime) {
  const motions::Setup setup = ball_and_hinge();
  motions::Setup other = setup;
  other.scene.bodies[0].path = Path::from("/other");
  const Motion motion = moving(1, 0);
  EXPECT_EQ(gap_of(gaps(setup, motion, other, motion), Metric::Position), nullptr);
  Motion shorter = moving(2, 0);
  shorter.run.recording.times.resize(6);
  EXPECT_NEAR(gap_of(gaps(setup, motion, setup, shorter), Metric::Position)->largest, 0.5, 1e-12);
}

TEST(Gaps, MetricsAreKnownByName) {
  for (const MetricInfo& info : metrics()) {
    EXPECT_EQ(metric_named(info.name), info.metric);
    EXPECT_EQ(&info_of(info.metric), &info);
  }
  EXPECT_FALSE(metric_named("beauty"));
}

}  // namespace
}  // namespace tenon::motions
