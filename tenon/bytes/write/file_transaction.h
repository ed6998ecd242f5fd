// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/limits/undo_limits.h"
#include "tenon/base/result.h"
#include "tenon/bytes/write/replaced_file.h"

namespace tenon::bytes {

struct CommitOptions {
  /// Files that the run has read (read_record.h) may be replaced, as long as they still are what
  /// was read. Without this they are never replaced.
  bool in_place = false;
  /// Missing folders of files are made; without this they are an error.
  bool make_folders = false;
  /// Called once no one else can write, before anything changes; its Error ends the commit.
  std::function<Result<void>()> check = nullptr;
  /// Is given, when all is written, which files changed and what they held before. Left as it is
  /// where they held more than `most_replaced` bytes. Devices are not among them.
  std::vector<ReplacedFile>* replaced = nullptr;
  std::size_t most_replaced = limits::kUndoEditBytes;
};

/// Files that change together: all of them or none.
///
/// New contents are written beside their places, without a name where the file system can do so,
/// synced, and then renamed into their places. One file is one step. Several are renamed by a
/// child of its own session, which goes on when this process is killed; that takes some
/// microseconds for each file. A journal, the hidden file ".tenon-journal" in the folder that holds
/// them all, lists the remaining steps meanwhile: should the whole machine fail, the next
/// transaction that has to do with the folder finishes it. The folders stay what they are: nobody's
/// current folder goes away, and files of others are not touched.
///
/// Several transactions on a folder wait for one another: each holds an advisory lock (flock) on
/// the folders of its files, which leaves no file behind. File systems without it (some NFS) lock
/// nothing; there the only protection is the comparison with what was read, made right before.
class FileTransaction {
 public:
  /// Writes `contents` to `path`. If there is a file already, its permissions and, where allowed,
  /// its owner are kept. A symbolic link stays a link. Devices and pipes are written to directly.
  /// The contents have to live until the commit.
  void put(std::string path, std::string_view contents);
  /// The file goes, as far as it is there, and folders that are empty then, up to `top`.
  void remove(std::string path, std::string top);
  /// Holds a lock on this folder, too.
  void hold(std::string folder) { held_.insert(std::move(folder)); }

  /// Errors, all of which leave everything as it was but where they say otherwise: ErrorCode::Io
  /// (rule "file.unwritable"; "file.changed", see read_record.h; "file.locked" when others have
  /// held the lock for half a minute), Invalid (rule "output.is-input", "output.twice").
  Result<void> commit(const CommitOptions& options = {}) const;

 private:
  struct Removal {
    std::string path;
    std::string top;
  };
  struct Put {
    std::string path;
    std::string_view contents;
  };

  std::vector<Put> puts_;
  std::vector<Removal> removals_;
  std::set<std::string> held_;

  friend class Commit;
};

/// Refuses a folder to be replaced or removed with its contents: an Error with rule
/// "output.is-input" when the run has read one of its files.
Result<void> check_holds_no_input(const std::string& folder);

}  // namespace tenon::bytes
