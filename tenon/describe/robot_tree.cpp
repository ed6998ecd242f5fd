// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/describe/robot_tree.h"

namespace tenon::describe {

using robot::Index;

Index RobotTree::add_link(Path prim, const std::string& name, const Pose& pose,
                          const Pose& in_body) {
  const auto number = static_cast<Index>(links_.size());
  links_.emplace_back().name = link_names_.make(name);
  poses_.push_back(pose);
  in_body_.push_back(in_body);
  if (!prim.empty()) {
    link_of_prim_.emplace(prim, number);
  }
  return number;
}

Index RobotTree::add_joint(robot::Joint joint) {
  joint.name = joint_names_.make(joint.name);
  joints_.push_back(std::move(joint));
  return static_cast<Index>(joints_.size() - 1);
}

Index RobotTree::add_joint(Index parent, Index child, robot::JointKind kind) {
  robot::Joint joint;
  joint.parent = parent;
  joint.child = child;
  joint.kind = kind;
  joint.name = links_[child].name + "_joint";
  joint.origin = inverse(poses_[parent]) * poses_[child];
  return add_joint(std::move(joint));
}

std::optional<Index> RobotTree::link_at(Path prim) const {
  const auto at = link_of_prim_.find(prim);
  return at == link_of_prim_.end() ? std::nullopt : std::optional(at->second);
}

std::optional<Index> RobotTree::link_above(Path prim) const {
  for (Path at = prim; !at.empty() && !at.is_absolute_root(); at = at.parent()) {
    if (const std::optional<Index> found = link_at(at)) {
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace tenon::describe
