// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A spline is a row of segments between knots. A Bezier segment is a curve in time and value: its
// inner control points lie one tangent away from the knots. A Hermite segment takes the slopes over
// equal thirds. Before and after the knots the ends say what happens (Core Spec 1.0.1 on splines).
#include "tenon/stage/evaluate_spline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "tenon/stage/spline_knots.h"

namespace tenon::stage {
namespace {

using layer::Spline;
using layer::SplineEnd;
using layer::SplineExtrapolation;
using layer::SplineInterpolation;
using layer::SplineKnot;
using Number = std::optional<double>;

double pre_value(const SplineKnot& knot) { return knot.pre_value.value_or(knot.value); }

double cubic(double p0, double p1, double p2, double p3, double u) {
  const double w = 1 - u;
  return w * w * w * p0 + 3 * w * w * u * p1 + 3 * w * u * u * p2 + u * u * u * p3;
}

// The parameter in [0, 1] where a quadratic or a cubic (in power form) is zero: closed forms, as
// OpenUSD has them, so that where they lose digits (near a vertical tangent) the values still
// agree.
double quadratic_zero(double a, double b, double c) {
  const double root = std::sqrt(b * b - 4 * a * c);
  const double low = (-b - root) / (2 * a);
  return low >= 0 && low <= 1 ? low : (-b + root) / (2 * a);
}

double cubic_zero(double b, double c, double d) {
  const double p = (3 * c - b * b) / 9;
  const double q = (2 * b * b * b - 9 * b * c + 27 * d) / 54;
  const double discriminant = q * q + p * p * p;
  if (discriminant > 0) {
    const double root = std::sqrt(discriminant);
    return std::cbrt(root - q) - std::cbrt(root + q) - b / 3;
  }
  if (discriminant == 0) {
    const double first = -2 * std::cbrt(q) - b / 3;
    return first >= 0 && first <= 1 ? first : std::cbrt(q) - b / 3;
  }
  const double radius = std::sqrt(-p * p * p);
  const double angle = std::acos(std::clamp(-q / radius, -1.0, 1.0));
  double zero = 0;
  for (int i = 0; i < 3; ++i) {
    const double turned = (angle + 2 * i * std::numbers::pi) / 3;
    const double candidate = 2 * std::cbrt(radius) * std::cos(turned) - b / 3;
    zero = candidate >= 0 && candidate <= 1 ? candidate : zero;
  }
  return zero;
}

/// Where a Bezier coordinate with these control points, which only grows, is zero.
double cubic_parameter(double p0, double p1, double p2, double p3) {
  constexpr double kTiny = 1e-10;
  const double a = -p0 + 3 * p1 - 3 * p2 + p3;
  const double b = 3 * p0 - 6 * p1 + 3 * p2;
  const double c = -3 * p0 + 3 * p1;
  double zero = 0;
  if (std::fabs(a) >= kTiny) {
    zero = cubic_zero(b / a, c / a, p0 / a);
  } else if (std::fabs(b) >= kTiny) {
    zero = quadratic_zero(b, c, p0);
  } else if (c != 0) {
    zero = -p0 / c;
  }
  return std::clamp(std::isfinite(zero) ? zero : 0.0, 0.0, 1.0);
}

/// Widths of the two tangents of a segment, in parts of its length.
struct Widths {
  double first = 0;
  double last = 0;
};

// Tangents so long that the curve would run back in time are shortened, their ratio kept, until it
// just stands still: there (first, last) lies on the ellipse where the derivative of time has one
// zero. The paddings are OpenUSD's (Ts regression prevention, "keep ratio").
Widths without_regression(Widths widths) {
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
  const double last = (std::sqrt(ratio) + ratio + 1) / (ratio * ratio + ratio + 1);
  return {ratio * last - kWritePadding, last - kWritePadding};
}

double curve_value(const Spline& spline, const SplineKnot& a, const SplineKnot& b, double time) {
  const double span = b.time - a.time;
  const bool hermite = spline.curve == layer::SplineCurve::Hermite;
  const Widths widths =
      hermite ? Widths{1.0 / 3, 1.0 / 3}
              : without_regression({a.post_tangent.width / span, b.pre_tangent.width / span});
  const double first = widths.first * span;
  const double last = widths.last * span;
  const double u = hermite ? (time - a.time) / span
                           : cubic_parameter(a.time - time, a.time + first - time,
                                             b.time - last - time, b.time - time);
  return cubic(a.value, a.value + first * a.post_tangent.slope,
               pre_value(b) - last * b.pre_tangent.slope, pre_value(b), u);
}

Number segment_value(const Spline& spline, const SplineKnot& a, const SplineKnot& b, double time) {
  switch (a.next) {
    case SplineInterpolation::None:
      return std::nullopt;
    case SplineInterpolation::Held:
      return a.value;
    case SplineInterpolation::Linear:
      return a.value + (pre_value(b) - a.value) * (time - a.time) / (b.time - a.time);
    case SplineInterpolation::Curve:
      return curve_value(spline, a, b, time);
  }
  return std::nullopt;
}

// Slope that goes on linearly from the outermost segment.
double end_slope(const SplineKnots& knots, bool before) {
  if (knots.size() < 2) {
    return 0;
  }
  const SplineKnot a = before ? knots[0] : knots[knots.size() - 2];
  const SplineKnot b = before ? knots[1] : knots.back();
  const SplineKnot& end = before ? a : b;
  if (end.pre_value.has_value()) {
    return 0;
  }
  if (a.next == SplineInterpolation::Linear) {
    return (pre_value(b) - a.value) / (b.time - a.time);
  }
  if (a.next == SplineInterpolation::Curve) {
    return before ? a.post_tangent.slope : b.pre_tangent.slope;
  }
  return 0;
}

Number inside_value(const Spline& spline, const SplineKnots& knots, double time) {
  const std::size_t after = knots.count_until(time);
  const SplineKnot a = knots[std::max<std::size_t>(after, 1) - 1];
  // At a knot the side after it counts: of the last one that is the extrapolation.
  const SplineKnot& last = spline.knots.back();
  const bool is_last = a.time == last.time && a.value == last.value;
  if (after == knots.size() || (is_last && a.time == time)) {
    return is_last && spline.post.mode == SplineExtrapolation::None ? Number() : Number(a.value);
  }
  return a.time == time && a.next != SplineInterpolation::None
             ? Number(a.value)
             : segment_value(spline, a, knots[after], time);
}

/// What the segment that ends at `b` comes to there.
Number value_before(const SplineKnot& a, const SplineKnot& b) {
  if (a.next == SplineInterpolation::None) {
    return std::nullopt;
  }
  return a.next == SplineInterpolation::Held ? a.value : pre_value(b);
}

Number looped_value(const Spline& spline, const SplineKnots& knots, double time,
                    SplineExtrapolation mode) {
  const double start = knots.front().time;
  const double span = knots.back().time - start;
  if (!(span > 0)) {
    return time < start ? pre_value(knots.front()) : knots.front().value;
  }
  const double turns = std::floor((time - start) / span);
  double inner = time - turns * span;
  const bool backwards =
      mode == SplineExtrapolation::LoopOscillate && std::fmod(std::fabs(turns), 2.0) == 1.0;
  if (backwards) {
    inner = start + (start + span - inner);
    if (inner >= start + span) {
      return value_before(knots[knots.size() - 2], knots.back());
    }
  }
  Number value = inside_value(spline, knots, std::clamp(inner, start, start + span));
  if (value && mode == SplineExtrapolation::LoopRepeat) {
    // What comes before goes on from the inward sides of the ends.
    const bool ends_as_written = spline.loop && spline.loop->post_loops == 0 &&
                                 spline.knots.back().time == knots.back().time;
    const SplineKnot last = ends_as_written ? spline.knots.back() : knots.back();
    const double rise =
        turns < 0 ? pre_value(last) - pre_value(knots.front()) : last.value - knots.front().value;
    *value += turns * rise;
  }
  return value;
}

Number outside_value(const Spline& spline, const SplineKnots& knots, double time, bool before) {
  const SplineEnd& end = before ? spline.pre : spline.post;
  const SplineKnot knot = before ? knots.front() : knots.back();
  const double value = before ? pre_value(knot) : knot.value;
  switch (end.mode) {
    case SplineExtrapolation::None:
      return std::nullopt;
    case SplineExtrapolation::Held:
      return value;
    case SplineExtrapolation::Linear:
      return value + end_slope(knots, before) * (time - knot.time);
    case SplineExtrapolation::Sloped:
      return value + end.slope * (time - knot.time);
    default:
      return looped_value(spline, knots, time, end.mode);
  }
}

void move_tangent(layer::SplineTangent& tangent, double scale) {
  tangent.width *= scale;
  tangent.slope /= scale;
}

}  // namespace

layer::Spline moved_spline(Spline spline, const layer::LayerOffset& offset) {
  if (offset.is_identity() || offset.scale == 0) {
    return spline;
  }
  spline.pre.slope /= offset.scale;
  spline.post.slope /= offset.scale;
  if (spline.loop) {
    spline.loop->start = offset.apply(spline.loop->start);
    spline.loop->end = offset.apply(spline.loop->end);
  }
  for (SplineKnot& knot : spline.knots) {
    knot.time = offset.apply(knot.time);
    move_tangent(knot.pre_tangent, offset.scale);
    move_tangent(knot.post_tangent, offset.scale);
  }
  return spline;
}

namespace {

// Extrapolation goes on from the knots as they are written, where no copies of a loop stand beyond
// them; repetition goes on from the copies.
Number value_beyond(const Spline& spline, const SplineKnots& knots, double time, bool before) {
  const SplineEnd& end = before ? spline.pre : spline.post;
  if (!spline.loop || end.mode > SplineExtrapolation::Sloped) {
    return outside_value(spline, knots, time, before);
  }
  const layer::SplineLoop& loop = *spline.loop;
  const SplineKnot& knot = before ? spline.knots.front() : spline.knots.back();
  const bool is_outermost = knot.time == (before ? knots.front() : knots.back()).time;
  const bool is_alone = before ? loop.pre_loops == 0 || knot.time < loop.start
                               : loop.post_loops == 0 || knot.time > loop.end;
  return outside_value(spline, is_outermost && is_alone ? SplineKnots::written(spline) : knots,
                       time, before);
}

Number value_at_time(const Spline& spline, double time) {
  const SplineKnots knots = SplineKnots::looped(spline);
  const bool repeats_after = spline.post.mode > SplineExtrapolation::Sloped;
  if (time < knots.front().time) {
    return value_beyond(spline, knots, time, true);
  }
  if (time > knots.back().time || (time == knots.back().time && repeats_after)) {
    return value_beyond(spline, knots, time, false);
  }
  return inside_value(spline, knots, time);
}

}  // namespace

layer::Value evaluate_spline(const Spline& spline, double time) {
  if (spline.knots.empty()) {
    return {};
  }
  const Number value = value_at_time(spline, time);
  if (!value) {
    return {};
  }
  switch (spline.value_type) {
    case layer::ValueType::Float:
      return static_cast<float>(*value);
    case layer::ValueType::Half:
      return Half(*value);
    case layer::ValueType::TimeCode:
      return layer::TimeCode{*value};
    default:
      return *value;
  }
}

}  // namespace tenon::stage
