// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tenon/base/containers/numbered_store.h"

namespace tenon {

/// The text of a token, stored once. Internal to Token.
struct TokenText {
  std::string text;
  std::uint32_t number = 0;  ///< counts up as texts are met, from 1 on
};

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

  const std::string& str() const { return text_->text; }
  std::string_view view() const { return text_->text; }
  bool empty() const { return text_->text.empty(); }
  const void* id() const { return text_; }
  /// The token as a number of four bytes; never 0.
  std::uint32_t number() const { return text_->number; }
  static Token numbered(std::uint32_t number) { return Token(&texts_[number]); }

  bool operator==(const Token& other) const { return text_ == other.text_; }
  bool operator==(std::string_view other) const { return text_->text == other; }
  bool operator==(const char* other) const { return text_->text == other; }
  /// Order of the text, byte by byte.
  std::strong_ordering operator<=>(const Token& other) const {
    return text_ == other.text_ ? std::strong_ordering::equal : text_->text <=> other.text_->text;
  }

 private:
  explicit Token(const TokenText* text) : text_(text) {}
  static const TokenText* intern(std::string_view text);
  static const TokenText* intern_empty();

  static NumberedStore<TokenText> texts_;
  static std::atomic<const TokenText*> empty_;  // the text of Token(), once it was asked for
  const TokenText* text_;
};

/// A token in four bytes, for what there is much of.
class ShortToken {
 public:
  ShortToken() : ShortToken(Token()) {}
  ShortToken(Token token) : number_(token.number()) {}

  operator Token() const { return Token::numbered(number_); }
  const std::string& str() const { return Token(*this).str(); }
  std::string_view view() const { return Token(*this).view(); }

  bool operator==(const ShortToken& other) const = default;
  bool operator==(const Token& other) const { return number_ == other.number(); }
  /// Order of the text, byte by byte.
  std::strong_ordering operator<=>(const ShortToken& other) const {
    return Token(*this) <=> Token(other);
  }

 private:
  std::uint32_t number_;
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
