// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/describe/robot_tree.h"
#include "tenon/describe/scene_source.h"

/// Internal to this folder.
namespace tenon::describe {

/// A camera or a light of the stage on a link at `link`, named by its path. Of lights: nothing for
/// a kind that robots do not have, which is reported.
robot::Camera read_camera(SceneSource& source, const stage::Prim& prim, const RobotTree& tree,
                          const Pose& link);
std::optional<robot::Light> read_light(SceneSource& source, const stage::Prim& prim,
                                       const RobotTree& tree, const Pose& link);

}  // namespace tenon::describe
