// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// Adds joints, so that the list stays sorted by path and everything that refers to a joint still
/// means the same one. What the new ones refer to is in `scene` already; they follow no joint.
/// -> their places, in the order of `joints`.
std::vector<Index> insert_joints(PhysicsScene& scene, std::vector<Joint> joints);

}  // namespace tenon::scene
