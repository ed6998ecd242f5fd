// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// Puts `contents` at `path` in one step: readers see the old file or the new one, whole. Written
/// beside it, synced, then renamed; permissions of an existing file are kept, a symbolic link stays
/// a link. ErrorCode::Io leaves the old file untouched.
Result<void> write_file(const std::string& path, std::string_view contents);

}  // namespace tenon::bytes
