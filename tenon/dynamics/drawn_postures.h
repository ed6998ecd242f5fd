// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tenon/dynamics/multibody.h"

namespace tenon::dynamics {

/// Tilts the axis of a ball back into its cone; `values` are the coordinates of the joint.
void keep_in_cone(const scene::Joint& joint, const scene::JointDofs& dofs,
                  std::vector<double>& values);

/// `from` with the coordinates of these joints (joint_count) put inside their limits: by a whole
/// turn where that is enough, else to the nearer bound, and balls back into their cones. Followers
/// and loops go along as in Multibody::moved, without a look at their limits.
Posture inside_limits(const Multibody& multibody, const Posture& from,
                      const std::vector<bool>& joints);

/// The start, with joints of trees that are outside of their limits by more than 1e-6 rad or m put
/// inside, as engines push them; the start itself where loops do not close there.
Posture start_inside_limits(const Multibody& multibody);

/// Postures of the trees of a scene, drawn within the limits of its joints. Each number of a seed
/// is a posture of its own, whichever others are drawn, on every machine.
///
/// A coordinate is uniform between its bounds; a rotation without them goes once around, one with a
/// single bound once around from there. A ball is uniform in the angle of its tilt, as far as its
/// cone lets it, and in its twist. Slides that a bound lacks, floating bodies, and joints that
/// follow others by a mimic are not drawn.
class DrawnPostures {
 public:
  /// `multibody` must outlive it.
  explicit DrawnPostures(const Multibody& multibody);

  const Posture& start() const { return start_; }
  /// Coordinates that are drawn, a ball's three among them.
  std::size_t coordinate_count() const;
  /// Loops are closed as far as they can be (Multibody::loop_gap).
  Posture draw(std::uint64_t seed, std::uint64_t number) const;
  /// Loops are closed, within the limits of all joints: what closes them moves joints without a
  /// look at these.
  bool is_possible(const Posture& posture) const;

 private:
  struct Range {
    scene::Index joint = 0;
    std::size_t part = 0;  // of Posture::joints
    double lower = 0;      // [m or rad]
    double upper = 0;
  };
  struct Ball {
    scene::Index joint = 0;
    std::size_t part = 0;  // the first of three
    scene::Axis axis = scene::Axis::X;
    double cone = 0;  // [rad]
  };
  void add_joint(scene::Index joint);
  std::vector<double> coordinates_of(const Posture& posture, scene::Index joint) const;

  const Multibody* multibody_;
  Posture start_;
  std::vector<Range> ranges_;
  std::vector<Ball> balls_;
};

}  // namespace tenon::dynamics
