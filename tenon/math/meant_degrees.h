// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "tenon/math/angle.h"

namespace tenon {

/// Whether the limits of a hinge [rad] look like degrees that were written without converting them:
/// the one farther from 0 is from 30 to 360, and as radians neither whole quarters of a turn nor a
/// multiple of 5 degrees. Below 30, some turns, people write 10 for "far".
inline bool degrees_were_meant(double lower, double upper) {
  constexpr double kLeast = 30;
  constexpr double kMost = 360;
  constexpr double kQuarter = 90;
  constexpr double kQuarterSlack = 1;  // [deg]: ten times pi with one decimal
  constexpr double kStep = 5;
  constexpr double kStepSlack = 0.01;
  const double farther = std::max(std::fabs(lower), std::fabs(upper));
  const double degrees = farther * kDegreesPerRadian;
  const auto off = [degrees](double step) { return std::fabs(std::remainder(degrees, step)); };
  return farther >= kLeast && farther <= kMost && off(kQuarter) > kQuarterSlack &&
         off(kStep) > kStepSlack;
}

}  // namespace tenon
