// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/layer/layer.h"

namespace tenon {

/// Old path -> new path of prims that moved in the new layers, as links do when one is inserted: a
/// removed and a new prim with the same name and type, where there is only one of each. Descendants
/// that move along are not listed.
std::map<Path, Path> moved_prims(const std::vector<const layer::Layer*>& before,
                                 const std::vector<const layer::Layer*>& after);

/// Moves them in one layer, as far as it has specs of them, with all that names them.
void follow_moves(const std::map<Path, Path>& moved, layer::Layer& layer);

}  // namespace tenon
