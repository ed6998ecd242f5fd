// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// meshoptimizer compares the triangles at each point with each other, so a mesh whose triangles
// meet at few points is left as it is.
#include "tenon/approximate/mesh_codec.h"

#include <meshoptimizer.h>

#include "tenon/base/limits/collider_limits.h"
#include "tenon/base/shared_library.h"

namespace tenon::approximate {
namespace {

constexpr float kThinningError = 0.1f;  // of the size of the mesh

using Size = std::size_t;
#if MESHOPTIMIZER_VERSION >= 180
using ThinOut = Size (*)(unsigned*, const unsigned*, Size, const float*, Size, Size, Size, float,
                         unsigned, float*);
#else
using ThinOut = Size (*)(unsigned*, const unsigned*, Size, const float*, Size, Size, Size, float,
                         float*);
#endif

/// The functions that are used, as they are in the library.
struct Codec {
  Size (*encode_vertices)(unsigned char*, Size, const void*, Size, Size) = nullptr;
  Size (*vertices_bound)(Size, Size) = nullptr;
  void (*vertex_version)(int) = nullptr;
  Size (*encode_indices)(unsigned char*, Size, const unsigned*, Size) = nullptr;
  Size (*indices_bound)(Size, Size) = nullptr;
  void (*index_version)(int) = nullptr;
  void (*order_triangles)(unsigned*, const unsigned*, Size, Size) = nullptr;
  Size (*order_points)(unsigned*, const unsigned*, Size, Size) = nullptr;
  ThinOut thin = nullptr;
  bool complete = false;
};

/// Does not compile where the library's function has another type.
template <class Function>
constexpr void check(Function, Function) {}
[[maybe_unused]] constexpr void check_types() {
  constexpr Codec kAll;
  check<decltype(kAll.encode_vertices)>(nullptr, &::meshopt_encodeVertexBuffer);
  check<decltype(kAll.vertices_bound)>(nullptr, &::meshopt_encodeVertexBufferBound);
  check<decltype(kAll.vertex_version)>(nullptr, &::meshopt_encodeVertexVersion);
  check<decltype(kAll.encode_indices)>(nullptr, &::meshopt_encodeIndexBuffer);
  check<decltype(kAll.indices_bound)>(nullptr, &::meshopt_encodeIndexBufferBound);
  check<decltype(kAll.index_version)>(nullptr, &::meshopt_encodeIndexVersion);
  check<decltype(kAll.order_triangles)>(nullptr, &::meshopt_optimizeVertexCacheStrip);
  check<decltype(kAll.order_points)>(nullptr, &::meshopt_optimizeVertexFetchRemap);
  check<decltype(kAll.thin)>(nullptr, &::meshopt_simplify);
}

/// glTF's extension has version 0 of attributes and version 1 of triangles.
const Codec& codec() {
  static const Codec found = [] {
    const SharedLibrary library =
        SharedLibrary::open({own_library(TENON_MESHOPTIMIZER_SONAME), TENON_MESHOPTIMIZER_SONAME});
    Codec all;
    const bool complete = library.find("meshopt_encodeVertexBuffer", all.encode_vertices) &&
                          library.find("meshopt_encodeVertexBufferBound", all.vertices_bound) &&
                          library.find("meshopt_encodeVertexVersion", all.vertex_version) &&
                          library.find("meshopt_encodeIndexBuffer", all.encode_indices) &&
                          library.find("meshopt_encodeIndexBufferBound", all.indices_bound) &&
                          library.find("meshopt_encodeIndexVersion", all.index_version) &&
                          library.find("meshopt_optimizeVertexCacheStrip", all.order_triangles) &&
                          library.find("meshopt_optimizeVertexFetchRemap", all.order_points) &&
                          library.find("meshopt_simplify", all.thin);
    if (complete) {
      all.vertex_version(0);
      all.index_version(1);
    }
    all.complete = complete;
    return all;
  }();
  return found;
}

unsigned char* room(std::string& bytes) { return reinterpret_cast<unsigned char*>(bytes.data()); }

}  // namespace

bool mesh_codec_is_there() { return codec().complete; }

std::optional<std::string> encoded_attributes(std::string_view bytes, std::size_t stride) {
  if (!codec().complete) {
    return std::nullopt;
  }
  const std::size_t count = bytes.size() / stride;
  std::string encoded(codec().vertices_bound(count, stride), '\0');
  encoded.resize(
      codec().encode_vertices(room(encoded), encoded.size(), bytes.data(), count, stride));
  return encoded;
}

std::optional<std::string> encoded_triangles(const std::vector<std::uint32_t>& corners,
                                             std::size_t point_count) {
  if (!codec().complete) {
    return std::nullopt;
  }
  std::string encoded(codec().indices_bound(corners.size(), point_count), '\0');
  encoded.resize(
      codec().encode_indices(room(encoded), encoded.size(), corners.data(), corners.size()));
  return encoded;
}

std::size_t meshoptimizer_work(const std::vector<std::uint32_t>& corners, std::size_t point_count) {
  std::vector<std::size_t> triangles(point_count);
  for (const std::uint32_t corner : corners) {
    ++triangles[corner];
  }
  std::size_t work = 0;
  for (const std::size_t count : triangles) {
    work += count * count;
  }
  return work;
}

std::optional<std::vector<std::uint32_t>> put_in_order(std::vector<std::uint32_t>& corners,
                                                       std::size_t point_count) {
  if (!codec().complete || meshoptimizer_work(corners, point_count) > limits::kMeshOptimizerWork) {
    return std::nullopt;
  }
  std::vector<std::uint32_t> ordered(corners.size());
  codec().order_triangles(ordered.data(), corners.data(), corners.size(), point_count);
  std::vector<std::uint32_t> number(point_count);
  auto next = static_cast<std::uint32_t>(
      codec().order_points(number.data(), ordered.data(), ordered.size(), point_count));
  for (std::uint32_t& one : number) {
    one = one == ~0u ? next++ : one;
  }
  for (std::uint32_t& corner : ordered) {
    corner = number[corner];
  }
  corners = std::move(ordered);
  return number;
}

std::optional<std::vector<std::uint32_t>> thinned_out(const std::vector<std::uint32_t>& corners,
                                                      const std::vector<Vec3f>& points,
                                                      std::size_t wanted) {
  if (!codec().complete ||
      meshoptimizer_work(corners, points.size()) > limits::kMeshOptimizerWork) {
    return std::nullopt;
  }
  static_assert(sizeof(Vec3f) == 3 * sizeof(float));
  std::vector<std::uint32_t> fewer(corners.size());
  const float* first = points.empty() ? nullptr : points[0].v.data();
#if MESHOPTIMIZER_VERSION >= 180
  fewer.resize(codec().thin(fewer.data(), corners.data(), corners.size(), first, points.size(),
                            sizeof(Vec3f), 3 * wanted, kThinningError, 0, nullptr));
#else
  fewer.resize(codec().thin(fewer.data(), corners.data(), corners.size(), first, points.size(),
                            sizeof(Vec3f), 3 * wanted, kThinningError, nullptr));
#endif
  return fewer;
}

}  // namespace tenon::approximate
