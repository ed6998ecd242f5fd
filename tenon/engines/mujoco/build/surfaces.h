// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "tenon/engines/mujoco/build/build.h"

/// Friction and restitution of contacts.
namespace tenon::engines::mujoco {

/// Gives every geom its own values and tabulates the averages of pairs (S-72). A collider without
/// material has friction 0.5 and restitution 0 (S-71). After add_geoms.
Surfaces add_surfaces(Build& build);

/// Direct solver reference {-stiffness, -damping} of a contact that rebounds with `restitution` of
/// the impact speed when stepped with `time_step`: damping found by running the one-dimensional
/// contact as MuJoCo integrates it.
std::array<double, 2> contact_solref(double restitution, double time_step);

/// Writes pair averages into the made contacts; true when any contact was changed.
bool apply_surfaces(const Surfaces& surfaces, mjData* data);

}  // namespace tenon::engines::mujoco
