// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/scene/physics_scene.h"

/// Where rays meet shapes.
namespace tenon::scene {

/// How far along a ray the surface of a shape lies [m]: from `origin` along the unit `direction`,
/// both in the shape's frame. Infinity: the ray misses it. One that begins inside meets the surface
/// from within. Of hulls the triangles of the mesh count that the hull is of.
double ray_distance(const Shape& shape, const std::vector<TriangleMesh>& meshes,
                    const Vec3d& origin, const Vec3d& direction);

/// The radius of a ball about the origin of a shape's frame that holds the shape [m]; infinity:
/// none does.
double bounding_radius(const Shape& shape, const std::vector<TriangleMesh>& meshes);

}  // namespace tenon::scene
