// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace tenon {

/// A hash of a short text, eight bytes at a time: each is multiplied with what came before to 128
/// bits, of which both halves count, so that all bits of it are as good as each other. Not for
/// storage: it depends on the order of bytes in the machine.
inline std::uint64_t text_hash(std::string_view text) {
  __extension__ using Wide = unsigned __int128;
  constexpr std::uint64_t kStart = 0x9E3779B97F4A7C15u;   // digits of the golden ratio
  constexpr std::uint64_t kFactor = 0xD1B54A32D192ED03u;  // odd, bits as if thrown
  const auto mix = [](std::uint64_t before, std::uint64_t more) {
    const Wide product = static_cast<Wide>(before ^ more) * kFactor;
    return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64u);
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
