// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/token.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(Token, EqualTextIsOneToken) {
  const std::string text = "radius";
  EXPECT_EQ(Token(text), Token("radius"));
  EXPECT_EQ(Token(text).id(), Token(std::string_view("radius")).id());
  EXPECT_NE(Token("radius"), Token("Radius"));
  EXPECT_TRUE(Token().empty());
  EXPECT_EQ(Token(), Token(""));
  EXPECT_LT(Token("a"), Token("b"));
  EXPECT_LT(Token("B"), Token("a"));
}

TEST(Token, IsTheSameInFourBytes) {
  const Token name("radius");
  const ShortToken brief = name;
  EXPECT_EQ(sizeof(brief), 4u);
  EXPECT_EQ(Token(brief), name);
  EXPECT_EQ(brief.str(), "radius");
  EXPECT_EQ(brief.view(), "radius");
  EXPECT_TRUE(brief == name);
  EXPECT_FALSE(brief == Token("height"));
  EXPECT_EQ(brief, ShortToken(Token("radius")));
  EXPECT_LT(ShortToken(Token("a")), ShortToken(Token("b")));
  EXPECT_LT(ShortToken(Token("B")), ShortToken(Token("a")));
  EXPECT_TRUE(Token(ShortToken()).empty());
}

TEST(Token, ThreadsGetTheSameTokens) {
  std::vector<std::vector<const void*>> ids(4);
  std::vector<std::thread> threads;
  for (auto& own : ids) {
    threads.emplace_back([&own] {
      for (int i = 0; i < 2000; ++i) {
        own.push_back(Token("thread_" + std::to_string(i)).id());
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  for (const auto& own : ids) {
    EXPECT_EQ(own, ids.front());
  }
}

TEST(Token, DictionaryOrderReadsNumbersAndIgnoresCaseAtFirst) {
  // Each row stands before the next one, as OpenUSD 26.11 sorts them.
  const char* const rows[] = {"_x", "a", "A9", "a9", "a10", "B", "b_1", "ba", "x", "x:a", "x:z"};
  for (std::size_t i = 0; i < std::size(rows); ++i) {
    for (std::size_t j = 0; j < std::size(rows); ++j) {
      EXPECT_EQ(dictionary_less(rows[i], rows[j]), i < j) << rows[i] << " < " << rows[j];
    }
  }
}

}  // namespace
}  // namespace tenon
