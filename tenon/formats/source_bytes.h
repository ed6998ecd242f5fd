// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "tenon/bytes/file_bytes.h"
#include "tenon/bytes/files.h"

namespace tenon::formats {

/// What the file or layer that findings name was read from; nothing for what is no file.
std::shared_ptr<const bytes::FileBytes> source_bytes(const bytes::Files& files,
                                                     const std::string& identifier);

}  // namespace tenon::formats
