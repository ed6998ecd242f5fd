// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tenon {

/// A table, open to the next free slot, of numbered things that are told apart by `tag`, a part of
/// their hash: a slot keeps it, so that few others are looked at.
class TagSlots {
 public:
  /// The number of the thing with this tag that `is_it` says yes to; where there is none, that of
  /// the one that `make` makes. Numbers count from 1 on.
  template <class IsIt, class Make>
  std::uint32_t find_or_make(std::uint32_t tag, const IsIt& is_it, const Make& make) {
    if (4 * (count_ + 1) > 3 * slots_.size()) {
      grow();
    }
    std::size_t at = tag & (slots_.size() - 1);
    for (; slots_[at].number != 0; at = (at + 1) & (slots_.size() - 1)) {
      if (slots_[at].tag == tag && is_it(slots_[at].number)) {
        return slots_[at].number;
      }
    }
    slots_[at] = {tag, make()};
    ++count_;
    return slots_[at].number;
  }

 private:
  struct Slot {
    std::uint32_t tag = 0;
    std::uint32_t number = 0;  // 0 in an empty slot
  };

  void grow() {
    const std::vector<Slot> before =
        std::exchange(slots_, std::vector<Slot>(slots_.empty() ? 64 : 2 * slots_.size()));
    for (const Slot& slot : before) {
      if (slot.number == 0) {
        continue;
      }
      std::size_t at = slot.tag & (slots_.size() - 1);
      while (slots_[at].number != 0) {
        at = (at + 1) & (slots_.size() - 1);
      }
      slots_[at] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace tenon
