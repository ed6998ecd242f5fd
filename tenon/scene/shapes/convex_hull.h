// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// Hull of points in space: its corners and outward triangles. Empty (and `flat`) when all points
/// lie in one plane, on a line or in one place. Takes a time that is nearly linear; of hulls with
/// more than a thousand corners, corners may be missing that lie within 1e-11 of the size of it,
/// and triangles may be slivers.
TriangleMesh convex_hull(const std::vector<Vec3d>& points);

/// Points that have the same hull as others.
struct HullPoints {
  std::vector<Vec3d> points;
  bool simplified = false;  ///< nearly the same: the hull has more corners than limits::kHullPoints
};

/// For those who make hulls in a time that grows with the square: the points themselves, where they
/// are not more than limits::kHullPoints, else the corners of their hull, and of more corners those
/// that lie outermost in a grid of 40 cells across (where the hull is smooth the simplified one
/// lies inside it by 0.2 % of the size at most).
HullPoints hull_points(const std::vector<Vec3d>& points);

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

/// The smallest box with a face on a face of the hull (S-66), of hulls with more than a
/// thousand corners nearly so.
BoundingBox bounding_box(const std::vector<Vec3d>& points);
/// The smallest ball that holds all points (S-66).
BoundingBall bounding_ball(const std::vector<Vec3d>& points);

}  // namespace tenon::scene
