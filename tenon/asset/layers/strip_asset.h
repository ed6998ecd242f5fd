// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/asset/made_file.h"
#include "tenon/bake/mute_layer.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/physics/strip.h"

/// Assets without physics, or with physics that is switched off.
namespace tenon {

struct StripOptions {
  OpenOptions open;
  bool in_place = false;  ///< over the asset's own layers; else:
  std::string output;     ///< a file, a folder, or "-" for standard output
};

struct StrippedLayer {
  std::string file;
  physics::StripCounts counts;
};

struct StrippedAsset {
  physics::StripCounts counts;        ///< of all layers
  std::vector<StrippedLayer> layers;  ///< that held physics
  MadeFiles files;
  std::vector<std::string> without_layout;  ///< files whose comments and layout are not kept
  bool is_whole = true;                     ///< no layer is missing
};

/// Takes all physics out of the layers that the asset leads to, whichever variants are selected.
/// Physics in layers that do not belong to the asset stays, with an error in `diagnostics`. No file
/// is touched. Errors: those of open_layer and of AssetLayers.
Result<StrippedAsset> strip_asset(const std::string& path, const StripOptions& options,
                                  Diagnostics& diagnostics);

struct MutedAsset {
  bake::MuteCounts counts;
  MadeFile file;
};

/// Deletes nothing: bodies, colliders and joints are switched off by their enable flags, in a layer
/// over the asset or, in place, in its root layer. No file is touched. Errors: those of
/// tenon::open; Invalid (output.is-input) for a layer over the asset that would replace it.
Result<MutedAsset> mute_asset(const std::string& path, const StripOptions& options,
                              Diagnostics& diagnostics);

/// {"prims", "apiSchemas", "properties", "metadata": counts, "layers": [{"file", and the same}]}.
answers::Json stripped_json(const StrippedAsset& asset);

/// {"bodies", "colliders", "joints", "outOfReach"}: counts.
answers::Json muted_json(const bake::MuteCounts& counts);

}  // namespace tenon
