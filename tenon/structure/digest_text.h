// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Digests as notes have them: sixteen digits, always.
namespace tenon::structure {

inline constexpr std::size_t kDigestDigits = 16;

inline std::string hex_of(std::uint64_t digest) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text(kDigestDigits, '0');
  for (std::size_t i = kDigestDigits; i-- > 0; digest >>= 4) {
    text[i] = kDigits[digest & 0xf];
  }
  return text;
}

inline std::optional<std::uint64_t> digest_from(std::string_view hex) {
  std::uint64_t digest = 0;
  const auto [end, error] = std::from_chars(hex.data(), hex.data() + hex.size(), digest, 16);
  const bool whole = error == std::errc() && end == hex.data() + hex.size();
  return whole && hex.size() == kDigestDigits ? std::optional(digest) : std::nullopt;
}

}  // namespace tenon::structure
