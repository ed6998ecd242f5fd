// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace tenon {

/// The two halves of the product of 128 bits, one over the other.
inline std::uint64_t folded_product_in_parts(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t kLow = 0xFFFFFFFFu;
  const std::uint64_t low = (a & kLow) * (b & kLow);
  const std::uint64_t cross = (a & kLow) * (b >> 32u);
  const std::uint64_t other = (a >> 32u) * (b & kLow);
  const std::uint64_t middle = (low >> 32u) + (cross & kLow) + (other & kLow);
  const std::uint64_t high =
      (a >> 32u) * (b >> 32u) + (cross >> 32u) + (other >> 32u) + (middle >> 32u);
  return (a * b) ^ high;
}

/// The same in one multiplication where the machine has one.
inline std::uint64_t folded_product(std::uint64_t a, std::uint64_t b) {
#ifdef __SIZEOF_INT128__
  __extension__ using Wide = unsigned __int128;
  const Wide product = static_cast<Wide>(a) * b;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64u);
#else
  return folded_product_in_parts(a, b);
#endif
}

/// A hash of a short text, eight bytes at a time: each is multiplied with what came before to 128
/// bits, of which both halves count, so that all bits of it are as good as each other. Not for
/// storage: it depends on the order of bytes in the machine.
inline std::uint64_t text_hash(std::string_view text) {
  constexpr std::uint64_t kStart = 0x9E3779B97F4A7C15u;   // digits of the golden ratio
  constexpr std::uint64_t kFactor = 0xD1B54A32D192ED03u;  // odd, random bits
  const auto mix = [](std::uint64_t before, std::uint64_t more) {
    return folded_product(before ^ more, kFactor);
  };
  const char* const at = text.data();
  const std::size_t size = text.size();
  const std::uint64_t hash = kStart ^ size;
  if (size >= 8) {
    std::uint64_t word = 0;
    std::uint64_t mixed = hash;
    for (std::size_t i = 0; i + 8 < size; i += 8) {
      std::memcpy(&word, at + i, 8);
      mixed = mix(mixed, word);
    }
    std::memcpy(&word, at + size - 8, 8);
    return mix(mixed, word);
  }
  if (size >= 4) {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    std::memcpy(&first, at, 4);
    std::memcpy(&last, at + size - 4, 4);
    return mix(hash, std::uint64_t{first} << 32u | last);
  }
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < size; ++i) {
    word = word << 8u | static_cast<unsigned char>(at[i]);
  }
  return mix(hash, word);
}

}  // namespace tenon
