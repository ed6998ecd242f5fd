// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/base/text/name_pattern.h"
#include "tenon/bytes/files.h"
#include "tenon/tuning/gains.h"

namespace tenon {

/// What drives are asked to be. What is not given stays as it is.
struct GainWish {
  std::optional<double> frequency;  ///< natural [rad/s]
  std::optional<double> damping_ratio;
  std::optional<double> stiffness;  ///< SI, as tuning::Gains
  std::optional<double> damping;

  bool empty() const { return !frequency && !damping_ratio && !stiffness && !damping; }
};

/// The same for the joints that a pattern means.
struct PatternWish {
  NamePattern joints;
  GainWish wish;
  std::uint32_t line = 0;
};

/// "10", "10 Hz" or "62.8 rad/s" [rad/s]. Errors: Invalid (usage.value).
Result<double> frequency_named(const std::string& text);

/// A file of wishes, TOML: a table for each pattern with frequency (a number [Hz], or text with its
/// unit), damping_ratio, stiffness and damping (SI). Errors: those of opening the file and of
/// settings::toml_values; Limit above limits::kSettingsBytes; Invalid (tune.unknown-key, tune.type,
/// tune.value) with the line.
Result<std::vector<PatternWish>> read_gain_file(const std::string& file, const bytes::Files& files);

}  // namespace tenon
