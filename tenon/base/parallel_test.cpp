// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/parallel.h"

#include <atomic>
#include <vector>

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

TEST(Parallel, CallsEachNumberOnce) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{5}}) {
    std::vector<int> calls(count, 0);
    run_each(count, [&](std::size_t i) { ++calls[i]; });
    EXPECT_EQ(calls, std::vector<int>(count, 1));
  }
}

TEST(Parallel, RunsOneBesideTheOther) {
  std::atomic<bool> begun = false;
  std::atomic<bool> ended = false;
  EXPECT_TRUE(run_beside(
      [&] {
        begun = true;
        while (!ended) {
        }
      },
      [&] {
        while (!begun) {  // both run at the same time
        }
        ended = true;
      }));
  EXPECT_TRUE(begun);
}

}  // namespace
}  // namespace tenon
