// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/result.h"
#include "tenon/formats/layer_format.h"
#include "tenon/layer/layer.h"

namespace tenon::formats {

/// "usda", "usdc" or "usdz" (with or without a dot); ErrorCode::Invalid for anything else.
Result<LayerFormat> layer_format_named(std::string_view name);
/// By the name's ending: .usda text, .usdc and .usd crate, .usdz package.
Result<LayerFormat> layer_format_for(std::string_view path);

/// The bytes of a file that holds the layer. A package holds it alone, as a crate. The text of a
/// layer from a binary file is read back first, unless all of it is of forms that surely have one:
/// ErrorCode::Unsupported where that fails.
Result<std::string> encode_layer(const layer::Layer& layer, LayerFormat format);

/// Limit where a text would have arrays, which a binary file holds once, in so many places that it
/// is beyond limits::kRepeatedArrays. Decodes them.
Result<void> check_repeated_arrays(const layer::Layer& layer);

/// Writes the layer to `path` in the format that its ending names, in one step (the old file or the
/// new one, whole).
Result<void> save_layer(const layer::Layer& layer, const std::string& path);

}  // namespace tenon::formats
