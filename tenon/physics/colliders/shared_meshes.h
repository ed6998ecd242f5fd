// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "tenon/math/vector.h"
#include "tenon/physics/colliders/mesh_cache.h"
#include "tenon/physics/scene_names.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/scene/shapes/mesh_inertia.h"

namespace tenon::physics {

/// Which mesh of the scene a mesh prim has made, so that the robots of a fleet, each placed and
/// rotated otherwise, have their meshes in common. Two sources are the same where their arrays are
/// the same in memory and the collider's frame sees them alike within kSameMesh of their size:
/// coordinates are single floats, a hundred thousand times coarser. Lives for one reading.
class SharedMeshes {
 public:
  std::optional<Index> find(const MeshSource& source) const;
  void add(const MeshSource& source, Index mesh);

  /// Volume, centre and inertia of a mesh, of its hull, or of its pieces, computed once.
  struct Solid {
    SolidIntegrals integrals;
    bool used_hull = false;  ///< M-9
  };
  const Solid& solid(const Shape& shape, const std::vector<TriangleMesh>& meshes);

  /// The points of a mesh of the scene are numbers; looked at once, however many colliders have it.
  bool has_finite_points(Index mesh, const std::vector<TriangleMesh>& meshes);

  /// The meshes from this one on are not in the scene any more.
  void forget_from(Index mesh);

 private:
  struct Known {
    MeshSource source;  // keeps the arrays alive
    Vec3d rows[3];      // of the matrix, in the collider's frame
    Vec3d offset;
    Index mesh = 0;
  };
  struct SolidKey {
    ShapeKind kind = ShapeKind::Mesh;
    Index first = 0;  // the mesh, or the first of its pieces
    bool pieces = false;
    auto operator<=>(const SolidKey&) const = default;
  };

  static Known known_of(const MeshSource& source);
  static bool is_same(const Known& a, const Known& b);
  static std::uint64_t key_of(const Known& known);

  std::unordered_map<std::uint64_t, std::vector<Known>> known_;
  std::map<SolidKey, Solid> solids_;
  std::unordered_map<Index, bool> finite_;
};

}  // namespace tenon::physics
