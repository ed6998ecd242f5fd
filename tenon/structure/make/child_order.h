// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/layer/layer.h"

namespace tenon::structure {

/// The order of children that the structure composes to, whichever it was before, so that making
/// it again changes no byte: those that robot.usda names come first, because it is weaker than the
/// base, in which all of them stand.
void put_robot_order_first(layer::Layer& content);

/// Children that `like` has as well come first, in its order; then the others as they stand.
/// Layers that only add come behind what they are put over when they are composed.
void order_like(layer::Layer& content, const layer::Layer& like);

}  // namespace tenon::structure
