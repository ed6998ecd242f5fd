// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/text_number.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace tenon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(TextNumber, LayerTextIsWhatOpenUsdPrints) {
  const std::pair<double, const char*> rows[] = {
      {0, "0"},
      {-0.0, "-0"},
      {1, "1"},
      {-1.5, "-1.5"},
      {0.1, "0.1"},
      {1e-5, "0.00001"},
      {1e-6, "0.000001"},
      {1e-7, "1e-7"},
      {123456789, "123456789"},
      {1e14, "100000000000000"},
      {1e15, "1e15"},
      {123456789012345680.0, "1.2345678901234568e17"},
      {1e100, "1e100"},
      {1.0 / 3, "0.3333333333333333"},
      {5e-324, "5e-324"},
      {kInfinity, "inf"},
      {-kInfinity, "-inf"},
      {std::nan(""), "nan"},
  };
  for (const auto& [value, text] : rows) {
    EXPECT_EQ(layer_text(value), text);
  }
  EXPECT_EQ(layer_text(0.1f), "0.1");
  EXPECT_EQ(layer_text(16777216.0f), "16777216");
  EXPECT_EQ(layer_text(1e20f), "1e20");
}

TEST(TextNumber, NumbersReadBackAsThemselves) {
  for (int i = -300; i < 300; ++i) {
    const double value = 1.2345678901234567 * std::pow(10.0, i);
    EXPECT_EQ(parse_double(shortest(value)), value);
    EXPECT_EQ(parse_double(layer_text(value)), value);
  }
}

TEST(TextNumber, WholeTextsAreParsed) {
  EXPECT_EQ(parse_double("+1.5"), 1.5);
  EXPECT_EQ(parse_double("-inf"), -kInfinity);
  EXPECT_FALSE(parse_double("1.5x"));
  EXPECT_FALSE(parse_double(""));
  EXPECT_FALSE(parse_double("+-1"));
  EXPECT_EQ(parse_int64("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_FALSE(parse_int64("9223372036854775808"));
  EXPECT_EQ(parse_uint64("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_FALSE(parse_uint64("-1"));
  EXPECT_FALSE(parse_int64("1.0"));
}

}  // namespace
}  // namespace tenon
