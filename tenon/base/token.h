// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace tenon {

/// An interned name: equality and hashing cost one pointer. The text lives as long as the process.
class Token {
 public:
  Token() : text_(empty_.load(std::memory_order_relaxed)) {
    if (text_ == nullptr) {
      text_ = intern_empty();
    }
  }
  Token(std::string_view text);
  Token(const char* text) : Token(std::string_view(text)) {}
  Token(const std::string& text) : Token(std::string_view(text)) {}

  const std::string& str() const { return *text_; }
  std::string_view view() const { return *text_; }
  bool empty() const { return text_->empty(); }
  const void* id() const { return text_; }

  bool operator==(const Token& other) const { return text_ == other.text_; }
  bool operator==(std::string_view other) const { return *text_ == other; }
  bool operator==(const char* other) const { return *text_ == other; }
  /// Order of the text, byte by byte.
  std::strong_ordering operator<=>(const Token& other) const {
    return text_ == other.text_ ? std::strong_ordering::equal : *text_ <=> *other.text_;
  }

 private:
  static const std::string* intern_empty();

  static std::atomic<const std::string*> empty_;  // the text of Token(), once it was asked for
  const std::string* text_;
};

/// Order that OpenUSD uses for names in dictionaries of specs: letters without regard to case
/// first, runs of digits as numbers. "a2" < "a10".
bool dictionary_less(std::string_view a, std::string_view b);

}  // namespace tenon

template <>
struct std::hash<tenon::Token> {
  std::size_t operator()(const tenon::Token& token) const noexcept {
    const std::uint64_t bits = reinterpret_cast<std::uintptr_t>(token.id());
    return static_cast<std::size_t>((bits >> 4) * 0x9E3779B97F4A7C15ull);
  }
};
