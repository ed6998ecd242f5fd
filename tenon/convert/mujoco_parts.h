// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "tenon/convert/joints.h"
#include "tenon/convert/robot_layer.h"
#include "tenon/convert/shapes/shape_writer.h"

/// Internal to this folder.
namespace tenon::convert {

/// By the names that the description gives.
struct MujocoPrims {
  std::map<std::string, Path> tendons;
  std::map<std::string, Path> actuators;  ///< those that are no drives
};

/// Writes tendons, actuators that are not drives, and keyframes. Actuators of objects without a
/// prim are skipped.
MujocoPrims write_mujoco_parts(const robot::MujocoParts& parts, const JointPrims& joints,
                               const ShapePrims& shapes, PhysicsScope& physics);

}  // namespace tenon::convert
