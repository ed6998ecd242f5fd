// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/hull_points.h"

#include <cmath>

namespace tenon::engines {

std::vector<Vec3d> ellipsoid_points(const Vec3d& axes, bool with_ends) {
  constexpr int kSpread = 200;  // along a spiral, at equal heights
  std::vector<Vec3d> points;
  const double golden = M_PI * (3 - std::sqrt(5.0));
  for (int i = 0; i < kSpread; ++i) {
    const double z = 1 - 2 * (i + 0.5) / kSpread;
    const double radius = std::sqrt(1 - z * z);
    points.push_back({{axes[0] * radius * std::cos(golden * i),
                       axes[1] * radius * std::sin(golden * i), axes[2] * z}});
  }
  for (std::size_t axis = 0; with_ends && axis < 3; ++axis) {
    Vec3d end;
    end[axis] = axes[axis];
    points.push_back(end);
    points.push_back(-end);
  }
  return points;
}

}  // namespace tenon::engines
