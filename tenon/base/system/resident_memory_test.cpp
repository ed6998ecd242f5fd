// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/system/resident_memory.h"

#include <vector>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(ResidentMemory, GrowsWithWhatIsWritten) {
  const std::optional<double> before = resident_memory();
  ASSERT_TRUE(before);
  EXPECT_GT(*before, 1e6);
  constexpr std::size_t kBytes = 64'000'000;
  const std::vector<char> memory(kBytes, 'x');
  EXPECT_EQ(memory.back(), 'x');
  EXPECT_GT(resident_memory().value_or(0), *before + 0.9 * kBytes);
}

}  // namespace
}  // namespace tenon
