// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "tenon/base/text/text_cursor.h"

namespace tenon::formats::text {

/// Walks over text that is known to be a layer's. Knows just enough of the grammar to skip what may
/// contain brackets without meaning them: comments, strings and asset paths.
class Scanner : public TextCursor {
 public:
  Scanner(std::string_view text, std::size_t at) : TextCursor(text, at) {}

  void skip_blanks_and_comments() {
    while (!at_end() &&
           (is_blank(peek()) || peek() == '#' || starts_with("//") || starts_with("/*"))) {
      if (starts_with("/*")) {
        to_after("*/", 2);
      } else if (is_blank(peek())) {
        ++at_;
      } else {
        at_ = std::min(text_.find('\n', at_), text_.size());
      }
    }
  }

  /// Past the next word, string, asset path or single sign.
  std::string_view next() {
    skip_blanks_and_comments();
    const std::size_t start = at_;
    if (at_end()) {
      return {};
    }
    const char c = peek();
    if (c == '"' || c == '\'') {
      skip_string(c);
    } else if (c == '@') {
      starts_with("@@@") ? to_after("@@@", 3) : to_after("@", 1);
    } else if (is_word(c)) {
      while (is_word(peek())) {
        ++at_;
      }
    } else {
      ++at_;
    }
    return text_.substr(start, at_ - start);
  }

  /// After an opening bracket was taken: past its partner. False at the end of the text.
  bool skip_block() {
    std::size_t depth = 1;
    while (depth > 0 && !at_end()) {
      const std::string_view token = next();
      depth += token == "(" || token == "{" || token == "[" ? 1u : 0u;
      depth -= token == ")" || token == "}" || token == "]" ? 1u : 0u;
    }
    return depth == 0;
  }

  /// A byte of names and numbers.
  static bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == ':' || static_cast<unsigned char>(c) >= 0x80;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void to_after(std::string_view end, std::size_t from) {
    const std::size_t found = text_.find(end, at_ + from);
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
  }
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool triple = starts_with(three);
    at_ += triple ? 3 : 1;
    while (!at_end()) {
      if (peek() == '\\') {
        at_ += 2;
      } else if (triple ? starts_with(three) : peek() == quote) {
        at_ += triple ? 3 : 1;
        return;
      } else {
        ++at_;
      }
    }
    at_ = text_.size();
  }
};

}  // namespace tenon::formats::text
