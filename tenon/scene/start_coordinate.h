// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/scene/physics_scene.h"

namespace tenon::scene {

/// X_J0J1 as the poses of the bodies have it.
Pose relative_frames(const PhysicsScene& scene, const Joint& joint);
/// Coordinate of a revolute or prismatic joint as the poses of its bodies have it [rad or m].
double coordinate_from_poses(const PhysicsScene& scene, const Joint& joint);
/// The authored start, else that of the poses.
double start_coordinate(const PhysicsScene& scene, const Joint& joint);

}  // namespace tenon::scene
