// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/math/half.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(Half, EveryFiniteBitPatternSurvivesTheWayThroughFloat) {
  for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
    const auto pattern = static_cast<std::uint16_t>(bits);
    const float value = Half::from_bits(pattern);
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(float(Half(value))));
    } else {
      EXPECT_EQ(Half(value).bits, pattern);
    }
  }
}

TEST(Half, RoundsToTheNearestAndTiesToEven) {
  EXPECT_EQ(Half(1.0f + 0x1p-11f).bits, Half(1.0f).bits);
  EXPECT_EQ(Half(1.0f + 0x1.8p-10f).bits, Half(1.0f + 0x1p-9f).bits);
  EXPECT_EQ(float(Half(65519.0f)), 65504.0f);
  EXPECT_TRUE(std::isinf(float(Half(65520.0f))));
  EXPECT_EQ(Half(0x1p-25f).bits, 0u);
  EXPECT_EQ(Half(0x1.8p-25f).bits, 1u);
  EXPECT_EQ(Half(-0.0f).bits, 0x8000u);
}

}  // namespace
}  // namespace tenon
