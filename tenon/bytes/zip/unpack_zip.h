// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/result.h"
#include "tenon/bytes/zip/zip_archive.h"

namespace tenon::bytes {

/// Checks that every entry has a name of its own that stays below a folder: relative, without "..",
/// ".", empty parts, backslashes, control characters or a colon in its first part; and that none is
/// both a file and a folder. Error: ErrorCode::Invalid, rule "package.bad-name".
Result<void> check_entry_names(const ZipArchive& archive);

/// Writes every file of the archive below `folder`, which must not exist yet, or be empty. All or
/// nothing: the files are written to a folder beside it, which then takes its name; into an empty
/// folder that is there they come in one transaction. Errors: those of `check_entry_names`, before
/// anything is written, and of ZipArchive::read_checked; ErrorCode::Io, Invalid for a folder that
/// holds something.
Result<void> unpack_zip(const ZipArchive& archive, const std::string& folder);

}  // namespace tenon::bytes
