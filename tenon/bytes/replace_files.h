// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "tenon/base/result.h"

namespace tenon::bytes {

/// Gives files that exist new contents, all in one step: other programs see all old ones or all new
/// ones, also when the process is killed or the disk is full. Links are followed; permissions stay.
///
/// One file is replaced by its name. Several are: the folder that holds them all is made again
/// under a hidden name, its other files as hard links, and the two are exchanged. A kill may leave
/// the hidden folder behind, beside that folder. Where the file system can do neither, or the
/// folder holds other than files, folders and links, or more than 100000 of them, the files are
/// replaced one after the other, and put back when one cannot be written: a kill then may leave
/// some of them new.
/// `contents_by_path`: path -> what is to stand in that file. Errors: ErrorCode::Io.
Result<void> replace_files(const std::map<std::string, std::string>& contents_by_path);

}  // namespace tenon::bytes
