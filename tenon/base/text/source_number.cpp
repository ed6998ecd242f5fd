// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/source_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "tenon/base/text/text_number.h"

namespace tenon {
namespace {

constexpr double kLastBits = 8 * std::numeric_limits<double>::epsilon();  // relative
constexpr int kTyped = 6;              // digits that people give to an angle in degrees
constexpr int kShort = 9;              // digits of a number that nobody wants shorter
constexpr int kShortBesideNoise = 12;  // leaves four digits to tell noise by
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kNoise = 1e-15;  // relative

int digits_of(const std::string& text) {
  const std::size_t end = std::min(text.find('e'), text.size());
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto first = std::find_if(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end),
                                  [](char c) { return c >= '1' && c <= '9'; });
  return static_cast<int>(
      std::count_if(first, text.begin() + static_cast<std::ptrdiff_t>(end), is_digit));
}

/// Rounded to so many digits.
double rounded(double value, int digits) {
  std::array<char, 64> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::scientific, digits - 1)
                       .ptr;
  double result = value;
  std::from_chars(buffer.data(), end, result);
  return result;
}

bool is_close(double a, double b) { return std::fabs(a - b) <= kLastBits * std::fabs(b); }

/// The shortest decimal that gives the same float in units of `unit`; nullopt where the number is
/// none of a float of them, or looks better there: 90 degrees are no decimal of radians.
std::optional<std::string> of_float(double value, double unit) {
  const auto held = [&](double number) { return static_cast<float>(number / unit); };
  const float wanted = held(value);
  if (!std::isnormal(wanted) || !is_close(static_cast<double>(wanted) * unit, value)) {
    return std::nullopt;
  }
  for (int digits = 1; digits <= std::numeric_limits<float>::max_digits10; ++digits) {
    const double shorter = rounded(value, digits);
    if (held(shorter) == wanted) {
      const int there = digits_of(layer_text(wanted));
      const bool is_own = unit == 1 || digits <= there || there > kTyped;
      return is_own ? std::optional(layer_text(shorter)) : std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace

std::string source_number(double value) {
  value += 0.0;
  std::string exact = layer_text(value);
  if (!std::isfinite(value) || digits_of(exact) <= kShort) {
    return exact;
  }
  for (const double unit : {1.0, kDegree, 1 / kDegree}) {
    if (auto found = of_float(value, unit)) {
      return *found;
    }
  }
  for (int digits = 1; digits <= kShortBesideNoise; ++digits) {
    const double shorter = rounded(value, digits);
    if (is_close(shorter, value)) {
      return layer_text(shorter);
    }
  }
  return exact;
}

void drop_noise(std::span<double> numbers, double least) {
  double largest = least;
  for (const double number : numbers) {
    largest = std::max(largest, std::fabs(number));
  }
  for (double& number : numbers) {
    if (std::fabs(number) < kNoise * largest) {
      number = 0;
    }
  }
}

}  // namespace tenon
