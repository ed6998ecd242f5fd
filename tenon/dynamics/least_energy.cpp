// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/dynamics/least_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace tenon::dynamics {
namespace {

constexpr double kRank = 1e-11;      // singular values below are none, relative to the largest
constexpr double kNoEnergy = 1e-13;  // of the largest
constexpr double kNoSpeed = 1e-18;   // squared, of a base of unit size
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

}  // namespace

LeastEnergy::LeastEnergy(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& rows,
                         const std::vector<Eigen::Index>& moving) {
  const auto count = static_cast<Eigen::Index>(moving.size());
  ways_ = Eigen::MatrixXd::Identity(count, count);
  if (rows.rows() > 0) {
    Eigen::FullPivLU<Eigen::MatrixXd> factors;
    factors.setThreshold(kRank);
    factors.compute(rows(Eigen::all, moving));
    // Of a matrix without a kernel Eigen gives one column of zeros.
    ways_ = factors.kernel();
  }
  can_move_ = ways_.rowwise().squaredNorm();
  // Each way at unit energy, so that light and heavy parts are judged alike.
  const Eigen::MatrixXd inertia = mass(moving, moving);
  for (Eigen::Index i = 0; i < ways_.cols(); ++i) {
    const double energy = ways_.col(i).dot(inertia * ways_.col(i));
    ways_.col(i) /= energy > 0 ? std::sqrt(energy) : 1;
  }
  energy_ = ways_.transpose() * inertia * ways_;
  const Eigen::LDLT<Eigen::MatrixXd> factors(energy_);
  const auto pivots = factors.vectorD();
  if (factors.isPositive() && pivots.minCoeff() > kNoEnergy * pivots.maxCoeff()) {
    speeds_ = ways_.cwiseProduct(factors.solve(ways_.transpose()).transpose()).rowwise().sum();
    return;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(energy_);
  const double least = kNoEnergy * std::max(modes.eigenvalues().maxCoeff(), 0.0);
  const Eigen::MatrixXd shapes = ways_ * modes.eigenvectors();
  speeds_ = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    const double value = modes.eigenvalues()[i];
    for (Eigen::Index c = 0; c < count; ++c) {
      const double along = shapes(c, i) * shapes(c, i);
      speeds_[c] += value > least ? along / value : along > kNoSpeed ? kUnbounded : 0;
    }
  }
}

Eigen::VectorXd LeastEnergy::motion(Eigen::Index column) const {
  const Eigen::VectorXd impulse = ways_.row(column).transpose();
  return ways_ * energy_.ldlt().solve(impulse) / speeds_[column];
}

double LeastEnergy::inertia(Eigen::Index column) const {
  return can_move_[column] > kNoSpeed ? 1 / speeds_[column] : kUnbounded;
}

}  // namespace tenon::dynamics
