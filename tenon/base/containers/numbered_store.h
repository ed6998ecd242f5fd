// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>

namespace tenon {

/// Sets `block` to untouched memory, unless another thread does at the same time.
void add_block(std::byte*& block, std::size_t size);

/// Objects by number, which are never moved or freed; a number has four bytes. Threads may make
/// objects of different numbers at once. A caller gets a number from the thread that made its
/// object, so looking it up needs no ordering of its own. Static: its table of blocks has a place
/// for each possible block; the system provides those that are touched.
template <class T>
class NumberedStore {
 public:
  constexpr NumberedStore() = default;
  NumberedStore(const NumberedStore&) = delete;
  NumberedStore& operator=(const NumberedStore&) = delete;
  ~NumberedStore() = default;

  /// The object of a number for which room was made.
  T& operator[](std::uint32_t number) const {
    return *std::launder(reinterpret_cast<T*>(blocks_[number / kBlock]) + number % kBlock);
  }

  /// Room for an object.
  T& make_room(std::uint32_t number) {
    std::byte*& block = blocks_[number / kBlock];
    if (std::atomic_ref(block).load(std::memory_order_acquire) == nullptr) {
      add_block(block, kBlock * sizeof(T));
    }
    return (*this)[number];
  }

 private:
  static constexpr std::uint32_t kBlock = 1u << 13u;

  std::byte* blocks_[static_cast<std::size_t>((std::uint64_t{1} << 32u) / kBlock)] = {};
};

}  // namespace tenon
