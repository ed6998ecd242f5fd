// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage_sources.h"

#include "tenon/session_opinions.h"

namespace tenon {

compose::LayerOpener StageSources::opener() const {
  return [registry = registry](const std::string& asset, const layer::Layer& anchor) {
    return registry->open(asset, &anchor);
  };
}

bytes::ResolverOptions resolver_options(const OpenOptions& options) {
  return {options.search_paths, options.sandbox_roots};
}

Result<StageSources> open_sources(const std::string& path, const OpenOptions& options) {
  StageSources sources;
  sources.registry =
      std::make_shared<formats::LayerRegistry>(bytes::AssetResolver(resolver_options(options)));
  TENON_TRY(sources.root, sources.registry->open_root(path));
  if (!options.session_path.empty()) {
    TENON_TRY(sources.session, sources.registry->open(options.session_path, nullptr));
  }
  if (!options.physics_variant.empty()) {
    TENON_TRY(sources.session,
              with_variant(sources.session, *sources.root, "Physics", options.physics_variant));
  }
  return sources;
}

}  // namespace tenon
