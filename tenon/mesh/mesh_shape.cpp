// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mesh/mesh_shape.h"

#include <algorithm>

namespace tenon::mesh {

std::vector<Vec3f> face_normals(const PolygonMesh& mesh) {
  std::vector<Vec3f> normals;
  normals.reserve(mesh.face_counts.size());
  const Vec3f* const points = mesh.points.data();
  const std::int32_t* corner = mesh.face_points.data();
  for (const std::int32_t count : mesh.face_counts) {
    const Vec3d first = to_double(points[corner[0]]);
    Vec3d area;
    Vec3d before = to_double(points[corner[1]]) - first;
    for (std::int32_t i = 2; i < count; ++i) {
      const Vec3d next = to_double(points[corner[i]]) - first;
      area = area + cross(before, next);
      before = next;
    }
    const double size = length(area);
    normals.push_back(size > 0 ? to_float(area * (1 / size)) : Vec3f{{0, 0, 1}});
    corner += count;
  }
  return normals;
}

std::array<Vec3f, 2> extent_of(const std::vector<Vec3f>& points) {
  Vec3f low = points.empty() ? Vec3f{} : points.front();
  Vec3f high = low;
  for (const Vec3f& point : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  }
  return {low, high};
}

}  // namespace tenon::mesh
