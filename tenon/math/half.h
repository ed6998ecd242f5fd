// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

namespace tenon {

/// IEEE 754 binary16; arithmetic goes through float.
struct Half {
  std::uint16_t bits = 0;

  Half() = default;
  explicit Half(float value) : bits(from_float(value)) {}
  explicit Half(double value) : Half(static_cast<float>(value)) {}
  static Half from_bits(std::uint16_t bits) {
    Half half;
    half.bits = bits;
    return half;
  }

  operator float() const { return to_float(bits); }
  bool operator==(const Half& other) const { return float(*this) == float(other); }

  static float to_float(std::uint16_t half) {
    const std::uint32_t sign = (half & 0x8000u) << 16u;
    const std::uint32_t exponent = (half >> 10u) & 0x1Fu;
    std::uint32_t mantissa = half & 0x3FFu;
    if (exponent == 0x1F) {
      return std::bit_cast<float>(sign | 0x7F800000u | (mantissa << 13u));
    }
    if (exponent != 0) {
      return std::bit_cast<float>(sign | ((exponent + 112u) << 23u) | (mantissa << 13u));
    }
    const float magnitude = static_cast<float>(mantissa) * 0x1p-24f;
    return sign != 0 ? -magnitude : magnitude;
  }

  /// Round to nearest, ties to even.
  static std::uint16_t from_float(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto sign = static_cast<std::uint16_t>((bits >> 16u) & 0x8000u);
    const std::uint32_t magnitude = bits & 0x7FFFFFFFu;
    if (magnitude >= 0x7F800000u) {
      const bool nan = magnitude > 0x7F800000u;
      return static_cast<std::uint16_t>(sign | 0x7C00u |
                                        (nan ? 0x200u | ((magnitude >> 13u) & 0x3FFu) : 0u));
    }
    if (magnitude >= 0x477FF000u) {
      return static_cast<std::uint16_t>(sign | 0x7C00u);
    }
    if (magnitude < 0x38800000u) {
      const float scaled = std::bit_cast<float>(magnitude) * 0x1p24f;
      auto whole = static_cast<std::uint32_t>(scaled);
      const float rest = scaled - static_cast<float>(whole);
      if (rest > 0.5f || (rest == 0.5f && (whole & 1u) != 0)) {
        ++whole;
      }
      return static_cast<std::uint16_t>(sign | whole);
    }
    const std::uint32_t rounded = magnitude + 0xFFFu + ((magnitude >> 13u) & 1u);
    return static_cast<std::uint16_t>(sign | ((rounded - 0x38000000u) >> 13u));
  }
};

}  // namespace tenon
