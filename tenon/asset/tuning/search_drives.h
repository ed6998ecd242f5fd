// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/tuning/gain_search.h"

/// Gains that are searched for, so that steps meet a goal with every payload and at every pose.
namespace tenon {

struct SearchRequest {
  tuning::StepGoal goal;
  std::vector<double> payloads;  ///< [kg], 0 for none; empty: none
  std::string at;                ///< the prim on a body that has them (pose_asset.h)
  std::size_t poses = 0;         ///< drawn within limits, beside the start
  std::uint64_t seed = 1;        ///< of these
};

/// What was found for one drive.
struct SearchedRow {
  std::size_t drive = 0;  ///< into TunedAsset::drives
  tuning::FoundGains found;
};

struct TunedSearch {
  SearchRequest request;
  std::vector<std::string> engines;
  std::size_t scene_count = 0;  ///< engines times payloads times poses
  std::vector<SearchedRow> drives;
  bool interrupted = false;

  bool all_met() const;
};

/// "1", "1%" or "1 %" [-]. Errors: Invalid (usage.value).
Result<double> overshoot_named(const std::string& text);
/// "0,0.5" or "0kg,0.5kg" [kg]. Errors: Invalid (usage.value).
Result<std::vector<double>> payloads_named(const std::vector<std::string>& texts);

}  // namespace tenon
