// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/rounded_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tenon {

std::string rounded_text(double value, int digits) {
  if (std::isnan(value)) {
    return "nan";
  }
  char buffer[40];  // 17 digits, sign, point, exponent
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value + 0.0,
                                 std::chars_format::general, std::clamp(digits, 1, 17));
  return std::string(buffer, end.ptr);
}

}  // namespace tenon
