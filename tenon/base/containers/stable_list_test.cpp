// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/containers/stable_list.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(StableList, KeepsItsElementsWhereTheyAre) {
  StableList<std::string> list;
  std::vector<const std::string*> places;
  for (int i = 0; i < 100; ++i) {
    std::string& added = list.emplace_back();
    added = std::to_string(i);
    places.push_back(&added);
  }
  const StableList<std::string> copy = list;
  ASSERT_EQ(list.size(), 100U);
  ASSERT_EQ(copy.size(), 100U);
  std::size_t at = 0;
  for (const std::string& each : list) {
    EXPECT_EQ(&each, places[at]);
    EXPECT_EQ(each, std::to_string(at));
    EXPECT_NE(&copy[at], &each);
    EXPECT_EQ(copy[at], each);
    ++at;
  }
  EXPECT_EQ(at, 100U);
  EXPECT_EQ(list.back(), "99");
  StableList<std::string> moved = std::move(list);
  EXPECT_TRUE(list.empty());  // NOLINT(bugprone-use-after-move): that is what is tested
  EXPECT_EQ(moved.size(), 100U);
  list.emplace_back() = "again";
  EXPECT_EQ(list[0], "again");
}

TEST(StableList, IsReadRowByRow) {
  StableList<int> list;
  for (int i = 0; i < 50; ++i) {
    list.emplace_back() = i;
  }
  for (std::size_t first = 0; first < 50; ++first) {
    for (std::size_t end = first + 1; end <= 50; ++end) {
      int next = static_cast<int>(first);
      for (std::size_t at = first; at < end;) {
        const std::span<const int> row = list.row(at, end);
        for (const int each : row) {
          EXPECT_EQ(each, next++);
        }
        at += row.size();
      }
      EXPECT_EQ(next, static_cast<int>(end));
    }
  }
}

TEST(StableList, TakesWhatAnotherHas) {
  StableList<std::string> list;
  StableList<std::string> other;
  for (int i = 0; i < 20; ++i) {
    list.emplace_back() = "own " + std::to_string(i);
  }
  for (int i = 0; i < 37; ++i) {
    other.emplace_back() = std::to_string(i);
  }
  const std::string* const place = &other[36];
  const std::size_t first = list.take_rows(std::move(other));
  EXPECT_TRUE(other.empty());  // NOLINT(bugprone-use-after-move): that is what is tested
  EXPECT_EQ(list.size(), first + 37);
  EXPECT_EQ(&list[first + 36], place);
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i], i < 20      ? "own " + std::to_string(i)
                       : i < first ? ""
                                   : std::to_string(i - first));
  }
  EXPECT_EQ(list.take_rows({}), list.size());
  list.emplace_back() = "last";
  EXPECT_EQ(list.back(), "last");
  list.pop_back();
  EXPECT_EQ(list.back(), "36");
  EXPECT_EQ(list.emplace_back(), "");
}

}  // namespace
}  // namespace tenon
