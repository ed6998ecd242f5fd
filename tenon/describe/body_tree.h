// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/describe/robot_tree.h"
#include "tenon/describe/scene_source.h"

/// Internal to this folder.
namespace tenon::describe {

/// The bodies of a scene as one tree of links.
struct BodyTree {
  RobotTree tree;
  std::vector<robot::Index> link_of_body;  ///< (body_count)
};

/// Links of all bodies and, where bodies hang on it, of the world; joints with all their numbers.
/// Reports joints that are in no tree.
BodyTree read_bodies(SceneSource& source);

}  // namespace tenon::describe
