// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/scene/physics_scene.h"
#include "tenon/scene/shapes/convex_hull.h"

/// How far what collides is from what it represents.
namespace tenon::approximate {

/// A shape by its surface, outward [m].
struct ShapeSurface {
  std::vector<scene::TriangleMesh> parts;  ///< convex, where it is solid
  bool is_solid = true;
  /// It is this ball, of which `parts` has triangles.
  std::optional<scene::BoundingBall> ball;
};

/// The surface of a shape that has triangles nowhere: of a box exactly; of what is round with its
/// corners on it, 64 around. No triangles: a plane, and shapes of meshes. Of many balls each is a
/// part.
ShapeSurface surface_of(const scene::Shape& shape);

struct SurfaceGap {
  double outside = 0;  ///< how far the shape stands out of the mesh, at most [m]
  double inside = 0;   ///< how far the mesh stands out of the shape, at most [m]
  double error = 0;    ///< by which both may be larger [m]

  double largest() const { return outside > inside ? outside : inside; }
};

/// Of a closed mesh what is inside of it is no gap; of an open one distances are those to its
/// surface. `error` is half a hundredth of the size of the mesh at most, unless
/// limits::kSurfaceParts or limits::kSurfaceWork ends the search.
SurfaceGap surface_gap(const scene::TriangleMesh& mesh, const ShapeSurface& shape);

/// The diagonal of the box along the axes around the points of a mesh [m]; 0 without points.
double diagonal_of(const scene::TriangleMesh& mesh);

/// The same points and triangles, points in one place made one: what readers of STL leave open
/// may be closed then.
scene::TriangleMesh welded(const scene::TriangleMesh& mesh);

}  // namespace tenon::approximate
