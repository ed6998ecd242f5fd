// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/terminal_text.h"

#include <gtest/gtest.h>

namespace tenon::cli {
namespace {

TEST(TerminalText, PlainTextAndOtherScriptsStay) {
  EXPECT_EQ(terminal_text("", true), "");
  EXPECT_EQ(terminal_text("a b\tc\n", true), "a b\tc\n");
  EXPECT_EQ(terminal_text("Größe 手 \xF0\x9F\xA4\x96", false), "Größe 手 \xF0\x9F\xA4\x96");
}

TEST(TerminalText, EscapesWhatActsOnATerminal) {
  EXPECT_EQ(terminal_text("\033[31mred\a", true), "\\x1b[31mred\\x07");
  EXPECT_EQ(terminal_text("a\rb\x7F", true), "a\\x0db\\x7f");
  EXPECT_EQ(terminal_text("a\nb\tc", false), "a\\x0ab\\x09c");
  EXPECT_EQ(terminal_text("\xC2\x9B", true), "\\x9b");  // CSI as one character
  EXPECT_EQ(terminal_text(std::string_view("a\0b", 3), true), "a\\x00b");
}

TEST(TerminalText, EscapesWhatReordersText) {
  EXPECT_EQ(terminal_text("a\u202Egnp.exe", true), "a\\u202egnp.exe");
  EXPECT_EQ(terminal_text("\u2066x\u2069\u200F\uFEFF\u2028", true),
            "\\u2066x\\u2069\\u200f\\ufeff\\u2028");
}

TEST(TerminalText, EscapesWhatIsNoUtf8) {
  EXPECT_EQ(terminal_text("\x9B", true), "\\x9b");
  EXPECT_EQ(terminal_text("\xC0\x9B", true), "\\xc0\\x9b");           // overlong
  EXPECT_EQ(terminal_text("\xE2\x80", true), "\\xe2\\x80");           // cut
  EXPECT_EQ(terminal_text("\xED\xA0\x80", true), "\\xed\\xa0\\x80");  // surrogate
}

}  // namespace
}  // namespace tenon::cli
