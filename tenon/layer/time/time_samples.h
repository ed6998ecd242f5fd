// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "tenon/layer/value.h"

namespace tenon::layer {

/// Values over time: `times` ascending without repeats, one value each (ValueBlock allowed).
struct TimeSamples {
  std::vector<double> times;  // (sample_count)
  std::vector<Value> values;  // (sample_count)

  bool operator==(const TimeSamples&) const = default;
  bool empty() const { return times.empty(); }
  std::size_t size() const { return times.size(); }
  /// Inserts or replaces the sample at `time`.
  void set(double time, Value value);

  struct Bracket {
    std::size_t lower = 0;
    std::size_t upper = 0;  ///< equal to lower at, before and after the outermost samples
  };
  /// The samples around `time`; must not be called when empty.
  Bracket bracket(double time) const;
};

}  // namespace tenon::layer
