// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include <sys/stat.h>

#include "tenon/bytes/files.h"
#include "tenon/bytes/read_record.h"

namespace tenon::bytes {
namespace {

namespace fs = std::filesystem;

NameKind kind_of_name(const fs::directory_entry& entry) {
  std::error_code ignored;
  if (entry.is_regular_file(ignored)) {
    return NameKind::File;
  }
  const bool is_folder = entry.is_directory(ignored) && !entry.is_symlink(ignored);
  return is_folder ? NameKind::Folder : NameKind::Other;
}

class DiskFiles : public FileSource {
 public:
  NameKind kind(const std::string& path) const override {
    struct stat info = {};
    if (::stat(path.c_str(), &info) != 0) {
      note_missing(path);
      return NameKind::Nothing;
    }
    return S_ISREG(info.st_mode)   ? NameKind::File
           : S_ISDIR(info.st_mode) ? NameKind::Folder
                                   : NameKind::Other;
  }

  std::string real_path(const std::string& path) const override {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(fs::absolute(path, error), error);
    return error ? absolute_file_path(path) : real.string();
  }

  Result<std::shared_ptr<const FileBytes>> open(const std::string& path,
                                                const FileRules& rules) const override {
    return FileBytes::open(path, rules);
  }

  Result<std::vector<FolderEntry>> list(const std::string& folder) const override {
    std::error_code error;
    std::vector<FolderEntry> entries;
    fs::directory_iterator at(folder, error);
    for (const fs::directory_iterator end; !error && at != end; at.increment(error)) {
      entries.push_back({at->path().filename().string(), kind_of_name(*at)});
    }
    if (error) {
      const bool none = error == std::errc::no_such_file_or_directory;
      return Error(none ? ErrorCode::NotFound : ErrorCode::Io,
                   "the folder cannot be read: " + error.message())
          .in_file(folder)
          .with_rule(none ? "file.not-found" : "file.unreadable")
          .with_fix(none ? "" : "make it readable, or name the folders beside it");
    }
    std::sort(entries.begin(), entries.end(),
              [](const FolderEntry& a, const FolderEntry& b) { return a.name < b.name; });
    return entries;
  }

  bool is_on_disk(const std::string&) const override { return true; }
};

}  // namespace

Files::Files() {
  static const auto kDisk = std::make_shared<const DiskFiles>();
  source_ = kDisk;
}

}  // namespace tenon::bytes
