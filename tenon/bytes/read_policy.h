// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/files.h"

/// The files that may be read for an asset (docs/reading.md). An asset comes from somebody else and
/// names any files; they go into an output only from folders that belong to it, or that a person
/// named.
namespace tenon::bytes {

/// The rule of an error about a file outside of the folders.
inline constexpr const char* kOutsideRule = "read.outside";

/// Folders that may be read, judged by where symbolic links lead. Without folders nothing may be.
class ReadPolicy {
 public:
  ReadPolicy() = default;
  explicit ReadPolicy(const std::vector<std::string>& folders, Files files = {});
  /// Every file there is.
  static ReadPolicy unrestricted() { return ReadPolicy({"/"}); }

  /// A folder, or a single file; relative ones are taken from the working directory. What does not
  /// exist adds nothing.
  void add(const std::string& folder);
  /// From now on folders found while reading add nothing: a person named the folders.
  void close() { is_closed_ = true; }
  bool is_closed() const { return is_closed_; }
  /// A folder that was found to belong to the asset, while it reads.
  void add_found(const std::string& folder);
  /// Where the files are that it judges.
  const Files& files() const { return files_; }
  /// Absolute, without symbolic links.
  const std::vector<std::string>& roots() const { return roots_; }

  /// `real` is absolute and without symbolic links.
  bool allows_real(const std::string& real) const;
  /// The file that `path` leads to. A file in a package is judged by the package:
  /// `/a/b.usdz[c.png]`.
  bool allows(const std::string& path) const;
  /// NotFound, rule kOutsideRule, with the file that `path` leads to and what a person can do.
  Result<void> check(const std::string& path) const;

  /// The bytes of a file or of a file in a package, checked once more when it is open. Errors:
  /// kOutsideRule; those of FileSource::open; Limit for more than kCopiedFileBytes.
  Result<std::shared_ptr<const FileBytes>> open(const std::string& identifier) const;

 private:
  Result<void> check_real(const std::string& real, const std::string& path) const;

  Files files_;
  std::vector<std::string> roots_;
  bool is_closed_ = false;
};

}  // namespace tenon::bytes
