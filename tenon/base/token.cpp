// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Texts are kept once, found by a hash, and never freed: so two tokens are equal when they are one
// in memory. The table is in parts with a lock each, and threads remember what they asked for last.
#include "tenon/base/token.h"

#include <array>
#include <functional>
#include <mutex>
#include <new>

#include "tenon/base/assert.h"
#include "tenon/base/containers/tag_slots.h"
#include "tenon/base/text/text_hash.h"

namespace tenon {
namespace {

/// A part of the table of all names.
class TextTable {
 public:
  const TokenText* intern(std::string_view text, std::uint32_t tag,
                          NumberedStore<TokenText>& texts) {
    const std::lock_guard lock(mutex_);
    const std::uint32_t found = slots_.find_or_make(
        tag, [&](std::uint32_t number) { return texts[number].text == text; },
        [&] {
          static std::atomic<std::uint32_t> last = 0;
          const std::uint32_t number = last.fetch_add(1, std::memory_order_relaxed) + 1;
          TENON_ASSERT(number != 0);
          ::new (&texts.make_room(number)) TokenText{std::string(text), number};
          return number;
        });
    return &texts[found];
  }

 private:
  std::mutex mutex_;
  TagSlots slots_;
};

constexpr std::size_t kTextShards = 32;  // so that threads seldom wait for each other
constexpr std::size_t kRecentTexts = 512;

unsigned char lower(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 'A' && byte <= 'Z' ? static_cast<unsigned char>(byte + ('a' - 'A')) : byte;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct NumberRun {
  std::string_view digits;  // without leading zeros
  std::size_t length = 0;   // with them
};

NumberRun number_run(std::string_view text) {
  NumberRun run;
  while (run.length < text.size() && is_digit(text[run.length])) {
    ++run.length;
  }
  std::string_view digits = text.substr(0, run.length);
  while (digits.size() > 1 && digits.front() == '0') {
    digits.remove_prefix(1);
  }
  run.digits = digits;
  return run;
}

}  // namespace

// There before anything runs: tokens are made before main() too.
constinit NumberedStore<TokenText> Token::texts_;
constinit std::atomic<const TokenText*> Token::empty_{nullptr};

const TokenText* Token::intern(std::string_view text) {
  static auto* shards = new std::array<TextTable, kTextShards>();
  // What this thread asked for lately is found without a lock.
  thread_local std::array<const TokenText*, kRecentTexts> recent{};
  const std::uint64_t hash = text_hash(text);
  const TokenText*& last = recent[(hash >> 8) % kRecentTexts];
  if (last == nullptr || last->text != text) {
    TextTable& shard = (*shards)[(hash >> 40) % kTextShards];
    last = shard.intern(text, static_cast<std::uint32_t>(hash), texts_);
  }
  return last;
}

const TokenText* Token::intern_empty() {
  const TokenText* const text = intern("");
  empty_.store(text, std::memory_order_relaxed);
  return text;
}

Token::Token(std::string_view text) : text_(intern(text)) {}

bool dictionary_less(std::string_view a, std::string_view b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const NumberRun x = number_run(a.substr(i));
      const NumberRun y = number_run(b.substr(j));
      if (x.digits.size() != y.digits.size()) {
        return x.digits.size() < y.digits.size();
      }
      if (x.digits != y.digits) {
        return x.digits < y.digits;
      }
      i += x.length;
      j += y.length;
      continue;
    }
    const unsigned char x = lower(a[i]);
    const unsigned char y = lower(b[j]);
    if (x != y) {
      return x < y;
    }
    ++i;
    ++j;
  }
  if ((i < a.size()) != (j < b.size())) {
    return j < b.size();
  }
  return a < b;
}

}  // namespace tenon
