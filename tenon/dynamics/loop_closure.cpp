// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The step is the smallest one in weighted coordinates that ends the violation to first order; a
// joint with a drive is weighted so that it moves only where no other joint can close the loop.
#include "tenon/dynamics/loop_closure.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/dynamics/constraints.h"

namespace tenon::dynamics {
namespace {

constexpr double kClosed = 1e-13;      // [m, rad]
constexpr double kDrivenShare = 1e-4;  // of a coordinate with a drive
constexpr double kLongestStep = 0.5;   // [m, rad]
constexpr double kRankTolerance = 1e-10;

/// Violations of the rows of constraint_matrix.
Eigen::VectorXd violations(const Multibody& multibody, const scene::JointTree& tree,
                           const Posture& posture) {
  const scene::LoopRows& loops = tree.loops();
  Eigen::VectorXd result =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(loops.rows.size() + loops.speed_rows.size()));
  for (std::size_t r = 0; r < loops.rows.size(); ++r) {
    const scene::LoopRow& row = loops.rows[r];
    const scene::Screw apart = frames_apart(multibody, posture, row.joint);
    result[static_cast<Eigen::Index>(r)] = row.impulse.move == Vec3d{}
                                               ? dot(row.impulse.turn, apart.turn)
                                               : dot(row.impulse.move, apart.move);
  }
  return result;
}

void turn_ball(const scene::JointDofs& dofs, const Vec3d& turn, std::vector<double>& joint) {
  const std::size_t first = dofs.free.size();
  const Vec3d before{{joint[first], joint[first + 1], joint[first + 2]}};
  const auto rotation = [](const Vec3d& v) {
    return length(v) > 0 ? rotation_about(normalized(v), length(v)) : kIdentityRotation;
  };
  const Vec3d after = rotation_vector(normalized(rotation(turn) * rotation(before)));
  for (std::size_t i = 0; i < 3; ++i) {
    joint[first + i] = after[i];
  }
}

/// How far each column may move in a step; those of floating bodies do not.
Eigen::VectorXd weights_of(const Multibody& multibody, const scene::JointTree& tree) {
  Eigen::VectorXd weights =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(tree.tree().members.size()));
  for (const auto& [joint, first] : tree.first_columns()) {
    const scene::JointDofs& dofs = multibody.dofs()[joint];
    for (std::size_t i = 0; i < dofs.count(); ++i) {
      const bool driven = i < dofs.free.size()
                              ? is_driven(multibody.scene().joints[joint], dofs.free[i].dof)
                              : false;
      weights[static_cast<Eigen::Index>(first + i)] = driven ? kDrivenShare : 1;
    }
  }
  return weights;
}

}  // namespace

void move_joint(const scene::JointDofs& dofs, const Eigen::VectorXd& step, std::size_t column,
                std::vector<double>& joint) {
  for (std::size_t i = 0; i < dofs.free.size(); ++i) {
    joint[i] += step[static_cast<Eigen::Index>(column + i)];
  }
  if (dofs.ball) {
    const auto first = static_cast<Eigen::Index>(column + dofs.free.size());
    turn_ball(dofs, {{step[first], step[first + 1], step[first + 2]}}, joint);
  }
}

scene::Screw frames_apart(const Multibody& multibody, const Posture& posture, Index joint) {
  const scene::Joint& j = multibody.scene().joints[joint];
  const Pose frame0 = j.body0 ? posture.bodies[*j.body0] * j.frame0 : j.frame0;
  const Pose frame1 = j.body1 ? posture.bodies[*j.body1] * j.frame1 : j.frame1;
  const scene::JointDofs& dofs = multibody.dofs()[joint];
  const Pose allowed =
      frame0 * relative_pose_at(dofs, coordinates_at(dofs, inverse(frame0) * frame1));
  return {rotation_vector(normalized(frame1.orientation * conjugate(allowed.orientation))),
          frame1.position - allowed.position};
}

bool loop_step(const Multibody& multibody, const scene::JointGroup& group, Posture& posture) {
  const scene::JointTree tree(multibody.scene(), multibody.forest(), multibody.dofs(),
                              posture.bodies, group, {0, 0, scene::TiedMimics::All});
  if (tree.tree().members.size() > limits::kDenseCoordinates) {
    return false;
  }
  const Eigen::VectorXd apart = violations(multibody, tree, posture);
  const std::size_t columns = tree.tree().members.size();
  if (!(apart.lpNorm<Eigen::Infinity>() > kClosed) ||
      static_cast<std::size_t>(apart.size()) * columns * columns > limits::kLoopWork) {
    return false;
  }
  const Eigen::VectorXd weights = weights_of(multibody, tree);
  const Eigen::MatrixXd weighted = constraint_matrix(tree) * weights.asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors;
  factors.setThreshold(kRankTolerance);
  factors.compute(weighted);
  Eigen::VectorXd step = weights.asDiagonal() * factors.solve(-apart).eval();
  const double longest = step.lpNorm<Eigen::Infinity>();
  if (!std::isfinite(longest) || !(longest > kClosed)) {
    return false;
  }
  step *= std::min(1.0, kLongestStep / longest);
  for (const auto& [joint, first] : tree.first_columns()) {
    move_joint(multibody.dofs()[joint], step, first, posture.joints[joint]);
  }
  return true;
}

}  // namespace tenon::dynamics
