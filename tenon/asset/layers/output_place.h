// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon {

/// Whether an output names a folder: it ends with '/', has no ending, or is a folder.
bool names_folder(const std::string& output);

}  // namespace tenon
