// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Files in memory are files over a source that has none. Those over another source are kept by the
// real paths that this gives their names, and looked up by them: whichever name leads to a file,
// the same one is found, and policies judge the path that they would judge without it. Folders are
// not kept: the paths of files in one follow each other in the order of the map.
#include "tenon/bytes/files.h"

#include <algorithm>
#include <filesystem>

namespace tenon::bytes {
namespace {

using Bytes = std::shared_ptr<const FileBytes>;

Error no_such_file(const std::string& path) {
  return Error(ErrorCode::NotFound, "cannot open the file: there is none")
      .in_file(path)
      .with_rule("file.not-found");
}

/// No file at all; names mean what they say.
class NoFiles : public FileSource {
 public:
  NameKind kind(const std::string&) const override { return NameKind::Nothing; }
  std::string real_path(const std::string& path) const override { return absolute_file_path(path); }
  Result<Bytes> open(const std::string& path, const FileRules&) const override {
    return no_such_file(path);
  }
  Result<std::vector<FolderEntry>> list(const std::string& folder) const override {
    return no_such_file(folder);
  }
  bool is_on_disk(const std::string&) const override { return false; }
};

/// Files over those of another source, by the real paths of that.
class FilesOver : public FileSource {
 public:
  FilesOver(Files below, FileMap files) : below_(std::move(below)) {
    for (auto& [path, bytes] : files) {
      files_.insert_or_assign(real_path(path), std::move(bytes));
    }
  }

  NameKind kind(const std::string& path) const override {
    const std::string real = real_path(path);
    if (files_.contains(real)) {
      return NameKind::File;
    }
    const NameKind below = below_->kind(path);
    return below == NameKind::Nothing && first_in(real) != files_.end() ? NameKind::Folder : below;
  }

  std::string real_path(const std::string& path) const override {
    std::string real = below_->real_path(path);
    if (real.size() > 1 && real.ends_with('/')) {
      real.pop_back();
    }
    return real;
  }

  Result<Bytes> open(const std::string& path, const FileRules& rules) const override {
    const std::string real = real_path(path);
    const auto file = files_.find(real);
    if (file == files_.end()) {
      return below_->open(path, rules);
    }
    if (rules.check) {
      TENON_CHECK(rules.check(real));
    }
    TENON_CHECK(check_size(file->second->size(), rules, path));
    return file->second;
  }

  Result<std::vector<FolderEntry>> list(const std::string& folder) const override {
    const std::string real = real_path(folder);
    auto at = first_in(real);
    auto below = below_->list(folder);
    if (!below && at == files_.end()) {
      return below;
    }
    std::map<std::string, NameKind> names;
    for (FolderEntry& entry : below ? *below : std::vector<FolderEntry>()) {
      names.emplace(std::move(entry.name), entry.kind);
    }
    const std::string start = inside(real);
    for (; at != files_.end() && at->first.starts_with(start); ++at) {
      const std::string name = at->first.substr(start.size());
      const std::size_t slash = name.find('/');
      names.insert_or_assign(name.substr(0, slash),
                             slash == std::string::npos ? NameKind::File : NameKind::Folder);
    }
    std::vector<FolderEntry> entries;
    for (const auto& [name, kind] : names) {
      entries.push_back({name, kind});
    }
    return entries;
  }

  bool is_on_disk(const std::string& path) const override {
    return !files_.contains(real_path(path)) && below_->is_on_disk(path);
  }

 private:
  /// What the paths in a folder begin with.
  static std::string inside(const std::string& folder) {
    return folder == "/" ? "/" : folder + "/";
  }

  /// The first of these files in a folder.
  FileMap::const_iterator first_in(const std::string& folder) const {
    const std::string start = inside(folder);
    const auto at = files_.lower_bound(start);
    return at != files_.end() && at->first.starts_with(start) ? at : files_.end();
  }

  Files below_;
  FileMap files_;
};

}  // namespace

Files Files::nothing() {
  static const Files kNothing(std::make_shared<const NoFiles>());
  return kNothing;
}

Files Files::with(FileMap files) const {
  return Files(std::make_shared<const FilesOver>(*this, std::move(files)));
}

Result<std::vector<FolderEntry>> entries_below(const Files& files, const std::string& folder) {
  std::vector<FolderEntry> found;
  std::vector<std::string> pending{folder};
  while (!pending.empty()) {
    const std::string at = pending.back() + (pending.back().ends_with('/') ? "" : "/");
    pending.pop_back();
    TENON_TRY(const std::vector<FolderEntry> entries, files->list(at));
    for (const FolderEntry& entry : entries) {
      if (entry.kind == NameKind::Folder) {
        pending.push_back(at + entry.name);
      } else {
        found.push_back({at + entry.name, entry.kind});
      }
    }
  }
  std::sort(found.begin(), found.end(),
            [](const FolderEntry& a, const FolderEntry& b) { return a.name < b.name; });
  return found;
}

Result<std::vector<std::string>> files_below(const Files& files, const std::string& folder) {
  TENON_TRY(const std::vector<FolderEntry> entries, entries_below(files, folder));
  std::vector<std::string> found;
  for (const FolderEntry& entry : entries) {
    if (entry.kind == NameKind::File) {
      found.push_back(entry.name);
    }
  }
  return found;
}

Result<void> check_on_disk(const Files& files, const std::string& path) {
  if (files->is_on_disk(path)) {
    return {};
  }
  return Error(ErrorCode::Unsupported, "the file is read by tenon-worker, from the disk alone")
      .in_file(path)
      .with_rule("file.not-on-disk")
      .with_fix("save it to the disk, and open it there");
}

std::string absolute_file_path(std::string_view path) {
  std::error_code ignored;
  const std::filesystem::path absolute = std::filesystem::absolute(path, ignored);
  return absolute.lexically_normal().string();
}

}  // namespace tenon::bytes
