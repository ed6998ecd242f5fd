// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/time/time_samples.h"

#include <algorithm>

namespace tenon::layer {

void TimeSamples::set(double time, Value value) {
  const auto it = std::lower_bound(times.begin(), times.end(), time);
  const auto at = it - times.begin();
  if (it != times.end() && *it == time) {
    values[static_cast<std::size_t>(at)] = std::move(value);
    return;
  }
  times.insert(it, time);
  values.insert(values.begin() + at, std::move(value));
}

TimeSamples::Bracket TimeSamples::bracket(double time) const {
  const auto it = std::lower_bound(times.begin(), times.end(), time);
  const auto at = static_cast<std::size_t>(it - times.begin());
  if (it == times.end()) {
    return {at - 1, at - 1};
  }
  if (*it == time || at == 0) {
    return {at, at};
  }
  return {at - 1, at};
}

}  // namespace tenon::layer
