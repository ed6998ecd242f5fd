// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/asset/edited_file.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"
#include "tenon/bytes/write/undo_log.h"

namespace tenon {

/// The last edit of an asset, as what its files are to be again.
struct UndoneEdit {
  std::string verb;               ///< that made the edit
  std::string asset;              ///< that was named then
  std::vector<EditedFile> files;  ///< `before` is what they hold now; text where both are
  std::string record;             ///< to be forgotten once the files are written
};

/// Looks for the last edit of the asset, or of a file of one. No file is touched. Errors: NotFound
/// (undo.none) where no edit is kept; Invalid (undo.changed) where a file is not as the edit left
/// it; Missing (undo.no-folder) where there is no folder for edits. `files` are those on the disk.
Result<UndoneEdit> undo_edit(const std::string& asset, const bytes::Files& files);

/// Keeps what an edit replaced for undo_edit; none is kept of an edit that replaced nothing. That
/// it cannot be kept is no fault of the edit: undo_edit says so then. `files` are those on the
/// disk.
void keep_for_undo(const std::string& verb, const std::string& asset,
                   std::vector<bytes::ReplacedFile> replaced, const bytes::Files& files);
/// Writes the files as they were before the edit, which is forgotten then. Errors: those of
/// write_files.
Result<void> restore_undone(const UndoneEdit& edit);

/// {"dryRun", "verb", "asset", "files": [{"file", "diff", "removed", "made"}]}; "diff" is null for
/// what is no text.
answers::Json undone_json(const UndoneEdit& edit, bool dry_run);

}  // namespace tenon
