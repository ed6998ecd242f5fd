// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/name_pattern.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

bool matches(const std::string& pattern, const char* path) {
  return NamePattern::parse(pattern)->matches(*Path::parse(path));
}

TEST(NamePattern, MeansAPathANameOrAnExpressionForTheWhole) {
  EXPECT_TRUE(matches("/hand/Physics/thumb", "/hand/Physics/thumb"));
  EXPECT_TRUE(matches("thumb", "/hand/Physics/thumb"));
  EXPECT_FALSE(matches("thum", "/hand/Physics/thumb"));
  EXPECT_TRUE(matches("th.*", "/hand/Physics/thumb"));
  EXPECT_TRUE(matches("index|thumb", "/hand/Physics/thumb"));
  EXPECT_TRUE(matches("/hand/.*", "/hand/Physics/thumb"));
  EXPECT_FALSE(matches("hand", "/hand/Physics/thumb"));
}

TEST(NamePattern, MatchesNamesThatNoPrimHas) {
  EXPECT_TRUE(NamePattern::parse("left arm/.*")->matches_text("left arm/elbow"));
  EXPECT_TRUE(NamePattern::parse("a+b")->matches_text("a+b"));  // the name itself
  EXPECT_FALSE(NamePattern::parse("elbow")->matches_text("left arm/elbow"));
}

TEST(NamePattern, AParenthesisTooManyMatchesNoPartOfAName) {
  for (const char* text : {"a)|b", "a)|(b", "thumb)|(x", "x)|humb", "x)|(thum"}) {
    const auto pattern = NamePattern::parse(text);
    EXPECT_FALSE(pattern && pattern->matches_text("thumb")) << text;
    EXPECT_FALSE(pattern && pattern->matches_text("ab")) << text;
  }
  EXPECT_FALSE(NamePattern::parse("a)|(b"));
  EXPECT_TRUE(NamePattern::parse("a|ab|b")->matches_text("ab"));  // the longest one, not the first
  EXPECT_TRUE(NamePattern::parse("a|(ab)?c?")->matches_text("abc"));
  EXPECT_FALSE(NamePattern::parse("a*")->matches_text("ba"));
  EXPECT_TRUE(NamePattern::parse("^th.*b$")->matches_text("thumb"));
}

TEST(NamePattern, SaysWhatIsWrongWithOne) {
  for (const char* text : {"", "(", "[a", "(a)\\1"}) {
    const auto pattern = NamePattern::parse(text);
    ASSERT_FALSE(pattern) << text;
    EXPECT_EQ(pattern.error().diagnostic().rule, "name.bad-pattern") << text;
  }
  EXPECT_FALSE(NamePattern::parse(std::string(2000, 'a')));
}

TEST(NamePattern, RefusesRepetitionsThatTakeGigabytes) {
  for (const char* text : {"(((a{1000}){1000}){1000})", "(a*){3000}", "(([ab]{9,99}){99}){9}",
                           "a{1001}", "a{0,99999999999999999999}", "(a{40}{40})"}) {
    const auto pattern = NamePattern::parse(text);
    ASSERT_FALSE(pattern) << text;
    EXPECT_NE(pattern.error().message().find("written out"), std::string::npos) << text;
  }
  EXPECT_TRUE(NamePattern::parse("tip_[0-9]{2}_(a|b){1,2}")->matches_text("tip_07_a"));
  EXPECT_TRUE(NamePattern::parse("(ab){3}[]{]\\{")->matches_text("ababab]{"));
  EXPECT_TRUE(NamePattern::parse("a{300}")->matches_text(std::string(300, 'a')));
}

}  // namespace
}  // namespace tenon
