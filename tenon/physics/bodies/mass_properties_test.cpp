// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/bodies/mass_properties.h"

#include <gtest/gtest.h>

namespace tenon::physics {
namespace {

SolidIntegrals unit_box(const Vec3d& center = {}) {
  SolidIntegrals box;
  box.volume = 1;
  box.center = center;
  box.inertia = diagonal_matrix({{1.0 / 6, 1.0 / 6, 1.0 / 6}});
  return box;
}

// S-39: mass before density.
TEST(MassProperties, ColliderMassWinsOverDensity) {
  AuthoredMass authored;
  authored.mass = 7;
  const MassProperties result = collider_mass(unit_box(), authored, 1000);
  EXPECT_DOUBLE_EQ(result.mass, 7);
  EXPECT_DOUBLE_EQ(result.inertia[1][1], 7.0 / 6);
}

// M-14: a 7 kg box at 0 and a box of 2 kg/m^3 at 2: 9 kg, centre 4/9; the other way round 14/9.
TEST(MassProperties, PartsAddUpAboutTheCommonCentre) {
  AuthoredMass heavy;
  heavy.mass = 7;
  const MassProperties sum = sum_masses(
      {collider_mass(unit_box(), {}, 2), collider_mass(unit_box({{2, 0, 0}}), heavy, 1000)});
  EXPECT_DOUBLE_EQ(sum.mass, 9);
  EXPECT_NEAR(sum.center[0], 14.0 / 9, 1e-14);
  // reduced mass 14/9 at distance 2 across the line
  EXPECT_NEAR(sum.inertia[0][0], 9.0 / 6, 1e-14);
  EXPECT_NEAR(sum.inertia[1][1], 9.0 / 6 + 14.0 / 9 * 4, 1e-13);
}

// M-14, E-60: the body's mass scales the sum.
TEST(MassProperties, BodyMassScalesTheSum) {
  AuthoredMass authored;
  authored.mass = 10;
  const MassProperties sum = sum_masses({collider_mass(unit_box(), {}, 1000)});
  const MassProperties body = body_mass(sum, authored);
  EXPECT_DOUBLE_EQ(body.mass, 10);
  EXPECT_NEAR(body.inertia[2][2], 10.0 / 6, 1e-14);
}

// M-15: unit box of 1000 kg, centre moved by (1, 0, 0): (166.667, 1166.667, 1166.667).
TEST(MassProperties, MovedCentreAddsTheParallelAxis) {
  AuthoredMass authored;
  authored.center = Vec3d{{1, 0, 0}};
  const MassProperties body =
      body_mass(sum_masses({collider_mass(unit_box(), {}, 1000)}), authored);
  EXPECT_NEAR(body.inertia[0][0], 1000.0 / 6, 1e-9);
  EXPECT_NEAR(body.inertia[1][1], 1000.0 / 6 + 1000, 1e-9);
  EXPECT_NEAR(body.inertia[2][2], 1000.0 / 6 + 1000, 1e-9);
}

// M-16: an authored inertia is taken as it is, about the final centre.
TEST(MassProperties, AuthoredInertiaIsNotShifted) {
  AuthoredMass authored;
  authored.center = Vec3d{{1, 0, 0}};
  authored.inertia = diagonal_matrix({{1, 2, 3}});
  const MassProperties body =
      body_mass(sum_masses({collider_mass(unit_box(), {}, 1000)}), authored);
  EXPECT_EQ(body.inertia, diagonal_matrix({{1, 2, 3}}));
  EXPECT_DOUBLE_EQ(body.mass, 1000);
}

// M-18: mass 5 in a stage of centimetres gives 200 kg cm^2 = 0.02 kg m^2.
TEST(MassProperties, WithoutShapesABallGivesTheInertia) {
  AuthoredMass authored;
  authored.mass = 5;
  EXPECT_NEAR(body_mass({}, authored).inertia[0][0], 0.02, 1e-15);
  EXPECT_DOUBLE_EQ(body_mass({}, {}).mass, 1);  // S-42
  EXPECT_NEAR(body_mass({}, {}).inertia[0][0], 0.004, 1e-16);
}

// S-45, E-68
TEST(MassProperties, TriangleRule) {
  EXPECT_TRUE(satisfies_triangle_rule({{1, 2, 3}}));
  EXPECT_FALSE(satisfies_triangle_rule({{1, 2, 30}}));
  EXPECT_FALSE(is_positive_definite(diagonal_matrix({{1, 2, 0}})));
}

TEST(MassProperties, PlacingTurnsTheInertia) {
  SolidIntegrals rod = unit_box();
  rod.inertia = diagonal_matrix({{1, 2, 3}});
  const Pose quarter{{{5, 0, 0}}, rotation_about({{0, 0, 1}}, 1.5707963267948966)};
  const SolidIntegrals turned = placed(rod, quarter);
  EXPECT_NEAR(turned.inertia[0][0], 2, 1e-14);
  EXPECT_NEAR(turned.inertia[1][1], 1, 1e-14);
  EXPECT_DOUBLE_EQ(turned.center[0], 5);
}

}  // namespace
}  // namespace tenon::physics
