// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/layer/layer.h"
#include "tenon/structure/layout.h"

namespace tenon::structure {

/// One arc as a layer authors it.
struct LayerArc {
  Arc kind = Arc::Reference;
  std::string asset_path;  ///< empty for an arc within the layer
  Path target;             ///< prim in the target layer; empty for its default prim
  Path spec;               ///< prim, variant or attribute that has it; the root for sublayers
  std::uint32_t line = 0;  ///< of that spec

  /// What of the spec it is, for findings.
  StatementPart part() const;
};

/// All sublayers, references and payloads of a layer, variants included, and with `assets` the
/// asset values of its attributes, in the order of the layer's specs. Deleted arcs are skipped.
std::vector<LayerArc> arcs_of(const layer::Layer& layer, bool assets = false);

}  // namespace tenon::structure
