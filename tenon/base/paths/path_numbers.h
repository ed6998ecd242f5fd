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

/// Numbers, from 1 on, of things by the path that each of them has: four bytes a slot, since the
/// paths are not kept here. `path_of(number)` tells that of a number that was entered before,
/// always the same one, or the empty path once the thing is gone.
class PathNumbers {
 public:
  /// The number of what has the path; 0 for nothing, and for the empty path.
  template <class PathOf>
  std::uint32_t find(Path path, const PathOf& path_of) const {
    const std::uint32_t* const slot = find_slot(path, path_of);
    return slot == nullptr ? 0 : *slot;
  }

  /// Enters the number of what has the path, in place of what had it before.
  template <class PathOf>
  void put(Path path, std::uint32_t number, const PathOf& path_of) {
    if (const std::uint32_t* const there = find_slot(path, path_of)) {
      slots_[static_cast<std::size_t>(there - slots_.data())] = number;
    } else {
      add(path, number, path_of);
    }
  }

  /// The number of what has the path; `number`, which is then entered, where nothing has it.
  template <class PathOf>
  std::uint32_t find_or_put(Path path, std::uint32_t number, const PathOf& path_of) {
    if (const std::uint32_t* const there = find_slot(path, path_of)) {
      return *there;
    }
    add(path, number, path_of);
    return number;
  }

  /// Room for `count` without growing on the way.
  template <class PathOf>
  void reserve(std::size_t count, const PathOf& path_of) {
    std::size_t slot_count = slots_.empty() ? kFewest : slots_.size();
    while (is_full_with(count, slot_count)) {
      slot_count *= 2;
    }
    if (slot_count > slots_.size()) {
      grow(slot_count, path_of);
    }
  }

 private:
  static constexpr std::size_t kFewest = 64;

  /// Fuller, paths are looked for in many slots where others pile up.
  static bool is_full_with(std::size_t count, std::size_t slot_count) {
    return 8 * count > 5 * slot_count;
  }

  template <class PathOf>
  const std::uint32_t* find_slot(Path path, const PathOf& path_of) const {
    std::size_t at = places_.home(path.number());
    for (std::size_t left = path.empty() ? 0 : places_.reach(); left > 0; --left) {
      if (slots_[at] == 0) {
        return nullptr;
      }
      if (path_of(slots_[at]) == path) {
        return &slots_[at];
      }
      at = places_.next(at);
    }
    return nullptr;
  }

  template <class PathOf>
  void add(Path path, std::uint32_t number, const PathOf& path_of) {
    TENON_ASSERT(!path.empty() && number != 0);
    if (is_full_with(count_ + 1, slots_.size())) {
      grow(slots_.empty() ? kFewest : 2 * slots_.size(), path_of);
    }
    if (!place(path, number)) {
      fill(places_.scattered(), slots_.size(),
           [&](std::uint32_t each) { return each == number ? path : path_of(each); });
    }
  }

  /// False, though it was put in, when paths pile up.
  bool place(Path path, std::uint32_t number) {
    const std::size_t home = places_.home(path.number());
    std::size_t at = home;
    while (slots_[at] != 0) {
      at = places_.next(at);
    }
    slots_[at] = number;
    ++count_;
    return places_.note(home, at);
  }

  template <class PathOf>
  void grow(std::size_t slot_count, const PathOf& path_of) {
    std::uint32_t least = 0xFFFFFFFFu;
    std::uint32_t most = 0;
    for (const std::uint32_t number : slots_) {
      const Path path = number == 0 ? Path() : path_of(number);
      least = path.empty() || path.number() > least ? least : path.number();
      most = path.number() > most ? path.number() : most;
    }
    fill(PathSlots(slot_count, least, most), slot_count, path_of);
  }

  template <class PathOf>
  void fill(PathSlots places, std::size_t slot_count, const PathOf& path_of) {
    const std::vector<std::uint32_t> before =
        std::exchange(slots_, std::vector<std::uint32_t>(slot_count));
    places_ = places;
    count_ = 0;
    for (const std::uint32_t number : before) {
      const Path path = number == 0 ? Path() : path_of(number);
      if (!path.empty()) {
        place(path, number);
      }
    }
  }

  std::vector<std::uint32_t> slots_;  // open addressing; 0 in a free one
  PathSlots places_;
  std::size_t count_ = 0;  // of slots that are not free
};

}  // namespace tenon
