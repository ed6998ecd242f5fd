// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/layer/dictionary.h"
#include "tenon/layer/value.h"

namespace tenon::layer {

enum class SplineCurve : unsigned char { Bezier, Hermite };
enum class SplineInterpolation : unsigned char { None, Held, Linear, Curve };
enum class SplineExtrapolation : unsigned char {
  None,
  Held,
  Linear,
  Sloped,
  LoopRepeat,
  LoopReset,
  LoopOscillate,
};
enum class TangentAlgorithm : unsigned char { None, Custom, AutoEase };

struct SplineTangent {
  double width = 0;  ///< time codes; unused by Hermite curves
  double slope = 0;  ///< value per time code
  TangentAlgorithm algorithm = TangentAlgorithm::None;
  bool operator==(const SplineTangent&) const = default;
};

struct SplineKnot {
  double time = 0;
  double value = 0;
  std::optional<double> pre_value;  ///< of dual-valued knots
  SplineInterpolation next = SplineInterpolation::Held;
  SplineTangent pre_tangent;
  SplineTangent post_tangent;
  Dictionary custom_data;
  bool operator==(const SplineKnot&) const = default;
};

struct SplineEnd {
  SplineExtrapolation mode = SplineExtrapolation::Held;
  double slope = 0;                ///< of Sloped
  std::optional<double> boundary;  ///< of loops: a time; repeated is what lies inside of it
  bool operator==(const SplineEnd&) const = default;
};

/// Repeats the knots in [start, end) before and after, each time higher by `value_offset`.
struct SplineLoop {
  double start = 0;
  double end = 0;
  std::int32_t pre_loops = 0;
  std::int32_t post_loops = 0;
  double value_offset = 0;
  bool operator==(const SplineLoop&) const = default;
};

/// An animation curve; knots ascending in time. The value type is the attribute's: Double, Float,
/// Half (or TimeCode).
struct Spline {
  ValueType value_type = ValueType::Double;
  SplineCurve curve = SplineCurve::Bezier;
  bool time_valued = false;
  SplineEnd pre;
  SplineEnd post;
  std::optional<SplineLoop> loop;
  std::vector<SplineKnot> knots;
  bool operator==(const Spline&) const = default;
};

}  // namespace tenon::layer
