// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/answers/json.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::cli {

/// The forest of a scene as lines, one for each body, and one for each loop joint.
std::string forest_text(const scene::PhysicsScene& scene, const scene::JointForest& forest);

/// What answers::forest_as_json gives, as lines.
std::string forest_as_text(const answers::Json& forest);

}  // namespace tenon::cli
