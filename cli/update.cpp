// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/update.h"

#include "cli/output.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

}  // namespace

void UpdateArguments::add_to(const Command& verb) {
  verb.add_flag("--update", update,
                "Over an asset that was made from the same source: takes over what the source "
                "changed since, and keeps what was edited in the asset. Give the options that it "
                "was made with");
  verb.add_option("--conflicts", conflicts,
                  "With --update, where an edit and the source changed the same thing: edits (they "
                  "stay, the default), source, or fail (nothing is written). All are listed")
      .one_of({"edits", "source", "fail"});
}

Result<std::optional<UpdateOutcome>> update(const structure::Package& made,
                                            const std::string& folder,
                                            const UpdateArguments& options, bool dry_run,
                                            Diagnostics& diagnostics) {
  TENON_TRY(auto updated, update_folder(made, folder, options.keep(), diagnostics));
  if (!updated) {
    return std::optional<UpdateOutcome>();
  }
  UpdateOutcome outcome{*std::move(updated)};
  outcome.written = !dry_run && (options.conflicts != "fail" || outcome.asset.conflicts.empty());
  if (outcome.written) {
    TENON_CHECK(write_edits(outcome.asset.files));
  }
  return std::optional<UpdateOutcome>(std::move(outcome));
}

int tell_update(const Report& report, const UpdateOutcome& outcome, const UpdateArguments& options,
                const std::string& output) {
  const UpdatedAsset& asset = outcome.asset;
  const bool refused = options.conflicts == "fail" && !asset.conflicts.empty();
  report.note((refused ? "nothing is written, because of conflicts: " : "updated ") +
              shown_path(output) + ": " + counted(asset.files.size(), "file", "files") +
              ", taken from the source " + counted(asset.changes, "change", "changes") + ", kept " +
              counted(asset.edits, "edit", "edits") + ", " +
              counted(asset.conflicts.size(), "conflict", "conflicts"));
  return asset.conflicts.empty() ? kOk : kNo;
}

}  // namespace tenon::cli
