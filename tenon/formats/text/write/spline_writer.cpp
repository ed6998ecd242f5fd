// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/write/spline_writer.h"

#include <algorithm>

#include "tenon/base/text/text_number.h"
#include "tenon/formats/text/write/dictionary_writer.h"
#include "tenon/formats/text/write/list_writer.h"
#include "tenon/formats/text/write/value_text.h"

namespace tenon::formats::text {
namespace {

using layer::Spline;
using layer::SplineCurve;
using layer::SplineExtrapolation;
using layer::SplineInterpolation;
using layer::SplineKnot;
using layer::SplineTangent;
using layer::TangentAlgorithm;
using layer::ValueType;

/// A number in the precision of the spline's values.
std::string number_text(const Spline& spline, double value) {
  if (spline.value_type == ValueType::Float) {
    return layer_text(static_cast<float>(value));
  }
  if (spline.value_type == ValueType::Half) {
    return value_text(layer::Value(Half(static_cast<float>(value))));
  }
  return layer_text(value);
}

const char* mode_text(SplineExtrapolation mode) {
  constexpr const char* kNames[] = {"none",        "held",       "linear",        "sloped",
                                    "loop repeat", "loop reset", "loop oscillate"};
  return kNames[static_cast<std::size_t>(mode)];
}

void append_end(std::string& out, const char* label, const layer::SplineEnd& end,
                std::size_t indent) {
  if (end == layer::SplineEnd{}) {
    return;
  }
  append_indent(out, indent + 1);
  out += std::string(label) + ": " + mode_text(end.mode);
  if (end.mode == SplineExtrapolation::Sloped) {
    out += '(' + layer_text(end.slope) + ')';
  }
  if (end.boundary) {
    out += '(' + layer_text(*end.boundary) + ')';
  }
  out += ",\n";
}

void append_tangent(std::string& out, const Spline& spline, const char* label,
                    const SplineTangent& tangent) {
  out += std::string("; ") + label + " (";
  if (spline.curve == SplineCurve::Bezier) {
    out += layer_text(tangent.width) + ", ";
  }
  out += number_text(spline, tangent.slope);
  if (tangent.algorithm != TangentAlgorithm::None) {
    out += tangent.algorithm == TangentAlgorithm::Custom ? ", custom" : ", autoEase";
  }
  out += ')';
}

void append_knot(std::string& out, const Spline& spline, const SplineKnot& knot,
                 SplineInterpolation before) {
  out += layer_text(knot.time) + ':';
  if (knot.pre_value) {
    out += ' ' + number_text(spline, *knot.pre_value) + " &";
  }
  out += ' ' + number_text(spline, knot.value);
  if (before == SplineInterpolation::Curve) {
    append_tangent(out, spline, "pre", knot.pre_tangent);
  }
  if (knot.next == SplineInterpolation::Curve) {
    append_tangent(out, spline, "post curve", knot.post_tangent);
  } else {
    constexpr const char* kNames[] = {"none", "held", "linear", "curve"};
    out += std::string("; post ") + kNames[static_cast<std::size_t>(knot.next)];
  }
  if (!knot.custom_data.empty()) {
    out += "; ";
    append_dictionary(out, knot.custom_data, 0, Lines::One);
  }
  out += ",\n";
}

/// True when two neighbouring knots are joined by a curve.
bool has_curve_segment(const Spline& spline) {
  return !spline.knots.empty() &&
         std::any_of(spline.knots.begin(), spline.knots.end() - 1, [](const SplineKnot& knot) {
           return knot.next == SplineInterpolation::Curve;
         });
}

}  // namespace

void append_spline(std::string& out, const Spline& spline, std::size_t indent) {
  if (spline.curve == SplineCurve::Hermite || has_curve_segment(spline)) {
    append_indent(out, indent + 1);
    out += spline.curve == SplineCurve::Bezier ? "bezier,\n" : "hermite,\n";
  }
  append_end(out, "pre", spline.pre, indent);
  append_end(out, "post", spline.post, indent);
  if (spline.loop) {
    append_indent(out, indent + 1);
    out += "loop: (" + layer_text(spline.loop->start) + ", " + layer_text(spline.loop->end) + ", " +
           std::to_string(spline.loop->pre_loops) + ", " + std::to_string(spline.loop->post_loops) +
           ", " + layer_text(spline.loop->value_offset) + "),\n";
  }
  // The first knot has a tangent in front even though no segment ends there.
  SplineInterpolation before = SplineInterpolation::Curve;
  for (const SplineKnot& knot : spline.knots) {
    append_indent(out, indent + 1);
    append_knot(out, spline, knot, before);
    before = knot.next;
  }
}

int minor_version_of(const Spline& spline) {
  if (spline.pre.boundary || spline.post.boundary) {
    return 3;
  }
  const bool has_algorithms =
      std::any_of(spline.knots.begin(), spline.knots.end(), [](const SplineKnot& knot) {
        return knot.pre_tangent.algorithm != TangentAlgorithm::None ||
               knot.post_tangent.algorithm != TangentAlgorithm::None;
      });
  return has_algorithms ? 1 : 0;
}

}  // namespace tenon::formats::text
