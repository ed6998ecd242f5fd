// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/math/transform.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::check {

/// A convex solid in the world, shrunk about its middle.
struct ConvexSolid {
  const scene::Shape* shape = nullptr;
  const std::vector<Vec3d>* points = nullptr;  ///< of ConvexHull
  Pose pose;                                   ///< X_WC
  Vec3d middle;                                ///< in the shape's frame [m]
  double keep = 1;                             ///< size that is left, from 0 to 1

  /// The point of the solid that lies farthest in `direction`, in the world [m].
  Vec3d farthest(const Vec3d& direction) const;
};

/// The shape can be asked for its farthest point: all but planes, meshes and heaps of spheres.
bool is_convex(const scene::Shape& shape);

/// A world box around it: low and high corner [m].
std::pair<Vec3d, Vec3d> bounds_of(const ConvexSolid& solid);

/// No plane separates the two; false where that is not settled in a bounded number of steps.
bool overlap(const ConvexSolid& a, const ConvexSolid& b);

}  // namespace tenon::check
