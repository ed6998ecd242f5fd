// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// A folder in the making, under a hidden name beside its place: other programs see it whole or not
/// at all, also when the process is killed or the disk is full. Without `take_place` it goes with
/// the object; a kill may leave the hidden folder behind.
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
  /// has checked that. Folders above are made. Errors: ErrorCode::Io, also for a file that exists.
  Result<void> add_folder(const std::string& name);
  Result<void> add_file(const std::string& name, std::string_view contents);

  /// The same for a symbolic link with these contents, and for another name of the file `existing`;
  /// the owner and permissions of `existing` for what has that name, "" for the folder itself.
  /// Return 0 or an error number.
  int add_link(const std::string& name, const std::string& target);
  int add_hard_link(const std::string& name, const std::string& existing);
  int take_mode(const std::string& name, const std::string& existing);

  enum class Replace { Empty, Anything };
  /// Syncs all of it and gives it its place in one step. What stood there before goes: an empty
  /// folder, or any folder. Errors, which leave the place as it was: ErrorCode::Io, Unsupported
  /// where the file system cannot exchange folders.
  Result<void> take_place(Replace replace);

 private:
  explicit NewFolder(std::string place) : place_(std::move(place)) {}
  int make_folders(const std::string& name);
  int sync_and_rename(Replace replace);

  std::string place_;
  std::string path_;  // while it has a hidden name
  std::set<std::string> folders_;
  std::vector<std::string> files_;  // with contents of their own
};

}  // namespace tenon::bytes
