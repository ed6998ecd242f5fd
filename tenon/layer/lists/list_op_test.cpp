// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/lists/list_op.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tenon::layer {
namespace {

using Names = std::vector<std::string>;

Names letters(const char* text) {
  Names names;
  for (; *text != '\0'; ++text) {
    names.emplace_back(1, *text);
  }
  return names;
}

struct Edits {
  const char* deleted;
  const char* added;
  const char* prepended;
  const char* appended;
  const char* ordered;
  const char* before;
  const char* after;
};

TEST(ListOp, EditsApplyInTheirOrder) {
  // Results as OpenUSD 26.11 gives them.
  const Edits rows[] = {
      {"", "", "", "", "", "abc", "abc"},     {"b", "", "", "", "", "abc", "ac"},
      {"", "bd", "", "", "", "abc", "abcd"},  {"", "", "dc", "", "", "abc", "dcab"},
      {"", "", "", "ad", "", "abc", "bcad"},  {"", "", "d", "e", "", "abc", "dabce"},
      {"a", "", "a", "", "", "abc", "abc"},   {"", "", "a", "a", "", "abc", "bca"},
      {"", "", "", "", "cb", "abcd", "acdb"}, {"", "", "", "", "xda", "abcd", "dabc"},
      {"", "", "", "", "", "", ""},           {"abc", "x", "y", "z", "zy", "abc", "zyx"},
  };
  for (const Edits& row : rows) {
    ListOp<std::string> op;
    op.deleted = letters(row.deleted);
    op.added = letters(row.added);
    op.prepended = letters(row.prepended);
    op.appended = letters(row.appended);
    op.ordered = letters(row.ordered);
    Names list = letters(row.before);
    op.apply_to(list);
    EXPECT_EQ(list, letters(row.after)) << row.before << " -> " << row.after;
  }
}

TEST(ListOp, AnExplicitListReplacesAll) {
  Names list = letters("abc");
  const auto op = ListOp<std::string>::make_explicit(letters("xyx"));
  op.apply_to(list);
  EXPECT_EQ(list, letters("xy"));
  const auto nothing = ListOp<std::string>::make_explicit({});
  EXPECT_FALSE(nothing.empty());
  nothing.apply_to(list);
  EXPECT_TRUE(list.empty());
  EXPECT_TRUE(ListOp<std::string>().empty());
}

/// "i<from>" to "i<to - 1>".
Names numbered(int from, int to) {
  Names names;
  for (int i = from; i < to; ++i) {
    names.push_back("i" + std::to_string(i));
  }
  return names;
}

TEST(ListOp, LongListsFollowTheSameRules) {
  ListOp<std::string> op;
  op.deleted = numbered(0, 30);
  op.added = {"i40", "new", "new"};
  op.prepended = {"front", "i50", "front"};
  op.appended = {"i31", "back", "i31"};
  op.ordered = {"i60", "absent", "i55"};
  Names list = numbered(0, 100);
  op.apply_to(list);
  // What follows an ordered item goes with it: i60 to the end, then i55 to i59.
  Names expected = {"front", "i50", "i30"};
  for (const auto& [from, to] : {std::pair(32, 50), std::pair(51, 55), std::pair(60, 100)}) {
    const Names part = numbered(from, to);
    expected.insert(expected.end(), part.begin(), part.end());
  }
  expected.insert(expected.end(), {"new", "back", "i31"});
  const Names moved = numbered(55, 60);
  expected.insert(expected.end(), moved.begin(), moved.end());
  EXPECT_EQ(list, expected);
}

/// An item that counts how often it was compared: the work of an edit.
struct Counted {
  int number = 0;
  static inline std::size_t comparisons = 0;
  bool operator==(const Counted& other) const {
    ++comparisons;
    return number == other.number;
  }
  std::size_t hash() const { return static_cast<std::size_t>(number); }
};

std::vector<Counted> counted(int from, int to) {
  std::vector<Counted> items;
  for (int i = from; i < to; ++i) {
    items.push_back({i});
  }
  return items;
}

TEST(ListOp, TheWorkOfLongListsGrowsAsTheyDo) {
  constexpr int kItems = 20'000;
  ListOp<Counted> op;
  op.deleted = counted(0, kItems / 2);
  op.added = counted(kItems, 2 * kItems);
  op.prepended = counted(kItems / 2, kItems);
  op.appended = counted(kItems, kItems + kItems / 2);
  op.ordered = counted(kItems / 2, 2 * kItems);
  std::reverse(op.ordered.begin(), op.ordered.end());
  std::vector<Counted> list = counted(0, kItems);
  Counted::comparisons = 0;
  op.apply_to(list);
  ListOp<Counted>::make_explicit(counted(0, kItems)).apply_to(list);
  EXPECT_EQ(list.size(), static_cast<std::size_t>(kItems));
  EXPECT_LT(Counted::comparisons, 40u * kItems);
}

}  // namespace
}  // namespace tenon::layer
