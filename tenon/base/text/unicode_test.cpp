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

/// One code point after another, as the classes define it.
std::size_t length_by_classes(std::string_view text) {
  std::size_t at = 0;
  for (Decoded c = decode(text); c.length != 0; c = decode(text.substr(at))) {
    if (!(at == 0 ? starts_identifier(c.code_point) : continues_identifier(c.code_point))) {
      break;
    }
    at += c.length;
  }
  return at;
}

TEST(Unicode, AnIdentifierIsTakenAsItsClassesSay) {
  const std::string parts[] = {"a",        "Z",        "_",    "0",        "9",
                               ".",        ":",        " ",    "\xC3\xA9", "\xE4\xBA\xBA",
                               "\xC2\xB7", "\xC3\x97", "\xFF", "\xC3",     std::string(1, '\0'),
                               "{"};
  std::size_t count = 0;
  for (const std::string& a : parts) {
    for (const std::string& b : parts) {
      for (const std::string& c : parts) {
        const std::string text = a + b + c;
        EXPECT_EQ(identifier_length(text), length_by_classes(text)) << text;
        count += identifier_length(text) != 0 ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(count, 1000U);
  EXPECT_EQ(identifier_length(""), 0U);
}

}  // namespace
}  // namespace tenon::unicode
