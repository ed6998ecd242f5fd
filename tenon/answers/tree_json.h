// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"
#include "tenon/stage/stage.h"

namespace tenon::answers {

/// [{"path", "specifier", "type", "active", "instance"}]: every prim but the pseudo-root, depth
/// first, children in order.
Json tree_json(const stage::Stage& stage);

/// {"prims": that}.
Json prims_json(const stage::Stage& stage);

}  // namespace tenon::answers
