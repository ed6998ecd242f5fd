// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/steering.h"
#include "tenon/scene/physics_scene.h"

/// The numbers of drives as they are at a time, for engines that are given them before each step.
namespace tenon::engines {

/// Joints whose drives follow samples, ascending.
std::vector<scene::Index> joints_with_tracks(const scene::PhysicsScene& scene);

/// The drives of a joint at `now` [s] with what samples say, and over it what the user has set.
std::vector<scene::Drive> drives_at(const scene::PhysicsScene& scene, scene::Index joint,
                                    const Steering& steering, double now);

}  // namespace tenon::engines
