// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// An empty folder for another program's own files, which no other user may look into: below the
/// environment variable TMPDIR, else /tmp. Removed with all that is in it, with this.
class TemporaryFolder {
 public:
  /// Errors: Io where none can be made.
  static Result<TemporaryFolder> make();
  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
  }
  TemporaryFolder() = default;
  ~TemporaryFolder();

  const std::string& path() const { return path_; }

 private:
  std::string path_;  // empty: none
};

}  // namespace tenon::bytes
