// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/time/ease_tangents.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "tenon/layer/time/spline_rules.h"

namespace tenon::layer {
namespace {

// Numbers as OpenUSD 26.11 writes them for these knots.
TEST(EaseTangents, FollowTheNeighbours) {
  Spline spline;
  for (const auto& [time, value] : {std::pair{0.0, 1.0}, {4.0, 5.0}, {10.0, 6.0}, {12.0, 3.0}}) {
    SplineKnot knot;
    knot.time = time;
    knot.value = value;
    knot.next = SplineInterpolation::Curve;
    knot.pre_tangent.algorithm = TangentAlgorithm::AutoEase;
    knot.post_tangent.algorithm = TangentAlgorithm::AutoEase;
    spline.knots.push_back(knot);
  }
  spline.knots.back().post_tangent = {7, 8, TangentAlgorithm::None};
  ease_tangents(spline);
  EXPECT_EQ(spline.knots[0].post_tangent.slope, 0);
  EXPECT_DOUBLE_EQ(spline.knots[0].post_tangent.width, 4.0 / 3);
  EXPECT_DOUBLE_EQ(spline.knots[1].pre_tangent.slope, 0.5);
  EXPECT_DOUBLE_EQ(spline.knots[1].post_tangent.width, 2);
  EXPECT_EQ(spline.knots[2].pre_tangent.slope, 0);
  EXPECT_DOUBLE_EQ(spline.knots[3].pre_tangent.width, 2.0 / 3);
  EXPECT_EQ(spline.knots[3].post_tangent.slope, 8);
}

TEST(SplineRules, WidthsFarApartStayFiniteAndAboveZero) {
  for (const auto& [first, last] :
       {std::pair(1e300, 2.0), std::pair(2.0, 1e300), std::pair(1e6, 3.0), std::pair(1e-3, 1e9)}) {
    const TangentWidths widths = without_regression({first, last});
    for (const double width : {widths.first, widths.last}) {
      EXPECT_TRUE(std::isfinite(width)) << first << " " << last;
      EXPECT_GE(width, 0) << first << " " << last;
      EXPECT_LE(width, 4.0 / 3) << first << " " << last;
    }
  }
}

}  // namespace
}  // namespace tenon::layer
