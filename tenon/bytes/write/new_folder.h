// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/write/held_signals.h"

namespace tenon::bytes {

/// A folder in the making, under a hidden name beside its place: other programs see it whole or not
/// at all, also when the process is killed or the disk is full. Without `take_place` it goes with
/// the object; signals that ask this process to end wait for that (HeldSignals). SIGKILL may leave
/// the hidden folder behind, which goes with the next one that is made there.
class NewFolder {
 public:
  /// `place` is an absolute path without '/' at its end; its parent must exist. ErrorCode::Io.
  static Result<NewFolder> beside(const std::string& place);
  NewFolder(NewFolder&& other) noexcept;
  NewFolder& operator=(NewFolder&&) = delete;
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder();

  /// Names are relative to the folder, with '/' between parts, and lead nowhere else: the caller
  /// has checked that. Folders above are made. Errors: ErrorCode::Io, also for a file that exists,
  /// and once the process is asked to end.
  Result<void> add_folder(const std::string& name);
  Result<void> add_file(const std::string& name, std::string_view contents);

  /// Syncs all of it and gives it its place in one step, where nothing may stand but an empty
  /// folder. Errors, which leave the place as it was: ErrorCode::Io, with rule "file.exists" for
  /// what is no empty folder.
  Result<void> take_place();

 private:
  explicit NewFolder(std::string place) : place_(std::move(place)) {}
  int make_folders(const std::string& name);
  int sync_and_rename();

  std::string place_;
  std::string path_;  // while it has a hidden name
  HeldSignals held_;  // ends behind the removal
  int lock_ = -1;     // of the folder, which says that somebody is at work in it
  std::set<std::string> folders_;
  std::vector<std::string> files_;  // with contents of their own
};

}  // namespace tenon::bytes
