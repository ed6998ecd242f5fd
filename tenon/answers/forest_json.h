// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/answers/json.h"
#include "tenon/scene/joint_forest.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::answers {

/// The forest of a scene: {"links": [{"body", "parent", "joint", "jointType", "dofs", "mass_kg"}],
/// (body_count) in the order of the scene, "loopJoints": paths}. "dofs" counts what the joint
/// leaves free, 6 for a body that hangs on none and is not kinematic; "mass_kg" [kg].
Json forest_json(const scene::PhysicsScene& scene, const scene::JointForest& forest);

/// {"kinematicTree": that}.
Json kinematic_tree_json(const scene::PhysicsScene& scene, const scene::JointForest& forest);

}  // namespace tenon::answers
