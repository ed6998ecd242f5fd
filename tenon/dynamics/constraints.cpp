// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/dynamics/constraints.h"

#include <algorithm>

namespace tenon::dynamics {
namespace {

/// Adds what the columns above a member do along a row.
void add_columns(const scene::JointTree& tree, std::size_t member, const scene::Screw& impulse,
                 double sign, Eigen::Index row, Eigen::MatrixXd& matrix) {
  const scene::MotionTree& motions = tree.tree();
  for (std::size_t m = member; m != scene::MotionTree::kNone; m = motions.parents[m]) {
    const auto begin = std::lower_bound(motions.members.begin(), motions.members.end(), m);
    for (auto c = begin; c != motions.members.end() && *c == m; ++c) {
      const auto column = static_cast<std::size_t>(c - motions.members.begin());
      matrix(row, static_cast<Eigen::Index>(column)) += sign * dot(impulse, motions.screws[column]);
    }
  }
}

}  // namespace

Eigen::MatrixXd constraint_matrix(const scene::JointTree& tree) {
  const scene::LoopRows& loops = tree.loops();
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(loops.rows.size() + loops.speed_rows.size()),
                            static_cast<Eigen::Index>(tree.tree().members.size()));
  Eigen::Index r = 0;
  for (const scene::LoopRow& row : loops.rows) {
    if (row.member1) {
      add_columns(tree, *row.member1, row.impulse, 1, r, matrix);
    }
    if (row.member0) {
      add_columns(tree, *row.member0, row.impulse, -1, r, matrix);
    }
    ++r;
  }
  for (const scene::SpeedRow& row : loops.speed_rows) {
    matrix(r, static_cast<Eigen::Index>(row.follower)) += 1;
    matrix(r, static_cast<Eigen::Index>(row.leader)) -= row.ratio;
    ++r;
  }
  return matrix;
}

}  // namespace tenon::dynamics
