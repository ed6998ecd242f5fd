// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>

namespace tenon {

/// Sets `block` to memory that is zero, if nobody else does at the same time.
void add_zeros(std::atomic<std::byte*>& block, std::size_t size);

/// Objects by number, which are never moved or freed: a number of four bytes stands for one. Blocks
/// double in size, so that where an object lies needs one look. Memory is zero until an object is
/// made in it, and costs nothing until then. Threads may make objects of different numbers at once.
/// Static, for its first block is a part of it; that needs no code before main().
template <class T>
class NumberedStore {
 public:
  constexpr NumberedStore() : blocks_{first_} {}
  NumberedStore(const NumberedStore&) = delete;
  NumberedStore& operator=(const NumberedStore&) = delete;
  ~NumberedStore() = default;

  /// The object of a number that somebody made room for.
  T& operator[](std::uint32_t number) const {
    const std::uint64_t at = number + kFirst;
    const unsigned width = width_of(at);
    std::byte* block = blocks_[width - kFirstWidth].load(std::memory_order_relaxed);
    return *std::launder(reinterpret_cast<T*>(block) + (at - (std::uint64_t{1} << width)));
  }

  /// Room for an object.
  T& make_room(std::uint32_t number) {
    const unsigned width = width_of(number + kFirst);
    std::atomic<std::byte*>& block = blocks_[width - kFirstWidth];
    if (block.load(std::memory_order_acquire) == nullptr) {
      add_zeros(block, sizeof(T) << width);
    }
    return (*this)[number];
  }

 private:
  static constexpr unsigned kFirstWidth = 8;
  static constexpr std::uint64_t kFirst = std::uint64_t{1} << kFirstWidth;

  static unsigned width_of(std::uint64_t at) {
    return static_cast<unsigned>(std::bit_width(at)) - 1;
  }

  alignas(64) std::byte first_[kFirst * sizeof(T)] = {};
  std::atomic<std::byte*> blocks_[33 - kFirstWidth + 1];
};

}  // namespace tenon
