// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/convert/joints.h"
#include "tenon/convert/robot_layer.h"
#include "tenon/convert/shapes/shape_writer.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes tendons, actuators that are no drives, and keyframes. Actuators of what has no prim are
/// left out.
void write_mujoco_parts(const robot::MujocoParts& parts, const JointPrims& joints,
                        const ShapePrims& shapes, PhysicsScope& physics);

}  // namespace tenon::convert
