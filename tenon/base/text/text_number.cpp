// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// std::to_chars finds the shortest digits that read back as the same number, whatever the locale.
// When to write an exponent is another question, which layers answer as OpenUSD does: there the
// digits are taken from the scientific form as 0.DIGITS x 10^exponent and laid out again. Whole
// numbers that are exact take a short way. A text is a number only when all of it is read.
#include "tenon/base/text/text_number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "tenon/base/text/number_from_text.h"

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

/// The shortest decimal form of a finite number: 0.DIGITS x 10^exponent.
struct Decimal {
  std::array<char, 32> digits;  // significant, without point
  std::size_t count = 0;
  int exponent = 0;
  bool negative = false;
};

template <class T>
Decimal decimal_of(T value) {
  std::array<char, 64> buffer;
  const char* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                        std::chars_format::scientific)
                              .ptr;
  Decimal decimal;
  const char* at = buffer.data();
  if (*at == '-') {
    decimal.negative = true;
    ++at;
  }
  for (; *at != 'e'; ++at) {
    if (*at != '.') {
      decimal.digits[decimal.count++] = *at;
    }
  }
  ++at;
  std::from_chars(*at == '+' ? at + 1 : at, end, decimal.exponent);
  ++decimal.exponent;
  return decimal;
}

void append_decimal(std::string& out, const Decimal& d) {
  const char* const digits = d.digits.data();
  if (d.negative) {
    out += '-';
  }
  if (d.exponent > 15 || d.exponent < -5) {
    out += digits[0];
    if (d.count > 1) {
      out += '.';
      out.append(digits + 1, d.count - 1);
    }
    out += 'e';
    out += std::to_string(d.exponent - 1);
    return;
  }
  if (d.exponent <= 0) {
    out += "0.";
    out.append(static_cast<std::size_t>(-d.exponent), '0');
    out.append(digits, d.count);
    return;
  }
  const auto point = static_cast<std::size_t>(d.exponent);
  if (d.count <= point) {
    out.append(digits, d.count);
    out.append(point - d.count, '0');
    return;
  }
  out.append(digits, point);
  out += '.';
  out.append(digits + point, d.count - point);
}

template <class T>
void append_layer_text_of(std::string& out, T value) {
  // Whole numbers below this one are exact, and their digits are the shortest.
  constexpr T kWhole = sizeof(T) == sizeof(float) ? T(1 << 24) : T(1e15);
  if (!std::isfinite(value)) {
    out += shortest_of(value);
  } else if (value == T(0)) {
    out += std::signbit(value) ? "-0" : "0";
  } else if (std::fabs(value) < kWhole && std::trunc(value) == value) {
    std::array<char, 24> buffer;
    const auto whole = static_cast<std::int64_t>(value);
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), whole).ptr;
    out.append(buffer.data(), end);
  } else {
    append_decimal(out, decimal_of(value));
  }
}

template <class T>
std::string layer_text_of(T value) {
  std::string text;
  append_layer_text_of(text, value);
  return text;
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
  const auto result = number_from_text(text.data(), text.data() + text.size(), value);
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
void append_layer_text(std::string& out, double value) { append_layer_text_of(out, value); }
void append_layer_text(std::string& out, float value) { append_layer_text_of(out, value); }

std::optional<double> parse_double(std::string_view text) { return parse_whole<double>(text); }
std::optional<std::int64_t> parse_int64(std::string_view text) {
  return parse_whole<std::int64_t>(text);
}
std::optional<std::uint64_t> parse_uint64(std::string_view text) {
  return parse_whole<std::uint64_t>(text);
}

}  // namespace tenon
