// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A spline is a row of segments between knots. A Bezier segment is a curve in time and value: its
// inner control points lie one tangent away from the knots. A Hermite segment takes the slopes over
// equal thirds. Before and after the knots the ends say what happens (Core Spec 1.0.1 on splines).
#include "tenon/stage/values/evaluate_spline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "tenon/layer/time/spline_rules.h"
#include "tenon/math/functions.h"
#include "tenon/stage/values/spline_knots.h"

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
  double nearest = kInfinity;
  for (int i = 0; i < 3; ++i) {
    const double turned = (angle + 2 * i * std::numbers::pi) / 3;
    const double candidate = 2 * std::cbrt(radius) * std::cos(turned) - b / 3;
    const double outside = std::fabs(candidate - std::clamp(candidate, 0.0, 1.0));
    if (outside <= nearest) {  // rounding may put it a little outside
      zero = candidate;
      nearest = outside;
    }
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

double curve_value(const Spline& spline, const SplineKnot& a, const SplineKnot& b, double time) {
  const double span = b.time - a.time;
  const bool hermite = spline.curve == layer::SplineCurve::Hermite;
  const layer::TangentWidths written{a.post_tangent.width / span, b.pre_tangent.width / span};
  const layer::TangentWidths widths =
      hermite ? layer::TangentWidths{1.0 / 3, 1.0 / 3} : layer::without_regression(written);
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
double end_slope(const Spline& spline, const SplineKnots& knots, bool before) {
  if (spline.knots.size() < 2) {  // copies of one knot do not count
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

/// What a curve has at a knot: on the side after it, which for the last written knot and its copies
/// is the extrapolation.
Number value_at_knot(const Spline& spline, const SplineKnots& knots, std::size_t at) {
  const SplineKnot knot = knots[at];
  const bool is_last = knots.written_index(at) + 1 == spline.knots.size();
  const bool is_none = is_last ? spline.post.mode == SplineExtrapolation::None
                               : knot.next == SplineInterpolation::None;
  return is_none ? Number() : Number(knot.value);
}

/// The same on the side before it, where the segment to its written neighbour ends: copies end as
/// the knot does that they are copies of.
Number value_before_knot(const Spline& spline, const SplineKnots& knots, std::size_t at) {
  const SplineKnot knot = knots[at];
  const std::size_t written = knots.written_index(at);
  if (written == 0) {
    return spline.pre.mode == SplineExtrapolation::None ? Number() : Number(pre_value(knot));
  }
  const SplineKnot& before = spline.knots[written - 1];
  if (before.next == SplineInterpolation::None) {
    return std::nullopt;
  }
  return before.next == SplineInterpolation::Held
             ? before.value + (knot.value - spline.knots[written].value)
             : pre_value(knot);
}

Number value_beyond(const Spline& spline, const SplineKnots& knots, double time, bool before);

/// By how many copies OpenUSD goes back to reach the loop from `time`.
double copies_back(const layer::SplineLoop& loop, double time) {
  const double span = loop.end - loop.start;
  return time < loop.start ? -std::ceil((loop.start - time) / span)
                           : std::trunc((time - loop.end) / span) + 1;
}

/// OpenUSD takes the time of a copy back into the loop. Where rounding puts a copy of its first
/// knot before the loop or at the end of the copy before, the value there counts; nothing when that
/// is not so.
std::optional<Number> value_rounded_out(const Spline& spline, const SplineKnots& knots,
                                        std::size_t at) {
  const SplineKnot knot = knots[at];
  const std::size_t written = knots.written_index(at);
  const SplineKnot& first = spline.knots[written];
  if (knots.turn(at) == 0 || first.time != spline.loop->start) {
    return std::nullopt;
  }
  const double copies = copies_back(*spline.loop, knot.time);
  if (copies < knots.turn(at) && at > 0) {
    return segment_value(spline, knots[at - 1], knot, knot.time);
  }
  const double inside = knot.time - copies * (spline.loop->end - spline.loop->start);
  if (inside >= first.time) {
    return std::nullopt;
  }
  const bool loops = spline.pre.mode > SplineExtrapolation::Sloped;
  Number value;
  if (written > 0) {
    value = segment_value(spline, spline.knots[written - 1], first, inside);
  } else if (loops) {
    value = pre_value(first);
  } else {
    value = value_beyond(spline, SplineKnots::written(spline), inside, true);
  }
  if (value) {
    *value += knot.value - first.value;
  }
  return value;
}

/// Between the first knot and the last. `from_after`: at a knot, the side before it.
Number inside_value(const Spline& spline, const SplineKnots& knots, double time,
                    bool from_after = false) {
  const std::size_t after = knots.count_until(time);
  const std::size_t before = std::max<std::size_t>(after, 1) - 1;
  const SplineKnot a = knots[before];
  if (a.time == time || after == knots.size()) {
    if (const auto rounded = value_rounded_out(spline, knots, before); rounded && !from_after) {
      return *rounded;
    }
    return from_after ? value_before_knot(spline, knots, before)
                      : value_at_knot(spline, knots, before);
  }
  return segment_value(spline, a, knots[after], time);
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
  }
  // Rounding may put it a little outside, where the other end counts unless that is a loop, too.
  const double end = knots.back().time;
  const bool is_before = inner < start && spline.pre.mode <= SplineExtrapolation::Sloped;
  const bool is_beyond = inner > end && spline.post.mode <= SplineExtrapolation::Sloped;
  Number value = is_before || is_beyond
                     ? value_beyond(spline, knots, inner, is_before)
                     : inside_value(spline, knots, std::clamp(inner, start, end), backwards);
  if (value && mode == SplineExtrapolation::LoopRepeat) {
    // What comes before goes on from the inward sides of the ends.
    const bool starts_as_written = spline.knots.front().time == start;
    const bool ends_as_written = spline.knots.back().time == knots.back().time;
    const SplineKnot first = starts_as_written ? spline.knots.front() : knots.front();
    const SplineKnot last = ends_as_written ? spline.knots.back() : knots.back();
    const double rise = turns < 0 ? pre_value(last) - pre_value(first) : last.value - first.value;
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
      return value + end_slope(spline, knots, before) * (time - knot.time);
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
