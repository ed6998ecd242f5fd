// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tenon/base/assert.h"
#include "tenon/base/path.h"

namespace tenon {

/// Small values by path, in one array: no allocation for each of them, and paths that were made one
/// after another lie side by side. `Item` is copied while the table grows.
template <class Item>
class PathTable {
 public:
  std::size_t size() const { return count_; }

  /// What is there for `path`, until more is added; nullptr for nothing.
  const Item* find(Path path) const {
    if (slots_.empty()) {
      return nullptr;
    }
    const Slot& slot = slots_[slot_of(path)];
    return slot.path.empty() ? nullptr : &slot.item;
  }
  Item* find(Path path) { return const_cast<Item*>(std::as_const(*this).find(path)); }

  /// The same for a path that is there.
  const Item& at(Path path) const {
    const Item* const found = find(path);
    TENON_ASSERT(found != nullptr);
    return *found;
  }
  /// The same, made where there is nothing yet. The empty path has no place.
  Item& operator[](Path path) {
    TENON_ASSERT(!path.empty());
    if (is_full_with(count_ + 1, slots_.size())) {
      grow(slots_.empty() ? kFewest : 2 * slots_.size());
    }
    Slot& slot = slots_[slot_of(path)];
    if (slot.path.empty()) {
      slot.path = path;
      ++count_;
    }
    return slot.item;
  }

  /// Room for `count` without growing on the way.
  void reserve(std::size_t count) {
    std::size_t slot_count = slots_.empty() ? kFewest : slots_.size();
    while (is_full_with(count, slot_count)) {
      slot_count *= 2;
    }
    if (slot_count > slots_.size()) {
      grow(slot_count);
    }
  }

 private:
  static constexpr std::size_t kFewest = 16;

  struct Slot {
    Path path;  // empty in a free slot
    Item item{};
  };

  /// Fuller, paths are looked for in many slots where others pile up.
  static bool is_full_with(std::size_t count, std::size_t slot_count) {
    return 8 * count > 5 * slot_count;
  }

  /// Four neighbouring numbers share a line of the cache; such fours are scattered, so that long
  /// runs of numbers do not pile up.
  std::size_t slot_of(Path path) const {
    const std::uint32_t number = path.number();
    const std::uint64_t scattered = (std::uint64_t{number >> 2U} * 0x9E3779B97F4A7C15ULL) >> 32U;
    std::size_t at =
        static_cast<std::size_t>(scattered << 2U | (number & 3U)) & (slots_.size() - 1);
    while (!slots_[at].path.empty() && slots_[at].path != path) {
      at = (at + 1) & (slots_.size() - 1);
    }
    return at;
  }

  void grow(std::size_t slot_count) {
    const std::vector<Slot> before = std::exchange(slots_, std::vector<Slot>(slot_count));
    for (const Slot& slot : before) {
      if (!slot.path.empty()) {
        slots_[slot_of(slot.path)] = slot;
      }
    }
  }

  std::vector<Slot> slots_;  // open addressing
  std::size_t count_ = 0;
};

}  // namespace tenon
