// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A number is read once, into its digits as an integer and a power of ten. Integers up to 2^53 and
// powers up to 10^22 are exact doubles, so one multiplication or division of them is the correctly
// rounded value. All other numbers go to the general conversion, which is slower. Whole numbers of
// up to 18 digits cannot overflow and need no check. Strings are copied as they stand and rid of
// escapes only when they hold a backslash.
#include "tenon/formats/text/literals.h"

#include <array>
#include <charconv>

#include "tenon/base/text/number_from_text.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/math/functions.h"

namespace tenon::formats::text {
namespace {

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr std::array<double, 23> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::uint64_t kExactMantissa = std::uint64_t{1} << 53;

/// The parts of a number while it is read.
struct Digits {
  bool negative = false;
  bool whole = true;  // no point, no exponent
  std::uint64_t mantissa = 0;
  int count = 0;        // digits in mantissa without leading zeros
  int point_shift = 0;  // digits after the point
  int exponent = 0;
};

void take_digits(const char*& at, const char* end, Digits& digits, bool after_point) {
  const char* const first = at;
  while (digits.count == 0 && at != end && *at == '0') {
    ++at;
  }
  const char* const counted = at;
  for (; at != end && is_digit(*at); ++at) {
    digits.mantissa = digits.mantissa * 10 + static_cast<std::uint64_t>(*at - '0');
  }
  digits.count += static_cast<int>(at - counted);
  digits.point_shift += after_point ? static_cast<int>(at - first) : 0;
}

/// Takes what begins with 'e'; false, up to where digits are missing.
bool take_plain_exponent(const char*& at, const char* end, int& exponent) {
  ++at;
  bool negative = false;
  if (at != end && (*at == '+' || *at == '-')) {
    negative = *at == '-';
    ++at;
  }
  if (at == end || !is_digit(*at)) {
    return false;
  }
  int value = 0;
  while (at != end && is_digit(*at)) {
    value = value < 100000 ? value * 10 + (*at - '0') : value;
    ++at;
  }
  exponent = negative ? -value : value;
  return true;
}

bool take_exponent(Cursor& cursor, const char*& at, const char* end, Digits& digits) {
  digits.whole = false;
  const char* const start = at;
  if (take_plain_exponent(at, end, digits.exponent)) {
    return true;
  }
  cursor.advance(static_cast<std::size_t>(at - start));
  return cursor.fail_expected("digits of the exponent");
}

bool is_exact(std::uint64_t mantissa, std::ptrdiff_t power) {
  return mantissa <= kExactMantissa && power >= -22 && power <= 22;
}

/// mantissa * 10^power, where that is exact up to one rounding.
double scaled(std::uint64_t mantissa, std::ptrdiff_t power) {
  const auto size = static_cast<double>(mantissa);
  return power < 0 ? size / kPowersOfTen[static_cast<std::size_t>(-power)]
                   : size * kPowersOfTen[static_cast<std::size_t>(power)];
}

/// Of a number that no double is near: it is too large, not too small.
bool is_large(const char* at, const char* end) {
  Digits digits;
  at += *at == '-' ? 1 : 0;
  take_digits(at, end, digits, false);
  if (at != end && *at == '.') {
    ++at;
    take_digits(at, end, digits, true);
  }
  if (at != end) {
    take_plain_exponent(at, end, digits.exponent);
  }
  return digits.count + digits.exponent - digits.point_shift > 0;
}

/// The correctly rounded value of any number; infinity beyond the largest.
double general_value(const char* start, const char* end, bool negative) {
  double value = 0;
  if (number_from_text(start, end, value).ec != std::errc::result_out_of_range) {
    return value;
  }
  const double size = is_large(start, end) ? kInfinity : 0.0;
  return negative ? -size : size;
}

double value_of(const Digits& digits, const char* start, const char* end) {
  const std::ptrdiff_t power = digits.exponent - digits.point_shift;
  if (digits.count > 19 || !is_exact(digits.mantissa, power)) {
    return general_value(start, end, digits.negative);
  }
  const double size = scaled(digits.mantissa, power);
  return digits.negative ? -size : size;
}

void set_whole(Number& number, const Digits& digits, const char* start, const char* end) {
  if (digits.negative && digits.mantissa == 0 && digits.count == 0) {
    number.double_value = -0.0;
    return;
  }
  if (digits.count <= 18) {
    number.kind = digits.negative ? Number::Kind::Signed : Number::Kind::Unsigned;
    number.unsigned_value = digits.mantissa;
    number.signed_value = -static_cast<std::int64_t>(digits.mantissa);
    return;
  }
  std::errc error{};
  if (digits.negative) {
    number.kind = Number::Kind::Signed;
    error = std::from_chars(start, end, number.signed_value).ec;
  } else {
    number.kind = Number::Kind::Unsigned;
    error = std::from_chars(start, end, number.unsigned_value).ec;
  }
  if (error != std::errc{}) {
    number.kind = Number::Kind::Double;
    number.overflowed = true;
    number.double_value = value_of(digits, start, end);
  }
}

bool read_word_number(Cursor& cursor, Number& number) {
  const bool negative = cursor.peek() == '-';
  if (negative) {
    cursor.advance();
  }
  if (cursor.accept_word("inf")) {
    number.double_value = negative ? -kInfinity : kInfinity;
    return true;
  }
  if (!negative && cursor.accept_word("nan")) {
    number.double_value = kNotANumber;
    return true;
  }
  return cursor.fail_expected("a number");
}

}  // namespace

double Number::as_double() const {
  switch (kind) {
    case Kind::Unsigned:
      return static_cast<double>(unsigned_value);
    case Kind::Signed:
      return static_cast<double>(signed_value);
    case Kind::Double:
      break;
  }
  return double_value;
}

bool at_number(const Cursor& cursor) {
  const std::size_t sign = cursor.peek() == '-' ? 1 : 0;
  const char c = cursor.peek(sign);
  if (is_digit(c) || c == '.') {
    return true;
  }
  if (c != 'i' && c != 'n') {
    return false;
  }
  Cursor ahead = cursor;
  ahead.advance(sign);
  return ahead.accept_word("inf") || (sign == 0 && ahead.accept_word("nan"));
}

bool read_number(Cursor& cursor, Number& number) {
  const std::string_view rest = cursor.rest();
  const char* const start = rest.data();
  const char* const end = start + rest.size();
  const char* at = start;
  Digits digits;
  if (at != end && *at == '-') {
    digits.negative = true;
    ++at;
  }
  const char* const first = at;
  take_digits(at, end, digits, false);
  const bool has_whole = at != first;
  if (at != end && *at == '.') {
    digits.whole = false;
    ++at;
    const char* const fraction = at;
    take_digits(at, end, digits, true);
    if (!has_whole && at == fraction) {
      return cursor.fail_expected("a number");
    }
  } else if (!has_whole) {
    return read_word_number(cursor, number);
  }
  if (at != end && (*at == 'e' || *at == 'E')) {
    cursor.advance(static_cast<std::size_t>(at - start));
    if (!take_exponent(cursor, at, end, digits)) {
      return false;
    }
    cursor.seek(static_cast<std::size_t>(start - cursor.text().data()));
  }
  if (digits.whole) {
    set_whole(number, digits, start, at);
  } else {
    number.kind = Number::Kind::Double;
    number.double_value = value_of(digits, start, at);
  }
  cursor.advance(static_cast<std::size_t>(at - start));
  return true;
}

bool read_double(Cursor& cursor, double& value) {
  const std::string_view rest = cursor.rest();
  const char* at = rest.data();
  if (take_plain_double(at, at + rest.size(), value)) {
    cursor.advance(static_cast<std::size_t>(at - rest.data()));
    return true;
  }
  Number number;
  if (!read_number(cursor, number)) {
    return false;
  }
  value = number.as_double();
  return true;
}

bool take_plain_integer(const char*& at, const char* end, std::int64_t& value) {
  const char* next = at;
  Digits digits;
  if (next != end && *next == '-') {
    digits.negative = true;
    ++next;
  }
  const char* const first = next;
  take_digits(next, end, digits, false);
  const bool more = next != end && (*next == '.' || *next == 'e' || *next == 'E');
  if (next == first || more || digits.count > 18) {
    return false;
  }
  const auto size = static_cast<std::int64_t>(digits.mantissa);
  value = digits.negative ? -size : size;
  at = next;
  return true;
}

// Most of a layer are numbers: all that they take stays in registers here. Up to 19 digits fit the
// mantissa, leading zeros included; the rare rest is read once more.
bool take_plain_double(const char*& at, const char* end, double& value) {
  const char* const start = at;
  const bool negative = start != end && *start == '-';
  std::uint64_t mantissa = 0;
  const auto past_digits = [end, &mantissa](const char* next) {
    std::uint64_t sum = mantissa;
    for (; next != end; ++next) {
      const auto digit = static_cast<unsigned char>(*next - '0');
      if (digit > 9) {
        break;
      }
      sum = sum * 10 + digit;
    }
    mantissa = sum;
    return next;
  };
  const char* const first = start + (negative ? 1 : 0);
  const char* next = past_digits(first);
  std::ptrdiff_t digits = next - first;
  std::ptrdiff_t power = 0;
  if (next != end && *next == '.') {
    const char* const fraction = next + 1;
    next = past_digits(fraction);
    power = fraction - next;
    digits -= power;
  }
  if (digits == 0) {
    return false;
  }
  if (next != end && (*next == 'e' || *next == 'E')) {
    int exponent = 0;
    const char* behind = next;
    if (!take_plain_exponent(behind, end, exponent)) {
      return false;
    }
    next = behind;
    power += exponent;
  }
  if (digits <= 19 && is_exact(mantissa, power)) {
    const double size = scaled(mantissa, power);
    value = negative ? -size : size;
  } else {
    value = general_value(start, next, negative);
  }
  at = next;
  return true;
}

bool fail_expected_close(Cursor& cursor, std::string_view separator, char close,
                         std::string_view what) {
  std::string expected(separator);
  expected += " or '";
  expected += close;
  expected += "' ";
  expected += what;
  return cursor.fail_expected(expected);
}

bool at_string(const Cursor& cursor) { return cursor.peek() == '"' || cursor.peek() == '\''; }

bool read_string(Cursor& cursor, std::string& value) {
  const char quote = cursor.peek();
  if (quote != '"' && quote != '\'') {
    return cursor.fail_expected("a string in quotes");
  }
  const std::size_t start = cursor.offset();
  const bool triple = cursor.peek(1) == quote && cursor.peek(2) == quote;
  const std::size_t width = triple ? 3 : 1;
  const std::string_view text = cursor.text();
  std::size_t at = start + width;
  bool escaped = false;
  while (at < text.size()) {
    const char c = text[at];
    if (c == quote && (!triple || text.substr(at, 3) == text.substr(start, 3))) {
      const std::string_view raw = text.substr(start + width, at - start - width);
      cursor.seek(at + width);
      if (escaped) {
        value = unescaped(raw);
      } else {
        value.assign(raw);
      }
      return true;
    }
    if (!triple && (c == '\n' || c == '\r')) {
      break;
    }
    // A backslash keeps a quote or a backslash after it from ending the string.
    const char next = at + 1 < text.size() ? text[at + 1] : '\0';
    escaped = escaped || c == '\\';
    at += c == '\\' && (next == '\\' || next == quote) ? 2 : 1;
  }
  return cursor.fail_at(
      start, ErrorCode::Parse, "text.syntax",
      triple ? "this string is never closed" : "this string is not closed on its line",
      triple ? "add the three closing quotes"
             : "add the closing quote, or use three quotes for several lines");
}

bool read_asset_path(Cursor& cursor, std::string& value) {
  const std::size_t start = cursor.offset();
  if (cursor.peek() != '@') {
    return cursor.fail_expected("an asset path such as @file.usda@");
  }
  const std::string_view text = cursor.text();
  const bool triple = cursor.starts_with("@@@");
  const std::size_t width = triple ? 3 : 1;
  value.clear();
  std::size_t at = start + width;
  while (at < text.size() && text[at] != '\n' && text[at] != '\r') {
    if (triple && text.substr(at, 4) == "\\@@@") {
      value += "@@@";
      at += 4;
    } else if (text[at] == '@' && (!triple || text.substr(at, 3) == "@@@")) {
      at += width;
      // Up to two more '@' belong to the path: the last three close it.
      for (int extra = 0; triple && extra < 2 && at < text.size() && text[at] == '@'; ++extra) {
        value += '@';
        ++at;
      }
      cursor.seek(at);
      return true;
    } else {
      const auto byte = static_cast<unsigned char>(text[at]);
      if (byte < 0x20 || byte == 0x7F) {
        return cursor.fail_at(at, ErrorCode::Parse, "text.syntax",
                              "an asset path holds a control character");
      }
      value += text[at];
      ++at;
    }
  }
  return cursor.fail_at(start, ErrorCode::Parse, "text.syntax",
                        "this asset path is not closed on its line", "add the closing '@'");
}

bool read_path(Cursor& cursor, Path& path) {
  const std::size_t start = cursor.offset();
  if (!cursor.accept('<')) {
    return cursor.fail_expected("a path such as </World/Body>");
  }
  const std::string_view rest = cursor.rest();
  const std::size_t close = rest.find_first_of(">\n");
  if (close == std::string_view::npos || rest[close] != '>') {
    return cursor.fail_at(start, ErrorCode::Parse, "text.syntax",
                          "this path is not closed on its line", "add the closing '>'");
  }
  path = Path();
  if (close != 0) {
    const std::string_view text = rest.substr(0, close);
    if (text == ".") {  // a path elsewhere, but text layers have no way to write it
      return cursor.fail_at(start, ErrorCode::Parse, "text.path", "\".\" is not a path in a layer",
                            "write the path of the prim");
    }
    auto parsed = Path::parse(text);
    if (!parsed) {
      return cursor.fail_at(start, parsed.error().code(), "text.path", parsed.error().message());
    }
    path = *parsed;
  }
  cursor.advance(close + 1);
  return true;
}

std::string asset_path_text(std::string_view path) {
  if (path.find('@') == std::string_view::npos) {
    return '@' + std::string(path) + '@';
  }
  std::string out = "@@@";
  for (std::size_t at = 0; at < path.size();) {
    const bool delimiter = path.substr(at, 3) == "@@@";
    out += delimiter ? "\\@@@" : std::string(1, path[at]);
    at += delimiter ? 3 : 1;
  }
  return out + "@@@";
}

}  // namespace tenon::formats::text
