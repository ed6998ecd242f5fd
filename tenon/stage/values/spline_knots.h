// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "tenon/layer/time/spline.h"

/// Internal to this folder.
namespace tenon::stage {

/// The knots of a spline in their order, copies by its inner loop included, made one by one when
/// they are asked for: a short file can ask for very many. Knots that the copies cover are hidden
/// by them. Refers to the spline. Custom data of knots are not included.
class SplineKnots {
 public:
  /// As written: without copies.
  static SplineKnots written(const layer::Spline& spline);
  /// With the inner loop written out, up to limits::kSplineLoopKnots copies each way.
  static SplineKnots looped(const layer::Spline& spline);

  std::size_t size() const { return head_ + copies_ + tail_; }
  layer::SplineKnot operator[](std::size_t at) const;
  /// The written knot that it is, or is a copy of.
  std::size_t written_index(std::size_t at) const;
  /// Which copy of the loop the knot is in: 0 the loop itself and knots outside of it.
  std::int32_t turn(std::size_t at) const;
  layer::SplineKnot front() const { return (*this)[0]; }
  layer::SplineKnot back() const { return (*this)[size() - 1]; }
  /// The number of knots that are not later than `time`.
  std::size_t count_until(double time) const;

 private:
  explicit SplineKnots(const layer::Spline& spline) : spline_(spline) {}
  layer::SplineKnot copy(std::size_t at) const;

  const layer::Spline& spline_;
  std::size_t head_ = 0;         // knots before the copies
  std::size_t copies_ = 0;       // the one that ends the loop included
  std::size_t tail_ = 0;         // the last ones of the spline
  std::size_t proto_ = 0;        // the first knot of the loop
  std::size_t proto_count_ = 0;  // knots that are copied
  std::int32_t before_ = 0;      // copies of them all before the loop
  std::int32_t after_ = 0;
};

}  // namespace tenon::stage
