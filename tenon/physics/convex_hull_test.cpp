// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/convex_hull.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/physics/mesh_inertia.h"

namespace tenon::physics {
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
}  // namespace tenon::physics
