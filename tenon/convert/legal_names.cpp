// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/legal_names.h"

#include "tenon/base/path.h"

namespace tenon::convert {

std::string legal_name(std::string_view text) {
  if (is_identifier(text)) {
    return std::string(text);
  }
  std::string name;
  for (const char c : text) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool digit = c >= '0' && c <= '9';
    if (digit && name.empty()) {
      name += '_';
    }
    // Of a character of several bytes one '_' stays.
    const bool continues = (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
    if (!continues) {
      name += letter || digit ? c : '_';
    }
  }
  return name.empty() ? "_" : name;
}

Token NameScope::make(std::string_view wanted) { return Token(names_.make(legal_name(wanted))); }

}  // namespace tenon::convert
