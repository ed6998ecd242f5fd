// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "tenon/math/quaternion.h"
#include "tenon/math/vector.h"

namespace tenon {

/// Rows by columns as USD writes them. Points are rows: p' = p M, so M of "first A, then B" is A B.
template <std::size_t N>
struct Matrix {
  std::array<std::array<double, N>, N> m{};

  constexpr std::array<double, N>& operator[](std::size_t row) { return m[row]; }
  constexpr const std::array<double, N>& operator[](std::size_t row) const { return m[row]; }
  constexpr bool operator==(const Matrix&) const = default;

  static constexpr Matrix identity() {
    Matrix result;
    for (std::size_t i = 0; i < N; ++i) {
      result.m[i][i] = 1;
    }
    return result;
  }

  friend constexpr Matrix operator*(const Matrix& a, const Matrix& b) {
    Matrix result;
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < N; ++k) {
          sum += a.m[i][k] * b.m[k][j];
        }
        result.m[i][j] = sum;
      }
    }
    return result;
  }
};

using Mat2d = Matrix<2>;
using Mat3d = Matrix<3>;
using Mat4d = Matrix<4>;

template <std::size_t N>
constexpr Matrix<N> transpose(const Matrix<N>& a) {
  Matrix<N> result;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      result[i][j] = a[j][i];
    }
  }
  return result;
}

double determinant(const Mat3d& a);
/// Inverse; the zero matrix times 1/tiny is avoided: a singular input gives `*ok = false` and a
/// matrix of zeros.
Mat4d inverse(const Mat4d& a, bool* ok = nullptr);
Mat3d inverse(const Mat3d& a, bool* ok = nullptr);

Mat4d translation_matrix(const Vec3d& t);
Mat4d scale_matrix(const Vec3d& s);
/// Row-vector rotation matrix of a unit quaternion.
Mat3d rotation_matrix(const Quatd& q);
/// Unit quaternion of a proper row-vector rotation matrix.
Quatd rotation_of(const Mat3d& rotation);

Mat3d upper_left(const Mat4d& a);
Mat4d to_mat4(const Mat3d& linear, const Vec3d& translation = {});

/// p M with the homogeneous 1 appended (affine part only).
Vec3d transform_point(const Vec3d& p, const Mat4d& m);
/// d M without translation.
Vec3d transform_direction(const Vec3d& d, const Mat4d& m);
Vec3d operator*(const Vec3d& p, const Mat3d& m);

}  // namespace tenon
