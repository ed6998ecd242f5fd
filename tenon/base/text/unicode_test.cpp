// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/unicode.h"

#include <string>

#include <gtest/gtest.h>

namespace tenon::unicode {
namespace {

TEST(Unicode, WhatIsAppendedIsDecodedAgain) {
  for (const char32_t code_point : {1, 0x41, 0x7F, 0x80, 0xE9, 0x7FF, 0x800, 0x20AC, 0xD7FF, 0xE000,
                                    0xFFFF, 0x10000, 0x1F916, 0x10FFFF}) {
    std::string text = "before";
    append(code_point, text);
    const Decoded decoded = decode(std::string_view(text).substr(6));
    EXPECT_EQ(decoded.code_point, code_point);
    EXPECT_EQ(decoded.length, text.size() - 6);
  }
}

TEST(Unicode, ASurrogateIsNoText) {
  std::string text;
  append(0xD800, text);
  EXPECT_FALSE(is_valid(text));
}

}  // namespace
}  // namespace tenon::unicode
