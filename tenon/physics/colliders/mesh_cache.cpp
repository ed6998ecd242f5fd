// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/colliders/mesh_cache.h"

#include <algorithm>
#include <bit>

namespace tenon::physics {
namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <class Numbers>
bool same_bits(const Numbers& a, const Numbers& b) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b),
                    [](double x, double y) { return same_bits(x, y); });
}

bool same_linear(const Mat3d& a, const Mat3d& b) {
  return same_bits(a[0], b[0]) && same_bits(a[1], b[1]) && same_bits(a[2], b[2]);
}

bool same_turn(const Quatd& a, const Quatd& b) {
  return same_bits(a.w, b.w) && same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

}  // namespace

bool MeshSource::same_arrays(const MeshSource& other) const {
  return points.body() == other.points.body() && counts.body() == other.counts.body() &&
         indices.body() == other.indices.body() && holes.body() == other.holes.body();
}

bool MeshSource::is_same(const MeshSource& other) const {
  return same_arrays(other) && flipped == other.flipped && same_bits(length, other.length) &&
         same_bits(offset.v, other.offset.v) && same_linear(linear, other.linear) &&
         same_turn(turn, other.turn);
}

const TriangleMesh* MeshCache::find(const MeshSource& source) const {
  const auto alike = by_points_.find(source.points.body());
  if (alike == by_points_.end()) {
    return nullptr;
  }
  const auto found = std::find_if(alike->second.begin(), alike->second.end(),
                                  [&](const Known& known) { return known.source.is_same(source); });
  return found == alike->second.end() ? nullptr : &found->mesh;
}

void MeshCache::add(const MeshSource& source, const TriangleMesh& mesh) {
  by_points_[source.points.body()].push_back({source, mesh});
}

}  // namespace tenon::physics
