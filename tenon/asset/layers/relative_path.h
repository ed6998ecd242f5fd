// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tenon {

/// The asset path by which a layer in `folder` names `file`, both absolute: "./a/b.usda" or
/// "../b.usda", which is taken from the layer's folder alone.
inline std::string relative_asset_path(const std::filesystem::path& file,
                                       const std::filesystem::path& folder) {
  const std::string name = file.lexically_relative(folder).generic_string();
  return name.starts_with("../") ? name : "./" + name;
}

}  // namespace tenon
