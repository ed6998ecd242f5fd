// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "tenon/formats/open_layer.h"
#include "tenon/session_opinions.h"
#include "tenon/tenon.h"

namespace tenon {

Result<std::unique_ptr<compose::IndexCache>> open_indices(const std::string& path,
                                                          const OpenOptions& options,
                                                          Diagnostics& diagnostics) {
  bytes::ResolverOptions resolver;
  resolver.roots = options.sandbox_roots;
  const auto registry =
      std::make_shared<formats::LayerRegistry>(bytes::AssetResolver(std::move(resolver)));
  TENON_TRY(const layer::LayerPtr root, registry->open_root(path));
  layer::LayerPtr session;
  if (!options.session_path.empty()) {
    TENON_TRY(session, registry->open(options.session_path, nullptr));
  }
  if (!options.physics_variant.empty()) {
    TENON_TRY(session, with_variant(session, *root, "Physics", options.physics_variant));
  }
  compose::ComposeOptions compose;
  compose.load_payloads = options.load_payloads;
  compose.variant_fallbacks = options.variant_fallbacks;
  auto opener = [registry](const std::string& asset, const layer::Layer& anchor) {
    return registry->open(asset, &anchor);
  };
  diagnostics.append(registry->diagnostics());
  return std::make_unique<compose::IndexCache>(root, session, std::move(opener),
                                               std::move(compose));
}

}  // namespace tenon
