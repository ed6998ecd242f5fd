// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/containers/like_or_many.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace tenon::compose {
namespace {

struct Element {
  std::uint64_t number = 0;
  int kind = 0;
  bool operator==(const Element&) const = default;
};

using List = LikeOrMany<Element>;

std::vector<Element> contents(const List& list) { return {list.own().begin(), list.own().end()}; }

TEST(LikeOrMany, HasNothingAtFirst) {
  const List list;
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(list.size(), 0u);
  EXPECT_EQ(contents(list), std::vector<Element>());
  EXPECT_EQ(list.like(), nullptr);
  EXPECT_EQ(sizeof(List), sizeof(void*));
}

TEST(LikeOrMany, OneMayBeLikeAnother) {
  const Element shape{7, 1};
  List list;
  list.be_like(shape);
  EXPECT_EQ(list.size(), 1u);
  EXPECT_EQ(list.like(), &shape);
  EXPECT_TRUE(list.own().empty());
}

TEST(LikeOrMany, ManyAreItsOwn) {
  const std::array<Element, 3> elements{Element{1, 1}, Element{2, 2}, Element{3, 0}};
  List list;
  list.assign(elements);
  EXPECT_EQ(contents(list), std::vector<Element>(elements.begin(), elements.end()));
  list.own()[1].number = 5;
  EXPECT_EQ(contents(list)[1].number, 5u);
  EXPECT_EQ(elements[1].number, 2u);
  list.assign(std::span<const Element>(elements).first(1));
  EXPECT_EQ(list.size(), 1u);
  EXPECT_EQ(list.like(), nullptr);
  list.assign({});
  EXPECT_TRUE(list.empty());
}

TEST(LikeOrMany, MovesAndIsReplaced) {
  const Element shape{7, 1};
  const std::array<Element, 2> elements{Element{1, 0}, Element{2, 0}};
  List many;
  many.assign(elements);
  List like;
  like.be_like(shape);
  List taken = std::move(many);
  EXPECT_EQ(taken.size(), 2u);
  taken = std::move(like);
  EXPECT_EQ(taken.like(), &shape);
  taken.assign(elements);
  EXPECT_EQ(taken.like(), nullptr);
  taken.be_like(shape);
  EXPECT_EQ(taken.like(), &shape);
  taken.clear();
  EXPECT_TRUE(taken.empty());
}

}  // namespace
}  // namespace tenon::compose
