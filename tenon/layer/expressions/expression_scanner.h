// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tenon/base/text/text_cursor.h"

namespace tenon::layer {

/// A read position in the text of a path expression. The first failure is kept; functions that
/// return bool return false after one, or when what they look for does not stand here.
class ExpressionScanner : public TextCursor {
 public:
  explicit ExpressionScanner(std::string_view text) : TextCursor(text) {}

  /// Blanks and tabs; true when there was one.
  bool blanks() {
    const std::size_t start = at_;
    while (peek() == ' ' || peek() == '\t') {
      ++at_;
    }
    return at_ > start;
  }
  /// An end of line ends an expression, too.
  bool at_end() const { return at_ >= text_.size() || peek() == '\n' || starts_with("\r\n"); }

  /// Takes `word` when no longer identifier starts here.
  bool accept_keyword(std::string_view word) {
    if (ascii_identifier() != word) {
      return false;
    }
    at_ += word.size();
    return true;
  }

  /// Keeps the first failure; always false.
  bool fail(std::string_view message) {
    if (error_.empty()) {
      error_ = "character " + std::to_string(at_ + 1) + ": " + std::string(message);
    }
    return false;
  }
  bool failed() const { return !error_.empty(); }
  const std::string& error() const { return error_; }

 private:
  std::string error_;
};

}  // namespace tenon::layer
