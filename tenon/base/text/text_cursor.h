// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace tenon {

/// A read position in a text: what every reader of a grammar begins with. Behind the end stands
/// '\0'.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text, std::size_t at = 0) : text_(text), at_(at) {}

  std::string_view text() const { return text_; }
  std::size_t offset() const { return at_; }
  void seek(std::size_t offset) { at_ = offset; }
  void advance(std::size_t count = 1) { at_ += count; }
  bool at_end() const { return at_ >= text_.size(); }
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  std::string_view rest() const { return text_.substr(at_); }
  std::string_view since(std::size_t start) const { return text_.substr(start, at_ - start); }
  bool starts_with(std::string_view word) const { return text_.substr(at_).starts_with(word); }

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

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_word_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
  }
  /// The identifier of ASCII letters here, not taken; empty when there is none.
  std::string_view ascii_identifier() const {
    std::size_t end = at_;
    while (end < text_.size() && is_word_character(text_[end])) {
      ++end;
    }
    return is_digit(peek()) ? std::string_view() : text_.substr(at_, end - at_);
  }

 protected:
  std::string_view text_;
  std::size_t at_;
};

}  // namespace tenon
