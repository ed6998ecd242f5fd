// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tenon {

/// A table, open to the next free slot, of numbered things that are distinguished by `tag`, a part
/// of their hash: a slot keeps it, so that few others are looked at. Slots are in the order of
/// tags, whatever their count is, which grows by half: twice as many would be empty for long.
class TagSlots {
 public:
  /// The number of the thing with this tag that `is_it` says yes to; where there is none, that of
  /// the one that `make` makes. Numbers count from 1 on.
  template <class IsIt, class Make>
  std::uint32_t find_or_make(std::uint32_t tag, const IsIt& is_it, const Make& make) {
    if (4 * (count_ + 1) > 3 * slots_.size()) {
      grow();
    }
    std::size_t at = home(tag);
    for (; slots_[at].number != 0; at = next(at)) {
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

  std::size_t home(std::uint32_t tag) const {
    return static_cast<std::size_t>(std::uint64_t{tag} * slots_.size() >> 32u);
  }
  std::size_t next(std::size_t at) const { return at + 1 == slots_.size() ? 0 : at + 1; }

  void grow() {
    const std::size_t more = slots_.empty() ? 64 : slots_.size() + slots_.size() / 2;
    const std::vector<Slot> before = std::exchange(slots_, std::vector<Slot>(more));
    for (const Slot& slot : before) {
      if (slot.number == 0) {
        continue;
      }
      std::size_t at = home(slot.tag);
      while (slots_[at].number != 0) {
        at = next(at);
      }
      slots_[at] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace tenon
