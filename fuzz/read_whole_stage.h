// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/stage/stage.h"

namespace tenon::fuzz {

/// Asks everything of every prim, down to `max_prims` of them (instance proxies included): types,
/// metadata, values at several times, targets, transforms, collections. The number of prims seen.
std::size_t read_whole_stage(const stage::Stage& stage, std::size_t max_prims);

}  // namespace tenon::fuzz
