// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/time/spline.h"

namespace tenon::layer {

/// `number` as a value of this type keeps it: Double, Float, Half or TimeCode.
double in_precision(ValueType type, double number);
/// The numbers of the knot as values of this type keep them.
void round_knot(SplineKnot& knot, ValueType type);

/// What no knot may have, as OpenUSD has it: values or tangents that are not finite, widths below
/// zero. Null when there is nothing of the kind.
const char* fault_of(const SplineKnot& knot);

/// Widths of the two tangents of a segment, in parts of its length.
struct TangentWidths {
  double first = 0;
  double last = 0;
  bool operator==(const TangentWidths&) const = default;
};
/// Tangents so long that the curve would run back in time, shortened, their ratio kept, until it
/// just stands still. Others as they are.
TangentWidths without_regression(TangentWidths widths);
/// The same for all Bezier segments of a spline.
void shorten_tangents(Spline& spline);

}  // namespace tenon::layer
