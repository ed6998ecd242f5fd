// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"

/// Where files come from. Everything above this folder that reads an asset asks a value `Files`:
/// the disk, files in memory, unsaved text of an editor over either, or a source of your own.
/// Packages need none: a file in one is read from the bytes of the package.
namespace tenon::bytes {

/// What a name leads to, symbolic links followed.
enum class NameKind : std::uint8_t {
  Nothing,
  File,
  Folder,
  Other,  ///< a pipe, a device; in a folder's list also a symbolic link to a folder
};

/// A name in a folder.
struct FolderEntry {
  std::string name;
  NameKind kind = NameKind::Nothing;
};

/// Answers for names of files. Paths are absolute, or relative to the working directory. The same
/// question has the same answer from several threads at once, for as long as an asset is in use.
class FileSource {
 public:
  virtual ~FileSource() = default;

  virtual NameKind kind(const std::string& path) const = 0;
  /// The file or folder that `path` leads to: absolute, without symbolic links, as far as there is
  /// one. Read policies and sandboxes judge by it.
  virtual std::string real_path(const std::string& path) const = 0;
  /// All of a file. Errors: NotFound "file.not-found" where there is none; Io "file.unreadable" for
  /// what is no file or cannot be read; Limit "file.too-large" by the rules; what their check says.
  virtual Result<std::shared_ptr<const FileBytes>> open(const std::string& path,
                                                        const FileRules& rules) const = 0;
  /// The names in a folder, sorted. Errors: NotFound "file.not-found" where there is none, Io
  /// "file.unreadable" where it cannot be read.
  virtual Result<std::vector<FolderEntry>> list(const std::string& folder) const = 0;
  /// Whether another process that opens `path` finds these very bytes.
  virtual bool is_on_disk(const std::string& path) const = 0;
};

/// Files by their paths.
using FileMap = std::map<std::string, std::shared_ptr<const FileBytes>>;

/// A source of files as a value: cheap to copy, never null.
class Files {
 public:
  /// The disk.
  Files();
  /// A source of your own; not null.
  explicit Files(std::shared_ptr<const FileSource> source) : source_(std::move(source)) {}
  /// Only these files: others are not looked for on the disk.
  static Files in_memory(FileMap files) { return nothing().with(std::move(files)); }
  /// These files over those of this source, such as text that an editor has not saved. Each stands
  /// for the file that its path leads to, so it is found under all names of that.
  Files with(FileMap files) const;

  const FileSource* operator->() const { return source_.get(); }

 private:
  static Files nothing();

  std::shared_ptr<const FileSource> source_;
};

/// What is in `folder` and below it but folders, by its paths, sorted; symbolic links to folders
/// are not followed. Errors: those of `list`.
Result<std::vector<FolderEntry>> entries_below(const Files& files, const std::string& folder);
/// Paths of the files in `folder` and below it, sorted; symbolic links to folders are not followed.
/// Errors: those of `list`.
Result<std::vector<std::string>> files_below(const Files& files, const std::string& folder);

/// Unsupported "file.not-on-disk" for a file to be read by another process that this would not
/// find.
Result<void> check_on_disk(const Files& files, const std::string& path);

/// The absolute form of a path, "." and ".." removed, links kept.
std::string absolute_file_path(std::string_view path);

}  // namespace tenon::bytes
