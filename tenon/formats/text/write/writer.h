// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/layer/layer.h"

namespace tenon::formats {

/// The canonical text of a layer: byte for byte what OpenUSD 26.11 exports. The header's version is
/// the lowest that has all features used. Deferred arrays are decoded; corrupt ones become `[]`.
std::string write_text(const layer::Layer& layer);

namespace text {

/// The text of one prim, property, variant set or variant that the layer has, at the left margin.
std::string part_text(const layer::Layer& layer, Path path);

}  // namespace text

}  // namespace tenon::formats
