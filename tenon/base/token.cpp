// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/token.h"

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <limits>
#include <mutex>
#include <vector>

namespace tenon {
namespace {

/// A part of the table of all names: open addressing over texts in stable storage.
class TextTable {
 public:
  const std::string* intern(std::string_view text, std::size_t hash) {
    const std::lock_guard lock(mutex_);
    if (3 * (texts_.size() + 1) > 2 * slots_.size()) {
      grow();
    }
    std::size_t at = hash & (slots_.size() - 1);
    while (slots_[at].text != nullptr) {
      if (slots_[at].hash == hash && *slots_[at].text == text) {
        return slots_[at].text;
      }
      at = (at + 1) & (slots_.size() - 1);
    }
    slots_[at] = {hash, &texts_.emplace_back(text)};
    return slots_[at].text;
  }

 private:
  struct Slot {
    std::size_t hash = 0;
    const std::string* text = nullptr;
  };

  void grow() {
    std::vector<Slot> bigger(std::max<std::size_t>(64, 2 * slots_.size()));
    for (const Slot& slot : slots_) {
      if (slot.text == nullptr) {
        continue;
      }
      std::size_t at = slot.hash & (bigger.size() - 1);
      while (bigger[at].text != nullptr) {
        at = (at + 1) & (bigger.size() - 1);
      }
      bigger[at] = slot;
    }
    slots_ = std::move(bigger);
  }

  std::mutex mutex_;
  std::deque<std::string> texts_;
  std::vector<Slot> slots_;
};

constexpr std::size_t kTextShards = 32;  // so that threads seldom wait for each other
constexpr int kShardShift =
    std::numeric_limits<std::size_t>::digits - 24;  // bits of the hash above
constexpr std::size_t kRecentTexts = 512;

const std::string* intern(std::string_view text) {
  static auto* shards = new std::array<TextTable, kTextShards>();
  // What this thread asked for lately is found without a lock.
  thread_local std::array<const std::string*, kRecentTexts> recent{};
  const std::size_t hash = std::hash<std::string_view>{}(text);
  const std::string*& last = recent[(hash >> 8) % kRecentTexts];
  if (last == nullptr || *last != text) {
    last = (*shards)[(hash >> kShardShift) % kTextShards].intern(text, hash);
  }
  return last;
}

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
constinit std::atomic<const std::string*> Token::empty_{nullptr};

const std::string* Token::intern_empty() {
  const std::string* const text = intern("");
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
