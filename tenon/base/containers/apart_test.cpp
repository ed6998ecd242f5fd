// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/containers/apart.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(Apart, IsUsedLikeAnOptional) {
  Apart<std::string> none;
  EXPECT_FALSE(none.has_value());
  EXPECT_FALSE(none);
  EXPECT_EQ(sizeof(none), sizeof(void*));
  Apart<std::string> one = std::string("a");
  EXPECT_TRUE(one);
  EXPECT_EQ(*one, "a");
  EXPECT_EQ(one->size(), 1u);
  EXPECT_NE(one, none);
  EXPECT_EQ(none.emplace(), "");
  *none = "a";
  EXPECT_EQ(one, none);
  none.reset();
  EXPECT_EQ(none, Apart<std::string>());
}

TEST(Apart, CopiesAreItsOwn) {
  Apart<std::string> first = std::string("a");
  Apart<std::string> copy = first;
  *copy += "b";
  EXPECT_EQ(*first, "a");
  first = copy;
  *copy += "c";
  EXPECT_EQ(*first, "ab");
  const Apart<std::string> moved = std::move(copy);
  EXPECT_EQ(*moved, "abc");
  first = Apart<std::string>();
  EXPECT_FALSE(first);
}

}  // namespace
}  // namespace tenon
