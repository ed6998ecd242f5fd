// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/edited_file.h"
#include "tenon/base/result.h"
#include "tenon/check/check_stage.h"
#include "tenon/check/finding.h"
#include "tenon/check/simready/verdict.h"
#include "tenon/open_stage.h"

/// Files checked and corrected: the rules of tenon/check over all Physics variants of an asset.
namespace tenon {

struct CheckOptions {
  OpenOptions open;  ///< with a physics_variant only that one is looked at
  check::Selection rules;
  physics::Readings readings;  ///< how the physics is read
  /// "isaac-3.0": the files are checked against Asset Structure 3.0 as well; "simready" and the
  /// like (tenon/asset/checking/judge_simready.h): the requirements of SimReady; empty: neither.
  std::string profile;
};

struct CheckedAsset {
  std::vector<std::string> variants;  ///< of "Physics" that were looked at; empty: no such set
  std::vector<check::Finding> findings;
  /// Of the requirements of a profile that has codes, sorted by code; empty: it has none.
  std::vector<check::simready::CodeVerdict> codes{};
};

/// Opens the asset under each variant of its default prim's set "Physics", and as it opens by
/// itself where its selection names none of them. Fails as tenon::open does.
Result<CheckedAsset> check_asset(const std::string& path, const CheckOptions& options);

/// What the fixes of the findings make of the files that own the opinions; `files` are those that
/// were checked. No file is touched: the caller writes them together, in place (Outputs of
/// cli/output.h, bytes/write/file_transaction.h).
Result<std::vector<EditedFile>> corrected_files(const std::vector<check::Finding>& findings,
                                                const bytes::Files& files);

/// Files below a folder that no other of them uses as a layer, sorted; a file alone is one.
/// A file that cannot be opened, or may not be by the options, uses no others. A layer without a
/// default prim in the folder `payloads` of an asset counts as used by it.
/// Errors: ErrorCode::NotFound, Io.
Result<std::vector<std::string>> root_assets(const std::string& path, const OpenOptions& options);

}  // namespace tenon
