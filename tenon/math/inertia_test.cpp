// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/math/inertia.h"

#include <cmath>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(Inertia, TheParallelAxisTermOfAUnitBoxMovedAlongX) {
  // M-15: 1000 kg unit box, centre moved by (1,0,0): 166.667 -> (166.667, 1166.667, 1166.667).
  const Mat3d moved =
      shift_inertia(diagonal_matrix({{1000 / 6.0, 1000 / 6.0, 1000 / 6.0}}), 1000, {{1, 0, 0}});
  EXPECT_NEAR(moved[0][0], 166.667, 1e-3);
  EXPECT_NEAR(moved[1][1], 1166.667, 1e-3);
  EXPECT_NEAR(moved[2][2], 1166.667, 1e-3);
}

TEST(Inertia, PrincipalMomentsRebuildTheMatrix) {
  const Quatd q = rotation_about(normalized(Vec3d{{1, -2, 0.5}}), 1.2);
  const Mat3d inertia = rotate_inertia(q, diagonal_matrix({{1, 2, 2.5}}));
  const PrincipalInertia principal = principal_inertia(inertia);
  const Mat3d rebuilt = rotate_inertia(principal.axes, diagonal_matrix(principal.moments));
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(rebuilt[i][j], inertia[i][j], 1e-12);
    }
  }
  EXPECT_NEAR(principal.moments[0], 1, 1e-12);
  EXPECT_NEAR(principal.moments[2], 2.5, 1e-12);
}

TEST(Inertia, ADiagonalMatrixKeepsItsAxes) {
  const PrincipalInertia principal = principal_inertia(diagonal_matrix({{3, 1, 2}}));
  EXPECT_EQ(principal.axes, kIdentityRotation);
  EXPECT_EQ(principal.moments, (Vec3d{{3, 1, 2}}));
}

}  // namespace
}  // namespace tenon
