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

void JsonWriter::begin(char bracket) {
  before_item();
  text_ += bracket;
  has_items_.push_back(false);
}

void JsonWriter::end(char bracket) {
  const bool items = has_items_.back();
  has_items_.pop_back();
  if (items) {
    new_line();
  }
  text_ += bracket;
}

void JsonWriter::key(std::string_view name) {
  before_item();
  text_ += json_quoted(name);
  text_ += ": ";
  after_key_ = true;
}

void JsonWriter::string(std::string_view text) { raw(json_quoted(text)); }

void JsonWriter::number(double value) {
  if (std::isnan(value)) {
    string("nan");
  } else if (std::isinf(value)) {
    string(value > 0 ? "inf" : "-inf");
  } else {
    raw(json_number(value));
  }
}

void JsonWriter::integer(std::int64_t value) {
  constexpr std::int64_t kExact = std::int64_t{1} << 53;
  const std::string text = std::to_string(value);
  value >= -kExact&& value <= kExact ? raw(text) : string(text);
}

void JsonWriter::unsigned_integer(std::uint64_t value) {
  const std::string text = std::to_string(value);
  value <= (std::uint64_t{1} << 53) ? raw(text) : string(text);
}

void JsonWriter::raw(std::string_view text) {
  before_item();
  text_ += text;
}

void JsonWriter::before_item() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (has_items_.empty()) {
    return;
  }
  if (has_items_.back()) {
    text_ += ',';
  }
  has_items_.back() = true;
  new_line();
}

void JsonWriter::new_line() {
  constexpr std::size_t kHeldBack = 1u << 16;  // bytes
  if (text_.size() >= kHeldBack) {
    flush();
  }
  text_ += '\n';
  text_.append(has_items_.size(), ' ');
}

void JsonWriter::flush() {
  out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
  text_.clear();
}

}  // namespace tenon::answers
