// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/rounded_text.h"

#include <limits>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(RoundedText, KeepsSignificantDigits) {
  EXPECT_EQ(rounded_text(3.14159265), "3.14159");
  EXPECT_EQ(rounded_text(3.14159265, 3), "3.14");
  EXPECT_EQ(rounded_text(1234567.0), "1.23457e+06");
  EXPECT_EQ(rounded_text(0.5), "0.5");
  EXPECT_EQ(rounded_text(-0.0), "0");
}

TEST(RoundedText, NumbersThatAreNone) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(rounded_text(infinity), "inf");
  EXPECT_EQ(rounded_text(-infinity), "-inf");
  EXPECT_EQ(rounded_text(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(rounded_text(-std::numeric_limits<double>::max(), 99).size(), 24u);
}

}  // namespace
}  // namespace tenon
