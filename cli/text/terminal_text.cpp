// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/terminal_text.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace tenon::cli {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 0;  ///< in bytes; 0: no UTF-8
};

/// The character at the start of `text`, which is not empty.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  if (length == 0 || length > text.size()) {
    return {};
  }
  std::uint32_t code = length == 1 ? first : first & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) {
      return {};
    }
    code = code << 6u | (byte(i) & 0x3Fu);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return overlong || surrogate || code > 0x10FFFF ? Character{} : Character{code, length};
}

bool is_control(std::uint32_t code) { return code < 0x20 || (code >= 0x7F && code < 0xA0); }

bool reorders(std::uint32_t code) {
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF ||
         (code >= 0xE0000 && code <= 0xE007F);
}

void append_escape(std::string& out, const char* format, std::uint32_t number) {
  char buffer[16];
  std::snprintf(buffer, sizeof buffer, format, static_cast<unsigned>(number));
  out += buffer;
}

bool is_plain(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x20 && byte < 0x7F;
}

}  // namespace

std::string terminal_text(std::string_view text, bool keep_layout) {
  const auto stays = [&](char c) {
    return is_plain(c) || (keep_layout && (c == '\n' || c == '\t'));
  };
  std::string out;
  while (!text.empty()) {
    const auto special = std::find_if_not(text.begin(), text.end(), stays);
    const auto plain = static_cast<std::size_t>(special - text.begin());
    out.append(text.substr(0, plain));
    text.remove_prefix(plain);
    if (text.empty()) {
      break;
    }
    const Character character = first_character(text);
    if (character.length == 0 || is_control(character.code)) {
      const bool byte = character.length < 2;
      append_escape(out, "\\x%02x",
                    byte ? static_cast<unsigned char>(text.front()) : character.code);
    } else if (reorders(character.code)) {
      append_escape(out, "\\u%04x", character.code);
    } else {
      out.append(text.substr(0, character.length));
    }
    text.remove_prefix(std::max<std::size_t>(character.length, 1));
  }
  return out;
}

}  // namespace tenon::cli
