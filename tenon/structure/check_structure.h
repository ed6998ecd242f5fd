// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

namespace tenon::structure {

/// The files of an asset that is said to have Asset Structure 3.0.
struct AssetFiles {
  layer::LayerPtr interface;
  std::vector<layer::LayerPtr> payloads;  ///< all layers in the folder "payloads", used or not
  Function<bool(const std::string& identifier)> exists;
};

/// Checks each file against layout.h. Rules (docs/rules): structure.not-structured, wrong-layer,
/// wrong-arc, absolute-path, missing-file, orphan-file, dangling-selection, below-instance,
/// empty-over, scene-not-composed, legacy-schema. Findings name the layer's line.
Diagnostics check_files(const AssetFiles& files);

/// Holds the asset under one variant of "Physics": structure.dangling-target, live-collider.
Diagnostics check_variant(const stage::Stage& stage, const std::string& variant);

}  // namespace tenon::structure
