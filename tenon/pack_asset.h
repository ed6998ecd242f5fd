// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/formats/package/pack.h"
#include "tenon/open_stage.h"

namespace tenon {

/// An asset as one file.
struct PackedAsset {
  std::string package;                     ///< bytes of the .usdz
  std::vector<formats::PackedFile> files;  ///< what is in it, the root layer first
};

/// Packs the asset at `path` with everything that any of its variants needs (formats/package/pack.h
/// says how, and which diagnostics there are). No file is touched. The same bytes for the same
/// asset.
Result<PackedAsset> pack_asset(const std::string& path, const OpenOptions& options,
                               Diagnostics& diagnostics);

/// pack_layer of tenon.h for a layer that also names what is in no file yet: `made`.
Result<std::string> pack_layer(layer::Layer layer, const std::string& path,
                               const OpenOptions& options, const formats::MadeFiles& made,
                               Diagnostics& diagnostics);

}  // namespace tenon
