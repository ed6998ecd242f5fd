// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/view/smooth_normals.h"

#include <cmath>
#include <vector>

#include "tenon/view/corner_welder.h"

namespace tenon::view {
namespace {

constexpr double kCrease = 0.766;       // cosine of 40 degrees
constexpr std::size_t kMostFaces = 64;  // around one point, to be looked at in pairs

/// Twice the area of a triangle along its normal.
Vec3d area_normal(const ViewMesh& mesh, std::size_t triangle) {
  const auto corner = [&](std::size_t k) {
    return to_double(mesh.points[mesh.corners[3 * triangle + k]]);
  };
  return cross(corner(1) - corner(0), corner(2) - corner(0));
}

/// The triangles around each point: those of point p are at first[p] to first[p + 1].
struct PointTriangles {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> triangles;
};

PointTriangles triangles_of_points(const ViewMesh& mesh) {
  PointTriangles around;
  around.first.assign(mesh.points.size() + 1, 0);
  for (const std::uint32_t point : mesh.corners) {
    ++around.first[point + 1];
  }
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    around.first[p + 1] += around.first[p];
  }
  around.triangles.resize(mesh.corners.size());
  std::vector<std::uint32_t> next(around.first.begin(), around.first.end() - 1);
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    around.triangles[next[mesh.corners[i]]++] = static_cast<std::uint32_t>(i / 3);
  }
  return around;
}

}  // namespace

void make_smooth_normals(ViewMesh& mesh) {
  std::vector<Vec3d> areas(mesh.triangle_count());
  std::vector<Vec3d> units(mesh.triangle_count());
  for (std::size_t t = 0; t < areas.size(); ++t) {
    areas[t] = area_normal(mesh, t);
    units[t] = normalized(areas[t]);
  }
  const PointTriangles around = triangles_of_points(mesh);
  CornerWelder welder(true, false, false);
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const std::uint32_t point = mesh.corners[i];
    const std::size_t begin = around.first[point];
    const std::size_t end = around.first[point + 1];
    Vec3d sum = areas[i / 3];
    for (std::size_t k = begin; k < end && end - begin <= kMostFaces; ++k) {
      const std::uint32_t other = around.triangles[k];
      if (other != i / 3 && dot(units[i / 3], units[other]) >= kCrease) {
        sum += areas[other];
      }
    }
    // Rounded, so that sums in another order make no other corner.
    Vec3d normal = normalized(sum, {{0, 0, 1}});
    for (double& part : normal.v) {
      part = std::round(part * 1024) / 1024;
    }
    welder.add({point, mesh.points[point], to_float(normalized(normal, {{0, 0, 1}})), {}, {}});
  }
  mesh = welder.take();
}

}  // namespace tenon::view
