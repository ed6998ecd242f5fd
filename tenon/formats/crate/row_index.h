// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tenon::formats::crate {

/// A row's contents as a number. Seeded with the program's address in memory, so that nobody who
/// makes a layer can choose values that all fall into one slot of the tables. The output does not
/// depend on it.
class RowHash {
 public:
  RowHash() : bits_(reinterpret_cast<std::uintptr_t>(&kHere)) {}

  RowHash with(std::uint64_t word) const {
    const std::uint64_t bits = (bits_ ^ word) * 0x9E3779B97F4A7C15ULL;
    return RowHash(bits ^ (bits >> 32U));
  }
  std::uint32_t part() const { return static_cast<std::uint32_t>(bits_); }

 private:
  explicit RowHash(std::uint64_t bits) : bits_(bits) {}

  static constexpr char kHere = 0;
  std::uint64_t bits_;
};

/// Finds rows of a table by their contents. The caller has the rows and compares them; here are
/// parts of their hashes and their numbers, in one array: a table has a row for each value of a
/// layer, and an allocation for each would take longer than all else that is done with it.
class RowIndex {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  /// The number of the row with this hash that `is_equal(number)` says yes to, of several the one
  /// that was added first; kNone when there is none, and `added` is the number of a row from now
  /// on.
  template <class IsEqual>
  std::uint32_t find_or_add(RowHash hash, std::uint32_t added, const IsEqual& is_equal) {
    if (4 * (count_ + 1) > 3 * slots_.size()) {
      grow();
    }
    const std::uint32_t part = hash.part();
    std::size_t at = home_of(part);
    for (; slots_[at].number != kNone; at = after(at)) {
      if (slots_[at].part == part && is_equal(slots_[at].number)) {
        return slots_[at].number;
      }
    }
    slots_[at] = {part, added};
    ++count_;
    return kNone;
  }

 private:
  struct Slot {
    std::uint32_t part = 0;  // of the hash
    std::uint32_t number = kNone;
  };

  std::size_t after(std::size_t at) const { return (at + 1) & (slots_.size() - 1); }
  std::size_t home_of(std::uint32_t part) const { return part & (slots_.size() - 1); }

  /// From a free slot on once around: rows of one hash stay in the order in which they were added.
  void grow() {
    const std::size_t slot_count = slots_.empty() ? 16 : 2 * slots_.size();
    const std::vector<Slot> before = std::exchange(slots_, std::vector<Slot>(slot_count));
    std::size_t first = 0;
    while (first < before.size() && before[first].number != kNone) {
      ++first;
    }
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Slot& slot = before[(first + i) & (before.size() - 1)];
      if (slot.number == kNone) {
        continue;
      }
      std::size_t at = home_of(slot.part);
      while (slots_[at].number != kNone) {
        at = after(at);
      }
      slots_[at] = slot;
    }
  }

  std::vector<Slot> slots_;  // open addressing
  std::size_t count_ = 0;
};

}  // namespace tenon::formats::crate
