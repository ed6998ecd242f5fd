// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/conversion.h"

namespace tenon::convert {

using robot::Index;

/// What makes the prim a robot: the root of one articulation, and its links and joints in kinematic
/// order.
void Conversion::write_robot_metadata() {
  std::vector<Path> links;
  std::vector<Path> joints;
  if (base_joint_) {
    joints.push_back(*base_joint_);
  }
  for (const Index link : tree_.order) {
    if (links_[link].role == LinkRole::Body) {
      links.push_back(links_[link].path);
    }
    if (const std::optional<Index> above = tree_.joint_to_parent[link];
        above && !joints_[*above].empty()) {
      joints.push_back(joints_[*above]);
    }
  }
  for (const Path joint : joints) {
    builder_.apply(joint, "IsaacJointAPI");
  }
  if (!joints.empty()) {
    builder_.apply(robot_, "PhysicsArticulationRootAPI");
  }
  builder_.apply(robot_, "IsaacRobotAPI");
  builder_.set_targets(robot_, "IsaacRobotAPI", "isaac:physics:robotLinks", std::move(links));
  builder_.set_targets(robot_, "IsaacRobotAPI", "isaac:physics:robotJoints", std::move(joints));
}

}  // namespace tenon::convert
