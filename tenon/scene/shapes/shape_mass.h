// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/scene/physics_scene.h"
#include "tenon/scene/shapes/mesh_inertia.h"

namespace tenon::scene {

/// Integrals of a collision shape in its own frame (M-1..M-11). Zero volume for planes and flat
/// meshes. `used_hull` is set when an open mesh had to be closed by its convex hull (M-9).
SolidIntegrals shape_integrals(const Shape& shape, const std::vector<TriangleMesh>& meshes,
                               bool* used_hull = nullptr);

/// The sum of solids in one frame, each counted whole where they overlap; empty without a volume.
SolidIntegrals sum_of(const std::vector<SolidIntegrals>& parts);

/// A solid of revolution about +Z between two heights (M-7).
struct Profile {
  double bottom = 0;
  double top = 0;
  double bottom_radius = 0;  ///< of the frustum, or of the lower ball with `capped`
  double top_radius = 0;
  bool capped = false;  ///< hull of two balls whose centres are `bottom` and `top`
};
SolidIntegrals profile_integrals(const Profile& profile);

}  // namespace tenon::scene
