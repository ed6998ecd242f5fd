// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Times and values of attributes in a clip set. A clip answers for its own stretch of time only;
// its start counts as a sample, so that no value depends on more than the clip in force and the
// start of the next. Core Spec 1.0.1 section 12 on value clips; where it is silent, as OpenUSD.
#include <algorithm>
#include <array>
#include <cmath>

#include "tenon/base/limits/limits.h"
#include "tenon/layer/fields.h"
#include "tenon/stage/clips/clip_set.h"

namespace tenon::stage {
namespace {

using layer::TimeSamples;
using layer::Value;
namespace fields = layer::fields;

const TimeSamples* samples_in(const layer::Layer* layer, Path path) {
  const layer::Spec* spec = layer == nullptr ? nullptr : layer->find(path);
  const auto* samples = spec == nullptr ? nullptr : spec->get<TimeSamples>(fields::timeSamples);
  return samples == nullptr || samples->empty() ? nullptr : samples;
}

// Ascending times around `time`; both the same at, before and after the outermost.
std::pair<double, double> around(const double* first, const double* last, double time) {
  const double* after = std::lower_bound(first, last, time);
  if (after == last) {
    return {*(last - 1), *(last - 1)};
  }
  return *after == time || after == first ? std::pair{*after, *after}
                                          : std::pair{*(after - 1), *after};
}

bool has_sample_at(const TimeSamples& samples, double time) {
  return std::binary_search(samples.times.begin(), samples.times.end(), time);
}

// Time codes in a clip are times of the clip.
Value with_stage_codes(Value value, const ClipTimes& times, double stage) {
  if (const auto* code = value.get<layer::TimeCode>()) {
    return layer::TimeCode{times.code_to_stage(code->value, stage)};
  }
  if (const auto* codes = value.get<layer::Array<layer::TimeCode>>()) {
    std::vector<layer::TimeCode> result(codes->begin(), codes->end());
    for (layer::TimeCode& code : result) {
      code.value = times.code_to_stage(code.value, stage);
    }
    return result;
  }
  return value;
}

}  // namespace

const Value* ClipSet::manifest_default(Path in_clip) const {
  const layer::Layer* layer = manifest_ == nullptr ? nullptr : manifest_->get();
  const layer::Spec* spec = layer == nullptr ? nullptr : layer->find(in_clip);
  return spec == nullptr ? nullptr : spec->find(fields::default_value);
}

// Where missing values are interpolated, a clip without samples counts only for a default in the
// manifest. A block in the manifest at the clip's start says that it has none.
bool ClipSet::contributes(const Clip& clip, Path in_clip) const {
  if (!interpolate_missing_ || manifest_default(in_clip) != nullptr) {
    return true;
  }
  const TimeSamples* declared =
      manifest_ == nullptr ? nullptr : samples_in(manifest_->get(), in_clip);
  if (declared != nullptr && has_sample_at(*declared, clip.authored_start) &&
      stage::value_at(*declared, clip.authored_start, Interpolation::Held).is_block()) {
    return false;
  }
  return samples_in(clip.layer->get(), in_clip) != nullptr;
}

// Samples of the layer in stage time. Several stage times may share one clip time; the nearest in
// either direction is taken, except jumps.
ClipSet::Bracket ClipSet::layer_bracket(const TimeSamples& samples, double time) const {
  const TimeSamples::Bracket found = samples.bracket(times_.to_clip(time));
  const double lower = samples.times[found.lower];
  const double upper = samples.times[found.upper];
  if (times_.is_identity()) {
    return {lower, upper};
  }
  const std::vector<ClipTimes::Entry>& entries = times_.entries();
  const auto stage_time = [&](std::size_t segment, double clip_time,
                              bool is_lower) -> std::optional<double> {
    const ClipTimes::Entry& start = entries[segment];
    const ClipTimes::Entry& end = entries[segment + 1];
    if (start.jump || !times_.covers(segment, clip_time)) {
      return std::nullopt;
    }
    if (!times_.is_constant(segment)) {
      return times_.to_stage(clip_time, segment);
    }
    if (lower == upper && (time == start.stage || time == end.stage)) {
      return time;
    }
    return is_lower ? start.stage : end.stage;
  };
  const std::size_t here = times_.segment(time);
  std::optional<double> from;
  for (std::size_t i = here + 1; !from && i-- > 0;) {
    from = stage_time(i, lower, true);
  }
  std::optional<double> to;
  for (std::size_t i = here; !to && i + 1 < entries.size(); ++i) {
    to = stage_time(i, upper, false);
  }
  if (!from && !to) {
    const auto clamped = [&](double clip_time) {
      return clip_time < entries.front().clip  ? entries.front().stage
             : clip_time > entries.back().clip ? entries.back().stage
                                               : time;
    };
    return {clamped(lower), clamped(upper)};
  }
  return {from ? *from : *to, to ? *to : *from};
}

ClipSet::Bracket ClipSet::clip_bracket(const Clip& clip, Path in_clip, double time) const {
  std::array<double, 5> times{};  // the first `count`, in order
  std::size_t count = 0;
  const auto add = [&](double candidate) {
    if (clip.start <= candidate && candidate < clip.end) {
      std::size_t at = count++;
      for (; at > 0 && candidate < times[at - 1]; --at) {
        times[at] = times[at - 1];
      }
      times[at] = candidate;
    }
  };
  if (const TimeSamples* samples = samples_in(clip.layer->get(), in_clip)) {
    const Bracket bracket = layer_bracket(*samples, time);
    add(bracket.lower);
    add(bracket.upper);
  }
  if (!times_.is_identity()) {
    const auto& entries = times_.entries();
    const auto after =
        std::lower_bound(entries.begin(), entries.end(), time,
                         [](const ClipTimes::Entry& entry, double at) { return entry.stage < at; });
    add(after == entries.end() ? entries.back().stage : after->stage);
    if (after != entries.end() && after != entries.begin() && after->stage != time) {
      add((after - 1)->stage);
    }
  }
  add(clip.authored_start);
  const auto [lower, upper] = around(times.data(), times.data() + count, time);
  return {lower, upper};
}

ClipSet::Bracket ClipSet::bracket(Path in_clip, double time) const {
  const std::size_t here = active(time);
  std::optional<double> lower;
  std::optional<double> upper;
  if (contributes(clips_[here], in_clip)) {
    const Bracket bracket = clip_bracket(clips_[here], in_clip, time);
    lower = bracket.lower;
    // Behind the last sample the next clip's start is what comes.
    if (bracket.lower != bracket.upper || time <= bracket.upper) {
      upper = bracket.upper;
    }
  }
  for (std::size_t i = here; !lower && i-- > 0;) {
    if (contributes(clips_[i], in_clip)) {
      lower = clip_bracket(clips_[i], in_clip, time).upper;
    }
  }
  for (std::size_t i = here + 1; !upper && i < clips_.size(); ++i) {
    if (contributes(clips_[i], in_clip)) {
      upper = clips_[i].start;
    }
  }
  const double first = clips_.front().authored_start;
  return {lower.value_or(upper.value_or(first)), upper.value_or(lower.value_or(first))};
}

void ClipSet::list_times(const Clip& clip, Path in_clip, std::vector<double>& times) const {
  const auto add = [&](double time) {
    if (clip.start <= time && time < clip.end && times.size() < limits::kClipTimeSamples) {
      times.push_back(time);
    }
  };
  const TimeSamples* samples = samples_in(clip.layer->get(), in_clip);
  if (samples != nullptr && times_.is_identity()) {
    std::for_each(samples->times.begin(), samples->times.end(), add);
  }
  const auto& entries = times_.entries();
  auto at = std::lower_bound(
      entries.begin(), entries.end(), clip.start,
      [](const ClipTimes::Entry& entry, double time) { return entry.stage < time; });
  at -= at == entries.begin() ? 0 : 1;
  for (; at != entries.end() && at->stage < clip.end; ++at) {
    add(at->stage);
    const auto segment = static_cast<std::size_t>(at - entries.begin());
    if (samples == nullptr || at->jump || segment + 1 == entries.size()) {
      continue;
    }
    const auto [low, high] = std::minmax(at->clip, entries[segment + 1].clip);
    auto sample = std::lower_bound(samples->times.begin(), samples->times.end(), low);
    for (; sample != samples->times.end() && *sample <= high; ++sample) {
      add(times_.to_stage(*sample, segment));
    }
  }
  add(clip.authored_start);
}

std::vector<double> ClipSet::time_samples(Path attribute) const {
  const Path path = in_clip(attribute);
  std::vector<double> times;
  for (const Clip& clip : clips_) {
    if (contributes(clip, path)) {
      list_times(clip, path, times);
    }
  }
  if (times.empty()) {
    times.push_back(clips_.front().authored_start);
  }
  for (double& time : times) {
    time = offset_.apply(time);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

bool ClipSet::may_vary(Path attribute) const {
  return clips_.size() > 1 || time_samples(attribute).size() > 1;
}

// The value at a stage time that is an end of a bracket: of the clip in force there, also a block;
// where it has no samples the manifest's default.
Value ClipSet::sample(const Query& query, double time) const {
  const Clip& clip = clips_[active(time)];
  if (const TimeSamples* samples = samples_in(clip.layer->get(), query.attribute)) {
    Value value = stage::value_at(*samples, times_.to_clip(time), query.interpolation);
    return with_stage_codes(std::move(value), times_, time);
  }
  const Value* fallback = manifest_default(query.attribute);
  return fallback == nullptr ? Value(layer::ValueBlock()) : *fallback;
}

Value ClipSet::resolve(const Query& query, double time) const {
  const Bracket bracket = this->bracket(query.attribute, time);
  Value lower = sample(query, bracket.lower);
  if (lower.is_block()) {
    return {};
  }
  if (std::abs(bracket.upper - bracket.lower) < kSameTime ||
      query.interpolation == Interpolation::Held || !is_interpolated(lower)) {
    return lower;
  }
  Value upper = sample(query, bracket.upper);
  if (upper.holds<layer::ArrayEdit>()) {
    return upper;
  }
  return upper.is_block()
             ? lower
             : interpolate(lower, upper, (time - bracket.lower) / (bracket.upper - bracket.lower));
}

ClipSet::Active ClipSet::active_at(Path attribute, double time) const {
  const double at = layer_time(offset_, time);
  return {clips_[active(at)].layer->get(), in_clip(attribute), times_.to_clip(at)};
}

ClipSet::Found ClipSet::value_at(Path attribute, double time, Interpolation interpolation) const {
  const Query query{in_clip(attribute), interpolation};
  const double at = layer_time(offset_, time);
  const layer::Layer* layer = clips_[active(at)].layer->get();
  const bool has_samples = samples_in(layer, query.attribute) != nullptr;
  const layer::Layer* manifest = manifest_ == nullptr ? nullptr : manifest_->get();
  return {resolve(query, at), has_samples ? layer : manifest};
}

}  // namespace tenon::stage
