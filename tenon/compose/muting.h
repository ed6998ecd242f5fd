// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "tenon/layer/layer.h"

namespace tenon::compose {

/// Whether `muted`, identifiers of layers, names what `asset_path` means in `anchor`: as it is
/// written or, for a path that starts with a dot, beside the anchor. Needs no look at the layer, so
/// that one that is absent or damaged can be muted.
bool is_muted(const std::set<std::string>& muted, const std::string& asset_path,
              const layer::Layer& anchor);

}  // namespace tenon::compose
