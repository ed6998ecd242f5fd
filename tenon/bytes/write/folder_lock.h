// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// Advisory locks (flock) on folders, held until it ends; children of this process hold them, too.
/// All transactions take them in one order, so that none waits in a cycle. Folders that cannot be
/// locked (no flock there, no permission to list them) are skipped.
class FolderLock {
 public:
  /// Waits for others, half a minute at most: then ErrorCode::Io, rule "file.locked".
  static Result<FolderLock> take(const std::set<std::string>& folders);
  FolderLock(FolderLock&& other) noexcept : descriptors_(std::move(other.descriptors_)) {
    other.descriptors_.clear();
  }
  FolderLock& operator=(FolderLock&&) = delete;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  FolderLock() = default;
  std::vector<int> descriptors_;
};

}  // namespace tenon::bytes
