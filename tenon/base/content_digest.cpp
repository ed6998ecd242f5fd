// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/content_digest.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace tenon {

std::uint64_t content_digest(std::string_view contents) {
  constexpr std::uint64_t kMultiplier = 0x9E3779B97F4A7C15u;
  constexpr std::size_t kStep = 4 * sizeof(std::uint64_t);
  const auto mixed = [](std::uint64_t digest, std::uint64_t word) {
    return std::rotl(digest ^ word, 31) * kMultiplier;
  };
  std::array<std::uint64_t, 4> lanes{1, 2, 3, contents.size()};  // that processors do at once
  std::array<std::uint64_t, 4> words{};
  for (; contents.size() >= kStep; contents.remove_prefix(kStep)) {
    std::memcpy(words.data(), contents.data(), kStep);
    lanes = {mixed(lanes[0], words[0]), mixed(lanes[1], words[1]), mixed(lanes[2], words[2]),
             mixed(lanes[3], words[3])};
  }
  words = {};
  std::memcpy(words.data(), contents.data(), contents.size());
  std::uint64_t digest = 0;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    digest = mixed(mixed(digest, lanes[i]), words[i]);
    digest ^= digest >> 32;
  }
  return digest * kMultiplier;
}

}  // namespace tenon
