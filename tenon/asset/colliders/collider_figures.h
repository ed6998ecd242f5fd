// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tenon/approximate/surface_gap.h"
#include "tenon/engines/shapes/used_shape.h"
#include "tenon/scene/physics_scene.h"

/// How well the shape that an engine uses represents a collider, and what it costs.
namespace tenon {

/// What a collider represents, in the frame of its parent: the body, of a static one the world.
struct MeshOfCollider {
  scene::TriangleMesh mesh;      ///< [m]
  std::optional<double> volume;  ///< [m^3]; none: it is open, or flat
};

struct ColliderFigures {
  /// "none", the kind of shape ("box", "sphere", ...), "convexHull", "convexDecomposition" (several
  /// hulls), "mesh" (triangles).
  std::string used = "none";
  std::size_t pieces = 0;
  std::size_t vertices = 0;   ///< of hulls and triangles
  std::size_t triangles = 0;  ///< the same
  /// Corners that a search for contacts goes through: of hulls their own, of each triangle 3, of a
  /// box 8, of a capsule 2, of what else has no corners 1.
  std::size_t cost = 0;
  std::optional<double> volume;  ///< of all pieces [m^3]; none: triangles, or a plane
  std::optional<double> mesh_volume;
  /// From the mesh, or where there is none from the shape that the asset describes; none: no
  /// triangles could be made of either.
  std::optional<approximate::SurfaceGap> gap;
  std::vector<std::string> notes;  ///< of the engine

  /// volume / mesh_volume; none: one of them is not known.
  std::optional<double> cover() const;
};

MeshOfCollider mesh_of_collider(const scene::Collider& collider, const scene::PhysicsScene& scene);

/// `mesh`: null where the collider is of no mesh.
ColliderFigures collider_figures(const scene::Collider& collider, const scene::PhysicsScene& scene,
                                 const engines::UsedShape& used, const MeshOfCollider* mesh);

}  // namespace tenon
