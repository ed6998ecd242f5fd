// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/crate/row_index.h"

#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace tenon::formats::crate {
namespace {

/// Rows with their hashes: `same_hash` of them share one.
void compare_with_a_map(std::size_t values, std::size_t same_hash) {
  RowIndex index;
  std::map<std::size_t, std::uint32_t> map;
  std::vector<std::size_t> rows;
  std::mt19937 random(7);
  for (std::size_t i = 0; i < 3 * values; ++i) {
    const std::size_t value = random() % values;
    const RowHash hash = RowHash().with(value / same_hash);
    const auto next = static_cast<std::uint32_t>(rows.size());
    const std::uint32_t found =
        index.find_or_add(hash, next, [&](std::uint32_t number) { return rows[number] == value; });
    const auto [known, added] = map.try_emplace(value, next);
    ASSERT_EQ(found, added ? RowIndex::kNone : known->second);
    if (added) {
      rows.push_back(value);
    }
  }
}

TEST(RowIndex, AnswersLikeAMap) {
  compare_with_a_map(5000, 1);
  compare_with_a_map(500, 7);
  compare_with_a_map(60, 60);
}

TEST(RowIndex, GivesTheFirstOfEqualRows) {
  RowIndex index;
  const auto is_none = [](std::uint32_t) { return false; };
  const auto is_any = [](std::uint32_t) { return true; };
  for (std::uint32_t i = 0; i < 1000; ++i) {
    index.find_or_add(RowHash().with(i % 10), i, is_none);
  }
  for (std::uint32_t hash = 0; hash < 10; ++hash) {
    EXPECT_EQ(index.find_or_add(RowHash().with(hash), 5000, is_any), hash);
  }
}

}  // namespace
}  // namespace tenon::formats::crate
