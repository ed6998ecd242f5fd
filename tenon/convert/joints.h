// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/convert/link_prims.h"
#include "tenon/convert/robot_layer.h"

/// Internal to this folder.
namespace tenon::convert {

/// What joints are on the stage.
struct JointPrims {
  std::vector<Path> joints;                 ///< (joint_count), empty: no prim
  std::optional<Path> base;                 ///< the joint that holds the root in the world
  std::map<std::string, Path> actuators{};  ///< of drives, by the names that descriptions give
};

/// Writes joints with all their numbers, and actuators of their drives. Reports joints that are
/// none on the stage.
JointPrims write_joints(const Source& source, const LinkPrims& links, PhysicsScope& physics);

/// The type of the prim of a joint: "PhysicsRevoluteJoint".
const char* joint_type(robot::JointKind kind);

/// Writes what a joint holds at one side: `frame` of the joint in `body`, which is empty for the
/// world.
void write_side(LayerBuilder& builder, Path joint, int side, Path body, const Pose& frame);

/// The turn from the joint frame of UsdPhysics, whose axis is X, Y or Z, to that of `axis`, and the
/// token of that axis: no turn and exact ones where `axis` lies along a coordinate axis.
struct AxisTurn {
  const char* token = "X";
  Quatd rotation = kIdentityRotation;
};
AxisTurn axis_turn(const Vec3d& axis);

}  // namespace tenon::convert
