// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/layer.h"

namespace tenon::structure {

/// Long arrays of `layer` that are, bit for bit, what `original` has in the same place become one
/// with them in memory: compared here once, they need not be compared or worked on again.
void share_arrays(const layer::Layer& original, layer::Layer& layer);

}  // namespace tenon::structure
