// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/write/replaced_file.h"

namespace tenon::bytes {

/// An edit of an asset that can be undone.
struct UndoEntry {
  std::string verb;   ///< that made it: "set"
  std::string asset;  ///< absolute, without symbolic links
  std::vector<ReplacedFile> files;
};

/// What edits replaced, one file for each edit in a folder of the user's own. The oldest go when
/// there are more than limits::kUndoEdits or kUndoBytes. Several processes may use it at once.
class UndoLog {
 public:
  explicit UndoLog(std::string folder) : folder_(std::move(folder)) {}

  /// $XDG_STATE_HOME/tenon/undo, else ~/.local/state/tenon/undo; nothing where neither variable is
  /// an absolute path.
  static std::optional<UndoLog> of_user();

  const std::string& folder() const { return folder_; }

  /// Errors: Io where the folder cannot be made or written, or others may write there.
  Result<void> add(const UndoEntry& entry) const;

  struct Found {
    std::string record;  ///< for `forget`
    UndoEntry entry;
  };
  /// The last edit of `file`, which is the asset of the edit or one of the files that it changed;
  /// nothing where none is kept. Records that are damaged are skipped.
  std::optional<Found> last_of(const std::string& file) const;

  void forget(const std::string& record) const;

 private:
  std::string folder_;
};

}  // namespace tenon::bytes
