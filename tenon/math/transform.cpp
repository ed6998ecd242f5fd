// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/math/transform.h"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace tenon {
namespace {

bool rows_are_orthogonal(const Mat3d& a) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d x{a[i]};
    const Vec3d y{a[(i + 1) % 3]};
    if (std::fabs(dot(x, y)) > 1e-9 * length(x) * length(y)) {
      return false;
    }
  }
  return true;
}

Mat3d from_eigen(const Eigen::Matrix3d& e) {
  Mat3d result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      result[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = e(i, j);
    }
  }
  return result;
}

/// Rows orthogonal: the scale is along the own axes and no eigenvectors are needed.
void factor_orthogonal(const Mat3d& a, double sign, Factored* result) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d row{a[i]};
    const double size = length(row);
    result->scale[i] = sign * size;
    const Vec3d unit = size > 0 ? row * (sign / size) : Vec3d{};
    result->rotation[i] = unit.v;
  }
}

/// Polar decomposition: A A^T = r S^2 r^T, then u = r S^-1 r^T A.
void factor_general(const Mat3d& a, double sign, Factored* result) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      m(i, j) = a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m * m.transpose());
  Eigen::Vector3d scale = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt() * sign;
  const Eigen::Matrix3d r = solver.eigenvectors();
  Eigen::Vector3d inverse_scale = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) {
    result->scale[static_cast<std::size_t>(i)] = scale(i);
    if (std::fabs(scale(i)) > 1e-10) {
      inverse_scale(i) = 1 / scale(i);
    }
  }
  const Eigen::Matrix3d u = r * inverse_scale.asDiagonal() * r.transpose() * m;
  result->scale_orientation = from_eigen(r);
  result->rotation = from_eigen(u);
  const double spread = scale.cwiseAbs().maxCoeff() - scale.cwiseAbs().minCoeff();
  result->sheared = spread > 1e-6 * scale.cwiseAbs().maxCoeff();
}

}  // namespace

Mat4d pose_matrix(const Pose& pose) {
  return to_mat4(rotation_matrix(pose.orientation), pose.position);
}

Factored factor(const Mat4d& m) {
  Factored result;
  result.translation = {{m[3][0], m[3][1], m[3][2]}};
  const Mat3d a = upper_left(m);
  const double sign = determinant(a) < 0 ? -1 : 1;
  if (rows_are_orthogonal(a)) {
    factor_orthogonal(a, sign, &result);
  } else {
    factor_general(a, sign, &result);
  }
  return result;
}

Pose rigid_part(const Mat4d& m) {
  const Factored parts = factor(m);
  return {parts.translation, rotation_of(parts.rotation)};
}

Vec3d row_scale(const Mat4d& m) {
  Vec3d scale;
  for (std::size_t i = 0; i < 3; ++i) {
    scale[i] = length(Vec3d{{m[i][0], m[i][1], m[i][2]}});
  }
  if (determinant(upper_left(m)) < 0) {
    scale[0] = -scale[0];
  }
  return scale;
}

}  // namespace tenon
