// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// Assets in repositories are often missing in a clone: a small text file of Git LFS is there
/// instead (its specification, version 1). ErrorCode::NotFound with rule "file.lfs-pointer" for
/// one.
inline Result<void> check_no_lfs_pointer(std::string_view contents, const std::string& path) {
  if (!contents.starts_with("version https://git-lfs.github.com/spec/")) {
    return {};
  }
  return Error(ErrorCode::NotFound, "the file is a pointer of Git LFS; its contents are not here")
      .in_file(path)
      .with_rule("file.lfs-pointer")
      .with_fix("run `git lfs pull` in its repository");
}

}  // namespace tenon::bytes
