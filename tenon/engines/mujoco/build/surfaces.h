// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "tenon/engines/mujoco/build/build.h"

/// Friction and restitution of contacts.
namespace tenon::engines::mujoco {

/// Gives every geom the values of a contact with its like, and lists the kinds of surfaces (S-72).
/// A collider without material has friction 0.5 and restitution 0 (S-71). After add_geoms.
Surfaces add_surfaces(Build& build);

/// Direct solver reference {-stiffness, -damping} of a contact that rebounds with `restitution` of
/// the impact speed when stepped with `time_step`: damping found by running the one-dimensional
/// contact as MuJoCo integrates it.
std::array<double, 2> contact_solref(double restitution, double time_step);

/// Writes the values of pairs into the made contacts; true when any contact was changed.
bool apply_surfaces(Surfaces& surfaces, const mjModel* model, mjData* data);

/// Whether friction of a model is softened where surfaces slide.
bool softens_sliding(const mjModel& model);

/// Softens the friction of contacts that slide, so that they stay down: in MuJoCo's cones friction
/// that brakes hard also pushes apart. After apply_surfaces; true when any contact was changed.
bool soften_sliding(Surfaces& surfaces, const mjModel& model, mjData& data);

}  // namespace tenon::engines::mujoco
