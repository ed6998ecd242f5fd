// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "tenon/base/assert.h"
#include "tenon/base/path.h"
#include "tenon/base/paths/path_slots.h"

namespace tenon {

/// Small values by path, in one array: no allocation for each of them, and paths that were made one
/// after another lie side by side. `Item` is copied while the table grows.
template <class Item>
class PathTable {
 public:
  std::size_t size() const { return count_; }

  /// What is there for `path`, until more is added; nullptr for nothing, and for the empty path.
  const Item* find(Path path) const {
    std::size_t at = places_.home(path.number());
    for (std::size_t left = places_.reach(); left > 0; --left, at = places_.next(at)) {
      const Slot& slot = slots_[at];
      if (slot.path.empty()) {
        break;
      }
      if (slot.path == path) {
        return &slot.item;
      }
    }
    return nullptr;
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
    if (Item* const there = find(path)) {
      return *there;
    }
    ++count_;
    Item* made = put({path, {}});
    if (made == nullptr) {
      fill(places_.scattered(), slots_.size());
      made = find(path);
    }
    return *made;
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

  /// Null, though it was put in, when paths pile up.
  Item* put(const Slot& slot) {
    const std::size_t home = places_.home(slot.path.number());
    std::size_t at = home;
    while (!slots_[at].path.empty()) {
      at = places_.next(at);
    }
    slots_[at] = slot;
    return places_.note(home, at) ? &slots_[at].item : nullptr;
  }

  void grow(std::size_t slot_count) {
    std::uint32_t least = 0xFFFFFFFFu;
    std::uint32_t most = 0;
    for (const Slot& slot : slots_) {
      const std::uint32_t number = slot.path.number();
      least = slot.path.empty() || number > least ? least : number;
      most = number > most ? number : most;
    }
    fill(PathSlots(slot_count, least, most), slot_count);
  }

  void fill(PathSlots places, std::size_t slot_count) {
    const std::vector<Slot> before = std::exchange(slots_, std::vector<Slot>(slot_count));
    places_ = places;
    for (const Slot& slot : before) {
      if (!slot.path.empty()) {
        put(slot);
      }
    }
  }

  std::vector<Slot> slots_;  // open addressing
  PathSlots places_;
  std::size_t count_ = 0;
};

}  // namespace tenon
