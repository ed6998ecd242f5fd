// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/check_profile.h"

#include <algorithm>
#include <filesystem>

#include "tenon/stage_sources.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> layers_below(const fs::path& folder) {
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    const std::string ending = at->path().extension().string();
    if (ending == ".usd" || ending == ".usda" || ending == ".usdc") {
      found.push_back(at->path().string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

Result<structure::AssetFiles> asset_files(const std::string& path, const OpenOptions& options) {
  OpenOptions plain = options;
  plain.physics_variant.clear();
  plain.session_path.clear();
  TENON_TRY(const StageSources sources, open_sources(path, plain));
  structure::AssetFiles files;
  files.interface = sources.root;
  const fs::path folder = fs::path(sources.root->identifier()).parent_path() / "payloads";
  for (const std::string& name : layers_below(folder)) {
    if (auto layer = sources.registry->open(name, nullptr)) {
      files.payloads.push_back(*std::move(layer));
    }
  }
  files.exists = [](const std::string& identifier) {
    std::error_code ignored;
    return fs::exists(identifier, ignored);
  };
  return files;
}

}  // namespace tenon
