// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text_number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace tenon {
namespace {

template <class T>
std::string shortest_of(T value) {
  if (std::isnan(value)) {
    return "nan";
  }
  if (std::isinf(value)) {
    return value > 0 ? "inf" : "-inf";
  }
  std::array<char, 64> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

struct Digits {
  bool negative = false;
  std::string digits;  // significant, without point
  int exponent = 0;    // value = 0.DIGITS x 10^exponent
};

template <class T>
Digits decimal_digits(T value) {
  std::array<char, 64> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::scientific)
                       .ptr;
  std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
  Digits result;
  if (text.front() == '-') {
    result.negative = true;
    text.remove_prefix(1);
  }
  const std::size_t e = text.find('e');
  std::string_view exponent = text.substr(e + 1);
  if (exponent.front() == '+') {
    exponent.remove_prefix(1);
  }
  std::from_chars(exponent.data(), exponent.data() + exponent.size(), result.exponent);
  ++result.exponent;
  for (const char c : text.substr(0, e)) {
    if (c != '.') {
      result.digits += c;
    }
  }
  return result;
}

template <class T>
std::string layer_text_of(T value) {
  if (!std::isfinite(value)) {
    return shortest_of(value);
  }
  if (value == T(0)) {
    return std::signbit(value) ? "-0" : "0";
  }
  const Digits d = decimal_digits(value);
  const int count = static_cast<int>(d.digits.size());
  std::string text = d.negative ? "-" : "";
  if (d.exponent > 15 || d.exponent < -5) {
    text += d.digits[0];
    if (count > 1) {
      text += '.' + d.digits.substr(1);
    }
    return text + 'e' + std::to_string(d.exponent - 1);
  }
  if (d.exponent <= 0) {
    return text + "0." + std::string(static_cast<std::size_t>(-d.exponent), '0') + d.digits;
  }
  if (count <= d.exponent) {
    return text + d.digits + std::string(static_cast<std::size_t>(d.exponent - count), '0');
  }
  const auto point = static_cast<std::size_t>(d.exponent);
  return text + d.digits.substr(0, point) + '.' + d.digits.substr(point);
}

template <class T>
std::optional<T> parse_whole(std::string_view text) {
  if (!text.empty() && text.front() == '+') {
    text.remove_prefix(1);
    if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
      return std::nullopt;
    }
  }
  T value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
    return std::nullopt;
  }
  return value;
}

}  // namespace

std::string shortest(double value) { return shortest_of(value); }
std::string shortest(float value) { return shortest_of(value); }
std::string layer_text(double value) { return layer_text_of(value); }
std::string layer_text(float value) { return layer_text_of(value); }

std::optional<double> parse_double(std::string_view text) { return parse_whole<double>(text); }
std::optional<std::int64_t> parse_int64(std::string_view text) {
  return parse_whole<std::int64_t>(text);
}
std::optional<std::uint64_t> parse_uint64(std::string_view text) {
  return parse_whole<std::uint64_t>(text);
}

}  // namespace tenon
