// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/motion/joint_motion.h"

#include <algorithm>

namespace tenon::scene {
namespace {

constexpr double kParallel = 1e-9;  // sine of the angle below which an axis adds nothing

Vec3d across(Vec3d axis, const std::vector<Vec3d>& basis) {
  for (int pass = 0; pass < 2; ++pass) {  // twice, for what rounding leaves
    for (const Vec3d& direction : basis) {
      axis -= direction * dot(direction, axis);
    }
  }
  return axis;
}

}  // namespace

JointMotion joint_motion(const JointDofs& dofs, const Pose& frame0, const Pose& frame1) {
  const std::vector<double> coordinates = coordinates_at(dofs, inverse(frame0) * frame1);
  JointMotion result;
  result.point = frame1.position;
  Quatd turned = frame0.orientation;
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    const FreeDof& dof = dofs.free[i];
    if (is_angular(dof.dof)) {
      result.turns.push_back(rotate(turned, dof.axis0));
      turned = turned * rotation_about(dof.axis0, coordinates[i]);
    } else {
      result.slides.push_back(rotate(frame0.orientation, dof.axis0));
    }
  }
  for (int i = 0; dofs.ball && i < 3; ++i) {
    result.turns.push_back(rotate(frame0.orientation, unit_axis(static_cast<Axis>(i))));
  }
  return result;
}

std::vector<Vec3d> directions_across(const std::vector<Vec3d>& axes) {
  std::vector<Vec3d> basis;
  for (const Vec3d& axis : axes) {
    const Vec3d rest = across(axis, basis);
    if (length(rest) > kParallel) {
      basis.push_back(normalized(rest));
    }
  }
  std::vector<Vec3d> result;
  while (basis.size() < 3) {
    Vec3d best;
    for (int i = 0; i < 3; ++i) {
      const Vec3d rest = across(unit_axis(static_cast<Axis>(i)), basis);
      best = length(rest) > length(best) ? rest : best;
    }
    result.push_back(normalized(best));
    basis.push_back(result.back());
  }
  return result;
}

// Normal equations of at most three unknowns, by Cramer's rule over the axes that count.
std::vector<double> shares_of(const std::vector<Vec3d>& axes, const Vec3d& wanted) {
  std::vector<double> result(axes.size(), 0.0);
  Mat3d gram = Mat3d::identity();
  Vec3d right;
  for (std::size_t i = 0; i < std::min<std::size_t>(axes.size(), 3); ++i) {
    for (std::size_t j = 0; j < std::min<std::size_t>(axes.size(), 3); ++j) {
      gram[i][j] = dot(axes[i], axes[j]);
    }
    gram[i][i] += 1e-12;
    right[i] = dot(axes[i], wanted);
  }
  const Vec3d shares = right * inverse(gram);
  for (std::size_t i = 0; i < std::min<std::size_t>(axes.size(), 3); ++i) {
    result[i] = shares[i];
  }
  return result;
}

}  // namespace tenon::scene
