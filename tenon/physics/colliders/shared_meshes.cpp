// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/colliders/shared_meshes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/scene/shapes/shape_mass.h"

namespace tenon::physics {
namespace {

constexpr double kSameMesh = 1e-12;  // of the largest number of the matrix

double largest(const Vec3d& v) {
  return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])});
}

double largest(const Vec3d (&rows)[3]) {
  return std::max({largest(rows[0]), largest(rows[1]), largest(rows[2])});
}

std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  return (hash ^ word) * 0x9E3779B97F4A7C15u + (hash >> 29);
}

}  // namespace

SharedMeshes::Known SharedMeshes::known_of(const MeshSource& source) {
  Known known{source, {}, rotate(source.turn, source.offset), 0};
  for (std::size_t row = 0; row < 3; ++row) {
    known.rows[row] = rotate(source.turn, Vec3d{source.linear[row]});
  }
  return known;
}

bool SharedMeshes::is_same(const Known& a, const Known& b) {
  const MeshSource& x = a.source;
  const MeshSource& y = b.source;
  const double size = largest(a.rows);
  const auto near = [](const Vec3d& v, const Vec3d& w, double scale) {
    return largest(v - w) <= kSameMesh * scale;
  };
  return x.same_arrays(y) && x.flipped == y.flipped && x.length == y.length &&
         near(a.rows[0], b.rows[0], size) && near(a.rows[1], b.rows[1], size) &&
         near(a.rows[2], b.rows[2], size) && near(a.offset, b.offset, size + largest(a.offset));
}

/// Of rounded numbers: where two that are the same fall on different sides of a step they are only
/// not shared.
std::uint64_t SharedMeshes::key_of(const Known& known) {
  const double size = largest(known.rows);
  auto key = mixed(0, reinterpret_cast<std::uintptr_t>(known.source.points.body()));
  if (!(size > 0 && std::isfinite(size))) {
    return key;
  }
  for (const Vec3d& row : known.rows) {
    for (const double x : row.v) {
      key = mixed(key, static_cast<std::uint64_t>(std::llround(x / size * 0x1p30)));
    }
  }
  return mixed(key, static_cast<std::uint64_t>(std::llround(std::log2(size) * 0x1p20)));
}

std::optional<Index> SharedMeshes::find(const MeshSource& source) const {
  const Known asked = known_of(source);
  const auto alike = known_.find(key_of(asked));
  if (alike == known_.end()) {
    return std::nullopt;
  }
  const auto found = std::find_if(alike->second.begin(), alike->second.end(),
                                  [&](const Known& known) { return is_same(known, asked); });
  return found == alike->second.end() ? std::nullopt : std::optional(found->mesh);
}

void SharedMeshes::add(const MeshSource& source, Index mesh) {
  Known known = known_of(source);
  known.mesh = mesh;
  known_[key_of(known)].push_back(std::move(known));
}

const SharedMeshes::Solid& SharedMeshes::solid(const Shape& shape,
                                               const std::vector<TriangleMesh>& meshes) {
  const bool pieces = !shape.pieces.empty();
  const SolidKey key{shape.kind, pieces ? shape.pieces.front() : shape.mesh, pieces};
  const auto known = solids_.find(key);
  if (known != solids_.end()) {
    return known->second;
  }
  Solid solid;
  solid.integrals = scene::shape_integrals(shape, meshes, &solid.used_hull);
  return solids_.emplace(key, solid).first->second;
}

bool SharedMeshes::has_finite_points(Index mesh, const std::vector<TriangleMesh>& meshes) {
  const auto known = finite_.find(mesh);
  if (known != finite_.end()) {
    return known->second;
  }
  const std::vector<Vec3d>& points = meshes[mesh].points;
  const bool finite = std::all_of(points.begin(), points.end(),
                                  [](const Vec3d& point) { return is_finite(point); });
  return finite_.emplace(mesh, finite).first->second;
}

void SharedMeshes::forget_from(Index mesh) {
  for (auto& [key, known] : known_) {
    known.erase(std::remove_if(known.begin(), known.end(),
                               [&](const Known& each) { return each.mesh >= mesh; }),
                known.end());
  }
  std::erase_if(finite_, [&](const auto& each) { return each.first >= mesh; });
  std::erase_if(solids_, [&](const auto& each) { return each.first.first >= mesh; });
}

}  // namespace tenon::physics
