// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/shapes/mesh_inertia.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tenon::scene {
namespace {

/// Corners (0,0,0), (1,0,0), (0,1,0), (0,0,1), faces outward.
TriangleMesh right_tetrahedron() {
  TriangleMesh mesh;
  mesh.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  mesh.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}};
  return mesh;
}

TriangleMesh box_mesh(const Vec3d& half, const Vec3d& center) {
  TriangleMesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.points.push_back(
        center + Vec3d{{(i & 1u) != 0 ? half[0] : -half[0], (i & 2u) != 0 ? half[1] : -half[1],
                        (i & 4u) != 0 ? half[2] : -half[2]}});
  }
  mesh.triangles = {{{0, 2, 1}}, {{1, 2, 3}}, {{4, 5, 6}}, {{5, 7, 6}}, {{0, 1, 4}}, {{1, 5, 4}},
                    {{2, 6, 3}}, {{3, 6, 7}}, {{0, 4, 2}}, {{2, 4, 6}}, {{1, 3, 5}}, {{3, 7, 5}}};
  return mesh;
}

// M-8: at density 1000 the unit right tetrahedron weighs 166.667; about the origin the second
// moments are 1/60 and 1/120, which gives 12.5 and 2.0833 about the centre (1/4, 1/4, 1/4).
TEST(MeshInertia, RightTetrahedronHasTheTextbookMoments) {
  const SolidIntegrals solid = mesh_integrals(right_tetrahedron());
  EXPECT_NEAR(1000 * solid.volume, 1000.0 / 6, 1e-10);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(solid.center[i], 0.25, 1e-14);
    EXPECT_NEAR(1000 * solid.inertia[i][i], 12.5, 1e-11);
    EXPECT_NEAR(1000 * solid.inertia[i][(i + 1) % 3], 25.0 / 12, 1e-11);
  }
}

// M-9, E-72
TEST(MeshInertia, InsideOutMeshCountsAsTurned) {
  TriangleMesh mesh = right_tetrahedron();
  for (Vec3i& t : mesh.triangles) {
    std::swap(t[1], t[2]);
  }
  const SolidIntegrals turned = mesh_integrals(mesh);
  const SolidIntegrals right = mesh_integrals(right_tetrahedron());
  EXPECT_DOUBLE_EQ(turned.volume, right.volume);
  EXPECT_DOUBLE_EQ(turned.inertia[0][0], right.inertia[0][0]);
  EXPECT_DOUBLE_EQ(turned.center[2], right.center[2]);
}

TEST(MeshInertia, BoxFarFromTheOriginKeepsItsPrecision) {
  const Vec3d half{{0.5, 1, 1.5}};
  const Vec3d center{{1000, -2000, 500}};
  const SolidIntegrals solid = mesh_integrals(box_mesh(half, center));
  const double mass = 8 * half[0] * half[1] * half[2];
  EXPECT_NEAR(solid.volume, mass, 1e-11 * mass);
  for (std::size_t i = 0; i < 3; ++i) {
    const double b = half[(i + 1) % 3];
    const double c = half[(i + 2) % 3];
    EXPECT_NEAR(solid.inertia[i][i], mass * (b * b + c * c) / 3, 1e-9 * mass);
    EXPECT_NEAR(solid.center[i], center[i], 1e-9);
  }
}

TEST(MeshInertia, FlatMeshHasNoVolume) {
  TriangleMesh mesh;
  mesh.points = {{{0, 0, 1}}, {{1, 0, 1}}, {{1, 1, 1}}, {{0, 1, 1}}};
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  EXPECT_EQ(mesh_integrals(mesh).volume, 0);
  EXPECT_EQ(mesh_integrals(TriangleMesh{}).volume, 0);
}

// E-73
TEST(MeshInertia, ClosedMeansEveryEdgeIsSharedByTwoFaces) {
  TriangleMesh mesh = box_mesh({{1, 1, 1}}, {});
  EXPECT_TRUE(is_closed(mesh));
  mesh.triangles.pop_back();
  EXPECT_FALSE(is_closed(mesh));
  EXPECT_FALSE(is_closed(TriangleMesh{}));
}

TEST(MeshInertia, MixedWindingIsNotClosed) {
  TriangleMesh mesh = right_tetrahedron();
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  EXPECT_FALSE(is_closed(mesh));
}

}  // namespace
}  // namespace tenon::scene
