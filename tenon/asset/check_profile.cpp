// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/check_profile.h"

#include <filesystem>

#include "tenon/stage_sources.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> layers_below(const bytes::Files& files, const std::string& folder) {
  std::vector<std::string> found =
      bytes::files_below(files, folder).value_or(std::vector<std::string>());
  std::erase_if(found, [](const std::string& name) { return !formats::is_layer_name(name); });
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
  for (const std::string& name : layers_below(options.files, folder.string())) {
    if (auto layer = sources.registry->open(name, nullptr)) {
      files.payloads.push_back(*std::move(layer));
    }
  }
  files.exists = [all = options.files](const std::string& identifier) {
    return all->kind(identifier) != bytes::NameKind::Nothing;
  };
  return files;
}

}  // namespace tenon
