// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

/// One channel of a colour, 0 to 1, between linear light and as displayed (IEC 61966-2-1).
namespace tenon {

inline double srgb_of_linear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

/// Above 1 as it is.
inline double linear_of_srgb(double value) {
  if (value <= 0.04045) {
    return value / 12.92;
  }
  return value >= 1 ? value : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace tenon
