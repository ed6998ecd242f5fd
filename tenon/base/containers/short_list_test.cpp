// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/containers/short_list.h"

#include <vector>

#include <gtest/gtest.h>

namespace tenon {
namespace {

using Numbers = ShortList<int, 3>;

std::vector<int> all(const Numbers& list) {
  const std::vector<int> backwards(list.rbegin(), list.rend());
  std::vector<int> elements(list.begin(), list.end());
  EXPECT_EQ(std::vector<int>(elements.rbegin(), elements.rend()), backwards);
  return elements;
}

Numbers numbers_to(int end) {
  Numbers list;
  for (int i = 0; i < end; ++i) {
    list.push_back(i);
  }
  return list;
}

std::vector<int> slow_numbers_to(int end) {
  std::vector<int> list;
  for (int i = 0; i < end; ++i) {
    list.push_back(i);
  }
  return list;
}

TEST(ShortList, HoldsWhatAVectorHolds) {
  for (const int count : {0, 1, 3, 4, 7, 100}) {
    Numbers list = numbers_to(count);
    std::vector<int> slow = slow_numbers_to(count);
    EXPECT_EQ(all(list), slow);
    list.erase_if([](int i) { return i % 2 == 1; });
    std::erase_if(slow, [](int i) { return i % 2 == 1; });
    EXPECT_EQ(all(list), slow);
    while (!list.empty()) {
      ASSERT_EQ(list.size(), slow.size());
      EXPECT_EQ(list.back(), slow.back());
      list.pop_back();
      slow.pop_back();
    }
    EXPECT_TRUE(slow.empty());
  }
}

TEST(ShortList, MovesWithItsElementsAndLeavesNone) {
  for (const int count : {0, 2, 3, 9}) {
    Numbers list = numbers_to(count);
    Numbers moved = std::move(list);
    EXPECT_EQ(all(moved), slow_numbers_to(count));
    EXPECT_TRUE(list.empty());  // NOLINT(bugprone-use-after-move): that is what is tested
    list.push_back(5);
    EXPECT_EQ(list.size(), 1u);
    Numbers assigned(7);
    assigned = std::move(moved);
    EXPECT_EQ(all(assigned), slow_numbers_to(count));
  }
}

TEST(ShortList, AssignsEqualElements) {
  Numbers list = numbers_to(2);
  list.assign(5, 8);
  EXPECT_EQ(all(list), std::vector<int>(5, 8));
  list.assign(1, 9);
  EXPECT_EQ(all(list), std::vector<int>(1, 9));
  list.resize(4, 6);
  EXPECT_EQ(all(list), (std::vector<int>{9, 6, 6, 6}));
  list.resize(2, 1);
  EXPECT_EQ(all(list), (std::vector<int>{9, 6}));
  list[0] = 4;
  EXPECT_EQ(list[0], 4);
}

}  // namespace
}  // namespace tenon
