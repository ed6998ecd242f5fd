// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/physics/physics_scene.h"

namespace tenon::physics {

/// Hull of points in space: its corners and outward triangles. Empty (and `flat`) when all points
/// lie in one plane, on a line or in one place.
TriangleMesh convex_hull(const std::vector<Vec3d>& points);

/// All points lie in one plane, within 1e-9 of their extent.
bool is_flat(const std::vector<Vec3d>& points);

/// A box or a ball around points.
struct BoundingBox {
  Pose pose;  ///< of its centre, in the frame of the points
  Vec3d half_extents;
};
struct BoundingBall {
  Vec3d center;
  double radius = 0;
};

/// The smallest box with a face on a face of the hull (S-66).
BoundingBox bounding_box(const std::vector<Vec3d>& points);
/// The smallest ball that holds all points (S-66).
BoundingBall bounding_ball(const std::vector<Vec3d>& points);

}  // namespace tenon::physics
