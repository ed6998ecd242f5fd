// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/dynamics/multibody.h"
#include "tenon/math/transform.h"

/// Inverse kinematics: where joints have to be for frames on bodies to be at given places.
namespace tenon::dynamics {

/// Where a frame on a body is to be.
struct ReachTarget {
  Index body = 0;
  Pose frame;                        ///< X_BF
  Vec3d position;                    ///< of the frame's origin, world [m]
  std::optional<Quatd> orientation;  ///< R_WF; none: any
};

struct ReachOptions {
  double distance = 1e-5;   ///< of a frame from its place that counts as reached [m]
  double angle = 1e-4;      ///< the same of its orientation [rad]
  std::size_t starts = 32;  ///< the given posture, then drawn ones; at most limits::kReachStarts
  std::uint64_t seed = 1;   ///< of the drawn ones
  std::vector<bool> held;   ///< (joint_count) joints that stay; empty: none
};

/// How far a frame is from where it is to be.
struct ReachGap {
  double distance = 0;  ///< [m]
  double angle = 0;     ///< [rad]; 0 where any orientation is right
};

/// Why targets were not reached, by what was tried without.
enum class ReachObstacle : std::uint8_t {
  None,
  Limits,     ///< without the limits of the joints they are
  Rotations,  ///< in any orientation they are, within limits
  Together,   ///< each alone is, within limits
  Distance,   ///< none of these is
};

/// One degree of freedom of a joint that is at a bound.
struct AtLimit {
  Index joint = 0;
  scene::Dof dof = scene::Dof::RotX;
  double bound = 0;  ///< [m or rad]
};

struct Reached {
  Posture posture;             ///< the nearest that was found; limits and mimics are kept
  std::vector<ReachGap> gaps;  ///< (target_count)
  bool reached = false;
  std::size_t starts = 0;  ///< that were tried
  ReachObstacle obstacle = ReachObstacle::None;
  std::vector<AtLimit> at_limits;  ///< of the joints that move the frames
};

/// Moves the joints that carry the frames, and no others, from `from` until each frame is where its
/// target says, by damped least squares (Sugihara, Solvability-unconcerned inverse kinematics by
/// the Levenberg-Marquardt method, 2011) within what loops, mimics and limits allow. Roots stay.
/// Where that ends elsewhere, it begins again at drawn postures. The same options give the same
/// answer on every machine. Errors (rule pose.no-reach): Invalid where nothing moves a frame, and
/// for targets on bodies that no joint ties together; Limit beyond limits::kDenseCoordinates.
Result<Reached> reach(const Multibody& multibody, const Posture& from,
                      const std::vector<ReachTarget>& targets, const ReachOptions& options = {});

}  // namespace tenon::dynamics
