// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

namespace tenon::formats {

/// How an asset path is meant.
enum class AssetUse : unsigned char {
  Layer,         ///< a sublayer, reference, payload or clip
  Value,         ///< of an attribute or of metadata: a texture, or anything else
  ClipTemplate,  ///< a pattern of clips with '#' for digits
};

/// Replaces every asset path of the layer, in arcs, values, samples, metadata and value clips, by
/// what `rename` gives for it. True when one changed.
using RenameAsset =
    std::function<std::string(const std::string& asset_path, AssetUse use, Path spec)>;
bool rename_assets(layer::Layer& layer, const RenameAsset& rename);

/// The same with the item or value that holds the asset path, for findings: see place_finding.
using RenameAssetPart = std::function<std::string(const std::string& asset_path, AssetUse use,
                                                  Path spec, const StatementPart& part)>;
bool rename_asset_parts(layer::Layer& layer, const RenameAssetPart& rename);

}  // namespace tenon::formats
