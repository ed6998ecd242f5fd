// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset_policy.h"

#include <algorithm>
#include <filesystem>

#include "tenon/base/file_finding.h"
#include "tenon/base/text/shell_word.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/asset_roots.h"

namespace tenon {

bytes::ReadPolicy policy_for(const std::string& path, const OpenOptions& options) {
  bytes::ReadPolicy policy(options.sandbox_roots, options.files);
  if (options.sandbox_roots.empty()) {
    const std::string file = bytes::split_package_path(path).package;
    for (const std::string& root : bytes::roots_of_asset(options.files, file)) {
      policy.add(root);
    }
    for (const std::string& folder : options.search_paths) {
      policy.add(folder);
    }
  }
  for (const std::string& allowed : options.allowed_reads) {
    policy.add(allowed);
  }
  if (!options.sandbox_roots.empty()) {
    policy.close();
  }
  return policy;
}

void name_outside_layer(const std::string& layer, const std::string& asset,
                        const bytes::ReadPolicy& policy, Diagnostics& diagnostics) {
  if (layer == asset || !layer.starts_with('/') || policy.allows(layer)) {
    return;
  }
  const std::string file = policy.files()->real_path(bytes::split_package_path(layer).package);
  diagnostics.add(file_finding(
      Severity::Warning, kOutsideLayerRule,
      "the layer @" + layer +
          "@ is outside of the folders of the asset; what it says goes into "
          "the result",
      asset, 0,
      "give --sandbox with the folders that may be read to keep it out, or --allow-read " +
          shell_word(std::filesystem::path(file).parent_path().string()) +
          " if it belongs to the asset"));
}

void name_outside_layers(const stage::Stage& stage, const bytes::ReadPolicy& policy,
                         Diagnostics& diagnostics) {
  for (const layer::LayerPtr& layer : stage.used_layers()) {
    name_outside_layer(layer->identifier(), stage.root_layer().identifier(), policy, diagnostics);
  }
}

bool left_out(const Diagnostics& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& finding) {
    const bool by_policy = finding.rule.starts_with("read.") && finding.rule != kOutsideLayerRule;
    return by_policy || finding.rule == "layer.outside" || finding.rule == "guard.outside";
  });
}

}  // namespace tenon
