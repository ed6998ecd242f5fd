// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Points are rows, so rotation matrices here are the transposes of those for columns. Inversion
// refuses a pivot that is exactly zero or no number; whether a matrix is too close to singular is
// for the caller to say. The quaternion of a rotation is found from a component of at least 1/2: w
// when the trace is positive, else the one of the largest diagonal entry, since the squares add up
// to 1. The division by it is well conditioned for every rotation.
#include "tenon/math/matrix.h"

#include <cmath>
#include <utility>

namespace tenon {
namespace {

/// Gauss-Jordan elimination with partial pivoting.
template <std::size_t N>
Matrix<N> inverse_of(Matrix<N> a, bool* ok) {
  Matrix<N> result = Matrix<N>::identity();
  for (std::size_t column = 0; column < N; ++column) {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < N; ++row) {
      if (std::fabs(a[row][column]) > std::fabs(a[pivot][column])) {
        pivot = row;
      }
    }
    if (!(std::fabs(a[pivot][column]) > 0)) {
      if (ok != nullptr) {
        *ok = false;
      }
      return {};
    }
    std::swap(a[pivot], a[column]);
    std::swap(result[pivot], result[column]);
    const double factor = 1 / a[column][column];
    for (std::size_t k = 0; k < N; ++k) {
      a[column][k] *= factor;
      result[column][k] *= factor;
    }
    for (std::size_t row = 0; row < N; ++row) {
      const double part = a[row][column];
      if (row == column || part == 0) {
        continue;
      }
      for (std::size_t k = 0; k < N; ++k) {
        a[row][k] -= part * a[column][k];
        result[row][k] -= part * result[column][k];
      }
    }
  }
  if (ok != nullptr) {
    *ok = true;
  }
  return result;
}

}  // namespace

double determinant(const Mat3d& a) {
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
         a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

Mat4d inverse(const Mat4d& a, bool* ok) { return inverse_of(a, ok); }
Mat3d inverse(const Mat3d& a, bool* ok) { return inverse_of(a, ok); }

Mat4d translation_matrix(const Vec3d& t) {
  Mat4d result = Mat4d::identity();
  for (std::size_t i = 0; i < 3; ++i) {
    result[3][i] = t[i];
  }
  return result;
}

Mat4d scale_matrix(const Vec3d& s) {
  Mat4d result = Mat4d::identity();
  for (std::size_t i = 0; i < 3; ++i) {
    result[i][i] = s[i];
  }
  return result;
}

Mat3d rotation_matrix(const Quatd& q) {
  const double xx = q.x * q.x;
  const double yy = q.y * q.y;
  const double zz = q.z * q.z;
  Mat3d r;
  r[0] = {1 - 2 * (yy + zz), 2 * (q.x * q.y + q.w * q.z), 2 * (q.x * q.z - q.w * q.y)};
  r[1] = {2 * (q.x * q.y - q.w * q.z), 1 - 2 * (xx + zz), 2 * (q.y * q.z + q.w * q.x)};
  r[2] = {2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x), 1 - 2 * (xx + yy)};
  return r;
}

Quatd rotation_of(const Mat3d& r) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  Quatd q;
  if (trace > 0) {
    const double s = std::sqrt(trace + 1) * 2;
    q = {(r[1][2] - r[2][1]) / s, (r[2][0] - r[0][2]) / s, (r[0][1] - r[1][0]) / s, s / 4};
  } else if (r[0][0] >= r[1][1] && r[0][0] >= r[2][2]) {
    const double s = std::sqrt(1 + r[0][0] - r[1][1] - r[2][2]) * 2;
    q = {s / 4, (r[0][1] + r[1][0]) / s, (r[0][2] + r[2][0]) / s, (r[1][2] - r[2][1]) / s};
  } else if (r[1][1] >= r[2][2]) {
    const double s = std::sqrt(1 + r[1][1] - r[0][0] - r[2][2]) * 2;
    q = {(r[0][1] + r[1][0]) / s, s / 4, (r[1][2] + r[2][1]) / s, (r[2][0] - r[0][2]) / s};
  } else {
    const double s = std::sqrt(1 + r[2][2] - r[0][0] - r[1][1]) * 2;
    q = {(r[0][2] + r[2][0]) / s, (r[1][2] + r[2][1]) / s, s / 4, (r[0][1] - r[1][0]) / s};
  }
  return normalized(q);
}

Mat3d upper_left(const Mat4d& a) {
  Mat3d result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result[i][j] = a[i][j];
    }
  }
  return result;
}

Mat4d to_mat4(const Mat3d& linear, const Vec3d& translation) {
  Mat4d result = translation_matrix(translation);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result[i][j] = linear[i][j];
    }
  }
  return result;
}

Vec3d transform_point(const Vec3d& p, const Mat4d& m) {
  Vec3d result = transform_direction(p, m);
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] += m[3][i];
  }
  return result;
}

Vec3d transform_direction(const Vec3d& d, const Mat4d& m) {
  Vec3d result;
  for (std::size_t j = 0; j < 3; ++j) {
    result[j] = d[0] * m[0][j] + d[1] * m[1][j] + d[2] * m[2][j];
  }
  return result;
}

Vec3d operator*(const Vec3d& p, const Mat3d& m) {
  Vec3d result;
  for (std::size_t j = 0; j < 3; ++j) {
    result[j] = p[0] * m[0][j] + p[1] * m[1][j] + p[2] * m[2][j];
  }
  return result;
}

}  // namespace tenon
