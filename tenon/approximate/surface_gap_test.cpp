// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/approximate/surface_gap.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tenon/approximate/surface_tree.h"
#include "tenon/scene/shapes/mesh_inertia.h"

namespace tenon::approximate {
namespace {

using scene::TriangleMesh;

/// A closed L: two long and wide, arms one wide, one high.
TriangleMesh ell() {
  const Vec2d outline[] = {{{0, 0}}, {{2, 0}}, {{2, 1}}, {{1, 1}}, {{1, 2}}, {{0, 2}}};
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const Vec2d& p : outline) {
      mesh.points.push_back({{p[0], p[1], z}});
    }
  }
  for (const Vec3i& t : {Vec3i{{0, 1, 3}}, Vec3i{{1, 2, 3}}, Vec3i{{0, 3, 5}}, Vec3i{{3, 4, 5}}}) {
    mesh.triangles.push_back({{t[0], t[2], t[1]}});
    mesh.triangles.push_back({{t[0] + 6, t[1] + 6, t[2] + 6}});
  }
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    mesh.triangles.push_back({{i, next, next + 6}});
    mesh.triangles.push_back({{i, next + 6, i + 6}});
  }
  return mesh;
}

scene::Shape box(const Vec3d& half) {
  scene::Shape shape;
  shape.kind = scene::ShapeKind::Box;
  shape.half_extents = half;
  return shape;
}

void shift(const Vec3d& by, TriangleMesh& mesh) {
  for (Vec3d& point : mesh.points) {
    point += by;
  }
}

TEST(SurfaceTree, KnowsDistancesAndWhatIsInside) {
  const TriangleMesh mesh = ell();
  ASSERT_TRUE(scene::is_closed(mesh));
  const SurfaceTree tree(mesh);
  EXPECT_TRUE(tree.contains({{0.5, 0.5, 0.5}}));
  EXPECT_TRUE(tree.contains({{0.5, 1.5, 0.9}}));
  EXPECT_FALSE(tree.contains({{1.5, 1.5, 0.5}}));
  EXPECT_FALSE(tree.contains({{-0.5, -0.5, -0.5}}));
  EXPECT_NEAR(tree.nearest({{1.25, 1.5, 0.5}}).distance, 0.25, 1e-12);
  EXPECT_NEAR(tree.nearest({{3, 2, 0.5}}).distance, std::sqrt(2.0), 1e-12);
  EXPECT_EQ(SurfaceTree(TriangleMesh()).nearest({}).distance, kInfinity);
}

TEST(SurfaceGap, IsNoneFromAMeshToItself) {
  const TriangleMesh mesh = ell();
  const SurfaceGap gap = surface_gap(mesh, {{mesh}, false, std::nullopt});
  EXPECT_LT(gap.largest(), 1e-12);
  EXPECT_LT(gap.error, 1e-12);
}

TEST(SurfaceGap, OfAHullIsWhatItSpans) {
  const TriangleMesh mesh = ell();
  const SurfaceGap gap = surface_gap(mesh, {{scene::convex_hull(mesh.points)}, true, std::nullopt});
  EXPECT_LE(gap.outside, 0.5 + 1e-9);
  EXPECT_GE(gap.outside + gap.error, 0.5 - 1e-9);
  EXPECT_LT(gap.inside, 1e-9);
  EXPECT_LE(gap.error, 0.005 * 3);
}

TEST(SurfaceGap, OfPiecesThatFillTheMeshIsNone) {
  TriangleMesh lying = surface_of(box({{1, 0.5, 0.5}})).parts[0];
  shift({{1, 0.5, 0.5}}, lying);
  TriangleMesh standing = surface_of(box({{0.5, 0.5, 0.5}})).parts[0];
  shift({{0.5, 1.5, 0.5}}, standing);
  const SurfaceGap gap = surface_gap(ell(), {{lying, standing}, true, std::nullopt});
  EXPECT_LT(gap.largest(), 1e-9);
  // Without one of them the mesh stands out of the other.
  const SurfaceGap half = surface_gap(ell(), {{lying}, true, std::nullopt});
  EXPECT_NEAR(half.inside, 1, 1e-9);
  EXPECT_LT(half.outside, 1e-9);
}

TEST(SurfaceGap, OfABallIsExactInside) {
  const TriangleMesh mesh = surface_of(box({{1, 1, 1}})).parts[0];
  scene::Shape ball;
  ball.kind = scene::ShapeKind::Sphere;
  ball.radius = 1;
  const SurfaceGap gap = surface_gap(mesh, surface_of(ball));
  EXPECT_NEAR(gap.inside, std::sqrt(3.0) - 1, 1e-12);
  EXPECT_LT(gap.outside, 1e-12);
}

// Each of 20,000 points is compared with 20,000 planes, which is more than kSurfaceWork.
TEST(SurfaceGap, ThatTakesTooLongTellsWhatIsUncertain) {
  TriangleMesh mesh;
  mesh.points.push_back({});
  for (std::int32_t i = 1; i < 20'000; ++i) {
    mesh.points.push_back({{std::cos(i), std::sin(i), 0}});
    mesh.triangles.push_back({{0, i, std::max(1, i - 1)}});
  }
  const SurfaceGap gap = surface_gap(mesh, {{mesh}, true, std::nullopt});
  EXPECT_LT(gap.inside, 1e-9);
  EXPECT_GT(gap.error, 0.1);
}

TEST(SurfaceOf, RoundShapesAreClosedAndFaceOutward) {
  for (const scene::ShapeKind kind :
       {scene::ShapeKind::Sphere, scene::ShapeKind::Capsule, scene::ShapeKind::Cylinder,
        scene::ShapeKind::Cone, scene::ShapeKind::Ellipsoid}) {
    for (const scene::Axis axis : {scene::Axis::X, scene::Axis::Y, scene::Axis::Z}) {
      scene::Shape shape;
      shape.kind = kind;
      shape.axis = axis;
      shape.radius = 0.5;
      shape.half_height = 1;
      shape.half_extents = {{1, 2, 3}};
      const ShapeSurface surface = surface_of(shape);
      ASSERT_EQ(surface.parts.size(), 1U);
      EXPECT_TRUE(scene::is_closed(surface.parts[0])) << scene::shape_name(kind);
      const SurfaceTree tree(surface.parts[0]);
      EXPECT_TRUE(tree.contains({{0.01, 0.02, 0.03}}));
      EXPECT_EQ(tree.contains({{0.9, 0.05, 0.05}}),
                kind == scene::ShapeKind::Ellipsoid ||
                    (axis == scene::Axis::X &&
                     (kind == scene::ShapeKind::Capsule || kind == scene::ShapeKind::Cylinder)))
          << scene::shape_name(kind);
    }
  }
}

TEST(Welded, PointsInOnePlaceAreOne) {
  const TriangleMesh mesh = ell();
  TriangleMesh loose;
  for (const Vec3i& t : mesh.triangles) {
    const auto first = static_cast<std::int32_t>(loose.points.size());
    for (std::size_t k = 0; k < 3; ++k) {
      loose.points.push_back(mesh.points[static_cast<std::size_t>(t[k])]);
    }
    loose.triangles.push_back({{first, first + 1, first + 2}});
  }
  EXPECT_FALSE(scene::is_closed(loose));
  EXPECT_TRUE(scene::is_closed(welded(loose)));
  EXPECT_EQ(welded(loose).points.size(), 12U);
}

}  // namespace
}  // namespace tenon::approximate
