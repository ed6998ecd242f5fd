// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/layer/field_values.h"

/// How stage time runs through a clip. Internal to tenon/stage.
namespace tenon::stage {

/// The smallest step that keeps two times apart below 1e6 codes and compressions of 10, as OpenUSD
/// computes it.
inline constexpr double kSafeStep = 2.220446049250313e-16 * 1e6 * 10.0 * 2.0;

/// A stage time in a layer's, rounded as OpenUSD rounds it.
inline double layer_time(const layer::LayerOffset& offset, double stage) {
  const double scale = 1 / offset.scale;
  return stage * scale + -offset.offset * scale;
}

/// A piecewise linear map from stage time to the time in clips; the `times` of a clip set.
class ClipTimes {
 public:
  struct Entry {
    double stage = 0;
    double clip = 0;
    bool jump = false;  ///< the segment that starts here is a jump: nothing lies on it
  };

  ClipTimes() = default;
  /// From pairs (stage time, clip time) in any order. Two pairs of one stage time are a jump: the
  /// first holds until just before.
  explicit ClipTimes(const std::vector<Vec2d>& pairs);

  /// Without pairs both times are the same; then there are no segments.
  bool is_identity() const { return entries_.empty(); }
  /// By stage time; the first and the last stand twice, so that every time is in a segment.
  const std::vector<Entry>& entries() const { return entries_; }
  /// Start of the segment in force at a stage time; not for an identity.
  std::size_t segment(double stage) const;
  double to_clip(double stage) const;

  /// The stage time of a time code read from a clip at a stage time: on the line of the segment
  /// there, continued. Where clip time does not advance, the segment's start.
  double code_to_stage(double code, double stage) const;

  /// The segment takes on this clip time.
  bool covers(std::size_t segment, double clip) const;
  /// Stage time of a clip time within a segment that is no jump and takes it on once.
  double to_stage(double clip, std::size_t segment) const;
  bool is_constant(std::size_t segment) const {
    return entries_[segment].clip == entries_[segment + 1].clip;
  }

 private:
  Entry segment_end(std::size_t segment) const;

  std::vector<Entry> entries_;
};

}  // namespace tenon::stage
