// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"

/// Macros of robot descriptions, expanded by ROS's own program.
namespace tenon::xacro {

struct XacroOptions {
  std::map<std::string, std::string> arguments;  ///< of $(arg NAME)
  std::map<std::string, std::string> packages;   ///< folders of ROS packages by name: $(find NAME)
  bytes::ReadPolicy reading;                     ///< what may be read; found packages join in
};

struct ExpandedXacro {
  std::string text;                        ///< as the program prints it
  std::vector<std::string> opened;         ///< the files that it says it has read
  std::vector<std::string> found_folders;  ///< of packages, beside those of the options
};

/// Whether a description is to be expanded: by its macros, or its ending .xacro.
bool is_xacro(std::string_view text, const std::string& path);

/// Expands the macros of a file on the disk by the Python package xacro, which runs the file's
/// expressions: in a process that may read the folders of `reading`, Python itself and nothing
/// else, write nowhere and reach no network, bounded in memory and time (docs/limits.md). Errors:
/// Missing (xacro.missing, xacro.sandbox) without Python, xacro or a kernel that confines it; Parse
/// (xacro.failed) with xacro's own message and file; Limit; Unsupported "file.not-on-disk".
Result<ExpandedXacro> expand_xacro(const std::string& path, const XacroOptions& options);

}  // namespace tenon::xacro
