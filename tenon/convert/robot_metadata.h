// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/joints.h"
#include "tenon/convert/link_prims.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes what makes the prim a robot: the root of one articulation, and its links and joints in
/// kinematic order.
void write_robot_metadata(const Source& source, const LinkPrims& link_prims,
                          const JointPrims& joint_prims, RobotLayer& layer);

}  // namespace tenon::convert
