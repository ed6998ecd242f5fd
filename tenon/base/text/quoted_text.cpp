// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/quoted_text.h"

namespace tenon {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') {
    return c - '0';
  }
  if (c >= 'a' && c <= 'f') {
    return c - 'a' + 10;
  }
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

char hex(unsigned digit) { return "0123456789abcdef"[digit & 15u]; }

/// One byte that is no part of a longer character.
void append_escaped(std::string& out, char c, char quote, bool triple) {
  if (c == '\n') {
    out += triple ? "\n" : "\\n";
  } else if (c == '\r') {
    out += "\\r";
  } else if (c == '\t') {
    out += "\\t";
  } else if (c == '\\') {
    out += "\\\\";
  } else if (c == quote) {
    out += '\\';
    out += quote;
  } else if (c < 0x20 || c > 0x7E) {
    const auto byte = static_cast<unsigned char>(c);
    out += "\\x";
    out += hex(byte >> 4u);
    out += hex(byte);
  } else {
    out += c;
  }
}

/// Length of the sequence at `at` when its form is that of a character of several bytes, else 0.
std::size_t multi_byte_length(std::string_view text, std::size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  const std::size_t length = (lead & 0xE0u) == 0xC0u   ? 2
                             : (lead & 0xF0u) == 0xE0u ? 3
                             : (lead & 0xF8u) == 0xF0u ? 4
                                                       : 0;
  if (length == 0 || at + length > text.size()) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[at + i]) & 0xC0u) != 0x80u) {
      return 0;
    }
  }
  return length;
}

/// Appends the character of the escape at `raw[at]` (after the backslash); returns its length.
std::size_t append_escape(std::string_view raw, std::size_t at, std::string& value) {
  const char c = raw[at];
  constexpr std::string_view kNames = "nrtabfv";
  constexpr std::string_view kMeanings = "\n\r\t\a\b\f\v";
  if (const std::size_t i = kNames.find(c); i != std::string_view::npos) {
    value += kMeanings[i];
    return 1;
  }
  if (c == 'x') {
    int code = 0;
    std::size_t count = 0;
    while (count < 2 && at + 1 + count < raw.size() && hex_digit(raw[at + 1 + count]) >= 0) {
      code = code * 16 + hex_digit(raw[at + 1 + count]);
      ++count;
    }
    value += static_cast<char>(code);
    return 1 + count;
  }
  if (c >= '0' && c <= '7') {
    int code = 0;
    std::size_t count = 0;
    while (count < 3 && at + count < raw.size() && raw[at + count] >= '0' &&
           raw[at + count] <= '7') {
      code = code * 8 + (raw[at + count] - '0');
      ++count;
    }
    value += static_cast<char>(code);
    return count;
  }
  value += c;
  return 1;
}

}  // namespace

std::string unescaped(std::string_view raw) {
  std::string value;
  std::size_t at = 0;
  while (true) {
    const std::size_t escape = raw.find('\\', at);
    value += raw.substr(at, escape - at);
    if (escape == std::string_view::npos || escape + 1 >= raw.size()) {
      return value;
    }
    at = escape + 1;
    at += append_escape(raw, at, value);
  }
}

std::string quoted_text(std::string_view text) {
  const bool has_double = text.find('"') != std::string_view::npos;
  const char quote = has_double && text.find('\'') == std::string_view::npos ? '\'' : '"';
  const bool triple = text.find('\n') != std::string_view::npos;
  // Written is what stands before a zero byte, in the quotes that all of it asks for, as OpenUSD
  // does.
  text = text.substr(0, text.find('\0'));
  std::string out(triple ? 3 : 1, quote);
  out.reserve(text.size() + 6);
  for (std::size_t at = 0; at < text.size();) {
    if (const std::size_t length = multi_byte_length(text, at)) {
      out += text.substr(at, length);
      at += length;
      continue;
    }
    append_escaped(out, text[at], quote, triple);
    ++at;
  }
  out.append(triple ? 3 : 1, quote);
  return out;
}

}  // namespace tenon
