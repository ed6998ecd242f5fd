// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/list_op.h"

#include <string>

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

struct Row {
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
  const Row rows[] = {
      {"", "", "", "", "", "abc", "abc"},     {"b", "", "", "", "", "abc", "ac"},
      {"", "bd", "", "", "", "abc", "abcd"},  {"", "", "dc", "", "", "abc", "dcab"},
      {"", "", "", "ad", "", "abc", "bcad"},  {"", "", "d", "e", "", "abc", "dabce"},
      {"a", "", "a", "", "", "abc", "abc"},   {"", "", "a", "a", "", "abc", "bca"},
      {"", "", "", "", "cb", "abcd", "acdb"}, {"", "", "", "", "xda", "abcd", "dabc"},
      {"", "", "", "", "", "", ""},           {"abc", "x", "y", "z", "zy", "abc", "zyx"},
  };
  for (const Row& row : rows) {
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

}  // namespace
}  // namespace tenon::layer
