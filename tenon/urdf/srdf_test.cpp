// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/urdf/srdf.h"

#include <gtest/gtest.h>

namespace tenon::urdf {
namespace {

TEST(Srdf, WrittenPairsAreReadAgain) {
  const std::vector<DisabledCollision> pairs = {{"palm", "thumb", "Adjacent"},
                                                {"a<b", "\"c\" & d", "Never"}};
  const std::string text = write_srdf("the & hand", pairs);
  Diagnostics diagnostics;
  const auto read = read_srdf_text(text, "hand.srdf", diagnostics);
  ASSERT_TRUE(read.has_value()) << read.error().to_string();
  ASSERT_EQ(read->size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ((*read)[i].link1, pairs[i].link1);
    EXPECT_EQ((*read)[i].link2, pairs[i].link2);
    EXPECT_EQ((*read)[i].reason, pairs[i].reason);
    EXPECT_EQ((*read)[i].place.line, i + 3);
  }
  EXPECT_TRUE(diagnostics.empty());
}

TEST(Srdf, WhatIsForMoveItAloneIsSkipped) {
  Diagnostics diagnostics;
  const auto read = read_srdf_text(
      "<robot name=\"r\"><group name=\"arm\"><disable_collisions link1=\"x\" link2=\"y\"/></group>"
      "<disable_collisions link1=\"a\" link2=\"b\"/><virtual_joint name=\"v\"/></robot>",
      "r.srdf", diagnostics);
  ASSERT_TRUE(read.has_value());
  ASSERT_EQ(read->size(), 1u);
  EXPECT_EQ((*read)[0].link1, "a");
  EXPECT_EQ((*read)[0].reason, "");
}

void expect_error(const std::string& text, const std::string& rule, std::uint32_t line) {
  Diagnostics diagnostics;
  const auto read = read_srdf_text(text, "r.srdf", diagnostics);
  ASSERT_FALSE(read.has_value()) << text;
  EXPECT_EQ(read.error().diagnostic().rule, rule) << text;
  EXPECT_EQ(read.error().diagnostic().file, "r.srdf");
  EXPECT_EQ(read.error().diagnostic().line, line) << text;
}

TEST(Srdf, BrokenTextIsAnErrorWithItsLine) {
  expect_error("", "srdf.xml", 1);
  expect_error("<robot>\n<disable_collisions link1=", "srdf.xml", 2);
  expect_error("\n<sdf/>", "srdf.root", 2);
  expect_error("<robot>\n\n<disable_collisions link1=\"a\"/>\n</robot>", "urdf.missing", 3);
  expect_error(std::string(100'000, '<'), "srdf.xml", 1);
}

}  // namespace
}  // namespace tenon::urdf
