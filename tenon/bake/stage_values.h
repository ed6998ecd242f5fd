// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

/// States in the units that a stage is authored in, so that they can be put back (S-35): stage
/// length units, degrees, seconds.
namespace tenon::bake {

/// Positions in stage units, orientation as is, angular velocity in degrees per second.
engines::BodyState in_stage_units(const engines::BodyState& state,
                                  const scene::PhysicsScene& scene);

/// Angular coordinates in degrees, linear ones in stage units.
engines::JointState in_stage_units(const engines::JointState& state, const scene::Joint& joint,
                                   const scene::PhysicsScene& scene);

inline void append(std::vector<double>& numbers, const Vec3d& v) {
  numbers.insert(numbers.end(), v.v.begin(), v.v.end());
}

}  // namespace tenon::bake
