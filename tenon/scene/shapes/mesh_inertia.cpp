// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each triangle (a, b, c) spans a tetrahedron with a reference point o. Signed volumes, first and
// second moments of the tetrahedra add up to those of the solid (M-8):
//   v = det(a, b, c) / 6,   first = v (a + b + c) / 4,
//   second_ij = v / 20 (a_i a_j + b_i b_j + c_i c_j + s_i s_j),   s = a + b + c.
// The inertia is I = tr(C) E - C for the second moments C about the centre of mass.
#include "tenon/scene/shapes/mesh_inertia.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace tenon::scene {
namespace {

struct Moments {
  double volume = 0;
  Vec3d first;
  Mat3d second;  // at and above the diagonal
};

void add_tetrahedron(const Vec3d& a, const Vec3d& b, const Vec3d& c, Moments& sum) {
  const double v = dot(a, cross(b, c)) / 6;
  const Vec3d s = a + b + c;
  sum.volume += v;
  sum.first += s * (v / 4);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {  // symmetric
      sum.second[i][j] += v / 20 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + s[i] * s[j]);
    }
  }
}

/// A point near the mesh keeps the sums free of cancellation.
Vec3d middle(const TriangleMesh& mesh) {
  Vec3d low = mesh.points.front();
  Vec3d high = low;
  for (const Vec3d& p : mesh.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  return (low + high) * 0.5;
}

Mat3d inertia_of(const Mat3d& second) {
  const double trace = second[0][0] + second[1][1] + second[2][2];
  Mat3d inertia;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      inertia[i][j] = (i == j ? trace : 0.0) - second[i][j];
    }
  }
  return inertia;
}

}  // namespace

SolidIntegrals mesh_integrals(const TriangleMesh& mesh) {
  SolidIntegrals result;
  if (mesh.points.empty()) {
    return result;
  }
  const Vec3d origin = middle(mesh);
  Moments sum;
  double area_volume = 0;  // scale against which a volume is zero
  for (const Vec3i& t : mesh.triangles) {
    const Vec3d a = mesh.points[static_cast<std::size_t>(t[0])] - origin;
    const Vec3d b = mesh.points[static_cast<std::size_t>(t[1])] - origin;
    const Vec3d c = mesh.points[static_cast<std::size_t>(t[2])] - origin;
    add_tetrahedron(a, b, c, sum);
    area_volume += length(cross(b - a, c - a)) * (length(a) + length(b) + length(c));
  }
  if (std::fabs(sum.volume) <= 1e-12 * area_volume) {
    return result;
  }
  const double sign = sum.volume < 0 ? -1 : 1;  // M-9
  result.volume = sign * sum.volume;
  const Vec3d offset = sum.first * (1 / sum.volume);
  Mat3d second;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      second[i][j] =
          sign * (sum.second[std::min(i, j)][std::max(i, j)] - sum.volume * offset[i] * offset[j]);
    }
  }
  result.center = origin + offset;
  result.inertia = inertia_of(second);
  return result;
}

namespace {

/// Ends of the directed edges that leave each point: those of point p from first[p] to first[p+1],
/// ascending. Empty when an index names no point.
struct DirectedEdges {
  std::vector<std::uint32_t> first;
  std::vector<std::int32_t> ends;

  auto begin_of(std::size_t point) const { return ends.begin() + first[point]; }
  auto end_of(std::size_t point) const { return ends.begin() + first[point + 1]; }
};

DirectedEdges directed_edges(const TriangleMesh& mesh) {
  std::int32_t last = -1;
  for (const Vec3i& t : mesh.triangles) {
    if (std::min({t[0], t[1], t[2]}) < 0) {
      return {};
    }
    last = std::max({last, t[0], t[1], t[2]});
  }
  if (last < 0 || static_cast<std::size_t>(last) >= mesh.points.size()) {
    return {};
  }
  DirectedEdges edges;
  edges.first.assign(static_cast<std::size_t>(last) + 2, 0);
  for (const Vec3i& t : mesh.triangles) {
    for (const std::int32_t corner : t.v) {
      ++edges.first[static_cast<std::size_t>(corner) + 1];
    }
  }
  std::partial_sum(edges.first.begin(), edges.first.end(), edges.first.begin());
  edges.ends.resize(mesh.triangles.size() * 3);
  std::vector<std::uint32_t> next(edges.first.begin(), edges.first.end() - 1);
  for (const Vec3i& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.ends[next[static_cast<std::size_t>(t[i])]++] = t[(i + 1) % 3];
    }
  }
  for (std::size_t p = 0; p + 1 < edges.first.size(); ++p) {
    std::sort(edges.ends.begin() + edges.first[p], edges.ends.begin() + edges.first[p + 1]);
  }
  return edges;
}

}  // namespace

bool is_closed(const TriangleMesh& mesh) {
  if (mesh.triangles.size() >= std::numeric_limits<std::uint32_t>::max() / 3) {
    return false;
  }
  const DirectedEdges edges = directed_edges(mesh);
  if (edges.ends.empty()) {
    return false;
  }
  for (std::size_t p = 0; p + 1 < edges.first.size(); ++p) {
    const auto begin = edges.begin_of(p);
    const auto end = edges.end_of(p);
    if (std::adjacent_find(begin, end) != end) {
      return false;
    }
    for (auto at = begin; at != end; ++at) {
      const auto other = static_cast<std::size_t>(*at);
      if (!std::binary_search(edges.begin_of(other), edges.end_of(other),
                              static_cast<std::int32_t>(p))) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace tenon::scene
