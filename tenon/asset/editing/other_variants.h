// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tenon/layer/layer.h"
#include "tenon/stage/stage.h"

/// Internal to the wiring.
namespace tenon {

/// Session layers over `session` (may be null) under which each variant that has arcs and is not
/// selected on a prim of the stage is selected once: as many as the largest set has of these. Sets
/// in `without` stay as they are.
std::vector<layer::LayerPtr> sessions_of_other_variants(const stage::Stage& stage,
                                                        const layer::LayerPtr& session,
                                                        const std::set<std::string>& without);

}  // namespace tenon
