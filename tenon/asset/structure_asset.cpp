// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/structure_asset.h"

#include "tenon/asset_policy.h"
#include "tenon/stage_sources.h"

namespace tenon {

namespace {

structure::AssetSource source_of(const StageSources& sources, const bytes::ReadPolicy& policy,
                                 std::size_t max_work) {
  structure::AssetSource source;
  source.max_work = max_work;
  source.root = sources.root;
  source.open_layer = sources.opener();
  source.resolve_asset = [registry = sources.registry](const std::string& asset,
                                                       const layer::Layer& anchor) {
    return registry->resolver().resolve(asset, anchor.identifier()).value_or(std::string());
  };
  source.open_asset = [policy](const std::string& identifier) { return policy.open(identifier); };
  source.files = policy.files();
  return source;
}

}  // namespace

structure::AssetSource asset_source(layer::Layer layer, const bytes::ReadPolicy& policy) {
  structure::AssetSource source;
  source.root = std::make_shared<const layer::Layer>(std::move(layer));
  source.open_layer = [](const std::string& asset, const layer::Layer&) -> Result<layer::LayerPtr> {
    return Error(ErrorCode::NotFound, "the layer stands alone").in_file(asset);
  };
  source.files = policy.files();
  source.resolve_asset = [files = policy.files()](const std::string& asset, const layer::Layer&) {
    const bool found = asset.starts_with('/') && files->kind(asset) != bytes::NameKind::Nothing;
    return found ? asset : std::string();
  };
  source.open_asset = [policy](const std::string& identifier) { return policy.open(identifier); };
  return source;
}

Result<structure::StructuredAsset> structure_asset(const std::string& path, const OpenOptions& open,
                                                   const structure::StructureOptions& options,
                                                   Diagnostics& diagnostics) {
  OpenOptions plain = open;
  plain.physics_variant.clear();  // all variants are looked at
  plain.session_path.clear();
  TENON_TRY(const StageSources sources, open_sources(path, plain));
  const bytes::ReadPolicy policy = policy_for(path, open);
  TENON_TRY(
      structure::StructuredAsset asset,
      structure::make_package(source_of(sources, policy, open.max_work), options, diagnostics));
  for (const std::string& layer : sources.registry->opened()) {
    name_outside_layer(layer, sources.root->identifier(), policy, diagnostics);
  }
  return asset;
}

}  // namespace tenon
