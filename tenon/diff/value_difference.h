// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/layer/value.h"

namespace tenon::diff {

/// |a - b| <= tolerance * max(1, |a|, |b|), and NaN equals NaN.
bool near(double a, double b, double tolerance);

/// How far two values are from each other.
struct ValueDifference {
  bool equal = false;
  std::size_t elements = 0;   ///< of the longer array; 1 for what is none
  std::size_t different = 0;  ///< of these
  std::size_t first = 0;      ///< index of the first element that differs
  double largest = 0;         ///< difference of two numbers; infinite where one is missing
};

/// Compares values of any type; numbers, in vectors, quaternions, matrices and arrays of these too,
/// within `tolerance` (see `near`), all else exactly. Values of different types differ.
ValueDifference compare_values(const layer::Value& a, const layer::Value& b, double tolerance);

}  // namespace tenon::diff
