// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/text/unique_names.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::describe {

/// Links and joints while they are made, where the links stand, and which prims they are of.
class RobotTree {
 public:
  /// A new link of a prim, or of none. `pose` is its place in the world, as on the stage, `in_body`
  /// its place in its body, or in the world where it has none [m].
  robot::Index add_link(Path prim, const std::string& name, const Pose& pose, const Pose& in_body);
  /// A new joint; its name gets a number where it is taken.
  robot::Index add_joint(robot::Joint joint);
  /// A joint without numbers, at the place where the links stand.
  robot::Index add_joint(robot::Index parent, robot::Index child, robot::JointKind kind);

  /// The link of a prim.
  std::optional<robot::Index> link_at(Path prim) const;
  /// The link of the nearest prim at or above one.
  std::optional<robot::Index> link_above(Path prim) const;
  /// The link of what stands still.
  std::optional<robot::Index> world() const { return world_; }
  void set_world(robot::Index link) { world_ = link; }

  const Pose& pose(robot::Index link) const { return poses_[link]; }
  const Pose& in_body(robot::Index link) const { return in_body_[link]; }

  std::vector<robot::Link>& links() { return links_; }
  std::vector<robot::Joint>& joints() { return joints_; }

 private:
  std::vector<robot::Link> links_;
  std::vector<robot::Joint> joints_;
  std::vector<Pose> poses_;    // (link_count)
  std::vector<Pose> in_body_;  // (link_count)
  std::map<Path, robot::Index> link_of_prim_;
  std::optional<robot::Index> world_;
  UniqueNames link_names_;
  UniqueNames joint_names_;
};

}  // namespace tenon::describe
