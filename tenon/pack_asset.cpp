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

}  // namespace tenon
