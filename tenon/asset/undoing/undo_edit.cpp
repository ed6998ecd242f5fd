// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/undoing/undo_edit.h"

#include <utility>

#include "tenon/asset/answers/edited_json.h"
#include "tenon/base/sha256.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/files.h"

namespace tenon {
namespace {

Error nothing_kept(const std::string& asset, const std::string& folder) {
  return Error(ErrorCode::NotFound, "no edit of this asset is kept")
      .in_file(asset)
      .with_rule("undo.none")
      .with_fix("edits are kept in " + folder +
                " while that can be written: the last 100 of all assets, 64 MB each");
}

Error changed(const std::string& file, const bytes::UndoEntry& entry, bool is_gone) {
  return Error(ErrorCode::Invalid, is_gone ? "the file is gone since tenon " + entry.verb
                                           : "the file has changed since tenon " + entry.verb)
      .in_file(file)
      .with_rule("undo.changed")
      .with_fix("take that change back first; what was edited since then would be lost");
}

/// Errors: undo.changed where the file is not as the edit left it.
Result<EditedFile> restored_file(const bytes::ReplacedFile& file, const bytes::UndoEntry& entry,
                                 const bytes::Files& files) {
  EditedFile restored{file.path, "", file.before.value_or(""), true, true, !file.before};
  if (files->kind(file.path) == bytes::NameKind::Nothing) {
    return file.after_digest ? Result<EditedFile>(changed(file.path, entry, true))
                             : Result<EditedFile>(std::move(restored));
  }
  TENON_TRY(const auto bytes, files->open(file.path, {}));
  restored.before = std::string(bytes->text());
  Sha256 digest;
  digest.update(restored.before);
  if (!file.after_digest || digest.hex_digest() != *file.after_digest) {
    return changed(file.path, entry, false);
  }
  restored.text = restored.before.find('\0') == std::string::npos &&
                  restored.after.find('\0') == std::string::npos;
  return restored;
}

}  // namespace

Result<UndoneEdit> undo_edit(const std::string& asset, const bytes::Files& files) {
  const std::optional<bytes::UndoLog> log = bytes::UndoLog::of_user();
  if (!log) {
    return Error(ErrorCode::Missing, "edits are not kept: there is no folder for them")
        .with_rule("undo.no-folder")
        .with_fix("set HOME or XDG_STATE_HOME to an absolute path");
  }
  const std::string file = files->real_path(bytes::absolute_file_path(asset));
  auto found = log->last_of(file);
  if (!found) {
    return nothing_kept(asset, log->folder());
  }
  UndoneEdit edit{found->entry.verb, found->entry.asset, {}, found->record};
  for (const bytes::ReplacedFile& replaced : found->entry.files) {
    TENON_TRY(EditedFile restored, restored_file(replaced, found->entry, files));
    edit.files.push_back(std::move(restored));
  }
  return edit;
}

void keep_for_undo(const std::string& verb, const std::string& asset,
                   std::vector<bytes::ReplacedFile> replaced, const bytes::Files& files) {
  if (replaced.empty()) {
    return;
  }
  if (const auto log = bytes::UndoLog::of_user()) {
    std::string file = files->real_path(bytes::absolute_file_path(asset));
    [[maybe_unused]] const auto kept = log->add({verb, std::move(file), std::move(replaced)});
  }
}

Result<void> restore_undone(const UndoneEdit& edit) {
  TENON_CHECK(write_files(edit.files));
  if (const auto log = bytes::UndoLog::of_user()) {
    log->forget(edit.record);
  }
  return {};
}

answers::Json undone_json(const UndoneEdit& edit, bool dry_run) {
  answers::Json files = answers::Json::array();
  for (const EditedFile& file : edit.files) {
    const std::string name = shown_path(file.path);
    files.push_back({{"file", name},
                     {"diff", text_difference_json(name, file.before, file.after, file.text)},
                     {"removed", file.removed}});
  }
  return {{"dryRun", dry_run},
          {"verb", edit.verb},
          {"asset", shown_path(edit.asset)},
          {"files", std::move(files)}};
}

}  // namespace tenon
