// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/update.h"

#include "cli/output.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
void UpdateArguments::add_to(const Command& verb) {
  verb.add_flag(
      "--update", update,
      "Merge changes of the source into an asset made from it, and keep local edits. Give "
      "the options that the asset was made with");
  verb.add_option("--conflicts", conflicts,
                  "With --update, where an edit and the source changed the same thing: edits (keep "
                  "the edit and report it no more), source (take the source's value) or fail "
                  "(write nothing); without it edits stay and every update reports them")
      .one_of({"edits", "source", "fail"})
      .only_with({"--update"});
}

Result<std::optional<UpdateOutcome>> update(const structure::Package& made,
                                            const std::string& folder,
                                            const UpdateArguments& options, bool dry_run,
                                            Diagnostics& diagnostics) {
  TENON_TRY(auto updated, update_folder(made, folder, options.choice(), diagnostics));
  if (!updated) {
    return std::optional<UpdateOutcome>();
  }
  UpdateOutcome outcome{*std::move(updated)};
  outcome.written = !dry_run && (options.conflicts != "fail" || outcome.asset.conflicts.empty());
  if (outcome.written) {
    TENON_CHECK(write_edits(outcome.asset.files,
                            {options.made_by + " --update", folder + "/" + made.interface}));
  }
  return std::optional<UpdateOutcome>(std::move(outcome));
}

int tell_update(const Report& report, const UpdateOutcome& outcome, const UpdateArguments& options,
                const std::string& output) {
  const UpdatedAsset& asset = outcome.asset;
  const bool refused = options.conflicts == "fail" && !asset.conflicts.empty();
  report.note((refused ? "nothing is written, because of conflicts: " : "updated ") +
              shown_path(output) + ": " + counted(asset.files.size(), "file") + " written, " +
              counted(asset.changes, "change") + " merged from source, " +
              counted(asset.edits, "local edit") + " kept, " +
              counted(asset.conflicts.size(), "conflict"));
  return asset.conflicts.empty() ? kOk : kNo;
}

}  // namespace tenon::cli
