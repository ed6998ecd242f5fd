// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/dynamics/reach.h"

/// Internal to reach.cpp: one search from one posture.
namespace tenon::dynamics {

enum class KeepLimits : std::uint8_t { Yes, No };

/// What all searches for the same targets share.
struct ReachTask {
  const Multibody* multibody = nullptr;
  std::vector<ReachTarget> targets;  ///< on bodies of one group
  std::vector<bool> moves;           ///< (joint_count) joints that may move
  double distance = 0;               ///< as in ReachOptions
  double angle = 0;
  double length = 1;  ///< an error by this much [m] weighs as much as one by a radian
  KeepLimits limits = KeepLimits::Yes;
};

/// What one search came to.
struct ReachRun {
  Posture posture;
  std::vector<ReachGap> gaps;
  double error = 0;  ///< weighted sum of squares; infinite where limits or loops are not kept
  bool reached = false;
};

/// The joints that move the frames: those on their way to the root, and what mimics and loops tie
/// to these; held ones, and followers that they hold, are among them. (joint_count)
std::vector<bool> joints_of_frames(const Multibody& multibody, const Posture& posture,
                                   const std::vector<ReachTarget>& targets);
std::vector<ReachGap> gaps_of(const Posture& posture, const std::vector<ReachTarget>& targets);
/// Free coordinates of the joints that are at a bound, to 1e-6.
std::vector<AtLimit> at_limits(const Multibody& multibody, const Posture& posture,
                               const std::vector<bool>& joints);
/// From `from`, whose coordinates are put inside their limits first.
ReachRun reach_from(const ReachTask& task, const Posture& from);

}  // namespace tenon::dynamics
