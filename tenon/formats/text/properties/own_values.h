// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/formats/text/layer_state.h"

namespace tenon::formats::text {

/// The default value of an attribute of `owner`, a prim or variant: of the attribute's type, or a
/// block.
bool read_default_value(LayerState& state, const OwnType& own, Path owner, layer::Value& value);

/// `{ time: value, ... }` of the attribute at `path`.
bool read_time_samples(LayerState& state, const OwnType& own, Path path, layer::Value& samples);

}  // namespace tenon::formats::text
