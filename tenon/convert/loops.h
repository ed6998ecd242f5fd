// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/convert/link_prims.h"
#include "tenon/convert/robot_layer.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes joints beside the tree: excluded from the articulation, soft as MuJoCo has them.
void write_loops(const std::vector<robot::LoopJoint>& loops, const LinkPrims& links,
                 PhysicsScope& physics);

}  // namespace tenon::convert
