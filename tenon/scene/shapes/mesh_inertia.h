// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/math/inertia.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// Volume integrals of a solid of density 1.
struct SolidIntegrals {
  double volume = 0;  ///< [m^3]
  Vec3d center;       ///< of mass [m]
  Mat3d inertia;      ///< about `center`, in the axes of the shape [m^5]
};

/// Integrals of a closed triangle mesh (M-8); inside-out meshes count as if turned (M-9). Zero
/// volume for a flat one.
SolidIntegrals mesh_integrals(const TriangleMesh& mesh);

/// Every edge is used once in each direction: the mesh has an inside (M-9).
bool is_closed(const TriangleMesh& mesh);

}  // namespace tenon::scene
