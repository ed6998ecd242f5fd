// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/formats/text/layer_state.h"

namespace tenon::formats::text {

/// Reads one attribute or relationship statement of `owner` (a prim or a variant) and notes new
/// names in `properties`.
bool read_property(LayerState& state, Path owner, std::vector<Token>& properties);

/// Reads the `{ ... }` of `.spline`.
bool read_spline(Cursor& cursor, layer::ValueType type, layer::Value& value);

}  // namespace tenon::formats::text
