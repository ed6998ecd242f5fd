// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/formats/text/layer_state.h"

namespace tenon::formats::text {

/// Reads the metadata of the spec at `path`, with the cursor at its '('. `made`: that spec where it
/// has none yet, so that a block which came before may be taken over; else null.
bool read_metadata(LayerState& state, Path path, layer::SpecKind kind, layer::Spec* made);

/// "name" or ["name", ...], not empty.
bool read_name_list(Cursor& cursor, std::vector<std::string>& names);

}  // namespace tenon::formats::text
