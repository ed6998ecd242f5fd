// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

/// UTF-8 and the identifier classes of Unicode (XID), which USD uses for names.
namespace tenon::unicode {

struct Decoded {
  char32_t code_point = 0;
  std::size_t length = 0;  ///< bytes read; 0 for the end of text or an ill-formed sequence
};

/// The code point at the head of `text`.
Decoded decode(std::string_view text);
/// Appends a code point, at most 0x10FFFF; a surrogate comes out as text that is not well-formed.
void append(char32_t code_point, std::string& text);
/// True when all of `text` is well-formed UTF-8.
bool is_valid(std::string_view text);
/// True when it has no control characters either: what an asset path in a text layer may hold.
bool is_printable(std::string_view text);

bool starts_identifier(char32_t code_point);     ///< XID_Start or '_'
bool continues_identifier(char32_t code_point);  ///< XID_Continue
/// Bytes of the identifier at the head of `text`, 0 when there is none.
std::size_t identifier_length(std::string_view text);

}  // namespace tenon::unicode
