// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/nearest_name.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(EditDistance, CountsLetters) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("info", "info"), 0u);
  EXPECT_EQ(edit_distance("inof", "info"), 1u);  // neighbours swapped
  EXPECT_EQ(edit_distance("check", "chek"), 1u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(NearestNameOf, IsTheOneThatWasProbablyMeant) {
  const std::vector<std::string_view> names = {"physics:mass", "physics:density", "radius"};
  EXPECT_EQ(nearest_name("physics:mas", names), "physics:mass");
  EXPECT_EQ(nearest_name("Physics:Mass", names), "physics:mass");
  EXPECT_EQ(nearest_name("physics:density", names), "");  // it is one of them
  EXPECT_EQ(nearest_name("width", names), "");
  EXPECT_EQ(nearest_name(std::string(1000, 'x'), names), "");
}

TEST(NearestNames, LookForNoMoreThanAThousand) {
  NearestNames nearest([] { return std::vector<std::string_view>{"radius"}; });
  EXPECT_EQ(nearest.find(Token("radiu")), "radius");
  for (int i = 0; i < 1000; ++i) {
    nearest.find(Token("radiu" + std::to_string(i)));
  }
  EXPECT_EQ(nearest.find(Token("adius")), "");
  EXPECT_EQ(nearest.find(Token("radiu")), "radius");  // known before
}

}  // namespace
}  // namespace tenon
