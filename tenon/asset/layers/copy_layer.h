// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/layer.h"
#include "tenon/open_stage.h"

/// An asset as one layer.
namespace tenon {

enum class CopyForm : std::uint8_t {
  AsItIs,              ///< the root layer
  Flattened,           ///< the composed scene
  FlattenedLayerStack  ///< the root layer with its sublayers merged
};

/// Errors: those of open_layer and tenon::open. Layers of a composed scene that lie elsewhere are
/// named in `diagnostics` (asset_policy.h).
Result<layer::Layer> copy_layer(const std::string& path, const OpenOptions& open, CopyForm form,
                                Diagnostics& diagnostics);

/// A layer that is copied as it is opens none of those that it names; they are inputs nevertheless,
/// and are noted as read (bytes/read_record.h).
void note_named_layers(layer::Layer& layer, const OpenOptions& open);

/// The layer as the bytes of a file; a package takes in what the asset at `path` names. Errors:
/// those of encode_layer and pack_layer.
Result<std::string> copied_contents(layer::Layer layer, formats::LayerFormat format,
                                    const std::string& path, const OpenOptions& open,
                                    Diagnostics& diagnostics);

}  // namespace tenon
