// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon {

/// `text` as one word of a POSIX shell, so that advice can be typed as it is printed: in single
/// quotes where it has anything but letters, digits, bytes beyond ASCII and `_-+=.,:/@%`.
inline std::string shell_word(const std::string& text) {
  bool plain = !text.empty();
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    plain = plain && (letter || static_cast<unsigned char>(c) >= 0x80 ||
                      std::string("_-+=.,:/@%").find(c) != std::string::npos);
  }
  if (plain) {
    return text;
  }
  std::string word = "'";
  for (const char c : text) {
    word += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return word + "'";
}

}  // namespace tenon
