// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/compose/layer_opener.h"
#include "tenon/layer/layer.h"

namespace tenon::compose {

/// One layer of a stack and how its times map to the stack's root layer.
struct StackedLayer {
  layer::LayerPtr layer;
  layer::LayerOffset offset;  ///< stack time = offset(layer time), tcps differences included
};

/// A root layer with its session layer and all sublayers, strongest first.
struct LayerStack {
  layer::LayerPtr root;
  layer::LayerPtr session;  ///< may be null
  std::vector<StackedLayer> layers;
  layer::Dictionary expression_variables;  ///< composed over the stack and its referencing stacks
  /// Composed relocates of the stack: source to target, both absolute; sorted by source.
  std::vector<std::pair<Path, Path>> relocates;
  Diagnostics errors;

  const std::string& identifier() const { return root->identifier(); }
};

using LayerStackPtr = std::shared_ptr<const LayerStack>;

}  // namespace tenon::compose
