// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/quoted_text.h"

#include <string>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(QuotedText, ChoosesQuotesThatNeedNoEscapes) {
  EXPECT_EQ(tenon::quoted_text("a"), "\"a\"");
  EXPECT_EQ(tenon::quoted_text("a\"b"), "'a\"b'");
  EXPECT_EQ(tenon::quoted_text("a\"b'"), "\"a\\\"b'\"");
  EXPECT_EQ(tenon::quoted_text("a\nb"), "\"\"\"a\nb\"\"\"");
}

TEST(QuotedText, EndsAtAZeroByteInTheQuotesOfTheWhole) {
  EXPECT_EQ(tenon::quoted_text(std::string("a\0b\nc", 5)), "\"\"\"a\"\"\"");
  EXPECT_EQ(tenon::quoted_text(std::string("a\0b\"c", 5)), "'a'");
}

TEST(QuotedText, ComesBackWithoutItsEscapes) {
  for (const char* text : {"tab\t", "back\\slash", "\x01\x1f", "\xc3\xa9"}) {
    const std::string written = quoted_text(text);
    EXPECT_EQ(unescaped(written.substr(1, written.size() - 2)), text);
  }
}

}  // namespace
}  // namespace tenon
