// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Closed forms of single coordinates: what a drive has to move is known by hand.
#include "tenon/tuning/gains.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/math/angle.h"
#include "tenon/tuning/test_tuning.h"

namespace tenon::tuning {
namespace {

using scene::Axis;
using scene::Dof;
using scene::JointKind;

std::vector<DriveRow> rows_in(const scene::PhysicsScene& scene) {
  const dynamics::Multibody multibody(scene);
  return drive_rows(multibody, dynamics::Dynamics(multibody, multibody.start()));
}

TEST(Gains, ResponseAndBack) {
  const Load load{2.5, false, {}};
  for (const double frequency : {0.5, 10.0, 300.0}) {
    for (const double ratio : {0.0, 0.3, 1.0, 4.0}) {
      const WantedGains wanted = gains_for({frequency, ratio}, load);
      EXPECT_NEAR(wanted.gains.stiffness, 2.5 * frequency * frequency,
                  1e-9 * frequency * frequency);
      EXPECT_NEAR(wanted.gains.damping, 2 * ratio * 2.5 * frequency, 1e-9 * frequency);
      const Response back = response_of(wanted.gains, load);
      EXPECT_NEAR(back.frequency, frequency, 1e-12 * frequency);
      EXPECT_NEAR(back.ratio, ratio, 1e-12);
      EXPECT_FALSE(wanted.stiffness_is_least || wanted.damping_is_least);
    }
  }
}

TEST(Gains, TheJointsOwnSpringAndDamperAreTakenOff) {
  const Load load{2, false, {8, 1}};
  const WantedGains wanted = gains_for({10, 0.5}, load);
  EXPECT_DOUBLE_EQ(wanted.gains.stiffness, 200 - 8);
  EXPECT_DOUBLE_EQ(wanted.gains.damping, 20 - 1);
  EXPECT_NEAR(response_of(wanted.gains, load).frequency, 10, 1e-12);
  EXPECT_NEAR(response_of(wanted.gains, load).ratio, 0.5, 1e-12);
  const WantedGains least = gains_for({1, 0.1}, load);
  EXPECT_TRUE(least.stiffness_is_least && least.damping_is_least);
  EXPECT_DOUBLE_EQ(least.gains.stiffness, 0);
  EXPECT_DOUBLE_EQ(least.gains.damping, 0);
}

TEST(Gains, OfAccelerationDrivesTheInertiaDividesOnlyWhatIsTheJoints) {
  const Load load{4, true, {0, 8}};
  const WantedGains wanted = gains_for({10, 1}, load);
  EXPECT_DOUBLE_EQ(wanted.gains.stiffness, 100);
  EXPECT_DOUBLE_EQ(wanted.gains.damping, 20 - 2);
}

TEST(Gains, RegimesByRatio) {
  EXPECT_EQ(regime_of(0.99), Regime::Underdamped);
  EXPECT_EQ(regime_of(1.0005), Regime::Critical);
  EXPECT_EQ(regime_of(1.01), Regime::Overdamped);
}

// The derivative of the form is 0 at its first peak, pi / (omega sqrt(1 - zeta^2)).
TEST(Gains, OvershootIsThePeakOfTheForm) {
  for (const double ratio : {0.1, 0.3, 0.7, 0.95}) {
    const double peak = kPi / (7 * std::sqrt(1 - ratio * ratio));
    EXPECT_NEAR(step_response({7, ratio}, peak) - 1, overshoot_of(ratio), 1e-12);
  }
  EXPECT_EQ(overshoot_of(1), 0);
}

TEST(Gains, TheFormSolvesItsEquation) {
  for (const double ratio : {0.0, 0.4, 1.0, 3.0}) {
    const Response response{5, ratio};
    const double h = 1e-4;
    for (const double t : {0.05, 0.3, 1.0}) {
      const double before = step_response(response, t - h);
      const double now = step_response(response, t);
      const double after = step_response(response, t + h);
      const double acceleration = (after - 2 * now + before) / (h * h);
      const double velocity = (after - before) / (2 * h);
      EXPECT_NEAR(acceleration + 2 * ratio * 5 * velocity + 25 * (now - 1), 0, 1e-4);
    }
  }
}

// exp(-omega t) (1 + omega t) = 0.9 and 0.1: omega t = 0.531812 and 3.889720.
TEST(Gains, CriticalRiseTime) { EXPECT_NEAR(rise_time_of({10, 1}), 0.3357908, 1e-6); }

// |H(i omega_b)| = 1 / sqrt(2).
TEST(Gains, BandwidthIsWhereTheAmplitudeFalls) {
  for (const double ratio : {0.2, 0.7071067811865476, 1.5}) {
    const double omega = bandwidth_of({3, ratio});
    const double gain = 9 / std::hypot(9 - omega * omega, 2 * ratio * 3 * omega);
    EXPECT_NEAR(gain, 1 / std::sqrt(2), 1e-9);
  }
}

/// The largest growth of a state by one step of each method.
double growth(Stepping stepping, double ratio, double coarse) {
  const double a = 2 * ratio * coarse;
  const double b = coarse * coarse;
  const double one = stepping == Stepping::Explicit ? 1 - a : 1 / (1 + a);
  const double trace = stepping == Stepping::Explicit ? 2 - a - b : 1 + (1 - b) / (1 + a);
  const double root = trace * trace / 4 - one;
  return root < 0 ? std::sqrt(one) : std::fabs(trace) / 2 + std::sqrt(root);
}

TEST(Gains, StepsAreStableUpToTheBound) {
  for (const Stepping stepping : {Stepping::Explicit, Stepping::ImplicitDamper}) {
    for (const double ratio : {0.05, 0.5, 1.0, 4.0}) {
      const double bound = stiffest_stable(stepping, ratio, 1);
      EXPECT_LE(growth(stepping, ratio, 0.999 * bound), 1) << ratio;
      EXPECT_GT(growth(stepping, ratio, 1.001 * bound), 1) << ratio;
    }
  }
  EXPECT_FALSE(std::isfinite(stiffest_stable(Stepping::Implicit, 0.1, 1e-3)));
  EXPECT_NEAR(stiffest_stable(Stepping::RungeKutta4, 0, 1), 2 * std::sqrt(2), 2e-3);
}

TEST(Gains, CoarseStepsAreNamed) {
  EXPECT_EQ(sampling_note(100, 0.002), "");
  EXPECT_EQ(sampling_note(300, 0.002),
            "under-sampled: omega*dt = 0.6 > 0.5 (the response will be slower than the form)");
}

TEST(DriveRows, RotorAboutAFixedAxis) {
  scene::PhysicsScene scene = weightless();
  const Index rotor = add_body(scene, 2, {{0.1, 0.5, 0.1}}, {{0, 0, 3}});
  add_drive(add_joint(scene, JointKind::Revolute, Axis::Y, std::nullopt, rotor), 50, 10);
  const auto rows = rows_in(scene);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].why_not, "");
  EXPECT_NEAR(rows[0].load.inertia, 0.5, 1e-12);
  EXPECT_NEAR(rows[0].response->frequency, 10, 1e-12);
  EXPECT_NEAR(rows[0].response->ratio, 1, 1e-12);
}

TEST(DriveRows, ArmatureCounts) {
  scene::PhysicsScene scene = weightless();
  const Index mass = add_body(scene, 2, {{1, 1, 1}}, {});
  scene::Joint& slider = add_joint(scene, JointKind::Prismatic, Axis::X, std::nullopt, mass);
  slider.armature = 6;
  add_drive(slider, 8, 0);
  EXPECT_NEAR(rows_in(scene)[0].load.inertia, 8, 1e-12);
  EXPECT_NEAR(rows_in(scene)[0].response->frequency, 1, 1e-12);
}

TEST(DriveRows, TwoBodiesThatFloat) {
  scene::PhysicsScene scene = weightless();
  const Index first = add_body(scene, 2, {{1, 1, 1}}, {});
  const Index second = add_body(scene, 3, {{1, 1, 1}}, {{1, 0, 0}});
  add_drive(add_joint(scene, JointKind::Prismatic, Axis::X, first, second), 1, 0);
  EXPECT_NEAR(rows_in(scene)[0].load.inertia, 2.0 * 3.0 / 5.0, 1e-12);
}

// Of a mimic chain the square of each ratio to the leader counts, of passive dampers as of masses.
TEST(DriveRows, MimicChain) {
  scene::PhysicsScene scene = weightless();
  for (int i = 0; i < 3; ++i) {
    const Index wheel = add_body(scene, 1, {{0.5, 0.5, 0.5}}, {{0.5 * i, 0, 0}});
    add_joint(scene, JointKind::Revolute, Axis::Y, std::nullopt, wheel).damping = 0.1;
  }
  add_drive(scene.joints[0], 4, 0);
  for (const auto& [follower, leader, ratio] :
       {std::tuple<Index, Index, double>{1, 0, 0.5}, {2, 1, -4}}) {
    scene::Mimic mimic;
    mimic.dof = mimic.leader_dof = Dof::RotY;
    mimic.leader = leader;
    mimic.multiplier = ratio;
    scene.joints[follower].mimics.push_back(mimic);
  }
  const auto rows = rows_in(scene);
  ASSERT_EQ(rows.size(), 3u);
  const double squares = 1 + 0.25 + 4;
  EXPECT_NEAR(rows[0].load.inertia, 0.5 * squares, 1e-9);
  EXPECT_NEAR(rows[0].load.passive.damping, 0.1 * squares, 1e-12);
  EXPECT_EQ(rows[1].why_not, "it follows joint0 (mimic)");
  EXPECT_EQ(rows[2].why_not, "it follows joint1 (mimic)");
}

TEST(DriveRows, WhatCannotBeTunedSaysWhy) {
  scene::PhysicsScene scene = weightless();
  for (int i = 0; i < 4; ++i) {
    const Index wheel = add_body(scene, 1, {{0.5, 0.5, 0.5}}, {{0.5 * i, 0, 0}});
    add_joint(scene, JointKind::Revolute, Axis::Y, std::nullopt, wheel);
  }
  add_drive(scene.joints[0], 4, 0);
  scene.joints[0].lower = 1;
  scene.joints[0].upper = -1;
  add_drive(scene.joints[1], 4, 0);
  scene.joints[1].drives[0].max_force = 0;
  add_drive(scene.joints[3], 0, 2);
  const auto rows = rows_in(scene);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].why_not, "the joint is locked");
  EXPECT_EQ(rows[1].why_not, "its maxForce is 0");
  EXPECT_EQ(rows[2].why_not, "no drive");
  EXPECT_EQ(rows[3].why_not, "");
  EXPECT_TRUE(rows[3].velocity_drive);
  EXPECT_FALSE(rows[3].response.has_value());
  EXPECT_FALSE(rows[3].position_drive());
}

}  // namespace
}  // namespace tenon::tuning
