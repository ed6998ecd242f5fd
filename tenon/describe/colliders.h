// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/describe/body_tree.h"
#include "tenon/describe/scene_source.h"

/// Internal to this folder.
namespace tenon::describe {

/// Adds the colliders of a scene to the links at or above them, and their meshes to `meshes`.
/// Reports what colliders of a robot cannot say.
void add_colliders(SceneSource& source, BodyTree& bodies, std::vector<robot::MeshFile>& meshes);

}  // namespace tenon::describe
