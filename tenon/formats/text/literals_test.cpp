// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/literals.h"

#include <cstdlib>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace tenon::formats::text {
namespace {

/// Digits are taken eight at a time; the C library takes them one by one.
TEST(Literals, NumbersOfAnyLengthAreReadAsTheCLibraryReadsThem) {
  std::mt19937 numbers(3);
  const auto dice = [&] { return static_cast<std::uint32_t>(numbers()); };
  const auto digits = [&](std::uint32_t count, bool zeros) {
    std::string text;
    for (std::uint32_t i = 0; i < count; ++i) {
      text += zeros && dice() % 2 == 0 ? '0' : static_cast<char>('0' + dice() % 10);
    }
    return text;
  };
  int plain = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text = dice() % 4 == 0 ? "-" : "";
    text += digits(dice() % 24, dice() % 3 == 0);
    text += dice() % 2 == 0 ? "." + digits(1 + dice() % 24, dice() % 3 == 0) : "";
    text += dice() % 8 == 0 ? "e" + std::to_string(static_cast<int>(dice() % 40) - 20) : "";
    const std::string_view ends[] = {"", ",", ")", " 12345678", "]]]]]]]]", ", 0.5, 0.25"};
    const std::string whole = text + std::string(ends[dice() % std::size(ends)]);
    const char* at = whole.data();
    double value = 0;
    if (!take_plain_double(at, whole.data() + whole.size(), value)) {
      continue;  // left to the reader that tells faults
    }
    ++plain;
    char* end = nullptr;
    EXPECT_EQ(value, std::strtod(whole.c_str(), &end)) << whole;
    EXPECT_EQ(at, end) << whole;
  }
  EXPECT_GT(plain, 10000);
}

}  // namespace
}  // namespace tenon::formats::text
