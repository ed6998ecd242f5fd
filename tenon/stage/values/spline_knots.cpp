// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/values/spline_knots.h"

#include <algorithm>

#include "tenon/base/limits/limits.h"

namespace tenon::stage {
namespace {

using layer::Spline;
using layer::SplineKnot;

SplineKnot without_custom_data(const SplineKnot& knot) {
  return {knot.time,         knot.value, knot.pre_value, knot.next, knot.pre_tangent,
          knot.post_tangent, {}};
}

/// The number of knots before `time`.
std::size_t count_before(const Spline& spline, double time) {
  const auto end = std::lower_bound(spline.knots.begin(), spline.knots.end(), time,
                                    [](const SplineKnot& knot, double t) { return knot.time < t; });
  return static_cast<std::size_t>(end - spline.knots.begin());
}

}  // namespace

SplineKnots SplineKnots::written(const Spline& spline) {
  SplineKnots knots(spline);
  knots.head_ = spline.knots.size();
  return knots;
}

SplineKnots SplineKnots::looped(const Spline& spline) {
  if (!spline.loop) {
    return written(spline);
  }
  const layer::SplineLoop& loop = *spline.loop;
  const double span = loop.end - loop.start;
  SplineKnots knots(spline);
  knots.proto_ = count_before(spline, loop.start);
  const std::size_t proto_end = count_before(spline, loop.end);
  const bool repeats = loop.pre_loops > 0 || loop.post_loops > 0;
  if (!repeats || !(span > 0) || proto_end <= knots.proto_ ||
      spline.knots[knots.proto_].time != loop.start) {
    return written(spline);
  }
  knots.proto_count_ = proto_end - knots.proto_;
  const auto most = static_cast<std::int32_t>(limits::kSplineLoopKnots / knots.proto_count_);
  knots.before_ = std::clamp(loop.pre_loops, 0, most);
  knots.after_ = std::clamp(loop.post_loops, 0, most);
  const auto turns = static_cast<std::size_t>(knots.before_ + knots.after_ + 1);
  knots.copies_ = turns * knots.proto_count_ + 1;
  knots.head_ = count_before(spline, loop.start - knots.before_ * span);
  const double last = loop.end + knots.after_ * span;
  const auto tail =
      std::upper_bound(spline.knots.begin(), spline.knots.end(), last,
                       [](double t, const SplineKnot& knot) { return t < knot.time; });
  knots.tail_ = static_cast<std::size_t>(spline.knots.end() - tail);
  return knots;
}

SplineKnot SplineKnots::operator[](std::size_t at) const {
  if (at < head_) {
    return without_custom_data(spline_.knots[at]);
  }
  return at < head_ + copies_
             ? copy(at - head_)
             : without_custom_data(spline_.knots[spline_.knots.size() - (size() - at)]);
}

std::size_t SplineKnots::written_index(std::size_t at) const {
  if (at < head_) {
    return at;
  }
  return at < head_ + copies_ ? proto_ + (at - head_) % proto_count_
                              : spline_.knots.size() - (size() - at);
}

std::int32_t SplineKnots::turn(std::size_t at) const {
  return at < head_ || at >= head_ + copies_
             ? 0
             : static_cast<std::int32_t>((at - head_) / proto_count_) - before_;
}

SplineKnot SplineKnots::copy(std::size_t at) const {
  const layer::SplineLoop& loop = *spline_.loop;
  const double span = loop.end - loop.start;
  const std::int32_t turn = static_cast<std::int32_t>(at / proto_count_) - before_;
  SplineKnot knot = without_custom_data(spline_.knots[proto_ + at % proto_count_]);
  // The first knot once more ends the loop.
  knot.time = turn > after_ ? loop.end + after_ * span : knot.time + turn * span;
  knot.value += turn * loop.value_offset;
  if (knot.pre_value) {
    *knot.pre_value += turn * loop.value_offset;
  }
  return knot;
}

std::size_t SplineKnots::count_until(double time) const {
  std::size_t low = 0;
  std::size_t high = size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (time < (*this)[middle].time) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return low;
}

}  // namespace tenon::stage
