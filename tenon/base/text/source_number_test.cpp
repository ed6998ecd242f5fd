// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/source_number.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tenon/base/text/text_number.h"

namespace tenon {
namespace {

TEST(SourceNumber, FloatsAndFloatDegreesLeaveNoNoise) {
  EXPECT_EQ(source_number(static_cast<double>(0.1f)), "0.1");
  EXPECT_EQ(source_number(static_cast<double>(2.7813568f)), "2.7813568");
  const double degree = std::numbers::pi / 180;
  EXPECT_EQ(source_number(static_cast<double>(static_cast<float>(-1.2345678 / degree)) * degree),
            "-1.2345678");
  EXPECT_EQ(source_number(static_cast<double>(static_cast<float>(20 * degree)) / degree), "20");
  EXPECT_EQ(source_number(0.24999999999999997), "0.25");
  EXPECT_EQ(source_number(-0.0), "0");
}

TEST(SourceNumber, AllOtherNumbersKeepTheirBits) {
  for (const double number : {0.0066666666666666688, 1.0 / 3, 0.123046875, 1e300, 5e-324,
                              123456789.125, std::numbers::pi}) {
    EXPECT_EQ(parse_double(source_number(number)), number) << number;
  }
  EXPECT_EQ(source_number(std::numeric_limits<double>::infinity()), "inf");
}

TEST(SourceNumber, NothingMovesByMoreThanAFloatRounds) {
  double number = 0.7312345678912345;
  for (int i = 0; i < 1000; ++i) {
    number = std::fmod(number * 7919.123456789, 10.0);
    for (const double held : {number, static_cast<double>(static_cast<float>(number))}) {
      EXPECT_NEAR(*parse_double(source_number(held)), held, 6e-8 * held);
      EXPECT_EQ(static_cast<float>(*parse_double(source_number(held))), static_cast<float>(held));
    }
  }
}

TEST(SourceNumber, NoiseBesideNumbersAndAloneIsZero) {
  std::array<double, 3> numbers = {1e-17, 0.3, -2e-16};
  drop_noise(numbers);
  EXPECT_EQ(numbers, (std::array<double, 3>{0, 0.3, 0}));
  std::array<double, 2> small = {1e-13, 1e-9};
  drop_noise(small);
  EXPECT_EQ(small[0], 1e-13);
}

}  // namespace
}  // namespace tenon
