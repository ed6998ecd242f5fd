// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// Which file it is, whatever its names are: links, other spellings and mounts lead to the same.
using FileIdentity = std::pair<std::uint64_t, std::uint64_t>;  // device, inode

/// The state of a file when it was read.
struct FileStamp {
  FileIdentity identity;
  std::int64_t size = 0;
  std::int64_t modified_ns = 0;
  std::int64_t changed_ns = 0;
  std::optional<std::uint64_t> digest;  ///< of its contents, where they were looked at

  bool same_state(const FileStamp& other) const {
    return identity == other.identity && size == other.size && modified_ns == other.modified_ns &&
           changed_ns == other.changed_ns;
  }
};

/// The file that `path` leads to; nothing when there is none.
std::optional<FileStamp> stamp_of(const std::string& path);

/// The files that a program has read. A program that installs one lets every reading function of
/// this folder note here what it opens, and every writing one ask here before it replaces a file.
///
/// It is one for the process, not a value that is handed on: files are opened in a dozen places
/// (layers, packages, meshes, textures, descriptions, baselines), and one that forgot to hand it on
/// would cost somebody a file. A library installs none, and nothing is noted then.
class ReadRecord {
 public:
  enum class Digests : bool { No, Yes };
  /// With digests files are compared by their contents, too; large ones by their times alone.
  explicit ReadRecord(Digests digests = Digests::No) : digests_(digests) {}
  ReadRecord(const ReadRecord&) = delete;
  ReadRecord& operator=(const ReadRecord&) = delete;
  ~ReadRecord();

  /// Null when none is installed.
  static ReadRecord* current();
  /// Makes this one the current one, until it ends.
  void install();
  /// None is from now on, where this one was.
  void uninstall();

  void keep_digests() { digests_ = Digests::Yes; }
  /// `path` was opened, and `contents` are what it holds.
  void note(const std::string& path, FileStamp stamp, std::string_view contents);
  /// The same for a file that something else opens by its name.
  void note(const std::string& path);
  /// `path` was asked for and is not there, or cannot be opened.
  void note_missing(const std::string& path);
  /// Clears the record, before everything is read again.
  void clear();

  bool has(const FileIdentity& file) const;
  /// As they were opened, sorted.
  std::vector<std::string> paths() const;
  /// Requested files that were missing, sorted; the first 10,000 of them.
  std::vector<std::string> missing() const;
  /// Error with rule "file.changed" when a file that was read is no longer what it was then. Files
  /// in `by_content` are read again to know.
  Result<void> check_unchanged(const std::set<FileIdentity>& by_content) const;
  /// The run has itself replaced these files: their new contents count as read.
  void refresh(const std::set<FileIdentity>& replaced);

 private:
  Digests digests_;
  mutable std::mutex mutex_;
  std::map<std::string, FileStamp> files_;  // by path as opened
  std::set<FileIdentity> identities_;
  std::set<std::string> missing_;
  std::string changed_;  // a path that was two different files, at different times
};

/// Notes a file that a library opens by itself. Nothing happens where no record is installed.
void note_read(const std::string& path);

/// Notes a requested file that is missing. Nothing happens where no record is installed.
void note_missing(const std::string& path);

/// True for the Error of a file that was changed by somebody else since it was read: the caller can
/// read it again and repeat the edit without losing anything.
bool is_changed_meanwhile(const Error& error);

}  // namespace tenon::bytes
