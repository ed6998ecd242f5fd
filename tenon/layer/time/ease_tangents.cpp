// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/time/ease_tangents.h"

#include <algorithm>
#include <cmath>

#include "tenon/layer/time/spline_rules.h"

namespace tenon::layer {
namespace {

/// The slope at `knot` between two neighbours, as OpenUSD and Maya blend it ("auto ease").
double eased_slope(const SplineKnot& before, const SplineKnot& knot, const SplineKnot& after) {
  const bool breaks = knot.pre_value.has_value() || knot.next == SplineInterpolation::None ||
                      before.next == SplineInterpolation::None;
  const double in = (knot.value - before.value) / (knot.time - before.time);
  const double out =
      (after.pre_value.value_or(after.value) - knot.value) / (after.time - knot.time);
  if (breaks || !(in * out > 0)) {
    return 0;
  }
  // The nearer neighbour counts for more.
  const double offset = (knot.time - before.time) / (after.time - before.time) - 0.5;
  const double weight = 0.5 + offset * (0.5 + 2 * offset * offset);
  const double slope = (1 - weight) * in + weight * out;
  return out > 0 ? std::min({slope, 3 * out, 3 * in}) : std::max({slope, 3 * out, 3 * in});
}

void set_tangent(SplineTangent& tangent, ValueType type, double span, double slope) {
  constexpr double kLargestHalf = 65504;
  tangent.width = span / 3;
  tangent.slope = in_precision(type, slope);
  if (!std::isfinite(tangent.slope)) {
    tangent.slope = std::copysign(kLargestHalf, slope);
    tangent.width *= slope / tangent.slope;  // the same height
  }
}

}  // namespace

void ease_tangents(Spline& spline) {
  const std::vector<SplineKnot> knots = spline.knots;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const bool is_inner = i > 0 && i + 1 < knots.size();
    const double slope = is_inner ? eased_slope(knots[i - 1], knots[i], knots[i + 1]) : 0;
    SplineKnot& knot = spline.knots[i];
    if (i > 0 && knot.pre_tangent.algorithm == TangentAlgorithm::AutoEase) {
      set_tangent(knot.pre_tangent, spline.value_type, knot.time - knots[i - 1].time, slope);
    }
    if (i + 1 < knots.size() && knot.post_tangent.algorithm == TangentAlgorithm::AutoEase) {
      set_tangent(knot.post_tangent, spline.value_type, knots[i + 1].time - knot.time, slope);
    }
  }
}

}  // namespace tenon::layer
