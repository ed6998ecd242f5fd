// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// With row vectors rotateIJK is R_i(a) R_j(b) R_k(c). Written out, with e = 1 for the cyclic orders
// and -1 for the others,
//   sin b = -e R[i][k],  tan a = e R[j][k] / R[k][k],  tan c = e R[i][j] / R[i][i],
// and where cos b is 0 only a with c = 0 is left: tan a = -e R[k][j] / R[j][j].
#include "tenon/bake/euler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "tenon/math/angle.h"

namespace tenon::bake {
namespace {

constexpr double kStraight = 1e-9;  // cosine of b below which two of the angles are one
constexpr std::string_view kPrefix = "xformOp:rotate";

using Angles = std::array<double, 3>;  // in the order of the op

Angles angles_of(const Mat3d& r, std::size_t i, std::size_t j, std::size_t k) {
  const double e = (i + 1) % 3 == j ? 1 : -1;
  const double b = std::asin(std::clamp(-e * r[i][k], -1.0, 1.0));
  if (std::hypot(r[j][k], r[k][k]) < kStraight) {
    return {std::atan2(-e * r[k][j], r[j][j]), b, 0};
  }
  return {std::atan2(e * r[j][k], r[k][k]), b, std::atan2(e * r[i][j], r[i][i])};
}

/// The same angle, full turns away, nearest to `before`.
double near(double degrees, double before) {
  return degrees + 360 * std::round((before - degrees) / 360);
}

/// The two solutions, the one nearer to `before`.
Vec3d nearest(const Angles& angles, const std::array<std::size_t, 3>& axes, const Vec3d& before) {
  constexpr double kHalf = 180;
  Vec3d best;
  double least = 0;
  for (int other = 0; other < 2; ++other) {
    Vec3d found;
    const double turn = other == 0 ? 0 : kHalf;
    found[axes[0]] = near(angles[0] * kDegreesPerRadian + turn, before[axes[0]]);
    found[axes[1]] =
        near(other == 0 ? angles[1] * kDegreesPerRadian : kHalf - angles[1] * kDegreesPerRadian,
             before[axes[1]]);
    found[axes[2]] = near(angles[2] * kDegreesPerRadian + turn, before[axes[2]]);
    const double distance = length(found - before);
    if (other == 0 || distance < least) {
      best = found;
      least = distance;
    }
  }
  return best;
}

}  // namespace

std::optional<Vec3d> euler_degrees(const Mat3d& rigid, Token op, const Vec3d& before) {
  const std::string_view name = op.view();
  if (!name.starts_with(kPrefix)) {
    return std::nullopt;
  }
  const std::string_view order = name.substr(kPrefix.size());
  const auto axis = [&](std::size_t i) { return static_cast<std::size_t>(order[i] - 'X'); };
  if (order.size() == 1) {
    const std::size_t i = axis(0);
    if (!(std::fabs(rigid[i][i] - 1) < 1e-12)) {
      return std::nullopt;
    }
    const std::size_t j = (i + 1) % 3;
    Vec3d found;
    found[i] = near(std::atan2(rigid[j][(i + 2) % 3], rigid[j][j]) * kDegreesPerRadian, before[i]);
    return found;
  }
  if (order.size() != 3) {
    return std::nullopt;
  }
  const std::array<std::size_t, 3> axes{axis(0), axis(1), axis(2)};
  return nearest(angles_of(rigid, axes[0], axes[1], axes[2]), axes, before);
}

}  // namespace tenon::bake
