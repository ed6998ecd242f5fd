// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/system/random_bytes.h"

#include <set>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(RandomBytes, AreHexadecimalAndNeverTheSame) {
  std::set<std::string> seen;
  for (int i = 0; i < 100; ++i) {
    const auto text = random_hex(16);
    ASSERT_TRUE(text);
    EXPECT_EQ(text->size(), 32U);
    EXPECT_EQ(text->find_first_not_of("0123456789abcdef"), std::string::npos);
    seen.insert(*text);
  }
  EXPECT_EQ(seen.size(), 100U);
}

}  // namespace
}  // namespace tenon
