// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::watches {

/// What gravity exerts along each joint as bodies stand now, in the direction of its coordinate
/// [N m or N] (joint_count): the weight of all bodies that hang on the joint. Of revolute and
/// prismatic joints in trees that are fixed to the world or to a kinematic body; 0 for others.
std::vector<double> weight_loads(const engines::Simulation& simulation,
                                 const scene::PhysicsScene& scene);

}  // namespace tenon::watches
