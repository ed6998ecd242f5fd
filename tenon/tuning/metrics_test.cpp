// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Metrics of signals that are made of their closed forms.
#include "tenon/tuning/metrics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/math/angle.h"
#include "tenon/tuning/gains.h"

namespace tenon::tuning {
namespace {

constexpr double kStep = 0.001;

/// From 2 to 5 at 0.1 s, by the form.
Signal step_of(const Response& response, double seconds) {
  Signal signal;
  for (int i = 0; i * kStep <= seconds; ++i) {
    const double time = i * kStep;
    signal.time.push_back(time);
    signal.command.push_back(time < 0.1 ? 2 : 5);
    signal.position.push_back(time < 0.1 ? 2 : 2 + 3 * step_response(response, time - 0.1));
    signal.velocity.push_back(0);
  }
  return signal;
}

TEST(Metrics, OvershootAndRiseOfTheForm) {
  for (const double ratio : {0.2, 0.5, 0.7, 1.0, 2.0}) {
    const Response response{20, ratio};
    const StepMetrics metrics = step_metrics(step_of(response, 3), 100, 5, scene::kUnlimited);
    EXPECT_NEAR(metrics.overshoot, overshoot_of(ratio), 1e-5) << ratio;
    ASSERT_TRUE(metrics.rise_time.has_value());
    EXPECT_NEAR(*metrics.rise_time, rise_time_of(response), 2e-5) << ratio;
    EXPECT_NEAR(metrics.steady_error, 0, 1e-3);
    EXPECT_EQ(metrics.saturation, 0);
  }
}

// |1 - y| <= 0.02 from omega t = 5.8339 on where the ratio is 1: exp(-x) (1 + x) = 0.02.
TEST(Metrics, SettlingOfTheForm) {
  const StepMetrics metrics = step_metrics(step_of({20, 1}, 3), 100, 5, scene::kUnlimited);
  ASSERT_TRUE(metrics.settling_time.has_value());
  EXPECT_NEAR(*metrics.settling_time, 5.8339 / 20, 1.5 * kStep);
}

TEST(Metrics, DownwardsIsTheSame) {
  Signal signal = step_of({20, 0.4}, 3);
  for (double& position : signal.position) {
    position = -position;
  }
  EXPECT_NEAR(step_metrics(signal, 100, -5, scene::kUnlimited).overshoot, overshoot_of(0.4), 1e-5);
}

TEST(Metrics, WhatNeverGetsThereHasNoTimes) {
  Signal signal = step_of({20, 1}, 3);
  for (double& position : signal.position) {
    position = std::min(position, 3.0);
  }
  const StepMetrics metrics = step_metrics(signal, 100, 5, scene::kUnlimited);
  EXPECT_FALSE(metrics.rise_time.has_value());
  EXPECT_FALSE(metrics.settling_time.has_value());
  EXPECT_NEAR(metrics.steady_error, 2, 1e-12);
}

TEST(Metrics, SineLagGainAndOffset) {
  const double period = 0.8;
  Signal signal;
  for (int i = 1; i <= 3200; ++i) {
    const double time = i * kStep;
    const double phase = 2 * kPi * time / period;
    signal.time.push_back(time);
    signal.command.push_back(1 + 0.5 * std::sin(phase));
    signal.position.push_back(1.1 + 0.4 * std::sin(phase - 0.3));
    signal.velocity.push_back(0.4 * 2 * kPi / period * std::cos(phase - 0.3));
  }
  const SineMetrics metrics = sine_metrics(signal, 800, 0.5, period, scene::kUnlimited);
  EXPECT_NEAR(metrics.gain, 0.8, 1e-6);
  EXPECT_NEAR(metrics.lag, 0.3 * period / (2 * kPi), 1e-6);
  EXPECT_NEAR(metrics.offset, 0.1, 1e-9);
  // Two sines of amplitudes 0.5 and 0.4, 0.3 apart: half of a^2 + b^2 - 2 a b cos.
  const double square = (0.25 + 0.16 - 0.4 * std::cos(0.3)) / 2;
  EXPECT_NEAR(metrics.position_error, std::sqrt(square + 0.01), 1e-6);
  EXPECT_NEAR(metrics.velocity_error, std::sqrt(square) * 2 * kPi / period, 1e-5);
}

TEST(Metrics, StillForSomeTime) {
  Signal signal;
  for (int i = 0; i < 1000; ++i) {
    signal.time.push_back(i * kStep);
    signal.position.push_back(0);
    signal.velocity.push_back(i < 300 || i == 400 ? 0.1 : -0.009);
  }
  const auto since = still_since(signal, 0, signal.size(), {});
  ASSERT_TRUE(since.has_value());
  EXPECT_NEAR(*since, 0.401, 1e-9);
  EXPECT_FALSE(still_since(signal, 0, 600, {}).has_value());
}

TEST(Metrics, SaturationIsAShareOfSamples) {
  Signal signal;
  signal.effort = {1, 2, -2, 0.5};
  EXPECT_DOUBLE_EQ(saturation(signal, 0, 4, 2), 0.5);
  EXPECT_DOUBLE_EQ(saturation(signal, 0, 4, scene::kUnlimited), 0);
}

TEST(Metrics, HoldErrorsAndGaps) {
  Signal first;
  first.time = {0, 1, 2, 3};
  first.position = {0, 1, 2, 3};
  EXPECT_DOUBLE_EQ(hold_error(first, 1, 4, 2).mean, 2.0 / 3);
  EXPECT_DOUBLE_EQ(hold_error(first, 1, 4, 2).most, 1);
  Signal second;
  second.time = {0, 2, 4};
  second.position = {0, 3, 4};
  EXPECT_DOUBLE_EQ(largest_gap(first, second), 1);  // at 2: 2 and 3
}

}  // namespace
}  // namespace tenon::tuning
