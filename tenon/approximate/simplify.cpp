// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/approximate/simplify.h"

#include <cstdint>
#include <vector>

#include <meshoptimizer.h>

namespace tenon::approximate {
namespace {

constexpr float kError = 0.01f;  // of the size of the mesh

/// Drops points that no triangle uses.
scene::TriangleMesh compact(const scene::TriangleMesh& mesh, const std::vector<unsigned>& corners) {
  constexpr std::int32_t kUnused = -1;
  std::vector<std::int32_t> place(mesh.points.size(), kUnused);
  scene::TriangleMesh result;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    Vec3i& t = result.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& at = place[corners[i + k]];
      if (at == kUnused) {
        at = static_cast<std::int32_t>(result.points.size());
        result.points.push_back(mesh.points[corners[i + k]]);
      }
      t[k] = at;
    }
  }
  return result;
}

}  // namespace

scene::TriangleMesh simplified(const scene::TriangleMesh& mesh) {
  std::vector<float> points;
  std::vector<unsigned> corners;
  for (const Vec3d& p : mesh.points) {
    for (const double x : p.v) {
      points.push_back(static_cast<float>(x));
    }
  }
  for (const Vec3i& t : mesh.triangles) {
    for (const std::int32_t i : t.v) {
      corners.push_back(static_cast<unsigned>(i));
    }
  }
  std::vector<unsigned> fewer(corners.size());
  const std::size_t count =
      meshopt_simplify(fewer.data(), corners.data(), corners.size(), points.data(),
                       mesh.points.size(), 3 * sizeof(float), 0, kError);
  fewer.resize(count);
  return count < 3 ? mesh : compact(mesh, fewer);
}

}  // namespace tenon::approximate
