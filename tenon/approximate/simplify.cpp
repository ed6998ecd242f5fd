// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// meshoptimizer is opened when the first mesh asks: it needs the C++ library of the system, which
// takes longer to open than most assets.
#include "tenon/approximate/simplify.h"

#include <cstdint>
#include <string>
#include <vector>

#include <meshoptimizer.h>

#include "tenon/approximate/mesh_codec.h"
#include "tenon/base/limits/collider_limits.h"
#include "tenon/base/shared_library.h"

namespace tenon::approximate {
namespace {

constexpr float kError = 0.01f;  // of the size of the mesh

#if MESHOPTIMIZER_VERSION >= 180
using Simplify = std::size_t (*)(unsigned* fewer, const unsigned* corners, std::size_t corner_count,
                                 const float* points, std::size_t point_count, std::size_t stride,
                                 std::size_t wanted_count, float error, unsigned options,
                                 float* reached_error);
#else
using Simplify = std::size_t (*)(unsigned* fewer, const unsigned* corners, std::size_t corner_count,
                                 const float* points, std::size_t point_count, std::size_t stride,
                                 std::size_t wanted_count, float error, float* reached_error);
#endif
// Does not compile where the library's function has another type.
static_assert(sizeof(static_cast<Simplify>(&::meshopt_simplify)) == sizeof(Simplify));

/// nullptr where there is no such library.
Simplify simplify_function() {
  static const Simplify found = [] {
    const SharedLibrary library =
        SharedLibrary::open({own_library(TENON_MESHOPTIMIZER_SONAME), TENON_MESHOPTIMIZER_SONAME});
    Simplify function = nullptr;
    library.find("meshopt_simplify", function);
    return function;
  }();
  return found;
}

std::size_t simplify(std::vector<unsigned>& fewer, const std::vector<unsigned>& corners,
                     const std::vector<float>& points) {
  const std::size_t stride = 3 * sizeof(float);
#if MESHOPTIMIZER_VERSION >= 180
  return simplify_function()(fewer.data(), corners.data(), corners.size(), points.data(),
                             points.size() / 3, stride, 0, kError, 0, nullptr);
#else
  return simplify_function()(fewer.data(), corners.data(), corners.size(), points.data(),
                             points.size() / 3, stride, 0, kError, nullptr);
#endif
}

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

std::string meshoptimizer_version() {
  if (simplify_function() == nullptr) {
    return "";
  }
  return std::to_string(MESHOPTIMIZER_VERSION / 1000) + "." +
         std::to_string(MESHOPTIMIZER_VERSION % 1000 / 10);
}

std::optional<scene::TriangleMesh> simplified(const scene::TriangleMesh& mesh) {
  if (simplify_function() == nullptr) {
    return std::nullopt;
  }
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
  if (meshoptimizer_work(corners, mesh.points.size()) > limits::kMeshOptimizerWork) {
    return std::nullopt;
  }
  std::vector<unsigned> fewer(corners.size());
  const std::size_t count = simplify(fewer, corners, points);
  fewer.resize(count);
  return count < 3 ? mesh : compact(mesh, fewer);
}

}  // namespace tenon::approximate
