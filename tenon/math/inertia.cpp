// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/math/inertia.h"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace tenon {

Mat3d rotate_inertia(const Quatd& q, const Mat3d& inertia) {
  const Mat3d row = rotation_matrix(q);  // transpose of the column-vector rotation
  return transpose(row) * inertia * row;
}

Mat3d shift_inertia(const Mat3d& about_center, double mass, const Vec3d& offset) {
  Mat3d result = about_center;
  const double square = dot(offset, offset);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result[i][j] += mass * ((i == j ? square : 0.0) - offset[i] * offset[j]);
    }
  }
  return result;
}

Mat3d diagonal_matrix(const Vec3d& diagonal) {
  Mat3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i][i] = diagonal[i];
  }
  return result;
}

PrincipalInertia principal_inertia(const Mat3d& inertia) {
  const double size =
      std::fabs(inertia[0][0]) + std::fabs(inertia[1][1]) + std::fabs(inertia[2][2]);
  const double off = std::fabs(inertia[0][1]) + std::fabs(inertia[0][2]) + std::fabs(inertia[1][2]);
  if (off <= 1e-12 * size) {
    return {{{inertia[0][0], inertia[1][1], inertia[2][2]}}, kIdentityRotation};
  }
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      m(i, j) = inertia[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  Eigen::Matrix3d frame = solver.eigenvectors();  // columns are principal axes in the given frame
  if (frame.determinant() < 0) {
    frame.col(2) = -frame.col(2);
  }
  PrincipalInertia result;
  Mat3d rows;  // row-vector matrix = transpose of the column-vector one
  for (int i = 0; i < 3; ++i) {
    result.moments[static_cast<std::size_t>(i)] = solver.eigenvalues()(i);
    for (int j = 0; j < 3; ++j) {
      rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = frame(j, i);
    }
  }
  result.axes = rotation_of(rows);
  return result;
}

}  // namespace tenon
