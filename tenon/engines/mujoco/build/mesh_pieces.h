// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/math/vector.h"
#include "tenon/scene/physics_scene.h"

/// Meshes as convex pieces, the only meshes whose contacts MuJoCo makes reliably.
namespace tenon::engines::mujoco {

struct MeshPieces {
  std::vector<std::vector<Vec3d>> hulls;  ///< points of each convex piece, in the collider's frame
  std::string note;  ///< what was done to the mesh, for the report; empty: the shape is exact
};

/// Hull of the points. Points in one plane get a thickness of one percent of their size, away from
/// `up` (collider frame) when that lies across the plane, else to both sides (S-65).
MeshPieces hull_pieces(const std::vector<Vec3d>& points, const Vec3d& up);

/// The triangles themselves, of a collider that does not move: one hull when the mesh is convex or
/// a convex flat polygon, else one thin prism per triangle, below its front side.
MeshPieces triangle_pieces(const scene::TriangleMesh& mesh, const Vec3d& up);

}  // namespace tenon::engines::mujoco
