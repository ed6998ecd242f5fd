// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

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

}  // namespace tenon::formats
