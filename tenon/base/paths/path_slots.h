// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace tenon {

/// Where in a table of slots, open to the next free one, paths are by their number. Paths of one
/// scene are mostly made one after another: where all numbers lie within the length of the table,
/// each has a slot of its own, in their order. Otherwise eights of neighbouring numbers, which
/// share a line of the cache, are scattered, so that long runs of numbers do not pile up. How far
/// the farthest is from its home bounds the search for what is not there.
class PathSlots {
 public:
  /// For a table of so many slots, a power of two, in which nothing is yet.
  PathSlots() = default;
  explicit PathSlots(std::size_t slot_count) : mask_(slot_count - 1) {}
  /// The same, when all entries put in first are among these numbers.
  PathSlots(std::size_t slot_count, std::uint32_t least, std::uint32_t most)
      : mask_(slot_count - 1), in_order_(least <= most && most - least < slot_count) {}

  std::size_t home(std::uint32_t number) const {
    if (in_order_) {
      return number & mask_;
    }
    const std::uint64_t scattered = (std::uint64_t{number >> 3u} * 0x9E3779B97F4A7C15ull) >> 32u;
    return static_cast<std::size_t>(scattered << 3u | (number & 7u)) & mask_;
  }
  std::size_t next(std::size_t slot) const { return (slot + 1) & mask_; }
  /// How many slots to look at, from the home on.
  std::size_t reach() const { return reach_; }
  /// Notes that an entry was put at a slot that is so far from its home. False when numbers pile
  /// up: then fill the table again, with `scattered`.
  bool note(std::size_t home, std::size_t slot) {
    const std::size_t distance = ((slot - home) & mask_) + 1;
    reach_ = distance > reach_ ? distance : reach_;
    return !in_order_ || distance <= kFar;
  }
  PathSlots scattered() const { return PathSlots(mask_ + 1); }

 private:
  static constexpr std::size_t kFar = 16;

  std::size_t mask_ = 0;
  std::size_t reach_ = 0;
  bool in_order_ = false;
};

}  // namespace tenon
