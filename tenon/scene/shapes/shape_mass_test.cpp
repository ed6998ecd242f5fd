// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/shapes/shape_mass.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tenon::scene {
namespace {

constexpr double kPi = 3.14159265358979323846;

Shape round_shape(ShapeKind kind, double radius, double height, Axis axis) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.half_height = height / 2;
  shape.axis = axis;
  return shape;
}

struct Row {
  const char* name;
  Shape shape;
  double mass;     // at 1000 kg/m^3
  Vec3d diagonal;  // [kg m^2]
  Vec3d center;
};

std::vector<Row> rows() {
  Shape box;
  box.half_extents = {{0.5, 0.5, 0.5}};
  Shape ellipsoid;
  ellipsoid.kind = ShapeKind::Ellipsoid;
  ellipsoid.half_extents = {{1, 2, 3}};
  const double ball = 4.0 / 3 * kPi * 6 * 1000;
  const double cylinder = kPi * 1000 * 2;
  const double cone = kPi * 1000 / 3 * 2;
  return {
      {"box M-1", box, 1000, {{1000.0 / 6, 1000.0 / 6, 1000.0 / 6}}, {}},
      {"ellipsoid M-2", ellipsoid, ball, {{ball * 13 / 5, ball * 10 / 5, ball}}, {}},
      {"cylinder M-3",
       round_shape(ShapeKind::Cylinder, 1, 2, Axis::Y),
       cylinder,
       {{cylinder * 7 / 12, cylinder / 2, cylinder * 7 / 12}},
       {}},
      {"cone M-4",
       round_shape(ShapeKind::Cone, 1, 2, Axis::Z),
       cone,
       {{cone * 0.3, cone * 0.3, cone * 0.3}},
       {{0, 0, -0.5}}},
      {"capsule M-5",
       round_shape(ShapeKind::Capsule, 0.5, 1, Axis::X),
       1308.9969389957,
       {{150.5346, 395.9716, 395.9716}},
       {}},
  };
}

TEST(ShapeMass, MatchesClosedForms) {
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.name);
    const SolidIntegrals solid = shape_integrals(row.shape, {});
    EXPECT_NEAR(1000 * solid.volume, row.mass, 1e-9 * row.mass);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(1000 * solid.inertia[i][i], row.diagonal[i], 1e-6 * row.diagonal[i]);
      EXPECT_NEAR(solid.center[i], row.center[i], 1e-12);
    }
  }
}

TEST(ShapeMass, PlaneHasNone) {
  Shape plane;
  plane.kind = ShapeKind::Plane;
  EXPECT_EQ(shape_integrals(plane, {}).volume, 0);
}

// M-11, M-12: two balls of radius 1 at +-2 on X.
TEST(ShapeMass, SpheresAddUp) {
  Shape shape;
  shape.kind = ShapeKind::Spheres;
  shape.sphere_centers = {{{2, 0, 0}}, {{-2, 0, 0}}};
  shape.sphere_radii = {1, 1};
  const double ball = 4.0 / 3 * kPi;
  const SolidIntegrals solid = shape_integrals(shape, {});
  EXPECT_NEAR(solid.volume, 2 * ball, 1e-12);
  EXPECT_NEAR(solid.inertia[0][0], 2 * ball * 0.4, 1e-12);
  EXPECT_NEAR(solid.inertia[1][1], 2 * ball * (0.4 + 4), 1e-11);
}

TEST(ShapeMass, OpenMeshIsWeighedByItsHull) {
  TriangleMesh mesh;  // the unit right tetrahedron without its slanted face
  mesh.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  mesh.triangles = {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}};
  Shape shape;
  shape.kind = ShapeKind::Mesh;
  bool used_hull = false;
  EXPECT_NEAR(shape_integrals(shape, {mesh}, &used_hull).volume, 1.0 / 6, 1e-14);
  EXPECT_TRUE(used_hull);
}

// M-6: a frustum with radii 1 below and 0.5 above, height 2.
TEST(ShapeMass, FrustumMatchesClosedForm) {
  const SolidIntegrals solid = profile_integrals({-1, 1, 1, 0.5, false});
  const double volume = kPi * 2 / 3 * (1 + 0.5 + 0.25);
  EXPECT_NEAR(solid.volume, volume, 1e-12);
  EXPECT_NEAR(solid.center[2], -1 + 2.0 / 4 * (1 + 1 + 0.75) / 1.75, 1e-12);
  EXPECT_NEAR(solid.inertia[2][2], 0.3 * volume * (1 - 0.03125) / (1 - 0.125), 1e-12);
}

// M-7: equal radii make a capsule (M-5).
TEST(ShapeMass, ProfileOfEqualBallsIsACapsule) {
  const SolidIntegrals profile = profile_integrals({-0.5, 0.5, 0.5, 0.5, true});
  const SolidIntegrals capsule =
      shape_integrals(round_shape(ShapeKind::Capsule, 0.5, 1, Axis::Z), {});
  EXPECT_NEAR(profile.volume, capsule.volume, 1e-12);
  EXPECT_NEAR(profile.inertia[0][0], capsule.inertia[0][0], 1e-12);
  EXPECT_NEAR(profile.inertia[2][2], capsule.inertia[2][2], 1e-12);
}

// M-10: two unit cubes side by side count as two, what lies between them not.
TEST(ShapeMass, PiecesCountTogether) {
  std::vector<TriangleMesh> meshes(3);
  for (std::size_t piece = 0; piece < 2; ++piece) {
    for (const double x : {0.0, 1.0}) {
      for (const double y : {0.0, 1.0}) {
        for (const double z : {0.0, 1.0}) {
          meshes[piece].points.push_back({{x + 3 * static_cast<double>(piece), y, z}});
        }
      }
    }
    meshes[2].points.insert(meshes[2].points.end(), meshes[piece].points.begin(),
                            meshes[piece].points.end());
  }
  Shape shape;
  shape.kind = ShapeKind::ConvexHull;
  shape.mesh = 2;
  EXPECT_NEAR(shape_integrals(shape, meshes).volume, 4, 1e-9);
  shape.pieces = {0, 1};
  const SolidIntegrals pieces = shape_integrals(shape, meshes);
  EXPECT_NEAR(pieces.volume, 2, 1e-9);
  EXPECT_NEAR(pieces.center[0], 2, 1e-9);
  // Two cubes 1.5 m from the centre: 2 (1/6 + 1.5^2) about y.
  EXPECT_NEAR(pieces.inertia[1][1], 2 * (1.0 / 6 + 2.25), 1e-9);
}

}  // namespace
}  // namespace tenon::scene
