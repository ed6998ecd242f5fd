// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/simulation_values.h"

namespace tenon::engines::mujoco {

/// What the constant forces of a body (scene::BodyForce) come to where it is now, about its centre
/// of mass. Poses of the data must be those of now.
Wrench body_forces(const scene::Body& body, const BodyMap& map, const mjData& data);

}  // namespace tenon::engines::mujoco
