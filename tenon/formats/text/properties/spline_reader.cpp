// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The items of a spline may come in any order and are settled at its '}': knots are put in order of
// time, the first of equal times stays, and only then automatic tangents are computed, since they
// depend on both neighbours. A knot is rounded to the type of the attribute before it is checked,
// so that a number that is finite only as a double is refused. Splines of time codes are kept as
// doubles.
#include <algorithm>
#include <cmath>

#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/properties/property_reader.h"
#include "tenon/formats/text/value_reader.h"
#include "tenon/layer/time/ease_tangents.h"
#include "tenon/layer/time/spline.h"
#include "tenon/layer/time/spline_rules.h"

namespace tenon::formats::text {
namespace {

using layer::Spline;
using layer::SplineExtrapolation;
using layer::SplineInterpolation;
using layer::SplineKnot;
using layer::SplineTangent;
using layer::TangentAlgorithm;
using layer::ValueType;

class SplineReader {
 public:
  explicit SplineReader(Cursor& cursor) : cursor_(cursor) {}

  bool read(Spline& spline) {
    if (!cursor_.expect('{', "before the spline")) {
      return false;
    }
    cursor_.skip_multi_line();
    const bool ok = cursor_.accept('}') ||
                    read_items(cursor_, '}', "of the spline", [&] { return read_item(spline); });
    if (ok) {
      sort_knots(spline.knots);
      layer::ease_tangents(spline);
    }
    return ok;
  }

 private:
  bool read_item(Spline& spline) {
    if (cursor_.accept_word("bezier")) {
      spline.curve = layer::SplineCurve::Bezier;
      return true;
    }
    if (cursor_.accept_word("hermite")) {
      spline.curve = layer::SplineCurve::Hermite;
      return true;
    }
    if (cursor_.accept_word("pre")) {
      return colon() && read_end(spline.pre);
    }
    if (cursor_.accept_word("post")) {
      return colon() && read_end(spline.post);
    }
    if (cursor_.accept_word("loop")) {
      return colon() && read_loop(spline.loop.emplace());
    }
    if (!at_number(cursor_)) {
      return cursor_.fail_expected("bezier, hermite, pre, post, loop or the time of a knot");
    }
    return read_knot(spline.knots.emplace_back(), spline.value_type);
  }

  bool colon() {
    cursor_.skip_inline();
    if (!cursor_.expect(':', "in a spline")) {
      return false;
    }
    cursor_.skip_inline();
    return true;
  }
  bool mark(char c) {
    cursor_.skip_inline();
    if (!cursor_.expect(c, "in a spline")) {
      return false;
    }
    cursor_.skip_inline();
    return true;
  }
  bool number(double& value) { return read_double(cursor_, value); }

  bool read_end(layer::SplineEnd& end) {
    constexpr std::pair<std::string_view, SplineExtrapolation> kModes[] = {
        {"none", SplineExtrapolation::None},
        {"held", SplineExtrapolation::Held},
        {"linear", SplineExtrapolation::Linear}};
    constexpr std::pair<std::string_view, SplineExtrapolation> kLoops[] = {
        {"repeat", SplineExtrapolation::LoopRepeat},
        {"reset", SplineExtrapolation::LoopReset},
        {"oscillate", SplineExtrapolation::LoopOscillate}};
    end = {};
    for (const auto& [word, mode] : kModes) {
      if (cursor_.accept_word(word)) {
        end.mode = mode;
        return true;
      }
    }
    if (cursor_.accept_word("sloped")) {
      end.mode = SplineExtrapolation::Sloped;
      if (!mark('(') || !number(end.slope)) {
        return false;
      }
      cursor_.skip_inline();
      return cursor_.expect(')', "after the slope");
    }
    if (cursor_.accept_word("loop") && cursor_.accept_separator()) {
      for (const auto& [word, mode] : kLoops) {
        if (cursor_.accept_word(word)) {
          end.mode = mode;
          return read_boundary(end);
        }
      }
      return cursor_.fail_expected("repeat, reset or oscillate");
    }
    return cursor_.fail_expected("none, held, linear, sloped or loop");
  }

  /// The `(time)` that may follow a loop at an end.
  bool read_boundary(layer::SplineEnd& end) {
    const std::size_t before = cursor_.offset();
    cursor_.skip_inline();
    if (!cursor_.accept('(')) {
      cursor_.seek(before);
      return true;
    }
    cursor_.skip_inline();
    if (!number(end.boundary.emplace())) {
      return false;
    }
    cursor_.skip_inline();
    return cursor_.expect(')', "after the boundary of the loop");
  }

  bool read_loop(layer::SplineLoop& loop) {
    const std::size_t start = cursor_.offset();
    double pre = 0;
    double post = 0;
    if (!mark('(') || !number(loop.start) || !mark(',') || !number(loop.end) || !mark(',') ||
        !number(pre) || !mark(',') || !number(post) || !mark(',') || !number(loop.value_offset)) {
      return false;
    }
    cursor_.skip_inline();
    const auto is_count = [](double number) {
      return std::trunc(number) == number && number >= -2147483648.0 && number <= 2147483647.0;
    };
    if (!is_count(pre) || !is_count(post)) {
      return cursor_.fail_at(start, ErrorCode::Parse, "text.value",
                             "the loop counts must be whole numbers");
    }
    loop.pre_loops = static_cast<std::int32_t>(std::max(pre, 0.0));
    loop.post_loops = static_cast<std::int32_t>(std::max(post, 0.0));
    return cursor_.expect(')', "after the loop");
  }

  bool read_knot(SplineKnot& knot, ValueType type) {
    const std::size_t start = cursor_.offset();
    if (!number(knot.time) || !colon() || !number(knot.value)) {
      return false;
    }
    const std::size_t before = cursor_.offset();
    cursor_.skip_inline();
    if (cursor_.accept('&')) {
      cursor_.skip_inline();
      knot.pre_value = knot.value;
      if (!number(knot.value)) {
        return false;
      }
    } else {
      cursor_.seek(before);
    }
    if (!read_parameters(knot)) {
      return false;
    }
    layer::round_knot(knot, type);
    const char* fault = layer::fault_of(knot);
    return fault == nullptr || cursor_.fail_at(start, ErrorCode::Parse, "text.value", fault);
  }

  /// `; parameter; parameter`, also one per line after the first; a last ';' is allowed.
  bool read_parameters(SplineKnot& knot) {
    cursor_.skip_inline();
    if (!cursor_.accept(';')) {
      return true;
    }
    bool more = true;
    while (more) {
      cursor_.skip_multi_line();
      if (cursor_.peek() == '}' || cursor_.peek() == ',') {
        return true;
      }
      if (!read_parameter(knot)) {
        return false;
      }
      cursor_.skip_single_line();
      more = cursor_.accept_statement_end();
    }
    return true;
  }

  bool read_parameter(SplineKnot& knot) {
    if (cursor_.peek() == '{') {
      return read_dictionary(cursor_, knot.custom_data);
    }
    if (cursor_.accept_word("pre")) {
      cursor_.skip_inline();
      return read_tangent(knot.pre_tangent);
    }
    if (!cursor_.accept_word("post")) {
      return cursor_.fail_expected("pre, post or a dictionary");
    }
    cursor_.skip_inline();
    if (!read_interpolation(knot.next)) {
      return false;
    }
    const std::size_t before = cursor_.offset();
    cursor_.skip_inline();
    if (cursor_.peek() == '(') {
      return read_tangent(knot.post_tangent);
    }
    cursor_.seek(before);
    return true;
  }

  bool read_interpolation(SplineInterpolation& mode) {
    constexpr std::pair<std::string_view, SplineInterpolation> kModes[] = {
        {"none", SplineInterpolation::None},
        {"held", SplineInterpolation::Held},
        {"linear", SplineInterpolation::Linear},
        {"curve", SplineInterpolation::Curve}};
    for (const auto& [word, value] : kModes) {
      if (cursor_.accept_word(word)) {
        mode = value;
        return true;
      }
    }
    return cursor_.fail_expected("none, held, linear or curve");
  }

  /// (slope), (width, slope), (slope, algorithm) or (width, slope, algorithm).
  bool read_tangent(SplineTangent& tangent) {
    if (!mark('(') || !number(tangent.slope)) {
      return false;
    }
    cursor_.skip_inline();
    while (cursor_.accept(',')) {
      cursor_.skip_inline();
      if (cursor_.accept_word("custom")) {
        tangent.algorithm = TangentAlgorithm::Custom;
        break;
      }
      if (cursor_.accept_word("autoEase")) {
        tangent.algorithm = TangentAlgorithm::AutoEase;
        break;
      }
      tangent.width = tangent.slope;
      if (!number(tangent.slope)) {
        return false;
      }
      cursor_.skip_inline();
    }
    cursor_.skip_inline();
    return cursor_.expect(')', "after the tangent");
  }

  /// Ascending in time; of equal times the first knot counts.
  static void sort_knots(std::vector<SplineKnot>& knots) {
    std::stable_sort(knots.begin(), knots.end(),
                     [](const SplineKnot& a, const SplineKnot& b) { return a.time < b.time; });
    knots.erase(
        std::unique(knots.begin(), knots.end(),
                    [](const SplineKnot& a, const SplineKnot& b) { return a.time == b.time; }),
        knots.end());
  }

  Cursor& cursor_;
};

}  // namespace

bool read_spline(Cursor& cursor, ValueType type, layer::Value& value) {
  Spline spline;
  spline.time_valued = type == ValueType::TimeCode;
  spline.value_type = spline.time_valued ? ValueType::Double : type;
  const bool fits = spline.value_type == ValueType::Double ||
                    spline.value_type == ValueType::Float || spline.value_type == ValueType::Half;
  if (!fits) {
    return cursor.fail_at(cursor.offset(), ErrorCode::Parse, "text.type",
                          "only double, float, half and timecode attributes can have a spline");
  }
  if (!SplineReader(cursor).read(spline)) {
    return false;
  }
  value = layer::Value(std::move(spline));
  return true;
}

}  // namespace tenon::formats::text
