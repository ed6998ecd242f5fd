// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/robot/robot_model.h"

namespace tenon::robot {

/// How the links of a model hang together.
struct KinematicTree {
  Index root = 0;  ///< the one link without a parent
  /// Links, each after its parent, children in the order of their joints, depth first.
  std::vector<Index> order;
  std::vector<std::optional<Index>> joint_to_parent;  ///< (link_count), into RobotModel::joints
  std::vector<std::vector<Index>> child_joints;       ///< (link_count)
};

/// The tree of a model. Errors (Invalid, with the line): no links, a link with two parents, links
/// in a cycle, more than one root; duplicate names of links or of joints.
Result<KinematicTree> kinematic_tree(const RobotModel& model);

/// Faults of a model whose tree is sound that can be fixed: numbers that are not finite, masses and
/// inertias that no body can have, zero axes, mimics in a cycle or of unfit joints, limits upside
/// down. Each finding goes to `diagnostics`, and what it names is made harmless: skipped or
/// unlimited, as its message says.
void sanitize_model(RobotModel& model, Diagnostics& diagnostics);

}  // namespace tenon::robot
