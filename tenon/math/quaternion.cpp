// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/math/quaternion.h"

#include <cmath>

namespace tenon {

Quatd rotation_about(const Vec3d& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {axis[0] * s, axis[1] * s, axis[2] * s, std::cos(angle / 2)};
}

Vec3d rotation_vector(Quatd q) {
  if (q.w < 0) {
    q = {-q.x, -q.y, -q.z, -q.w};
  }
  const Vec3d axis{{q.x, q.y, q.z}};
  const double s = length(axis);
  if (s < 1e-300) {
    return {};
  }
  return axis * (2 * std::atan2(s, q.w) / s);
}

Quatd slerp(const Quatd& a, Quatd b, double t) {
  double cosine = dot(a, b);
  if (cosine < 0) {
    b = {-b.x, -b.y, -b.z, -b.w};
    cosine = -cosine;
  }
  double wa = 1 - t;
  double wb = t;
  if (1 - cosine > 1e-5) {
    const double theta = std::acos(cosine);
    const double sine = std::sin(theta);
    wa = std::sin((1 - t) * theta) / sine;
    wb = std::sin(t * theta) / sine;
  }
  return {wa * a.x + wb * b.x, wa * a.y + wb * b.y, wa * a.z + wb * b.z, wa * a.w + wb * b.w};
}

}  // namespace tenon
