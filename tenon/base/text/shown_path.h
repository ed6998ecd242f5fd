// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon {

/// A file name, or the identifier of a layer in a package, as people read it: relative to the
/// working folder where it is absolute, else as it is.
std::string shown_path(const std::string& path);

/// From now on files at or below `folder`, an absolute path that a person gave, are shown by their
/// absolute paths where they lie outside of the working folder. For a program, before it has
/// threads.
void show_absolute(const std::string& folder);

}  // namespace tenon
