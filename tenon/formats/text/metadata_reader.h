// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/formats/text/layer_state.h"

namespace tenon::formats::text {

/// Reads the metadata of the spec at `path`; its '(' was taken.
bool read_metadata(LayerState& state, Path path, layer::SpecKind kind);

/// The same with the cursor at the '(', for a spec that has no metadata yet.
bool read_first_metadata(LayerState& state, layer::Spec& spec, Path path);

/// "name" or ["name", ...], not empty.
bool read_name_list(Cursor& cursor, std::vector<std::string>& names);

}  // namespace tenon::formats::text
