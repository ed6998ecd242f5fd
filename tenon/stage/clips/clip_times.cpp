// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/clips/clip_times.h"

#include <algorithm>

namespace tenon::stage {

ClipTimes::ClipTimes(const std::vector<Vec2d>& pairs) {
  if (pairs.empty()) {
    return;
  }
  entries_.reserve(pairs.size() + 2);
  entries_.push_back({});
  for (const Vec2d& pair : pairs) {
    entries_.push_back({pair[0], pair[1], false});
  }
  std::stable_sort(entries_.begin() + 1, entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.stage < b.stage; });
  // Nothing is in front of a jump at the very beginning.
  if (entries_.size() > 2 && entries_[1].stage == entries_[2].stage) {
    entries_.erase(entries_.begin() + 1);
  }
  for (std::size_t i = 1; i + 1 < entries_.size(); ++i) {
    if (entries_[i].stage == entries_[i + 1].stage) {
      entries_[i].stage -= kSafeStep;
      entries_[i].jump = true;
    }
  }
  entries_.front() = entries_[1];
  entries_.push_back(Entry(entries_.back()));
}

std::size_t ClipTimes::segment(double stage) const {
  if (stage <= entries_.front().stage) {
    return 0;
  }
  if (stage >= entries_.back().stage) {
    return entries_.size() - 2;
  }
  const auto after =
      std::lower_bound(entries_.begin(), entries_.end(), stage,
                       [](const Entry& entry, double time) { return entry.stage < time; });
  return static_cast<std::size_t>(after - entries_.begin()) - 1;
}

// Before a jump the line runs to the authored time, which keeps samples in front of it exact.
ClipTimes::Entry ClipTimes::segment_end(std::size_t segment) const {
  Entry end = entries_[segment + 1];
  if (end.jump && segment + 2 < entries_.size()) {
    end.stage = entries_[segment + 2].stage;
  }
  return end;
}

double ClipTimes::to_clip(double stage) const {
  if (is_identity()) {
    return stage;
  }
  const std::size_t at = segment(stage);
  const Entry& start = entries_[at];
  const Entry end = segment_end(at);
  // The ends are taken as they are, without rounding.
  if (start.stage == end.stage || stage == start.stage) {
    return start.clip;
  }
  if (stage == end.stage) {
    return end.clip;
  }
  return (end.clip - start.clip) / (end.stage - start.stage) * (stage - start.stage) + start.clip;
}

bool ClipTimes::covers(std::size_t segment, double clip) const {
  const auto [low, high] = std::minmax(entries_[segment].clip, entries_[segment + 1].clip);
  return low <= clip && clip <= high;
}

double ClipTimes::to_stage(double clip, std::size_t segment) const {
  const Entry& start = entries_[segment];
  const Entry end = segment_end(segment);
  if (start.clip == end.clip || clip == start.clip) {
    return start.stage;
  }
  if (clip == end.clip) {
    return end.stage;
  }
  return (end.stage - start.stage) / (end.clip - start.clip) * (clip - start.clip) + start.stage;
}

double ClipTimes::code_to_stage(double code, double stage) const {
  if (is_identity()) {
    return code;
  }
  // The doubled ends count as the segments next to them, a jump as the one behind it.
  const std::size_t last = entries_.size() - 2;
  std::size_t at = std::clamp<std::size_t>(segment(stage), 1, std::max<std::size_t>(last, 2) - 1);
  at += entries_[at].jump ? 1 : 0;
  return to_stage(code, std::min(at, last));
}

}  // namespace tenon::stage
