// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include "tenon/base/text/number_from_text.h"

namespace tenon::mesh {

/// Words of a text, line by line.
class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : rest_(text) {}

  std::uint32_t line() const { return line_; }

  /// Goes to the next line; false at the end. A backslash at the end of a line joins the next.
  bool next_line() {
    if (rest_.empty()) {
      return false;
    }
    std::size_t end = rest_.find('\n');
    line_ += 1 + joined_;
    joined_ = 0;
    while (end != std::string_view::npos && ends_in_backslash(end)) {
      ++joined_;
      end = rest_.find('\n', end + 1);
    }
    current_ = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view() : rest_.substr(end + 1);
    return true;
  }

  /// The next word of the line; empty at its end. A comment starts at '#'.
  std::string_view word() {
    std::size_t begin = 0;
    while (begin < current_.size() && is_space(current_[begin])) {
      ++begin;
    }
    std::size_t end = begin;
    while (end < current_.size() && !is_space(current_[end])) {
      ++end;
    }
    const std::string_view found = current_.substr(begin, end - begin);
    if (!found.empty() && found.front() == '#') {
      current_ = {};
      return {};
    }
    current_.remove_prefix(end);
    return found;
  }

  /// The rest of the line without white space around it.
  std::string_view rest_of_line() {
    std::string_view left = current_;
    current_ = {};
    while (!left.empty() && is_space(left.front())) {
      left.remove_prefix(1);
    }
    while (!left.empty() && is_space(left.back())) {
      left.remove_suffix(1);
    }
    return left;
  }

 private:
  static bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\\' || c == '\v' || c == '\f';
  }
  bool ends_in_backslash(std::size_t end) const {
    if (end > 0 && rest_[end - 1] == '\r') {
      --end;
    }
    return end > 0 && rest_[end - 1] == '\\';
  }

  std::string_view rest_;
  std::string_view current_;
  std::uint32_t line_ = 0;
  std::uint32_t joined_ = 0;
};

/// The number that all of `text` is, rounded once.
template <class T>
std::optional<T> number_of(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
  }
  T value{};
  const auto [end, error] = number_from_text(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    return std::nullopt;
  }
  return value;
}

}  // namespace tenon::mesh
