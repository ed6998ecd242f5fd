// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/parallel.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(Parallel, BothCallsHaveEnded) {
  EXPECT_GE(usable_processors(), 1u);
  for (int round = 0; round < 100; ++round) {
    int first = 0;
    int second = 0;
    run_both([&] { first = round + 1; }, [&] { second = round + 2; });
    EXPECT_EQ(first, round + 1);
    EXPECT_EQ(second, round + 2);
  }
}

}  // namespace
}  // namespace tenon
