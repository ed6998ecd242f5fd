// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A spline is a row of segments between knots. A Bezier segment is a curve in time and value: its
// inner control points lie one tangent away from the knots; the parameter of a time is found by
// bisection, which the monotonic time coordinate allows. A Hermite segment takes the slopes over
// equal thirds. Before and after the knots the ends say what happens (Core Spec 1.0.1 on splines).
#include "tenon/stage/evaluate_spline.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "tenon/base/limits.h"

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

double curve_value(const Spline& spline, const SplineKnot& a, const SplineKnot& b, double time) {
  const double span = b.time - a.time;
  const bool hermite = spline.curve == layer::SplineCurve::Hermite;
  const double first = hermite ? span / 3 : std::clamp(a.post_tangent.width, 0.0, span);
  const double last = hermite ? span / 3 : std::clamp(b.pre_tangent.width, 0.0, span);
  double low = 0;
  double high = 1;
  for (int i = 0; i < 64 && !hermite; ++i) {
    const double middle = (low + high) / 2;
    (cubic(a.time, a.time + first, b.time - last, b.time, middle) < time ? low : high) = middle;
  }
  const double u = hermite ? (time - a.time) / span : (low + high) / 2;
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
double end_slope(const std::vector<SplineKnot>& knots, bool before) {
  if (knots.size() < 2) {
    return 0;
  }
  const SplineKnot& a = before ? knots[0] : knots[knots.size() - 2];
  const SplineKnot& b = before ? knots[1] : knots.back();
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

Number inside_value(const Spline& spline, const std::vector<SplineKnot>& knots, double time) {
  const auto after = std::upper_bound(
      knots.begin(), knots.end(), time,
      [](double t, const SplineKnot& knot) { return t < knot.time; });
  const SplineKnot& a = *std::prev(after);
  return a.time == time || after == knots.end() ? Number(a.value)
                                                : segment_value(spline, a, *after, time);
}

Number looped_value(const Spline& spline, const std::vector<SplineKnot>& knots, double time,
                    SplineExtrapolation mode) {
  const double start = knots.front().time;
  const double span = knots.back().time - start;
  if (!(span > 0)) {
    return knots.front().value;
  }
  const double turns = std::floor((time - start) / span);
  double inner = time - turns * span;
  if (mode == SplineExtrapolation::LoopOscillate && std::fmod(std::fabs(turns), 2.0) == 1.0) {
    inner = start + (start + span - inner);
  }
  Number value = inside_value(spline, knots, std::clamp(inner, start, start + span));
  if (value && mode == SplineExtrapolation::LoopRepeat) {
    *value += turns * (pre_value(knots.back()) - knots.front().value);
  }
  return value;
}

Number outside_value(const Spline& spline, const std::vector<SplineKnot>& knots, double time,
                     bool before) {
  const SplineEnd& end = before ? spline.pre : spline.post;
  const SplineKnot& knot = before ? knots.front() : knots.back();
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

// Knots with the inner loop written out; knots that the copies cover are hidden by them.
std::vector<SplineKnot> unrolled(const Spline& spline) {
  const layer::SplineLoop& loop = *spline.loop;
  const double span = loop.end - loop.start;
  std::vector<SplineKnot> proto;
  for (const SplineKnot& knot : spline.knots) {
    if (knot.time >= loop.start && knot.time < loop.end) {
      proto.push_back(knot);
    }
  }
  if (proto.empty() || proto.front().time != loop.start || !(span > 0)) {
    return spline.knots;
  }
  const auto most = static_cast<std::int32_t>(limits::kSplineLoopKnots / proto.size());
  const std::int32_t before = std::clamp(loop.pre_loops, 0, most);
  const std::int32_t after = std::clamp(loop.post_loops, 0, most);
  const double first = loop.start - before * span;
  const double last = loop.end + after * span;
  std::vector<SplineKnot> result;
  for (const SplineKnot& knot : spline.knots) {
    if (knot.time < first) {
      result.push_back(knot);
    }
  }
  for (int turn = -before; turn <= after + 1; ++turn) {
    for (SplineKnot knot : proto) {
      knot.time += turn * span;
      knot.value += turn * loop.value_offset;
      if (knot.pre_value) {
        *knot.pre_value += turn * loop.value_offset;
      }
      if (turn <= after || knot.time == last) {
        result.push_back(knot);
      }
    }
  }
  for (const SplineKnot& knot : spline.knots) {
    if (knot.time > last) {
      result.push_back(knot);
    }
  }
  return result;
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

layer::Value evaluate_spline(const Spline& spline, double time) {
  if (spline.knots.empty()) {
    return {};
  }
  const std::vector<SplineKnot> knots = spline.loop ? unrolled(spline) : spline.knots;
  Number value;
  if (time < knots.front().time) {
    value = outside_value(spline, knots, time, true);
  } else if (time > knots.back().time) {
    value = outside_value(spline, knots, time, false);
  } else {
    value = inside_value(spline, knots, time);
  }
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
