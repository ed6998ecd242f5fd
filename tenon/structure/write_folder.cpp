// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cerrno>
#include <filesystem>

#include "tenon/bytes/new_folder.h"
#include "tenon/bytes/posix_files.h"
#include "tenon/structure/layout.h"
#include "tenon/structure/package.h"

namespace tenon::structure {
namespace {

namespace fs = std::filesystem;

bool is_known_place(const std::string& name) {
  if (name.starts_with("Textures/") || name.starts_with("Materials/")) {
    return true;
  }
  return role_of_file_name(name) != Role::Other;
}

Result<void> check_replaceable(const std::string& folder) {
  const std::vector<std::string> foreign = foreign_files(folder);
  if (foreign.empty()) {
    return {};
  }
  return Error(ErrorCode::Invalid, "the folder holds files that are no part of an asset, \"" +
                                       foreign.front() +
                                       "\" among them; they would go with what it is replaced by")
      .in_file(folder)
      .with_fix("name a new folder, or move those files elsewhere");
}

bool is_usable_name(const std::string& name) {
  const fs::path path(name);
  return !name.empty() && path.is_relative() && path.lexically_normal() == path &&
         *path.begin() != ".." && path.has_filename();
}

}  // namespace

std::vector<std::string> foreign_files(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    std::error_code ignored;
    if (at->is_directory(ignored) && !at->is_symlink(ignored)) {
      continue;
    }
    std::string name = at->path().lexically_relative(folder).generic_string();
    if (!is_known_place(name)) {
      found.push_back(std::move(name));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

Result<void> write_folder(const std::map<std::string, std::string_view>& files,
                          const std::string& folder) {
  for (const auto& [name, contents] : files) {
    if (!is_usable_name(name)) {
      return Error(ErrorCode::Invalid, "\"" + name + "\" is no name of a file in a folder")
          .in_file(folder);
    }
  }
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
  if (exists) {
    TENON_CHECK(check_replaceable(target.string()));
  }
  TENON_TRY(bytes::NewFolder made, bytes::NewFolder::beside(target.string()));
  for (const auto& [name, contents] : files) {
    TENON_CHECK(made.add_file(name, contents));
  }
  using Replace = bytes::NewFolder::Replace;
  return made.take_place(exists ? Replace::Anything : Replace::Empty);
}

}  // namespace tenon::structure
