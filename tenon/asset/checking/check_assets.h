// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tenon/asset/check_asset.h"
#include "tenon/asset/checking/reported_finding.h"
#include "tenon/base/function.h"
#include "tenon/base/result.h"

namespace tenon {

struct CheckAssetsOptions {
  CheckOptions check;
  bool correct = false;    ///< what has a safe fix
  bool suggested = false;  ///< and what has a suggestion
  /// Which of the findings are corrected; empty: all.
  Function<bool(const check::Finding& finding)> wanted;
  /// Writes what was corrected of one asset; the asset is then checked again. Empty: nothing is
  /// written, and the findings are those before.
  Function<Result<void>(const std::string& asset, const std::vector<EditedFile>& files)> write;
  std::string baseline;  ///< file of findings that are known; empty: none are
  /// Reads the tenon.toml of each asset's repository (tenon/settings/settings.h): its profile where
  /// `check` has none, and the rules that it skips unless `check.rules.only` names them.
  bool read_settings = false;
  Function<void(std::size_t done, std::size_t total)> progress;  ///< in assets; may be empty
};

/// One of the assets.
struct AssetChecked {
  std::string path;
  bool opened = true;
  std::vector<std::string> variants;                  ///< of "Physics" that were looked at
  std::string settings;                               ///< its tenon.toml; empty: none was read
  std::vector<check::simready::CodeVerdict> codes{};  ///< CheckedAsset::codes
};

/// Findings that a settings file skips.
struct SkippedFindings {
  std::string settings;  ///< file
  std::string rule;
  std::string reason;
  std::size_t count = 0;
};

/// The result for all assets together.
struct CheckedAssets {
  std::vector<ReportedFinding> findings;  ///< each once, in the order of the assets
  std::vector<EditedFile> corrected;      ///< each once
  std::vector<AssetChecked> assets;
  std::vector<SkippedFindings> skipped;  ///< in the order of the assets

  bool all_opened() const;
};

/// Checks the root assets (root_assets) of all paths. An asset that does not open is a finding.
/// Errors: those of root_assets, of settings and of a baseline that cannot be read; those of
/// `write`.
Result<CheckedAssets> check_assets(const std::vector<std::string>& paths,
                                   const CheckAssetsOptions& options);

struct FindingCounts {
  std::size_t errors = 0;
  std::size_t warnings = 0;
  std::size_t infos = 0;
  std::size_t fixable = 0;
  std::size_t suggested = 0;   ///< with a suggestion and no safe fix
  std::size_t suppressed = 0;  ///< counted as nothing else
};
FindingCounts count_findings(const std::vector<ReportedFinding>& findings);

/// Errors: NotFound, for a name that is neither a rule nor a family of rules.
Result<void> check_selection(const check::Selection& rules);

}  // namespace tenon
