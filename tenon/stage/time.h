// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace tenon::stage {

/// A time code of the stage, or the default time (which ignores time samples).
class Time {
 public:
  Time() = default;
  Time(double code) : code_(code) {}
  static Time default_time() { return {}; }
  bool is_default() const { return !code_.has_value(); }
  double code() const { return code_.value_or(0); }
  bool operator==(const Time&) const = default;

 private:
  std::optional<double> code_;
};

}  // namespace tenon::stage
