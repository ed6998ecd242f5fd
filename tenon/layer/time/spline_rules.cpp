// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/time/spline_rules.h"

#include <algorithm>
#include <cmath>

namespace tenon::layer {

double in_precision(ValueType type, double number) {
  if (type == ValueType::Float) {
    return static_cast<double>(static_cast<float>(number));
  }
  return type == ValueType::Half ? static_cast<double>(static_cast<float>(Half(number))) : number;
}

void round_knot(SplineKnot& knot, ValueType type) {
  knot.value = in_precision(type, knot.value);
  if (knot.pre_value) {
    knot.pre_value = in_precision(type, *knot.pre_value);
  }
  knot.pre_tangent.slope = in_precision(type, knot.pre_tangent.slope);
  knot.post_tangent.slope = in_precision(type, knot.post_tangent.slope);
}

const char* fault_of(const SplineKnot& knot) {
  if (!std::isfinite(knot.time)) {
    return "the time of a knot must be finite";
  }
  if (!std::isfinite(knot.value) || !std::isfinite(knot.pre_value.value_or(0))) {
    return "the value of a knot must be finite and fit its type";
  }
  for (const SplineTangent* tangent : {&knot.pre_tangent, &knot.post_tangent}) {
    if (!std::isfinite(tangent->slope)) {
      return "the slope of a tangent must be finite and fit its type";
    }
    if (!std::isfinite(tangent->width) || tangent->width < 0) {
      return "the width of a tangent must be finite and not below zero";
    }
  }
  return nullptr;
}

// Where the curve just stands still, (first, last) lies on the ellipse where the derivative of time
// has one zero. The paddings are OpenUSD's (Ts regression prevention, "keep ratio").
TangentWidths without_regression(TangentWidths widths) {
  constexpr double kReadPadding = 1e-6;
  constexpr double kWritePadding = 1e-5;
  if (widths.first <= 1 && widths.last <= 1) {
    return widths;
  }
  const double a = widths.first + kReadPadding;
  const double b = widths.last + kReadPadding;
  if (!(a * a + b * b - 2 * (a + b) + a * b + 1 > 0)) {
    return widths;
  }
  if (widths.first < kReadPadding) {
    return {widths.first, 1 - kWritePadding};
  }
  if (widths.last < kReadPadding) {
    return {1 - kWritePadding, widths.last};
  }
  const double ratio = widths.first / widths.last;
  if (!std::isfinite(ratio * ratio)) {
    return {1 - kWritePadding, 0};  // where the formula below leads to
  }
  const double last = (std::sqrt(ratio) + ratio + 1) / (ratio * ratio + ratio + 1);
  // No width is below zero, however far the two are apart.
  return {std::max(0.0, ratio * last - kWritePadding), std::max(0.0, last - kWritePadding)};
}

void shorten_tangents(Spline& spline) {
  if (spline.curve == SplineCurve::Hermite) {
    return;
  }
  for (std::size_t i = 1; i < spline.knots.size(); ++i) {
    SplineKnot& a = spline.knots[i - 1];
    SplineKnot& b = spline.knots[i];
    const double span = b.time - a.time;
    if (a.next != SplineInterpolation::Curve || !(span > 0)) {
      continue;
    }
    const TangentWidths before{a.post_tangent.width / span, b.pre_tangent.width / span};
    const TangentWidths after = without_regression(before);
    if (after != before) {
      a.post_tangent.width = after.first * span;
      b.pre_tangent.width = after.last * span;
    }
  }
}

}  // namespace tenon::layer
