// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/dump/spline_text.h"

#include "tenon/base/text/text_number.h"
#include "tenon/formats/text/write/value_text.h"

namespace tenon::answers {
namespace {

using layer::SplineExtrapolation;
using layer::SplineInterpolation;

const char* type_text(const layer::Spline& spline) {
  switch (spline.value_type) {
    case layer::ValueType::Float:
      return "float";
    case layer::ValueType::Half:
      return "half";
    default:
      return "double";
  }
}

std::string end_text(const layer::SplineEnd& end) {
  switch (end.mode) {
    case SplineExtrapolation::None:
      return "ValueBlock";
    case SplineExtrapolation::Held:
      return "Held";
    case SplineExtrapolation::Linear:
      return "Linear";
    case SplineExtrapolation::Sloped:
      return "Sloped " + layer_text(end.slope);
    case SplineExtrapolation::LoopRepeat:
      return "LoopRepeat";
    case SplineExtrapolation::LoopReset:
      return "LoopReset";
    case SplineExtrapolation::LoopOscillate:
      return "LoopOscillate";
  }
  return "";
}

const char* interpolation_text(SplineInterpolation interpolation) {
  switch (interpolation) {
    case SplineInterpolation::None:
      return "ValueBlock";
    case SplineInterpolation::Held:
      return "Held";
    case SplineInterpolation::Linear:
      return "Linear";
    case SplineInterpolation::Curve:
      return "Curve";
  }
  return "";
}

void add_line(std::string& text, const char* name, const std::string& value) {
  text += std::string("  ") + name + " " + value + "\n";
}

/// In the precision of the spline's values.
std::string number_text(const layer::Spline& spline, double value) {
  if (spline.value_type == layer::ValueType::Half) {
    return formats::value_text(layer::Value(Half(value)));
  }
  return spline.value_type == layer::ValueType::Float ? layer_text(static_cast<float>(value))
                                                      : layer_text(value);
}

void add_tangent(std::string& text, const layer::Spline& spline, const std::string& side,
                 const layer::SplineTangent& tangent, double width) {
  add_line(text, (side + "-tan width").c_str(), layer_text(width));
  add_line(text, (side + "-tan slope").c_str(), number_text(spline, tangent.slope));
  if (tangent.algorithm != layer::TangentAlgorithm::None) {
    const bool custom = tangent.algorithm == layer::TangentAlgorithm::Custom;
    add_line(text, (side + "-tan algorithm").c_str(), custom ? "Custom" : "AutoEase");
  }
}

// Hermite tangents are a third of the way to the next knot long.
double width(const layer::Spline& spline, std::size_t knot, bool before) {
  const layer::SplineKnot& at = spline.knots[knot];
  if (spline.curve == layer::SplineCurve::Bezier) {
    return before ? at.pre_tangent.width : at.post_tangent.width;
  }
  if (before) {
    return knot == 0 ? 0 : (at.time - spline.knots[knot - 1].time) / 3;
  }
  return knot + 1 == spline.knots.size() ? 0 : (spline.knots[knot + 1].time - at.time) / 3;
}

}  // namespace

std::string spline_text(const layer::Spline& spline) {
  std::string text = "Spline:\n";
  add_line(text, "value type", type_text(spline));
  add_line(text, "time valued", spline.time_valued ? "1" : "0");
  add_line(text, "curve type", spline.curve == layer::SplineCurve::Bezier ? "Bezier" : "Hermite");
  add_line(text, "pre extrap", end_text(spline.pre));
  add_line(text, "post extrap", end_text(spline.post));
  if (spline.loop) {
    text += "Loop:\n";
    add_line(text, "start",
             layer_text(spline.loop->start) + ", end " + layer_text(spline.loop->end) +
                 ", numPreLoops " + std::to_string(spline.loop->pre_loops) + ", numPostLoops " +
                 std::to_string(spline.loop->post_loops) + ", valueOffset " +
                 layer_text(spline.loop->value_offset));
  }
  for (std::size_t i = 0; i < spline.knots.size(); ++i) {
    const layer::SplineKnot& knot = spline.knots[i];
    text += "Knot:\n";
    add_line(text, "value type", type_text(spline));
    add_line(text, "time", layer_text(knot.time));
    add_line(text, "value", number_text(spline, knot.value));
    add_line(text, "next interp", interpolation_text(knot.next));
    if (knot.pre_value) {
      add_line(text, "preValue", number_text(spline, *knot.pre_value));
    }
    add_tangent(text, spline, "pre", knot.pre_tangent, width(spline, i, true));
    add_tangent(text, spline, "post", knot.post_tangent, width(spline, i, false));
  }
  return text;
}

}  // namespace tenon::answers
