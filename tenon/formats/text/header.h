// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/formats/text/layer_state.h"

namespace tenon::formats::text {

/// Takes the first line, `#usda 1.0`, after a look at the encoding of the whole text.
bool read_header(LayerState& state);

}  // namespace tenon::formats::text
