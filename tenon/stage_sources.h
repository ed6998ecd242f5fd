// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "tenon/base/result.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/compose/cache/index_cache.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/layer.h"
#include "tenon/open_stage.h"

namespace tenon {

/// What composition starts from: the layers of a stage and the way to all others.
struct StageSources {
  std::shared_ptr<formats::LayerRegistry> registry;
  layer::LayerPtr root;
  layer::LayerPtr session;  ///< null when nothing asks for one

  /// Keeps the registry alive.
  compose::LayerOpener opener() const;
};

/// Search paths, sandbox and files of the options.
bytes::ResolverOptions resolver_options(const OpenOptions& options);

/// What the options say about payloads, muted layers and variants; `root` is the root layer. Fails
/// on a path that is not one of a prim.
Result<compose::ComposeOptions> compose_options(const OpenOptions& options,
                                                const layer::Layer& root);

/// `text` as the absolute path of a prim; `what` names it in the message of failure.
Result<Path> parse_prim_path(const std::string& text, const std::string& what);

/// Opens the root layer of `path` and the session layer that the options ask for, with the variant
/// of "Physics" selected in it.
Result<StageSources> open_sources(const std::string& path, const OpenOptions& options);

}  // namespace tenon
