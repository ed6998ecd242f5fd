// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/describe/robot_tree.h"
#include "tenon/describe/scene_source.h"

/// Internal to this folder.
namespace tenon::describe {

/// What visuals refer to.
struct Looks {
  std::vector<robot::MeshFile> meshes;
  std::vector<robot::Material> materials;
};

/// Adds the visuals of the stage to the links at or above them and, where the format has no sites,
/// links for sites. Reports visuals that the format does not support.
Looks add_visuals(SceneSource& source, RobotTree& tree);

}  // namespace tenon::describe
