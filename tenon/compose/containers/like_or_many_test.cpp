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
  Path path;
  bool operator==(const Element&) const = default;
};

using List = LikeOrMany<Element>;

std::vector<Element> contents(const List& list) { return {list.begin(), list.end()}; }

TEST(LikeOrMany, HasNothingAtFirst) {
  const List list;
  EXPECT_TRUE(list.empty());
  EXPECT_EQ(list.size(), 0u);
  EXPECT_EQ(contents(list), std::vector<Element>());
  EXPECT_EQ(list.like(), nullptr);
  EXPECT_LE(sizeof(List), 16u);
}

TEST(LikeOrMany, OneMayBeLikeAnother) {
  const Element shape{7, Path::from("/A")};
  List list;
  list.be_like(shape, Path::from("/B"));
  EXPECT_EQ(contents(list), (std::vector<Element>{{7, Path::from("/B")}}));
  EXPECT_EQ(list.front(), (Element{7, Path::from("/B")}));
  EXPECT_EQ(list.like(), &shape);
  EXPECT_TRUE(list.own().empty());
}

TEST(LikeOrMany, ManyAreItsOwn) {
  const std::array<Element, 3> elements{Element{1, Path::from("/A")}, Element{2, Path::from("/B")},
                                        Element{3, Path()}};
  List list;
  list.assign(elements);
  EXPECT_EQ(contents(list), std::vector<Element>(elements.begin(), elements.end()));
  list.own()[1].number = 5;
  EXPECT_EQ(list[1].number, 5u);
  EXPECT_EQ(elements[1].number, 2u);
  list.assign(std::span<const Element>(elements).first(1));
  EXPECT_EQ(list.size(), 1u);
  EXPECT_EQ(list.like(), nullptr);
  list.assign({});
  EXPECT_TRUE(list.empty());
}

TEST(LikeOrMany, MovesAndIsReplaced) {
  const Element shape{7, Path::from("/A")};
  const std::array<Element, 2> elements{Element{1, Path()}, Element{2, Path()}};
  List many;
  many.assign(elements);
  List like;
  like.be_like(shape, Path::from("/B"));
  List taken = std::move(many);
  EXPECT_EQ(taken.size(), 2u);
  taken = std::move(like);
  EXPECT_EQ(contents(taken), (std::vector<Element>{{7, Path::from("/B")}}));
  taken.assign(elements);
  taken.be_like(shape, Path::from("/C"));
  EXPECT_EQ(taken.front().path, Path::from("/C"));
  taken.clear();
  EXPECT_TRUE(taken.empty());
}

}  // namespace
}  // namespace tenon::compose
