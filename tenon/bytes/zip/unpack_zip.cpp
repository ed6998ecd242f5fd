// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// All names are checked before anything is written: a name that leads out of the folder, a name
// that stands twice, or one of both a file and a folder ends the work. A folder that does not exist
// yet is filled beside its place and renamed into it. An empty folder that exists must stay the
// same folder, so its files are put there by one transaction.
#include "tenon/bytes/zip/unpack_zip.h"

#include <filesystem>
#include <memory>
#include <set>
#include <vector>

#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/posix_files.h"
#include "tenon/bytes/write/file_transaction.h"
#include "tenon/bytes/write/new_folder.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

bool is_safe_part(std::string_view part, bool first) {
  if (part.empty() || part == "." || part == "..") {
    return false;
  }
  for (const char c : part) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    if (control || c == '\\' || (first && c == ':')) {
      return false;
    }
  }
  return true;
}

/// Whether a name is safe; adds its parent folders, outermost first.
bool is_safe_name(std::string_view name, std::vector<std::string>& folders) {
  std::size_t begin = 0;
  while (true) {
    const std::size_t slash = name.find('/', begin);
    const std::size_t end = slash == std::string_view::npos ? name.size() : slash;
    if (!is_safe_part(name.substr(begin, end - begin), begin == 0)) {
      return false;
    }
    if (slash == std::string_view::npos) {
      return true;
    }
    folders.emplace_back(name.substr(0, slash));
    begin = slash + 1;
  }
}

Error bad_name(const std::string& name, const std::string& why) {
  std::string shown;
  for (const char c : name) {
    shown += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return Error(ErrorCode::Invalid, "the package holds \"" + shown + "\", " + why)
      .with_rule("package.bad-name")
      .with_fix("do not trust it; nothing was written");
}

/// An entry that names a folder alone, as some tools write them.
bool is_folder(const ZipEntry& entry) { return entry.name.ends_with('/') && entry.size == 0; }

Result<void> write_entries(const ZipArchive& archive, NewFolder& folder) {
  for (const ZipEntry& entry : archive.entries()) {
    if (is_folder(entry)) {
      TENON_CHECK(folder.add_folder(entry.name));
    } else {
      TENON_TRY(const auto contents, archive.read_checked(entry));
      TENON_CHECK(folder.add_file(entry.name, contents->text()));
    }
  }
  return {};
}

/// Into a folder that is there, which stays the folder that it is.
Result<void> write_entries_into(const ZipArchive& archive, const std::string& folder) {
  FileTransaction transaction;
  std::vector<std::shared_ptr<const FileBytes>> kept;
  for (const ZipEntry& entry : archive.entries()) {
    if (!is_folder(entry)) {
      TENON_TRY(kept.emplace_back(), archive.read_checked(entry));
      transaction.put(folder + "/" + entry.name, kept.back()->text());
    }
  }
  TENON_CHECK(transaction.commit({.make_folders = true}));
  for (const ZipEntry& entry : archive.entries()) {
    std::error_code failed;
    if (is_folder(entry) && (fs::create_directories(folder + "/" + entry.name, failed), failed)) {
      return unwritable(folder + "/" + entry.name, "folder", failed.value());
    }
  }
  return {};
}

}  // namespace

Result<void> check_entry_names(const ZipArchive& archive) {
  std::set<std::string> files;
  std::set<std::string> folders;
  for (const ZipEntry& entry : archive.entries()) {
    std::string name = entry.name;
    if (is_folder(entry)) {
      name.pop_back();
    }
    std::vector<std::string> above;
    if (!is_safe_name(name, above)) {
      return bad_name(entry.name, "a name that does not stay below a folder");
    }
    folders.insert(above.begin(), above.end());
    if (is_folder(entry)) {
      folders.insert(name);
    } else if (!files.insert(name).second) {
      return bad_name(entry.name, "a duplicate name");
    }
  }
  for (const std::string& folder : folders) {
    if (files.contains(folder)) {
      return bad_name(folder, "a file and a folder of the same name");
    }
  }
  return {};
}

Result<void> unpack_zip(const ZipArchive& archive, const std::string& folder) {
  TENON_CHECK(check_entry_names(archive));
  const fs::path target = absolute_file_path(folder);
  const fs::path place = target.has_filename() ? target : target.parent_path();
  std::error_code ignored;
  const bool exists = fs::exists(fs::symlink_status(place, ignored));
  if (exists && !fs::is_empty(place, ignored)) {
    return Error(ErrorCode::Invalid, "the folder holds something already")
        .in_file(place.string())
        .with_rule("file.exists")
        .with_fix("name a folder that does not exist yet");
  }
  if (exists) {
    return write_entries_into(archive, place.string());
  }
  std::error_code failed;
  fs::create_directories(place.parent_path(), failed);
  if (failed) {
    return unwritable(place.string(), "folder", failed.value());
  }
  TENON_TRY(NewFolder made, NewFolder::beside(place.string()));
  TENON_CHECK(write_entries(archive, made));
  return made.take_place();
}

}  // namespace tenon::bytes
