// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/dump/json_writer.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace tenon::answers {

std::string json_quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
        result += "\\\"";
        break;
      case '\\':
        result += "\\\\";
        break;
      case '\n':
        result += "\\n";
        break;
      case '\r':
        result += "\\r";
        break;
      case '\t':
        result += "\\t";
        break;
      case '\b':
        result += "\\b";
        break;
      case '\f':
        result += "\\f";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20) {
          char code[8];
          std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
          result += code;
        } else {
          result += c;
        }
    }
  }
  return result + "\"";
}

std::string json_number(double value) {
  char text[40];
  const auto shortest =
      std::to_chars(text, text + sizeof text, value, std::chars_format::scientific);
  std::string_view digits(text, static_cast<std::size_t>(shortest.ptr - text));
  const std::size_t e = digits.find('e');
  int exponent = 0;
  const std::string_view power = digits.substr(e + (digits[e + 1] == '+' ? 2 : 1));
  std::from_chars(power.data(), power.data() + power.size(), exponent);
  if (exponent < -4 || exponent >= 16) {
    return std::string(digits);
  }
  const auto fixed = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed);
  std::string result(text, fixed.ptr);
  return result.find('.') == std::string::npos ? result + ".0" : result;
}

JsonWriter::JsonWriter(std::ostream& out)
    : text_(1, false, [&out](std::string_view piece) {
        out.write(piece.data(), static_cast<std::streamsize>(piece.size()));
      }) {}

void JsonWriter::number(double value) {
  if (std::isnan(value)) {
    string("nan");
  } else if (std::isinf(value)) {
    string(value > 0 ? "inf" : "-inf");
  } else {
    text_.put_text(json_number(value));
  }
}

void JsonWriter::integer(std::int64_t value) {
  constexpr std::int64_t kExact = std::int64_t{1} << 53;
  const std::string text = std::to_string(value);
  value >= -kExact&& value <= kExact ? text_.put_text(text) : string(text);
}

void JsonWriter::unsigned_integer(std::uint64_t value) {
  const std::string text = std::to_string(value);
  value <= (std::uint64_t{1} << 53) ? text_.put_text(text) : string(text);
}

}  // namespace tenon::answers
