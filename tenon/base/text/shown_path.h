// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon {

/// A file name, or the identifier of a layer in a package, as people read it: as the caller gave it
/// (show_as_given), else relative to the working folder where it is absolute, else as it is.
std::string shown_path(const std::string& path);

/// The same for other programs: relative to the working folder wherever the file is in it.
std::string path_from_here(const std::string& path);

/// `given` is an argument, which may name a file or a folder. From now on this file, or what is in
/// this folder, is shown by its absolute path where that was given, and by a relative one where
/// that was; other files in the folder of an absolute one are shown by absolute paths, too, where
/// they are outside of the working folder. For a program, before it has threads.
void show_as_given(const std::string& given);

}  // namespace tenon
