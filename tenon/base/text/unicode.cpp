// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Characters are decoded one by one and looked up in ranges made of Unicode's tables. Most text is
// ASCII, which is detected by its bytes.
#include "tenon/base/text/unicode.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>

#include "tenon/base/generated/unicode_ranges.h"

namespace tenon::unicode {
namespace {

template <std::size_t N>
bool contains(const Range (&ranges)[N], char32_t code_point) {
  const Range* after =
      std::upper_bound(std::begin(ranges), std::end(ranges), code_point,
                       [](char32_t value, const Range& range) { return value < range.first; });
  return after != std::begin(ranges) && code_point <= std::prev(after)->last;
}

constexpr bool is_ascii_letter(char32_t c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::size_t sequence_length(std::uint8_t lead) {
  if (lead < 0x80) {
    return 1;
  }
  if (lead >= 0xC2 && lead < 0xE0) {
    return 2;
  }
  if (lead >= 0xE0 && lead < 0xF0) {
    return 3;
  }
  return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

/// Most names are ASCII: what its bytes are in one.
constexpr std::uint8_t kStarts = 1;
constexpr std::uint8_t kContinues = 2;
constexpr std::array<std::uint8_t, 256> kAsciiName = [] {
  std::array<std::uint8_t, 256> table{};
  for (char32_t c = 0; c < 0x80; ++c) {
    const bool starts = is_ascii_letter(c) || c == '_';
    table[c] = starts ? kStarts | kContinues : c >= '0' && c <= '9' ? kContinues : 0;
  }
  return table;
}();

}  // namespace

Decoded decode(std::string_view text) {
  if (text.empty()) {
    return {};
  }
  const auto lead = static_cast<std::uint8_t>(text.front());
  const std::size_t length = sequence_length(lead);
  if (length == 1) {
    return {lead, 1};
  }
  if (length == 0 || length > text.size()) {
    return {};
  }
  auto code_point = static_cast<char32_t>(lead & (0xFFu >> (length + 1)));
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<std::uint8_t>(text[i]);
    if ((byte & 0xC0u) != 0x80u) {
      return {};
    }
    code_point = (code_point << 6u) | (byte & 0x3Fu);
  }
  constexpr char32_t kSmallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code_point >= 0xD800 && code_point < 0xE000;
  if (code_point < kSmallest[length] || surrogate || code_point > 0x10FFFF) {
    return {};
  }
  return {code_point, length};
}

void append(char32_t code_point, std::string& text) {
  constexpr unsigned kFollowingBits = 6;
  const unsigned following = code_point < 0x80      ? 0
                             : code_point < 0x800   ? 1
                             : code_point < 0x10000 ? 2
                                                    : 3;
  constexpr std::uint32_t kLeads[] = {0, 0xC0, 0xE0, 0xF0};
  const std::uint32_t bits = code_point;
  text += static_cast<char>(kLeads[following] | (bits >> (kFollowingBits * following)));
  for (unsigned k = following; k > 0; --k) {
    text += static_cast<char>(0x80U | ((bits >> (kFollowingBits * (k - 1))) & 0x3FU));
  }
}

bool is_valid(std::string_view text) {
  while (!text.empty()) {
    const Decoded decoded = decode(text);
    if (decoded.length == 0) {
      return false;
    }
    text.remove_prefix(decoded.length);
  }
  return true;
}

bool is_printable(std::string_view text) {
  const auto is_control = [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; };
  return std::none_of(text.begin(), text.end(), is_control) && is_valid(text);
}

bool starts_identifier(char32_t code_point) {
  if (code_point < 0x80) {
    return is_ascii_letter(code_point) || code_point == '_';
  }
  return contains(kIdentifierStart, code_point);
}

bool continues_identifier(char32_t code_point) {
  if (code_point < 0x80) {
    return is_ascii_letter(code_point) || code_point == '_' ||
           (code_point >= '0' && code_point <= '9');
  }
  return contains(kIdentifierContinue, code_point);
}

std::size_t identifier_length(std::string_view text) {
  std::size_t at = 0;
  std::uint8_t use = kStarts;
  while (at < text.size()) {
    const auto byte = static_cast<unsigned char>(text[at]);
    if ((kAsciiName[byte] & use) != 0) {
      ++at;
    } else if (byte < 0x80) {
      break;
    } else {
      const Decoded c = decode(text.substr(at));
      const bool fits =
          at == 0 ? starts_identifier(c.code_point) : continues_identifier(c.code_point);
      if (c.length == 0 || !fits) {
        break;
      }
      at += c.length;
    }
    use = kContinues;
  }
  return at;
}

}  // namespace tenon::unicode
