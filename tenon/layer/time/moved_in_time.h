// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/field_values.h"

namespace tenon::layer {

/// The value as a layer sees it that includes the value's own layer with `offset`: time codes are
/// moved, durations scaled, also in arrays and in edits of them; other values stay as they are.
Value moved_in_time(const Value& value, const LayerOffset& offset);

}  // namespace tenon::layer
