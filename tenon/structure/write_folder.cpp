// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A file in the folder is one that this run has read, one that is as a package's note says, an
// edited one or an unknown one. Edited and unknown files stop the writing unless it is forced,
// files of the input unless it is in place. Files are removed when the new package lacks them, they
// are at a place of the structure, and they are known or the writing is forced. A new folder
// appears by one rename. An old one is looked at a second time when the transaction holds its
// locks, and the write ends unless the same files would go as before.
#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <set>

#include "tenon/bytes/posix_files.h"
#include "tenon/bytes/read_record.h"
#include "tenon/bytes/write/file_transaction.h"
#include "tenon/bytes/write/new_folder.h"
#include "tenon/structure/layout.h"
#include "tenon/structure/package.h"
#include "tenon/structure/written_note.h"

namespace tenon::structure {
namespace {

namespace fs = std::filesystem;
using Contents = std::map<std::string, std::string_view>;

bool is_known_place(const std::string& name) {
  if (name.starts_with("Textures/") || name.starts_with("Materials/") ||
      name.starts_with("Meshes/") || name.starts_with("runnables/physics/") ||
      name.starts_with(".thumbs/256x256/") || is_copy_place(name)) {
    return true;
  }
  return role_of_file_name(name) != Role::Other;
}

bool is_usable_name(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && path.is_relative() && path.lexically_normal() == path &&
         *path.begin() != ".." && path.has_filename();
}

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return names.size() > kNamed ? text + " and " + std::to_string(names.size() - kNamed) + " more"
                               : text;
}

/// Names of all files below a folder, links among them, sorted.
std::vector<std::string> files_below(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    std::error_code ignored;
    if (!at->is_directory(ignored) || at->is_symlink(ignored)) {
      found.push_back(at->path().lexically_relative(folder).generic_string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// What the notes of all assets that begin in this folder say.
WrittenState state_of(const std::string& folder, const std::vector<std::string>& files) {
  WrittenState all;
  for (const std::string& name : files) {
    if (role_of_file_name(name) == Role::Interface) {
      WrittenState state = written_state(folder + "/" + name);
      all.noted = all.noted || state.noted;
      std::move(state.written.begin(), state.written.end(), std::back_inserter(all.written));
      std::move(state.edited.begin(), state.edited.end(), std::back_inserter(all.edited));
    }
  }
  return all;
}

bool was_read(const std::string& file) {
  const bytes::ReadRecord* record = bytes::ReadRecord::current();
  const auto stamp = bytes::stamp_of(file);
  return record != nullptr && stamp && record->has(stamp->identity);
}

Error edited(const std::string& folder, const std::vector<std::string>& names) {
  return Error(ErrorCode::Invalid, "the asset was edited since it was written: " + list_of(names) +
                                       (names.size() == 1 ? " differs" : " differ"))
      .in_file(folder)
      .with_rule("output.edited")
      .with_fix("give --force to overwrite the edits, or name another folder");
}

Error unknown(const std::string& folder, const std::vector<std::string>& names) {
  return Error(
             ErrorCode::Invalid,
             "the folder holds files that were not written as part of an asset: " + list_of(names))
      .in_file(folder)
      .with_rule("output.unknown")
      .with_fix(
          "name a new folder, move those files elsewhere, or give --force: it overwrites "
          "files with the name of a new file, and leaves the rest");
}

Error holds_input(const std::string& file, bool known) {
  return Error(ErrorCode::Invalid, "the folder holds the asset that is read")
      .in_file(file)
      .with_rule("output.is-input")
      .with_fix(known ? "name another folder, or give --in-place" : "name another folder");
}

/// A folder that is there, and what of it may go.
class OldFolder {
 public:
  OldFolder(std::string folder, const Contents& files, const WriteOptions& options)
      : folder_(std::move(folder)), files_(files), options_(options) {}

  /// Error where something would be lost.
  Result<void> look() {
    const std::vector<std::string> present = files_below(folder_);
    const WrittenState state = state_of(folder_, present);
    const std::set<std::string> written(state.written.begin(), state.written.end());
    std::set<std::string> edited_names(state.edited.begin(), state.edited.end());
    std::vector<std::string> unknown_names;
    stale_.clear();
    for (const std::string& name : present) {
      const bool read = was_read(folder_ + "/" + name);
      if (read && !options_.in_place) {
        return holds_input(folder_ + "/" + name, options_.can_be_in_place);
      }
      const bool known = read || written.contains(name) || is_copy_place(name);
      if (read) {
        edited_names.erase(name);  // the edit is in the new files
      } else if (!known && !edited_names.contains(name)) {
        unknown_names.push_back(name);
      }
      if (!files_.contains(name) && is_known_place(name) && (known || options_.force)) {
        stale_.push_back(name);
      }
    }
    if (!options_.force && !edited_names.empty()) {
      return edited(folder_, {edited_names.begin(), edited_names.end()});
    }
    if (!options_.force && !unknown_names.empty()) {
      return unknown(folder_, unknown_names);
    }
    return {};
  }

  /// Files that have what they are to have are left alone.
  Result<void> write() {
    TENON_CHECK(look());
    bytes::FileTransaction transaction;
    for (const auto& [name, contents] : files_) {
      const std::string path = folder_ + "/" + name;
      bytes::FileRules rules;
      rules.is_input = false;
      const auto old = bytes::FileBytes::open(path, rules);
      if (!old || (*old)->text() != contents) {
        transaction.put(path, contents);
      }
    }
    for (const std::string& name : stale_) {
      transaction.remove(folder_ + "/" + name, folder_);
    }
    transaction.hold(folder_);
    const std::vector<std::string> stale = stale_;
    return transaction.commit({.in_place = options_.in_place,
                               .make_folders = true,
                               .check = [this, &stale]() -> Result<void> {
                                 TENON_CHECK(look());
                                 return stale == stale_ ? Result<void>() : changed();
                               },
                               .replaced = options_.replaced});
  }

 private:
  Error changed() const {
    return Error(ErrorCode::Io, "another program is writing in this folder")
        .in_file(folder_)
        .with_rule("file.changed")
        .with_fix("nothing was written; run the command again");
  }

  std::string folder_;
  const Contents& files_;
  const WriteOptions& options_;
  std::vector<std::string> stale_;  // of an earlier asset
};

/// The folder by its real name, whether it exists or not.
Result<std::string> real_folder(const std::string& folder) {
  std::error_code error;
  const bool exists = fs::exists(folder, error);
  fs::path target = exists ? fs::canonical(folder, error) : fs::absolute(folder, error);
  if (error) {
    return bytes::unwritable(folder, "folder", error.value());
  }
  target = target.lexically_normal();
  target = target.has_filename() ? target : target.parent_path();
  if (exists && !fs::is_directory(target, error)) {
    return bytes::unwritable(folder, "folder", ENOTDIR);
  }
  return target.string();
}

}  // namespace

Result<void> check_folder(const std::string& folder, const WriteOptions& options) {
  TENON_TRY(const std::string target, real_folder(folder));
  std::error_code error;
  if (!fs::exists(target, error)) {
    TENON_CHECK(bytes::check_parent(target, folder, "folder"));
  }
  const Contents none;
  return OldFolder(target, none, options).look();
}

Result<void> write_folder(const Contents& files, const std::string& folder,
                          const WriteOptions& options) {
  for (const auto& [name, contents] : files) {
    if (!is_usable_name(name)) {
      return Error(ErrorCode::Invalid, "\"" + name + "\" is not a file name").in_file(folder);
    }
  }
  TENON_TRY(const std::string target, real_folder(folder));
  std::error_code error;
  if (!fs::exists(target, error)) {
    TENON_TRY(bytes::NewFolder made, bytes::NewFolder::beside(target));
    for (const auto& [name, contents] : files) {
      TENON_CHECK(made.add_file(name, contents));
    }
    const auto taken = made.take_place();
    if (taken || taken.error().diagnostic().rule != "file.exists") {
      return taken;
    }  // somebody made it meanwhile
  }
  return OldFolder(target, files, options).write();
}

}  // namespace tenon::structure
