// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/token.h"

#include <array>
#include <cctype>
#include <mutex>
#include <unordered_set>

namespace tenon {
namespace {

struct TextHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const {
    return std::hash<std::string_view>{}(text);
  }
};

using TextSet = std::unordered_set<std::string, TextHash, std::equal_to<>>;

/// The table of all names, in shards so that threads seldom wait for each other.
struct Shard {
  std::mutex mutex;
  TextSet texts;
};

constexpr std::size_t kShardCount = 32;

const std::string* intern(std::string_view text) {
  static auto* shards = new std::array<Shard, kShardCount>();
  const std::size_t hash = TextHash{}(text);
  Shard& shard = (*shards)[(hash >> 16) % kShardCount];
  const std::lock_guard lock(shard.mutex);
  auto found = shard.texts.find(text);
  if (found == shard.texts.end()) {
    found = shard.texts.emplace(text).first;
  }
  return &*found;
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

Token::Token() {
  static const std::string* empty = intern("");
  text_ = empty;
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
    const int x = std::tolower(static_cast<unsigned char>(a[i]));
    const int y = std::tolower(static_cast<unsigned char>(b[j]));
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
