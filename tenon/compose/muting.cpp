// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/muting.h"

#include <filesystem>

namespace tenon::compose {

bool is_muted(const std::set<std::string>& muted, const std::string& asset_path,
              const layer::Layer& anchor) {
  if (muted.empty()) {
    return false;  // as in nearly all scenes: no path is parsed
  }
  if (muted.count(asset_path) != 0) {
    return true;
  }
  const std::string& identifier = anchor.identifier();
  const bool beside = asset_path.starts_with("./") || asset_path.starts_with("../");
  if (!beside || identifier.ends_with(']')) {  // a file within a package
    return false;
  }
  const std::filesystem::path folder = std::filesystem::path(identifier).parent_path();
  return muted.count((folder / asset_path).lexically_normal().string()) != 0;
}

}  // namespace tenon::compose
