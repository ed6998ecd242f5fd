// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/robot_metadata.h"

namespace tenon::convert {

using robot::Index;

void write_robot_metadata(const robot::KinematicTree& tree, const LinkPrims& link_prims,
                          const JointPrims& joint_prims, RobotLayer& layer) {
  LayerBuilder& builder = layer.builder();
  std::vector<Path> links;
  std::vector<Path> joints;
  if (joint_prims.base) {
    joints.push_back(*joint_prims.base);
  }
  for (const Index link : tree.order) {
    if (link_prims[link].role == LinkRole::Body) {
      links.push_back(link_prims[link].path);
    }
    if (const std::optional<Index> above = tree.joint_to_parent[link];
        above && !joint_prims.joints[*above].empty()) {
      joints.push_back(joint_prims.joints[*above]);
    }
  }
  for (const Path joint : joints) {
    builder.apply(joint, "IsaacJointAPI");
  }
  if (!joints.empty()) {
    builder.apply(layer.robot(), "PhysicsArticulationRootAPI");
  }
  builder.apply(layer.robot(), "IsaacRobotAPI");
  builder.set_targets(layer.robot(), "IsaacRobotAPI", "isaac:physics:robotLinks", std::move(links));
  builder.set_targets(layer.robot(), "IsaacRobotAPI", "isaac:physics:robotJoints",
                      std::move(joints));
}

}  // namespace tenon::convert
