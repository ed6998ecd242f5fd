// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/shapes/convex_hull.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/base/limits/physics_limits.h"
#include "tenon/scene/shapes/mesh_inertia.h"

namespace tenon::scene {
namespace {

std::vector<Vec3d> box_corners(const Vec3d& half, const Quatd& turn = kIdentityRotation,
                               const Vec3d& center = {}) {
  std::vector<Vec3d> corners;
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3d corner{{(i & 1u) != 0 ? half[0] : -half[0], (i & 2u) != 0 ? half[1] : -half[1],
                        (i & 4u) != 0 ? half[2] : -half[2]}};
    corners.push_back(center + rotate(turn, corner));
  }
  return corners;
}

TEST(ConvexHull, LeavesOutWhatLiesInside) {
  std::vector<Vec3d> points = box_corners({{1, 1, 1}});
  points.push_back({{0, 0, 0}});
  points.push_back({{0.5, 0.2, -0.9}});
  const TriangleMesh hull = convex_hull(points);
  EXPECT_FALSE(hull.flat);
  EXPECT_EQ(hull.points.size(), 8u);
  EXPECT_EQ(hull.triangles.size(), 12u);
  EXPECT_TRUE(is_closed(hull));
  EXPECT_NEAR(mesh_integrals(hull).volume, 8, 1e-12);
}

// S-65
TEST(ConvexHull, SaysThatPointsAreFlat) {
  const std::vector<Vec3d> quad{{{-1, 1, 0}}, {{1, 1, 0}}, {{1, -1, 0}}, {{-1, -1, 0}}};
  EXPECT_TRUE(is_flat(quad));
  EXPECT_TRUE(convex_hull(quad).flat);
  EXPECT_TRUE(convex_hull({}).flat);
  EXPECT_TRUE(is_flat({{{0, 0, 0}}, {{1, 1, 1}}, {{2, 2, 2}}, {{3, 3, 3}}, {{4, 4, 4}}}));
  EXPECT_FALSE(is_flat(box_corners({{1, 1, 1e-3}})));
}

/// Points on two circles above each other, all of them corners.
std::vector<Vec3d> drum(std::size_t count) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * M_PI * static_cast<double>(i) / static_cast<double>(count);
    points.push_back({{std::cos(angle), std::sin(angle), i % 2 == 0 ? 0.0 : 1.0}});
  }
  return points;
}

// Qhull merges the facets of either face one after the other: 100,000 corners took minutes.
TEST(ConvexHull, OfADrumOfVeryManyCornersEnds) {
  const std::vector<Vec3d> points = drum(100'000);
  const HullPoints few = hull_points(points);
  EXPECT_TRUE(few.simplified);
  EXPECT_LE(few.points.size(), limits::kHullPoints);
  const TriangleMesh hull = convex_hull(points);
  EXPECT_TRUE(is_closed(hull));
  EXPECT_NEAR(mesh_integrals(hull).volume, M_PI, 1e-6);
  EXPECT_NEAR(mesh_integrals(convex_hull(few.points)).volume, M_PI, 0.01);
  const BoundingBall ball = bounding_ball(points);
  EXPECT_NEAR(ball.radius, std::sqrt(1.25), 1e-3);
  const BoundingBox box = bounding_box(points);
  for (const Vec3d& p : points) {
    EXPECT_LE(length(p - ball.center), ball.radius * (1 + 1e-9));
    const Vec3d local = transform_point(inverse(box.pose), p);
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_LE(std::fabs(local[i]), box.half_extents[i] + 1e-9);
    }
  }
}

TEST(ConvexHull, OfVeryManyPointsInsideIsThatOfItsCorners) {
  std::vector<Vec3d> points;
  for (std::size_t i = 0; i < 31 * 31 * 31; ++i) {  // inside, and on the faces
    const auto at = [i](std::size_t by) { return static_cast<double>(i / by % 31) / 15 - 1; };
    points.push_back({{at(1), at(31), at(31 * 31)}});
  }
  EXPECT_FALSE(hull_points(points).simplified);
  EXPECT_LE(hull_points(points).points.size(), limits::kHullPoints);
  EXPECT_NEAR(mesh_integrals(convex_hull(points)).volume, 8, 1e-9);
}

TEST(ConvexHull, LeavesUpToItsLimitAsItIs) {
  const std::vector<Vec3d> points = drum(limits::kHullPoints);
  EXPECT_EQ(hull_points(points).points, points);
  EXPECT_FALSE(hull_points(points).simplified);
}

TEST(ConvexHull, OfVeryManyPointsThatAreFlatOrNoNumbersEnds) {
  std::vector<Vec3d> points = drum(limits::kHullPoints + 2);
  points[7][1] = NAN;
  EXPECT_LE(hull_points(points).points.size(), limits::kHullPoints);
  for (Vec3d& point : points) {
    point[2] = 0;
    point[1] = point[1] == point[1] ? point[1] : 0;
  }
  EXPECT_TRUE(convex_hull(points).flat);
  EXPECT_LE(hull_points(points).points.size(), limits::kHullPoints);
  EXPECT_NEAR(bounding_ball(points).radius, 1, 1e-3);
}

// E-58
TEST(ConvexHull, BoundingBoxOfATurnedSlabIsTheSlab) {
  const Quatd turn = normalized(Quatd{0.3, -0.5, 0.2, 0.8});
  const Vec3d half{{0.1, 1, 2}};
  const BoundingBox box = bounding_box(box_corners(half, turn, {{3, 4, 5}}));
  EXPECT_NEAR(box.half_extents[0] * box.half_extents[1] * box.half_extents[2], 0.2, 1e-9);
  EXPECT_NEAR(box.pose.position[1], 4, 1e-9);
  for (const Vec3d& corner : box_corners(half, turn, {{3, 4, 5}})) {
    const Vec3d local = transform_point(inverse(box.pose), corner);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(std::fabs(local[i]), box.half_extents[i] + 1e-9);
    }
  }
}

TEST(ConvexHull, BoundingBallOfABoxIsNearlyTheSmallest) {
  const BoundingBall ball = bounding_ball(box_corners({{1, 2, 3}}, kIdentityRotation, {{1, 1, 1}}));
  const double exact = std::sqrt(14.0);
  EXPECT_GE(ball.radius, exact - 1e-9);
  EXPECT_LE(ball.radius, exact * 1.001);
}

}  // namespace
}  // namespace tenon::scene
