// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/spec/field_list.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace tenon::layer {
namespace {

using Plain = std::vector<std::pair<std::string, int>>;

FieldList list_of(const Plain& plain) {
  FieldList list;
  for (const auto& [name, number] : plain) {
    list.append(Token(name), Value(number));
  }
  return list;
}

/// What the list has, asked for in each way.
Plain contents(const FieldList& list) {
  Plain found;
  const FieldRange items = list.items();
  for (const Field& field : items) {
    EXPECT_EQ(&items[found.size()], &field);
    EXPECT_EQ(list.find(field.name), &field.value);
    found.emplace_back(field.name.str(), field.value.get_or(-1));
  }
  EXPECT_EQ(items.size(), found.size());
  EXPECT_EQ(items.empty(), found.empty());
  EXPECT_EQ(list.find("none"), nullptr);
  return found;
}

/// The same fields, kept in each of the ways there are.
std::vector<FieldList> ways(const Plain& plain) {
  std::vector<FieldList> lists{list_of(plain)};
  for (std::size_t shared = 0; shared <= plain.size(); ++shared) {
    const auto turn = plain.begin() + static_cast<std::ptrdiff_t>(shared);
    FieldList list(list_of({plain.begin(), turn}), 1);
    for (auto more = turn; more != plain.end(); ++more) {
      list.append(Token(more->first), Value(more->second));
    }
    lists.push_back(std::move(list));
    lists.emplace_back(lists.back(), 2);  // shared with one that shares
  }
  std::vector<Field> fields;
  std::vector<std::uint32_t> runs{FieldTable::kEnd};
  for (auto field = plain.rbegin(); field != plain.rend(); ++field) {
    fields.push_back({Token(field->first), Value(field->second)});
  }
  for (std::size_t i = plain.size(); i > 0; --i) {
    runs.push_back(static_cast<std::uint32_t>(i - 1));
  }
  runs.push_back(FieldTable::kEnd);
  FieldTable* const table = FieldTable::make(std::move(fields), runs);
  lists.push_back(table->list(1));
  lists.push_back(table->list(1));
  EXPECT_TRUE(contents(table->list(0)).empty());
  table->release();
  return lists;
}

TEST(FieldList, IsTheSameHoweverItIsKept) {
  const Plain plain{{"a", 1}, {"b", 2}, {"c", 3}};
  for (const Plain& some : {Plain(), Plain(plain.begin(), plain.begin() + 1), plain}) {
    for (const FieldList& list : ways(some)) {
      EXPECT_EQ(contents(list), some);
    }
  }
}

TEST(FieldList, ChangesAloneHoweverItIsKept) {
  const Plain plain{{"a", 1}, {"b", 2}, {"c", 3}};
  const std::vector<FieldList> lists = ways(plain);
  for (const FieldList& list : lists) {
    FieldList copy = list;
    EXPECT_TRUE(copy.is_same(list));
    for (int i = 0; i < 6; ++i) {
      copy.append(Token("d" + std::to_string(i)), Value(i));
    }
    copy.erase("b");
    copy.own_items()[0].value = Value(7);
    EXPECT_FALSE(copy.is_same(list));
    EXPECT_EQ(
        contents(copy),
        (Plain{
            {"a", 7}, {"c", 3}, {"d0", 0}, {"d1", 1}, {"d2", 2}, {"d3", 3}, {"d4", 4}, {"d5", 5}}));
    FieldList without = list;
    without.erase("none");
    EXPECT_TRUE(without.is_same(list));
  }
  for (const FieldList& list : lists) {
    EXPECT_EQ(contents(list), plain);
  }
}

}  // namespace
}  // namespace tenon::layer
