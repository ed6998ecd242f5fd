// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/formats/text/layer_state.h"

namespace tenon::formats::text {

/// Reads one attribute or relationship statement of `owner` (a prim or a variant) and notes new
/// names in `properties`.
bool read_property(LayerState& state, Path owner, std::vector<Token>& properties);

/// The same for a statement that begins with the head of `known`, which state.known_attributes
/// found.
bool read_known_attribute(LayerState& state, KnownAttribute& known, Path owner,
                          std::vector<Token>& properties);

/// Reads the `{ ... }` of `.spline`.
bool read_spline(Cursor& cursor, layer::ValueType type, layer::Value& value);

/// The target that `path` means in a property of `owner`, a prim or variant. A relative one counts
/// from the prim, in which variants count as levels; the property's own variant does not. OpenUSD
/// 26.11.
Path target_of(Path path, Path owner);

}  // namespace tenon::formats::text
