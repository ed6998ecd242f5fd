// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset/updating/update_asset.h"

/// Assets made again from their source that keep what was edited: options and what becomes of them.
namespace tenon::cli {

struct UpdateArguments {
  std::string made_by;  ///< the verb that takes the options
  bool update = false;
  std::string conflicts = {};  ///< empty: edits stay, and each run tells of them

  void add_to(const Command& verb);
  UpdateChoice choice() const { return {keep(), conflicts == "edits"}; }
  diff::Side keep() const { return conflicts == "source" ? diff::Side::Source : diff::Side::Edits; }
};

/// What an update comes to.
struct UpdateOutcome {
  UpdatedAsset asset;
  bool written = false;  ///< false where conflicts forbid it
};

/// Updates the asset that `made.interface` opens in `folder`, and writes it unless `dry_run` says
/// otherwise; nothing where there is none.
Result<std::optional<UpdateOutcome>> update(const structure::Package& made,
                                            const std::string& folder,
                                            const UpdateArguments& options, bool dry_run,
                                            Diagnostics& diagnostics);

/// Tells people. The exit code: kNo where there were conflicts.
int tell_update(const Report& report, const UpdateOutcome& outcome, const UpdateArguments& options,
                const std::string& output);

}  // namespace tenon::cli
