// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/sdf/extruded.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tenon::sdf {
namespace {

/// Twice the area of a triangle, positive where it runs counter-clockwise.
double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool is_inside(const Vec2d& p, const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

/// Whether the corner `at` of the remaining ones can be cut off: no other one is in its triangle.
bool is_ear(const std::vector<Vec2d>& corners, const std::vector<int>& left, std::size_t at) {
  const auto corner = [&](std::size_t i) {
    return corners[static_cast<std::size_t>(left[i % left.size()])];
  };
  const std::size_t before = at + left.size() - 1;
  const Vec2d a = corner(before);
  const Vec2d b = corner(at);
  const Vec2d c = corner(at + 1);
  if (!(turn(a, b, c) > 0)) {
    return false;
  }
  for (std::size_t i = at + 2; i < before; ++i) {
    const Vec2d p = corner(i);
    if (p != a && p != b && p != c && is_inside(p, a, b, c)) {
      return false;
    }
  }
  return true;
}

/// By cutting ears; empty where none is left to cut.
std::vector<Vec3i> triangles_of(const std::vector<Vec2d>& corners) {
  std::vector<int> left(corners.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<Vec3i> triangles;
  std::size_t at = 0;
  for (std::size_t tries = 0; left.size() > 3;) {
    if (!is_ear(corners, left, at % left.size())) {
      if (++tries > left.size()) {
        return {};
      }
      ++at;
      continue;
    }
    tries = 0;
    at %= left.size();
    triangles.push_back(
        {{left[(at + left.size() - 1) % left.size()], left[at], left[(at + 1) % left.size()]}});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  triangles.push_back({{left[0], left[1], left[2]}});
  return triangles;
}

}  // namespace

bool add_extruded(std::vector<Vec2d> corners, double height, robot::MeshFile& mesh) {
  if (corners.size() > 1 && corners.front() == corners.back()) {
    corners.pop_back();
  }
  double area = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    area += turn(corners[0], corners[i], corners[i + 1]);
  }
  if (corners.size() < 3 || corners.size() > kExtrudedPoints || !std::isfinite(area) || area == 0 ||
      !std::isfinite(height) || !(height > 0)) {
    return false;
  }
  if (area < 0) {
    std::reverse(corners.begin(), corners.end());
  }
  const std::vector<Vec3i> caps = triangles_of(corners);
  if (caps.empty()) {
    return false;
  }
  const auto first = static_cast<int>(mesh.points.size());
  const auto count = static_cast<int>(corners.size());
  for (const double z : {0.0, height}) {
    for (const Vec2d& corner : corners) {
      mesh.points.push_back(
          {{static_cast<float>(corner[0]), static_cast<float>(corner[1]), static_cast<float>(z)}});
    }
  }
  for (const Vec3i& cap : caps) {
    mesh.triangles.push_back({{first + cap[0], first + cap[2], first + cap[1]}});
    mesh.triangles.push_back(
        {{first + count + cap[0], first + count + cap[1], first + count + cap[2]}});
  }
  for (int i = 0; i < count; ++i) {
    const int a = first + i;
    const int b = first + (i + 1) % count;
    mesh.triangles.push_back({{a, b, b + count}});
    mesh.triangles.push_back({{a, b + count, a + count}});
  }
  return true;
}

}  // namespace tenon::sdf
