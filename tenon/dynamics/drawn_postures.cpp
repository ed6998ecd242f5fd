// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each posture has a sequence of random numbers of its own, which seed and number begin; joints
// take theirs from it in the order of the scene. So postures can be drawn in any order and on any
// thread. Numbers are scaled by hand, as the distributions of the library differ between machines.
// Closing loops moves joints without a look at their limits, which is made up for afterwards.
#include "tenon/dynamics/drawn_postures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tenon/scene/joint_freedom.h"

namespace tenon::dynamics {
namespace {

using scene::Index;
using scene::Joint;

/// SplitMix64 (Steele, Lea and Flood 2014): each call is a number of a sequence that the start
/// alone decides.
class Drawing {
 public:
  Drawing(std::uint64_t seed, std::uint64_t number) : state_(seed) {
    state_ = next() ^ number;
    state_ = next();
  }

  double between(double lower, double upper) {
    const double unit = static_cast<double>(next() >> 11U) * 0x1p-53;
    return lower + (upper - lower) * unit;
  }

 private:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9U;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebU;
    return mixed ^ (mixed >> 31U);
  }
  std::uint64_t state_;
};

/// Where a coordinate is drawn; none: it stays.
std::optional<std::pair<double, double>> range_of(const scene::FreeDof& dof) {
  const bool has_lower = std::isfinite(dof.lower);
  const bool has_upper = std::isfinite(dof.upper);
  if (has_lower && has_upper) {
    return std::pair(dof.lower, dof.upper);
  }
  if (!scene::is_angular(dof.dof)) {
    return std::nullopt;
  }
  if (has_lower) {
    return std::pair(dof.lower, dof.lower + 2 * M_PI);
  }
  return has_upper ? std::pair(dof.upper - 2 * M_PI, dof.upper) : std::pair(-M_PI, M_PI);
}

/// A tilt of the axis by up to `cone`, after a twist about it, as a rotation vector.
Vec3d ball_turn(scene::Axis axis, double cone, Drawing& drawing) {
  const auto along = static_cast<std::size_t>(axis);
  const double way = drawing.between(-M_PI, M_PI);
  const double tilt = drawing.between(0, cone);
  const double twist = drawing.between(-M_PI, M_PI);
  Vec3d across;
  across[(along + 1) % 3] = std::cos(way);
  across[(along + 2) % 3] = std::sin(way);
  return rotation_vector(rotation_about(across, tilt) *
                         rotation_about(scene::unit_axis(axis), twist));
}

constexpr double kOpenLoop = 1e-3;     // [m]
constexpr double kBeyondLimit = 1e-3;  // [rad or m], as closing loops is not exact

/// A rotation is the same after a whole turn.
bool is_within(const scene::FreeDof& dof, double value) {
  const double turn = scene::is_angular(dof.dof) ? 2 * M_PI : 0;
  for (const double shift : {0.0, turn, -turn}) {
    if (value + shift >= dof.lower - kBeyondLimit && value + shift <= dof.upper + kBeyondLimit) {
      return true;
    }
  }
  return false;
}

/// Limits may hold a rotation after a whole turn of it.
double turned_inside(const scene::FreeDof& dof, double value) {
  constexpr double kTurn = 2 * M_PI;
  for (const double shifted : {value, value + kTurn, value - kTurn}) {
    if (is_angular(dof.dof) && shifted >= dof.lower && shifted <= dof.upper) {
      return shifted;
    }
  }
  return dof.lower <= dof.upper ? std::clamp(value, dof.lower, dof.upper) : value;
}

}  // namespace

void keep_in_cone(const scene::Joint& joint, const scene::JointDofs& dofs,
                  std::vector<double>& values) {
  const double cone = scene::circular_cone(joint);
  if (!dofs.ball || !std::isfinite(cone)) {
    return;
  }
  const std::size_t first = dofs.free.size();
  const Vec3d turn{{values[first], values[first + 1], values[first + 2]}};
  const Quatd rotation =
      length(turn) > 0 ? rotation_about(normalized(turn), length(turn)) : kIdentityRotation;
  const Vec3d axis = scene::unit_axis(joint.axis);
  const Vec3d leans = rotate(rotation, axis);
  const Vec3d back = cross(leans, axis);
  const double tilt = std::atan2(length(back), dot(leans, axis));
  if (tilt > cone && length(back) > 0) {
    const Vec3d kept =
        rotation_vector(normalized(rotation_about(normalized(back), tilt - cone) * rotation));
    std::copy(kept.v.begin(), kept.v.end(), values.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

Posture inside_limits(const Multibody& multibody, const Posture& from,
                      const std::vector<bool>& joints) {
  std::vector<std::vector<double>> inside = from.joints;
  for (Index j = 0; j < inside.size(); ++j) {
    const scene::JointDofs& dofs = multibody.dofs()[j];
    for (std::size_t i = 0; joints[j] && i < dofs.free.size(); ++i) {
      inside[j][i] = turned_inside(dofs.free[i], inside[j][i]);
    }
    if (joints[j]) {
      keep_in_cone(multibody.scene().joints[j], dofs, inside[j]);
    }
  }
  return inside == from.joints ? from : multibody.moved(from, std::move(inside));
}

Posture start_inside_limits(const Multibody& multibody) {
  constexpr double kOutside = 1e-6;  // [rad or m]
  const Posture start = multibody.start();
  std::vector<bool> trees;
  for (const scene::ForestRole role : multibody.forest().joints) {
    trees.push_back(role == scene::ForestRole::Tree);
  }
  Posture inside = inside_limits(multibody, start, trees);
  bool beyond = false;
  for (Index j = 0; j < trees.size(); ++j) {
    for (std::size_t i = 0; trees[j] && i < start.joints[j].size(); ++i) {
      beyond = beyond || std::abs(inside.joints[j][i] - start.joints[j][i]) > kOutside;
    }
  }
  return beyond && DrawnPostures(multibody).is_possible(inside) ? inside : start;
}

DrawnPostures::DrawnPostures(const Multibody& multibody)
    : multibody_(&multibody), start_(multibody.start()) {
  for (Index j = 0; j < multibody.scene().joints.size(); ++j) {
    if (multibody.forest().joints[j] == scene::ForestRole::Tree) {
      add_joint(j);
    }
  }
}

void DrawnPostures::add_joint(Index index) {
  const Joint& joint = multibody_->scene().joints[index];
  const scene::JointDofs& dofs = multibody_->dofs()[index];
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    const auto range = range_of(dofs.free[i]);
    if (range && mimic_of(joint, dofs.free[i].dof) == nullptr) {
      ranges_.push_back({index, i, range->first, range->second});
    }
  }
  if (dofs.ball) {
    const double cone = scene::circular_cone(joint);
    balls_.push_back({index, dofs.free.size(), joint.axis, std::clamp(cone, 0.0, M_PI)});
  }
}

std::size_t DrawnPostures::coordinate_count() const { return ranges_.size() + 3 * balls_.size(); }

/// Of a joint of a tree as they are, of another as the bodies have it.
std::vector<double> DrawnPostures::coordinates_of(const Posture& posture, Index index) const {
  if (multibody_->forest().joints[index] == scene::ForestRole::Tree) {
    return posture.joints[index];
  }
  const Joint& joint = multibody_->scene().joints[index];
  const Pose side0 = joint.body0 ? posture.bodies[*joint.body0] : Pose{};
  const Pose side1 = joint.body1 ? posture.bodies[*joint.body1] : Pose{};
  return scene::coordinates_at(multibody_->dofs()[index],
                               inverse(side0 * joint.frame0) * (side1 * joint.frame1));
}

bool DrawnPostures::is_possible(const Posture& posture) const {
  const scene::JointForest& forest = multibody_->forest();
  if (forest.loop_joints.empty()) {
    return true;
  }
  if (multibody_->loop_gap(posture) > kOpenLoop) {
    return false;
  }
  for (Index j = 0; j < forest.joints.size(); ++j) {
    if (forest.joints[j] == scene::ForestRole::None) {
      continue;
    }
    const std::vector<scene::FreeDof>& free = multibody_->dofs()[j].free;
    const std::vector<double> values = coordinates_of(posture, j);
    for (std::size_t i = 0; i < free.size() && i < values.size(); ++i) {
      if (!is_within(free[i], values[i])) {
        return false;
      }
    }
  }
  return true;
}

Posture DrawnPostures::draw(std::uint64_t seed, std::uint64_t number) const {
  Drawing drawing(seed, number);
  std::vector<std::vector<double>> joints = start_.joints;
  for (const Range& range : ranges_) {
    joints[range.joint][range.part] = drawing.between(range.lower, range.upper);
  }
  for (const Ball& ball : balls_) {
    const Vec3d turn = ball_turn(ball.axis, ball.cone, drawing);
    std::copy(turn.v.begin(), turn.v.end(),
              joints[ball.joint].begin() + static_cast<std::ptrdiff_t>(ball.part));
  }
  return multibody_->moved(start_, std::move(joints));
}

}  // namespace tenon::dynamics
