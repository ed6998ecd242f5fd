// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/containers/token_memo.h"

#include <string>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(TokenMemo, MakesOnceWhatIsAskedForAgain) {
  TokenMemo<std::string, 16> memo;
  int made = 0;
  const auto make = [&made](Token name) {
    ++made;
    return "<" + name.str() + ">";
  };
  EXPECT_EQ(memo.find_or_make("angular", make), "<angular>");
  EXPECT_EQ(memo.find_or_make("angular", make), "<angular>");
  EXPECT_EQ(made, 1);
  EXPECT_EQ(memo.find_or_make(Token(), make), "<>");  // as good a name as any
  EXPECT_EQ(memo.find_or_make(Token(), make), "<>");
  EXPECT_EQ(made, 2);
}

TEST(TokenMemo, GivesTheRightOneWhereNamesSharePlaces) {
  TokenMemo<std::string, 4> memo;
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 100; ++i) {
      const std::string name = "name" + std::to_string(i);
      EXPECT_EQ(memo.find_or_make(Token(name), [](Token token) { return token.str(); }), name);
    }
  }
}

}  // namespace
}  // namespace tenon
