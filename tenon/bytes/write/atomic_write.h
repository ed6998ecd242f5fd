// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// Puts `contents` at `path` in one step: readers see the old file or the new one, whole, also when
/// the process is killed or the disk is full. Written in the same folder without a name where the
/// file system can (else under a hidden one), synced, then renamed; permissions and, where allowed,
/// the owner of an existing file are kept; a symbolic link stays a link. Devices and pipes, which
/// hold nothing, are written to directly. ErrorCode::Io leaves the old file untouched: also for a
/// file whose permissions forbid writing.
Result<void> write_file(const std::string& path, std::string_view contents);

}  // namespace tenon::bytes
