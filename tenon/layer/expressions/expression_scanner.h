// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tenon::layer {

/// A read position in the text of a path expression. The first failure is kept; functions that
/// return bool return false after one, or when what they look for does not stand here.
class ExpressionScanner {
 public:
  explicit ExpressionScanner(std::string_view text) : text_(text) {}

  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  std::size_t offset() const { return at_; }
  void seek(std::size_t offset) { at_ = offset; }
  bool starts_with(std::string_view word) const { return text_.substr(at_).starts_with(word); }
  std::string_view since(std::size_t start) const { return text_.substr(start, at_ - start); }

  bool accept(char c) {
    if (at_ < text_.size() && text_[at_] == c) {
      ++at_;
      return true;
    }
    return false;
  }
  bool accept(std::string_view word) {
    if (starts_with(word)) {
      at_ += word.size();
      return true;
    }
    return false;
  }
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

  static bool is_word_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  /// The identifier at the position, not taken; empty when there is none.
  std::string_view identifier() const {
    std::size_t end = at_;
    while (end < text_.size() && is_word_character(text_[end])) {
      ++end;
    }
    return is_digit(peek()) ? std::string_view() : text_.substr(at_, end - at_);
  }
  /// Takes `word` when no longer identifier starts here.
  bool accept_keyword(std::string_view word) {
    if (identifier() != word) {
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
  std::string_view text_;
  std::size_t at_ = 0;
  std::string error_;
};

}  // namespace tenon::layer
