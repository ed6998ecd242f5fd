// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tenon {

/// A file to write: what is made of assets is a value until the caller writes all of it together
/// (docs/outputs.md).
struct MadeFile {
  std::string path;  ///< "-" is standard output
  std::string contents;
};
using MadeFiles = std::vector<MadeFile>;

}  // namespace tenon
