// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/comparing_engines/compare_engines.h"
#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"

namespace tenon {

struct ReportOptions {
  SimulateAssetOptions run;   ///< the motion that is shown; with duration 0 there is none
  std::size_t triangles = 0;  ///< that are drawn at most, about; 0: all
  bool colliders = true;
  /// Engines whose motions are compared in tables and plots (CompareEnginesOptions::engines);
  /// nothing: none are.
  std::optional<std::vector<std::string>> compared{};
};

struct AssetReport {
  std::string html;
  std::size_t triangles = 0;   ///< that are drawn
  std::size_t frames = 0;      ///< of the motion
  std::size_t findings = 0;    ///< of the check
  std::size_t scene_size = 0;  ///< of the GLB in it [bytes]
  bool interrupted = false;
};

/// One file for browsers about the asset at `path`: what it is, what is wrong with it, its masses
/// and joints, and its picture with the motion. It loads nothing else and runs no script but its
/// own. An asset whose motion cannot be simulated is shown without, and the finding says why.
/// Errors: Missing without the page (page_place.h); those of tenon::open and write_glb.
Result<AssetReport> report_asset(const std::string& path, const ReportOptions& options,
                                 Diagnostics& diagnostics);

}  // namespace tenon
