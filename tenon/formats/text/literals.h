// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tenon/base/path.h"
#include "tenon/formats/text/cursor.h"

namespace tenon::formats::text {

/// A number as written: whole numbers keep all their digits, "-0" and everything with a point or
/// an exponent is a double.
struct Number {
  enum class Kind : std::uint8_t { Unsigned, Signed, Double };
  Kind kind = Kind::Double;
  std::uint64_t unsigned_value = 0;
  std::int64_t signed_value = 0;
  double double_value = 0;
  bool overflowed = false;  ///< a whole number too large for 64 bits, kept as a double

  double as_double() const;
};

/// True when a number (or inf, -inf, nan) starts at the cursor.
bool at_number(const Cursor& cursor);
bool read_number(Cursor& cursor, Number& number);
/// The same for callers that need no whole numbers.
bool read_double(Cursor& cursor, double& value);

/// The number whose first character is `at`, up to which it moves on; false, and nothing taken, for
/// inf, nan and what is no number. For loops over many numbers; read_double reads the same ones.
bool take_plain_double(const char*& at, const char* end, double& value);
/// The same for whole numbers of at most 18 digits without point and exponent.
bool take_plain_integer(const char*& at, const char* end, std::int64_t& value);

/// '..', "..", '''..''' or """..""" with its escapes resolved.
bool at_string(const Cursor& cursor);
bool read_string(Cursor& cursor, std::string& value);

/// @..@ or @@@..@@@.
bool read_asset_path(Cursor& cursor, std::string& value);
/// `@path@`, or `@@@path@@@` when the path holds an '@'.
std::string asset_path_text(std::string_view path);

/// <..>; the path is empty for <>.
bool read_path(Cursor& cursor, Path& path);

/// Keeps the error that neither `separator` nor `close` "`what`" is at the cursor.
bool fail_expected_close(Cursor& cursor, std::string_view separator, char close,
                         std::string_view what);

/// Reads the items of a list whose opening character was taken: at least one, separated by ',',
/// a last ',' is allowed; takes `close`. `item()` reads one item.
template <class Item>
bool read_items(Cursor& cursor, char close, std::string_view what, Item item) {
  cursor.skip_multi_line();
  while (true) {
    if (!item()) {
      return false;
    }
    cursor.skip_inline();
    if (!cursor.accept(',')) {
      cursor.skip_multi_line();
      return cursor.accept(close) || fail_expected_close(cursor, "','", close, what);
    }
    cursor.skip_multi_line();
    if (cursor.accept(close)) {
      return true;
    }
  }
}

/// The same for statements separated by ends of line or ';'. There may be none.
template <class Item>
bool read_statements(Cursor& cursor, char close, std::string_view what, Item item) {
  cursor.skip_multi_line();
  if (cursor.accept(close)) {
    return true;
  }
  while (true) {
    if (!item()) {
      return false;
    }
    cursor.skip_single_line();
    const bool separated = cursor.accept_statement_end();
    cursor.skip_multi_line();
    if (cursor.accept(close)) {
      return true;
    }
    if (!separated) {
      return fail_expected_close(cursor, "the end of the line, ';'", close, what);
    }
  }
}

}  // namespace tenon::formats::text
