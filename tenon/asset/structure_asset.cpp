// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/structure_asset.h"

#include <filesystem>

#include "tenon/stage_sources.h"

namespace tenon {

Result<structure::AssetSource> asset_source(const std::string& path, const OpenOptions& options) {
  OpenOptions plain = options;
  plain.physics_variant.clear();  // all variants are looked at
  plain.session_path.clear();
  TENON_TRY(const StageSources sources, open_sources(path, plain));
  structure::AssetSource source;
  source.root = sources.root;
  source.open_layer = sources.opener();
  source.resolve_asset = [registry = sources.registry](const std::string& asset,
                                                       const layer::Layer& anchor) {
    return registry->resolver().resolve(asset, anchor.identifier()).value_or(std::string());
  };
  source.open_asset = [registry = sources.registry](const std::string& identifier) {
    return registry->resolver().open(identifier);
  };
  return source;
}

structure::AssetSource asset_source(layer::Layer layer) {
  structure::AssetSource source;
  source.root = std::make_shared<const layer::Layer>(std::move(layer));
  source.open_layer = [](const std::string& asset, const layer::Layer&) -> Result<layer::LayerPtr> {
    return Error(ErrorCode::NotFound, "the layer stands alone").in_file(asset);
  };
  source.resolve_asset = [](const std::string& asset, const layer::Layer&) {
    std::error_code error;
    const bool found =
        std::filesystem::path(asset).is_absolute() && std::filesystem::exists(asset, error);
    return found ? asset : std::string();
  };
  source.open_asset = [](const std::string& identifier) {
    return bytes::FileBytes::open(identifier);
  };
  return source;
}

Result<structure::StructuredAsset> structure_asset(const std::string& path, const OpenOptions& open,
                                                   const structure::StructureOptions& options,
                                                   Diagnostics& diagnostics) {
  TENON_TRY(const structure::AssetSource source, asset_source(path, open));
  return structure::make_package(source, options, diagnostics);
}

}  // namespace tenon
