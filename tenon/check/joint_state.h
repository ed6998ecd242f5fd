// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/physics/physics_scene.h"

namespace tenon::check {

/// Coordinate of a revolute or prismatic joint as the poses of its bodies have it [rad or m].
double coordinate_from_poses(const physics::PhysicsScene& scene, const physics::Joint& joint);
/// The authored start, else that of the poses.
double start_coordinate(const physics::PhysicsScene& scene, const physics::Joint& joint);

}  // namespace tenon::check
