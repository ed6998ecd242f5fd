// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/layer/layer.h"

namespace tenon::structure {

/// A joint and the prims that it names.
struct JointEnds {
  Path joint;
  Path from;  ///< body0; empty for the world
  Path to;    ///< body1
};
/// Of all joints, as they stand in the content.
std::vector<JointEnds> joint_ends(const layer::Layer& content);

/// The bodies and joints of a robot in the order of its kinematic tree: each link before those that
/// its joints carry; joints and links that nothing orders as they stand in the content.
struct KinematicOrder {
  std::vector<Path> links;
  std::vector<Path> joints;
};
KinematicOrder kinematic_order(const layer::Layer& content);

/// Describes the robot as robot tools want it, where the content does not yet: IsaacRobotAPI with
/// the ordered links and joints on the default prim, IsaacLinkAPI and IsaacJointAPI on those that
/// are in the content.
void add_robot_metadata(layer::Layer& content, const KinematicOrder& order);

}  // namespace tenon::structure
