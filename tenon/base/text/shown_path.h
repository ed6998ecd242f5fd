// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon {

/// A file name, or the identifier of a layer in a package, as people read it: relative to the
/// working folder where it is absolute, else as it is.
std::string shown_path(const std::string& path);

}  // namespace tenon
