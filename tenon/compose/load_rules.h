// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/base/path.h"
#include "tenon/compose/index_cache.h"

namespace tenon::compose {

/// The payloads of a stage prim are included: by default or because of itself, an ancestor or, as
/// they must be there for it, a descendant that is asked for.
bool is_loaded(const ComposeOptions& options, Path prim_path);

}  // namespace tenon::compose
