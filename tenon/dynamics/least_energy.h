// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

namespace tenon::dynamics {

/// The motions of some columns within the null space of rows, and what they cost: with N a base of
/// them and E = N^T M N, the least energy at unit speed of a column is 1 / (N E^-1 N^T), of its own
/// row and column. Motions without energy cost nothing.
class LeastEnergy {
 public:
  LeastEnergy(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& rows,
              const std::vector<Eigen::Index>& moving);

  /// The motion that costs least and moves a column at unit speed, by the places in `moving`; not
  /// finite where the column cannot move, or moves without energy.
  Eigen::VectorXd motion(Eigen::Index column) const;
  /// Of a column by its place in `moving`; infinite where it cannot move.
  double inertia(Eigen::Index column) const;

 private:
  Eigen::MatrixXd ways_;
  Eigen::MatrixXd energy_;
  Eigen::VectorXd speeds_;    // that a unit impulse gives
  Eigen::VectorXd can_move_;  // squared share of each column in the ways
};

}  // namespace tenon::dynamics
