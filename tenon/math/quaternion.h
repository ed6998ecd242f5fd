// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/math/functions.h"
#include "tenon/math/half.h"
#include "tenon/math/vector.h"

namespace tenon {

/// Memory order is i, j, k, real, as binary layers store it; text writes real first.
template <class T>
struct Quat {
  T x{};
  T y{};
  T z{};
  T w{};

  bool operator==(const Quat&) const = default;
};

using Quatd = Quat<double>;
using Quatf = Quat<float>;
using Quath = Quat<Half>;

inline constexpr Quatd kIdentityRotation{0, 0, 0, 1};

template <class T>
Quatd to_double(const Quat<T>& q) {
  return {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z),
          static_cast<double>(q.w)};
}

inline Quatf to_float(const Quatd& q) {
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
          static_cast<float>(q.w)};
}

/// Hamilton product: rotate by b first, then by a.
inline Quatd operator*(const Quatd& a, const Quatd& b) {
  return {
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

inline Quatd conjugate(const Quatd& q) { return {-q.x, -q.y, -q.z, q.w}; }

inline double dot(const Quatd& a, const Quatd& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

/// Unit quaternion; the identity for a zero or non-finite one.
inline Quatd normalized(const Quatd& q) {
  const double norm = square_root(dot(q, q));
  if (!(norm > 0) || !is_finite(norm)) {
    return kIdentityRotation;
  }
  return {q.x / norm, q.y / norm, q.z / norm, q.w / norm};
}

/// Rotates `p` by the unit quaternion `q`.
inline Vec3d rotate(const Quatd& q, const Vec3d& p) {
  const Vec3d axis{{q.x, q.y, q.z}};
  const Vec3d t = 2.0 * cross(axis, p);
  return p + q.w * t + cross(axis, t);
}

/// Rotation by `angle` radians about the unit vector `axis`.
Quatd rotation_about(const Vec3d& axis, double angle);

/// Shortest rotation vector of a unit quaternion: unit axis times angle in radians.
Vec3d rotation_vector(Quatd q);

/// Spherical interpolation along the shorter way:
/// the sign of b is chosen so that the angle is at most pi.
Quatd slerp(const Quatd& a, Quatd b, double t);

}  // namespace tenon
