// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/pack_asset.h"

#include <utility>

#include "tenon/asset_policy.h"
#include "tenon/stage_sources.h"

namespace tenon {

Result<PackedAsset> pack_asset(const std::string& path, const OpenOptions& options,
                               Diagnostics& diagnostics) {
  TENON_TRY(const layer::LayerPtr root, open_layer(path, options, diagnostics));
  bytes::ResolverOptions resolver = resolver_options(options);
  const std::string& file = root->identifier();
  resolver.search_paths.insert(resolver.search_paths.begin(), file.substr(0, file.rfind('/') + 1));
  PackedAsset packed;
  TENON_TRY(packed.package,
            formats::pack(bytes::AssetResolver(std::move(resolver)), policy_for(path, options),
                          *root, diagnostics, &packed.files));
  return packed;
}

Result<std::string> pack_layer(layer::Layer layer, const std::string& path,
                               const OpenOptions& options, const formats::MadeFiles& made,
                               Diagnostics& diagnostics) {
  const std::string file = bytes::absolute_file_path(bytes::split_package_path(path).package);
  const std::string folder = file.substr(0, file.rfind('/') + 1);
  if (!layer.identifier().starts_with('/')) {
    layer.set_identifier(folder + "composed");  // no file: its paths are relative to the folder
  }
  bytes::ResolverOptions resolver = resolver_options(options);
  resolver.search_paths.insert(resolver.search_paths.begin(), folder);
  return formats::pack(bytes::AssetResolver(std::move(resolver)), policy_for(path, options), layer,
                       diagnostics, nullptr, made);
}

}  // namespace tenon
