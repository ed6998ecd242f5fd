// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/shapes/ray_hit.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tenon::scene {
namespace {

Shape shape_of(ShapeKind kind) {
  Shape shape;
  shape.kind = kind;
  shape.half_extents = {{1, 2, 3}};
  shape.radius = 0.5;
  shape.half_height = 2;
  return shape;
}

double distance_to(const Shape& shape, const Vec3d& origin, const Vec3d& direction) {
  return ray_distance(shape, {}, origin, normalized(direction));
}

TEST(RayHit, MeetsTheNearestPartOfEachShape) {
  constexpr double kFar = kInfinity;
  const double half = std::sqrt(0.5);
  struct Row {
    ShapeKind kind;
    Vec3d origin;
    Vec3d direction;
    double distance;
  };
  const Row rows[] = {
      {ShapeKind::Box, {{5, 0, 0}}, {{-1, 0, 0}}, 4},
      {ShapeKind::Box, {{0, 0, 0}}, {{0, 0, 1}}, 3},  // from within
      {ShapeKind::Box, {{5, 2.5, 0}}, {{-1, 0, 0}}, kFar},
      {ShapeKind::Box, {{5, 0, 0}}, {{1, 0, 0}}, kFar},  // behind
      {ShapeKind::Sphere, {{0, 0, 3}}, {{0, 0, -1}}, 2.5},
      {ShapeKind::Sphere, {{0, 0, 0.25}}, {{0, 0, -1}}, 0.75},
      {ShapeKind::Sphere, {{0, 0.6, 3}}, {{0, 0, -1}}, kFar},
      {ShapeKind::Ellipsoid, {{0, 5, 0}}, {{0, -1, 0}}, 3},
      {ShapeKind::Ellipsoid, {{5, 0, 0}}, {{-1, 0, 0}}, 4},
      {ShapeKind::Capsule, {{0, 0, 5}}, {{0, 0, -1}}, 2.5},
      {ShapeKind::Capsule, {{3, 0, 1.9}}, {{-1, 0, 0}}, 2.5},
      {ShapeKind::Capsule, {{3, 0, 2.3}}, {{-1, 0, 0}}, 2.6},  // the cap: sqrt(0.25 - 0.09) = 0.4
      {ShapeKind::Capsule, {{0, 0, 0}}, {{0, 0, 1}}, 2.5},
      {ShapeKind::Cylinder, {{0, 0, 5}}, {{0, 0, -1}}, 3},
      {ShapeKind::Cylinder, {{3, 0, 1.9}}, {{-1, 0, 0}}, 2.5},
      {ShapeKind::Cylinder, {{3, 0, 2.1}}, {{-1, 0, 0}}, kFar},
      {ShapeKind::Cylinder, {{0.5, 0, 0}}, {{-1, 0, 0}}, 0},
      {ShapeKind::Cone, {{3, 0, 0}}, {{-1, 0, 0}}, 2.75},  // half of the radius at half the height
      {ShapeKind::Cone, {{0, 0, -5}}, {{0, 0, 1}}, 3},
      {ShapeKind::Cone, {{0, 0, 5}}, {{0, 0, -1}}, 3},  // the apex
      {ShapeKind::Cone, {{3, 0, 2.5}}, {{-1, 0, 0}}, kFar},
      {ShapeKind::Plane, {{0, 0, 2}}, {{1, 0, -1}}, 2 / half},
      {ShapeKind::Plane, {{0, 0, 2}}, {{1, 0, 0}}, kFar},
  };
  for (const Row& row : rows) {
    const double found = distance_to(shape_of(row.kind), row.origin, row.direction);
    if (std::isfinite(row.distance)) {
      EXPECT_NEAR(found, row.distance, 1e-12) << shape_name(row.kind) << row.origin[2];
    } else {
      EXPECT_EQ(found, row.distance) << shape_name(row.kind) << row.origin[2];
    }
    EXPECT_GE(bounding_radius(shape_of(row.kind), {}) + 1e-12,
              std::isfinite(found) && row.kind != ShapeKind::Plane
                  ? length(row.origin + normalized(row.direction) * found)
                  : 0);
  }
}

TEST(RayHit, FollowsTheAxisOfAShape) {
  Shape shape = shape_of(ShapeKind::Cylinder);
  shape.axis = Axis::X;
  EXPECT_NEAR(distance_to(shape, {{5, 0, 0}}, {{-1, 0, 0}}), 3, 1e-12);
  shape.axis = Axis::Y;
  EXPECT_NEAR(distance_to(shape, {{0, 5, 0}}, {{0, -1, 0}}), 3, 1e-12);
  EXPECT_NEAR(distance_to(shape, {{5, 0, 0}}, {{-1, 0, 0}}), 4.5, 1e-12);
}

TEST(RayHit, MeetsTrianglesFromBothSidesAndSpheresOneByOne) {
  Shape mesh = shape_of(ShapeKind::Mesh);
  const std::vector<TriangleMesh> meshes{
      {{{{0, 0, 1}}, {{1, 0, 1}}, {{0, 1, 1}}}, {{{0, 1, 2}}}, true}};
  EXPECT_NEAR(ray_distance(mesh, meshes, {{0.2, 0.2, 0}}, {{0, 0, 1}}), 1, 1e-12);
  EXPECT_NEAR(ray_distance(mesh, meshes, {{0.2, 0.2, 3}}, {{0, 0, -1}}), 2, 1e-12);
  EXPECT_EQ(ray_distance(mesh, meshes, {{0.6, 0.6, 0}}, {{0, 0, 1}}), kInfinity);
  EXPECT_NEAR(bounding_radius(mesh, meshes), std::sqrt(2), 1e-12);
  Shape spheres = shape_of(ShapeKind::Spheres);
  spheres.sphere_centers = {{{0, 0, 5}}, {{0, 0, 2}}};
  spheres.sphere_radii = {1, 0.5};
  EXPECT_NEAR(distance_to(spheres, {}, {{0, 0, 1}}), 1.5, 1e-12);
  EXPECT_EQ(bounding_radius(spheres, {}), 6);
}

}  // namespace
}  // namespace tenon::scene
